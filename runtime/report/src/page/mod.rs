//! The self-contained HTML page.

mod overview;
mod verdicts;

use super::plot::element::Element;
use super::plot::{COLOURS, file_name, style};
use super::table::{cost, error};
use super::text;
use super::{
    Cost, Curve, Fact, Kind, Measured, Measurements, MethodRecord, Outcome, Parameter,
    ProblemRecord, Scheme,
};

impl Measurements {
    /// The page in HTML: the fastest method for each problem; for each problem the times for the
    /// [targets](Self::targets), its plots, failures and all runs; the tables of [verdicts](Self::verdicts); the
    /// [limits](Self::limits) of stability; and the facts about the methods.
    ///
    /// It needs no other file and no network, and follows the reader's preference for a light or dark scheme. It is
    /// readable without its script, which brings a pale curve forward on a click.
    pub fn page(&self) -> String {
        let head = Element::new("head")
            .child(Element::new("meta").with("charset", "utf-8"))
            .child(
                Element::new("meta")
                    .with("name", "viewport")
                    .with("content", "width=device-width, initial-scale=1"),
            )
            .child(tag("title", &self.title))
            .child(Element::new("style").markup(format!(
                "\n{}{}",
                include_str!("page.css"),
                style(Scheme::Reader)
            )));
        // The overview links to the problems.
        let names = self.verdicts.iter().map(|table| &table.title);
        let links = names.map(|name| link(name, &file_name(name)));
        let limits = (!self.limits.is_empty()).then_some(&self.limits);
        let body = Element::new("body")
            .child(tag("h1", &self.title))
            .children(self.overview())
            .children(self.circumstances.iter().map(fact_line))
            .child(
                Element::new("nav")
                    .children(links)
                    .children(limits.map(|_| link(verdicts::LIMITS, verdicts::LIMITS_ID)))
                    .children(self.has_methods().then(|| link("The methods", METHODS_ID))),
            )
            .children(self.problems.iter().map(|problem| self.section(problem)))
            .children(self.verdicts.iter().map(verdicts::section))
            .children(limits.map(|limits| verdicts::limits_section(limits)))
            .children(self.has_methods().then(|| self.methods_section()))
            .child(Element::new("script").markup(include_str!("page.js")));
        let html = Element::new("html")
            .with("lang", "en")
            .child(head)
            .child(body);
        format!("<!DOCTYPE html>\n{html}\n")
    }

    const fn has_methods(&self) -> bool {
        !self.methods.is_empty()
    }

    fn section(&self, problem: &ProblemRecord) -> Element {
        let time = self.time_plot(problem).map(|plot| {
            Element::new("figure")
                .child(plot.inline())
                .child(self.caption(problem))
        });
        let more = [
            ("Evaluations against error", self.evaluations_plot(problem)),
            ("Error of the energy over time", self.energy_plot(problem)),
        ];
        let more = more.into_iter().filter_map(|(title, plot)| {
            let figure = Element::new("figure").child(plot?.inline());
            let summary = tag("summary", title);
            Some(Element::new("details").child(summary).child(figure))
        });
        let quiet = |words: String| tag("p", words).with("class", "quiet");
        let mut section = Element::new("section")
            .with("id", file_name(&problem.name))
            .child(tag("h2", &problem.name))
            .child(tag("p", &problem.description));
        if !problem.needs.is_empty() {
            section = section.child(quiet(format!("Needs: {}", problem.needs)));
        }
        section = section
            .child(quiet(format!(
                "{} positions, from time {} to {}. Reference: {}.",
                problem.dimension, problem.start, problem.end, problem.reference
            )))
            .child(self.times(problem))
            .children(time)
            .children(more);
        if let Some(failures) = failures(problem) {
            section = section.child(failures);
        }
        section.child(runs(problem))
    }

