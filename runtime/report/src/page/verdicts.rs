//! Tables of verdicts and of limits of stability on the page.

use super::{table, tag};
use crate::plot::element::Element;
use crate::plot::file_name;
use crate::{Cause, Cell, Fact, StabilityLimit, Verdict, Verdicts, text};

/// The appearance of a kind of verdict: CSS class, symbol, word.
type Kind = (&'static str, &'static str, &'static str);

const ACCURATE: Kind = ("accurate", "●", "accurate");
const BOUNDED: Kind = ("bounded", "◐", "bounded");
const UNSTABLE: Kind = ("unstable", "▲", "unstable");

const fn kind(verdict: &Verdict) -> Kind {
    match verdict {
        Verdict::Accurate { .. } => ACCURATE,
        Verdict::Bounded { .. } => BOUNDED,
        Verdict::Unstable { .. } => UNSTABLE,
        Verdict::Stopped { cause, .. } => (
            "stopped",
            "■",
            match cause {
                Cause::NoConvergence => "no convergence",
                Cause::NonFinite => "not finite",
                Cause::SingularMatrix => "singular",
                Cause::Other => "stopped",
            },
        ),
    }
}

/// The number next to the word.
fn number(verdict: &Verdict) -> String {
    match verdict {
        Verdict::Accurate { error } | Verdict::Bounded { error, .. } => text::scientific(*error),
        Verdict::Unstable { steps: 1 } => "1 step".into(),
        Verdict::Unstable { steps } => format!("{} steps", text::grouped(*steps)),
        Verdict::Stopped { .. } => String::new(),
    }
}

/// A section with a table of verdicts and its key.
pub(super) fn section(verdicts: &Verdicts) -> Element {
    let methods = verdicts.columns.iter().map(|column| column.method.clone());
    let header = ["problem".into()].into_iter().chain(methods);
    let rows = verdicts.rows.iter().map(|row| {
        // Missing cells at the end of a row were not run.
        let missing = verdicts.columns.len().saturating_sub(row.cells.len());
        let missing = (0..missing).map(|_| None);
        let cells = row.cells.iter().map(Option::as_ref).chain(missing);
        Element::new("tr")
            .child(tag("th", &row.problem))
            .children(cells.map(cell))
    });
    let rows = fact_rows(verdicts).into_iter().chain(rows);
    Element::new("section")
        .with("id", file_name(&verdicts.title))
        .with("class", "verdicts")
        .child(tag("h2", &verdicts.title))
        .child(tag("p", &verdicts.description))
        .child(key())
        .child(table("scroll", header, rows))
}

/// A row for each fact of any method.
fn fact_rows(verdicts: &Verdicts) -> Vec<Element> {
    let mut names: Vec<&str> = Vec::new();
    for Fact { name, .. } in verdicts.columns.iter().flat_map(|column| &column.facts) {
        if !names.contains(&name.as_str()) {
            names.push(name);
        }
    }
    let row = |name: &str| {
        let values = verdicts.columns.iter().map(|column| {
            let fact = column.facts.iter().find(|fact| fact.name == name);
            tag("td", fact.map_or("–", |fact| &fact.value))
        });
        let name = tag("th", name);
        Element::new("tr")
            .with("class", "quiet")
            .child(name)
            .children(values)
    };
    names.into_iter().map(row).collect()
}

fn cell(cell: Option<&Cell>) -> Element {
    let Some(found) = cell else {
        return tag("td", "–").with("class", "quiet");
    };
    let (class, sign, word) = kind(&found.verdict);
    let mut words = found.verdict.to_string();
    let mut element = Element::new("td").child(tag("b", format!("{sign} {word}")));
    let number = number(&found.verdict);
    if !number.is_empty() {
        element = element.child(tag("span", number));
    }
    match found.is_as_proved() {
        Some(true) => {
            words += "; as it is proved";
            element = element.child(tag("i", "as proved"));
        }
        Some(false) => {
            words += "; the contrary is proved";
            element = element.child(tag("i", "not as proved"));
        }
        None => {}
    }
    element.with("class", class).with("title", words)
}

/// The key of symbols and words.
fn key() -> Element {
    let stopped = ("stopped", "■", "no convergence, not finite, singular");
    let entries = [
        (
            ACCURATE,
            format!(
                "all steps, with a relative error of at most {}",
                text::scientific(Verdict::ACCURATE)
            ),
        ),
        (
            BOUNDED,
            "all steps, and the energy stays bounded, but the error is larger".into(),
        ),
        (
            UNSTABLE,
            format!(
                "the energy is wrong by a factor of more than {}",
                text::scientific(Verdict::GROWTH)
            ),
        ),
        (
            stopped,
            "a step was refused with an error and the state left as it was".into(),
        ),
    ];
    let entry = |((class, sign, word), meaning): (Kind, String)| {
        Element::new("li")
            .child(tag("b", format!("{sign} {word}")).with("class", class))
            .child(tag("span", meaning))
    };
    Element::new("ul")
        .with("class", "key")
        .children(entries.into_iter().map(entry))
}

/// A section with the limits of stability of all methods.
pub(super) fn limits_section(limits: &[StabilityLimit]) -> Element {
    let header = ["method", "proved: hω <", "measured", "apart by"].map(String::from);
    let rows = limits.iter().map(|limit| {
        let digits = |value: f64| format!("{value:.5}");
        Element::new("tr")
            .child(tag("td", &limit.method))
            .child(tag("td", digits(limit.proved)))
            .child(tag("td", digits(limit.measured)))
            .child(tag("td", text::scientific(limit.deviation())))
    });
    let largest = limits.iter().map(StabilityLimit::deviation);
    let largest = largest.fold(0.0, f64::max);
    let summary = format!(
        "{} methods; the measured limit is apart from the proved one by at most {}, relative",
        limits.len(),
        text::scientific(largest)
    );
    Element::new("section")
        .with("id", LIMITS_ID)
        .child(tag("h2", LIMITS))
        .child(tag("p", "The oscillator is stable with steps below hω, up to the first at which the powers of the matrix of a step grow: \
            as the compiler proves it, and as bisection finds it with doubles. Behind the limit there may be more intervals."))
        .child(
            Element::new("details")
                .child(tag("summary", summary))
                .child(table("scroll", header.into_iter(), rows)),
        )
}

/// The title of the section with limits.
pub(super) const LIMITS: &str = "Limits of stability, proved and measured";

/// The anchor of the section with limits.
pub(super) const LIMITS_ID: &str = "limits-of-stability";