    /// The time of every method for every target.
    fn times(&self, problem: &ProblemRecord) -> Element {
        let header = ["fastest method for an error of".into()].into_iter();
        let header = header.chain(self.targets.iter().map(|target| error(*target)));
        let rows = self.ranked(problem).into_iter().map(|curve| {
            let cells = self.targets.iter().map(|target| {
                let found = curve.cost(*target);
                let cell = tag("td", cost(&found)).with("title", explain(curve, &found));
                let fastest = problem.fastest(*target);
                let is_fastest = fastest
                    .first()
                    .is_some_and(|(best, _)| best.method == curve.method);
                if is_fastest {
                    cell.with("class", "best")
                } else {
                    cell
                }
            });
            Element::new("tr")
                .with("data-method", &curve.method)
                .child(tag("td", &curve.method))
                .children(cells)
        });
        table("times", header, rows)
    }

    /// The names of the coloured methods.
    fn caption(&self, problem: &ProblemRecord) -> Element {
        let roles = self.roles(problem);
        let is_coloured = |curve: &&Curve| roles.iter().any(|(_, held)| *held == *curve);
        let pale = problem.curves.iter().filter(|curve| !is_coloured(curve));
        let all_coloured = problem.curves.len() <= COLOURS;
        let pale = (!all_coloured).then(|| {
            format!(
                "{} more in grey, with numbers; a click on a curve or on a row of the table brings it forward.",
                pale.count()
            )
        });
        let named = roles.iter().map(|(role, curve)| {
            Element::new("span")
                .text(format!("{}: ", role.name()))
                .child(tag("b", &curve.method))
        });
        Element::new("figcaption")
            .children(named)
            .children(pale.map(|words| tag("span", words)))
    }

    fn methods_section(&self) -> Element {
        // A column for each fact of any method.
        let mut names: Vec<&str> = Vec::new();
        for fact in self.methods.iter().flat_map(|method| &method.facts) {
            if !names.contains(&fact.name.as_str()) {
                names.push(&fact.name);
            }
        }
        let header = ["method", "kind", "stages"]
            .into_iter()
            .chain(names.iter().copied());
        let header = header.chain(["definition"]).map(String::from);
        let rows = self.methods.iter().map(|method| method_row(method, &names));
        Element::new("section")
            .with("id", METHODS_ID)
            .child(tag("h2", "The methods"))
            .child(table("scroll", header, rows))
    }
}

const METHODS_ID: &str = "the-methods";

fn method_row(method: &MethodRecord, names: &[&str]) -> Element {
    let kind = match method.kind {
        Kind::Explicit => "explicit",
        Kind::Implicit => "implicit",
        Kind::Peer => "other",
    };
    let stages = method
        .stages
        .map_or_else(String::new, |stages| stages.to_string());
    let facts = names.iter().map(|name| {
        let fact = method.facts.iter().find(|fact| fact.name == *name);
        tag("td", fact.map_or("", |fact| &fact.value)).with("class", "words")
    });
    let definition = tag("code", method.definition.as_deref().unwrap_or("–"));
    Element::new("tr")
        .child(tag("td", &method.name))
        .child(tag("td", kind))
        .child(tag("td", stages))
        .children(facts)
        .child(Element::new("td").with("class", "words").child(definition))
}

/// The explanation of a time.
fn explain(curve: &Curve, found: &Cost) -> String {
    match found {
        Cost::Between { .. } => "interpolated between two runs".into(),
        Cost::AtMost { .. } => "the first run; none is less accurate".into(),
        Cost::NotReached { best } if curve.is_cut() => {
            let best = text::scientific(*best);
            format!("not reached within the budget; the best error is {best}")
        }
        Cost::NotReached { best } => {
            format!("not reached; the best error is {}", text::scientific(*best))
        }
        Cost::NoRun => "no run reached the end".into(),
    }
}

/// The runs that failed or were skipped.
fn failures(problem: &ProblemRecord) -> Option<Element> {
    let mut rows = Vec::new();
    for curve in &problem.curves {
        for point in &curve.points {
            let (what, why) = match &point.outcome {
                Outcome::Measured(_) => continue,
                Outcome::Failed { error } => ("failed", error),
                Outcome::Skipped { reason } => ("skipped", reason),
            };
            rows.push(
                Element::new("tr")
                    .child(tag("td", &curve.method))
                    .child(tag("td", parameter(curve.parameter, point.parameter)))
                    .child(tag("td", what))
                    .child(tag("td", why).with("class", "words")),
            );
        }
    }
    let summary = format!("{} runs failed or were skipped", rows.len());
    let header = ["method", "run", "", "why"].map(String::from).into_iter();
    (!rows.is_empty()).then(|| {
        Element::new("details")
            .child(tag("summary", summary))
            .child(table("scroll", header, rows.into_iter()))
    })
}

/// All runs that reached the end.
fn runs(problem: &ProblemRecord) -> Element {
    let fixed = [
        "method",
        "run",
        "steps",
        "evaluations",
        "iterations (most)",
        "CPU time",
        "error",
        "energy error",
    ];
    let header = fixed.into_iter().map(String::from);
    let header = header.chain(
        problem
            .invariants
            .iter()
            .map(|name| format!("deviation of {name}")),
    );
    let mut count = 0;
    let mut rows = Vec::new();
    for curve in &problem.curves {
        for (value, run) in curve.measured() {
            count += 1;
            rows.push(run_row(curve, value, run));
        }
    }
    Element::new("details")
        .child(tag("summary", format!("All {count} completed runs")))
        .child(table("scroll", header, rows.into_iter()))
}

fn run_row(curve: &Curve, value: f64, run: &Measured) -> Element {
    let number = |value: Option<f64>| value.map_or_else(|| "–".into(), text::scientific);
    let iterations = match run.most_iterations {
        0 => "–".into(),
        most => format!("{:.1} ({most})", run.mean_iterations),
    };
    let cells = [
        parameter(curve.parameter, value),
        run.steps.map_or_else(|| "–".into(), text::grouped),
        text::grouped(run.evaluations),
        iterations,
        text::seconds(run.seconds),
        text::scientific(run.error),
        number(run.energy_error),
    ];
    let drifts = run.drifts.iter().map(|drift| number(*drift));
    Element::new("tr")
        .child(tag("td", &curve.method))
        .children(cells.into_iter().chain(drifts).map(|cell| tag("td", cell)))
}

fn parameter(kind: Parameter, value: f64) -> String {
    match kind {
        Parameter::StepSize => format!("h = {}", text::scientific(value)),
        Parameter::Tolerance => format!("tol = {}", text::scientific(value)),
    }
}

fn table(
    class: &str,
    header: impl Iterator<Item = String>,
    rows: impl Iterator<Item = Element>,
) -> Element {
    let header = Element::new("tr").children(header.map(|name| tag("th", name)));
    let table = Element::new("table")
        .child(Element::new("thead").child(header))
        .child(Element::new("tbody").children(rows));
    Element::new("div").with("class", class).child(table)
}

fn fact_line(fact: &Fact) -> Element {
    tag("p", format!("{}: {}", fact.name, fact.value)).with("class", "quiet")
}

fn link(words: &str, id: &str) -> Element {
    tag("a", words).with("href", format!("#{id}"))
}

fn tag(name: &'static str, words: impl Into<String>) -> Element {
    Element::new(name).text(words)
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::tests::measurements;

    #[test]
    fn the_page_is_well_formed_and_needs_nothing_from_elsewhere() {
        let page = measurements().page();
        // Except for its first line, this page is also valid XML.
        let xml = page.strip_prefix("<!DOCTYPE html>\n").expect("it is HTML");
        let document = roxmltree::Document::parse(xml).expect("every element is closed");
        let count = |name: &str| {
            document
                .descendants()
                .filter(|node| node.tag_name().name() == name)
                .count()
        };
        assert_eq!(count("svg"), 3);
        assert_eq!((count("script"), count("link"), count("img")), (1, 0, 0));
        let without_namespace = page.replace("http://www.w3.org/2000/svg", "");
        assert!(
            !without_namespace.contains("http")
                && !page.contains("@import")
                && !page.contains("url(")
        );
        assert!(page.contains("prefers-color-scheme: dark"));
    }

    #[test]
    fn tables_come_before_plots() {
        let page = measurements().page();
        let at = |words: &str| page.find(words).expect(words);
        let order = [
            "<table class=\"overview\"",
            "<nav",
            "<div class=\"times\"",
            "<svg",
        ];
        assert!(order.map(at).is_sorted());
        assert!(page.contains("<th><a href=\"#kepler-co\">Kepler &amp; co</a></th>"));
    }

    #[test]
    fn methods_without_a_role_are_pale_and_can_be_brought_forward() {
        let mut found = measurements();
        assert!(!found.page().contains("curve pale") && !found.page().contains("more in grey"));
        for (count, name) in ["Gauss 2", "A", "B", "C", "D", "E"].into_iter().enumerate() {
            // Up to eight curves each have a colour.
            assert!(!found.page().contains("curve pale"), "{count}");
            let slower = crate::tests::curve(name, &[(1e-2, 1e-2), (1e-4, 1e-1)]);
            found.problems[0].curves.push(slower);
            let mut record = found.methods[1].clone();
            record.name = name.into();
            found.methods.push(record);
        }
        let page = found.page();
        // Once in each of the plots of time, evaluations and energy.
        let pale = "<g class=\"curve pale\" data-method=\"Gauss 2\">";
        assert_eq!(page.matches(pale).count(), 3);
        assert!(page.contains("<tr data-method=\"Gauss 2\">") && page.contains("6 more in grey"));
        // In print they are known by their numbers.
        let key = "1 Gauss 2  ·  2 A  ·  3 B  ·  4 C  ·  5 D  ·  6 E";
        assert_eq!(page.matches(key).count(), 3, "{page}");
        assert!(page.contains("best implicit: <b>Gauss 4</b>"), "{page}");
    }

    #[test]
    fn the_page_shows_failed_runs_with_their_errors() {
        let page = measurements().page();
        assert!(page.contains("2 runs failed or were skipped"), "{page}");
        assert!(page.contains("the stages did not converge, &quot;so&quot; &lt;it&gt; says"));
        assert!(page.contains("it would take about 1 s"));
        assert!(page.contains("4, proved"));
    }

    #[test]
    fn verdicts_are_words_with_signs() {
        let page = measurements().page();
        for words in [
            "<b>● accurate</b><span>2.0·10⁻⁵</span>",
            "<b>▲ unstable</b><span>12 steps</span><i>as proved</i>",
            "<b>◐ bounded</b><span>0.25</span><i>not as proved</i>",
            "<b>■ no convergence</b></td>",
            "title=\"stopped: step 1 of size 1 did not converge\"",
            "href=\"#stiff-extreme\"",
            "<td>2.00000</td><td>2.00002</td><td>1.0·10⁻⁵</td>",
        ] {
            assert!(page.contains(words), "{words} in {page}");
        }
        // A row for the fact, and a dash for a method without it.
        assert!(page.contains("<th>stable for hω in</th><td>(0, 2)</td><td>–</td>"));
    }

    #[test]
    fn sections_without_contents_are_left_out() {
        let empty = Measurements::default().page();
        assert!(
            !empty.contains("<table") && !empty.contains("<section"),
            "{empty}"
        );
    }

    #[test]
    fn the_fastest_is_marked_and_only_it() {
        let page = measurements().page();
        // One for each target that is reached.
        assert_eq!(page.matches("class=\"best\"").count(), 4);
        assert!(page.contains("not reached within the budget; the best error is 1.0·10⁻⁴"));
    }
}
