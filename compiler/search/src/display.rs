//! What the command prints.

use std::time::Duration;

use indicatif::{ProgressBar, ProgressDrawTarget, ProgressStyle};
use symplectic_compiler::order::HamiltonianClass;
use symplectic_terminal::aligned;

use crate::hunt::{Problem, Progress, Solution};
use crate::proof::Method;
use crate::trial::{Known, Trial, class_name};

/// The solutions of a table on the terminal.
const SHOWN: usize = 8;

/// The table of the best solutions so far, on a terminal.
pub(crate) struct Live(ProgressBar);

impl Live {
    pub(crate) fn new() -> Self {
        let bar = ProgressBar::with_draw_target(None, ProgressDrawTarget::stderr_with_hz(5));
        // The template has no parts that could be wrong.
        if let Ok(style) = ProgressStyle::with_template("{msg}") {
            bar.set_style(style);
        }
        Live(bar)
    }

    pub(crate) fn show(&self, problem: &Problem, progress: &Progress, elapsed: Duration) {
        if self.0.is_hidden() {
            return;
        }
        let Progress { starts, solved, .. } = progress;
        let time = elapsed.as_secs();
        let head =
            format!("{starts} starts, {solved} solutions, {time} s; Ctrl-C ends the search\n");
        self.0
            .set_message(head + &table(problem, &progress.solutions));
    }

    pub(crate) fn finish(&self) {
        self.0.finish_and_clear();
    }
}

/// The best solutions.
fn table(problem: &Problem, solutions: &[Solution]) -> String {
    let head = [
        "figure",
        "efficiency",
        "largest",
        "stable hω a kick",
        "found",
        "",
    ];
    let mut rows = vec![head.map(str::to_owned)];
    rows.extend(solutions.iter().take(SHOWN).map(|solution| {
        [
            format!("{:.4e}", solution.error),
            format!("{:.4}", problem.efficiency(solution.error)),
            format!("{:.3}", solution.largest()),
            format!("{:.3}", solution.stable),
            solution.found.to_string(),
            remark(solution).to_owned(),
        ]
    }));
    aligned(&rows)
}

fn remark(solution: &Solution) -> &'static str {
    match (solution.is_minimum, solution.is_at_bound) {
        (_, true) => "a coefficient is at its bound",
        (false, false) => "not yet a minimum",
        (true, false) => "",
    }
}

/// What was searched, and how.
pub(crate) fn summary(problem: &Problem, progress: &Progress) -> String {
    let Progress {
        starts,
        solved,
        conditions,
        unknowns,
        ..
    } = progress;
    let free = match progress.free {
        Some(0) => "solutions are isolated".to_owned(),
        Some(1) => "1 free parameter".to_owned(),
        Some(free) => format!("{free} free parameters"),
        None => String::new(),
    };
    format!(
        "{}: {conditions} conditions, {unknowns} unknowns, {free}.\n\
         {starts} starts with the seed {} led to {solved} solutions, {} of them different.\n\
         Efficiency: s C^(1/p), the force evaluations in a unit of time for an error of 1, with the error constant C; fewer are better.\n\n{}\n",
        capitalised(&problem.text()),
        progress.seed,
        progress.solutions.len(),
        table(problem, &progress.solutions)
    )
}

fn capitalised(text: &str) -> String {
    let mut letters = text.chars();
    letters.next().map_or_else(String::new, |first| {
        first.to_uppercase().chain(letters).collect()
    })
}

/// What to say where nothing was found.
pub(crate) fn nothing(problem: &Problem, progress: &Progress) -> String {
    let Progress {
        starts,
        solved,
        conditions,
        unknowns,
        ..
    } = progress;
    let why = if *solved > 0 {
        format!(
            "none of the {solved} solutions is stable up to hω = {} a kick",
            problem.at_least_stable
        )
    } else if conditions > unknowns {
        format!("there are {conditions} conditions for {unknowns} unknowns: take more kicks")
    } else {
        format!(
            "{conditions} conditions for {unknowns} unknowns may have no real solution: take more kicks, or more starts"
        )
    };
    format!(
        "{}: nothing found from {starts} starts; {why}.\n",
        capitalised(&problem.text())
    )
}

/// The name of a method in files.
pub(crate) fn name(problem: &Problem, number: usize) -> String {
    let (_, order) = problem.compared_in();
    let order = match &problem.claim {
        symplectic_compiler::certify::Claim::Perturbed(orders) => {
            let orders: Vec<String> = orders.iter().map(usize::to_string).collect();
            orders.join("-")
        }
        _ => order.to_string(),
    };
    format!(
        "{}-{order}-{}-{}-{number}",
        class_name(problem),
        problem.structure.name(),
        problem.kicks
    )
}

/// A proved method.
pub(crate) fn method(
    problem: &Problem,
    number: usize,
    solution: &Solution,
    method: &Method,
) -> String {
    let report = method.tableau.orders();
    let orders = [HamiltonianClass::Separable, HamiltonianClass::Nystrom].map(|class| {
        let found = report.class(class);
        let at_least = if found.refuted_by.is_none() {
            "at least "
        } else {
            ""
        };
        format!("{at_least}{} for {class} H", found.order)
    });
    let perturbed = method
        .tableau
        .perturbed_order()
        .map_or_else(String::new, |found| {
            format!(", {} for perturbed H", found.numbers())
        });
    let free = match method.free.len() {
        0 => "no free parameters",
        _ => "free parameters at short decimals",
    };
    format!(
        "{number}. Proved: order {}{perturbed}; {}symplectic; {free}.\n   Error constant {:.6e}, efficiency {:.4}; largest coefficient {:.3}; stable for hω in {}.\n   {}\n\n",
        orders.join(", "),
        if method.tableau.separable_properties().symmetric.holds {
            "symmetric, "
        } else {
            ""
        },
        method.error,
        problem.efficiency(method.error),
        solution.largest(),
        method.tableau.stable_steps(),
        method.definition
    )
}

/// The efficiencies of the methods beside those of the catalogue.
pub(crate) fn beside_the_catalogue(
    problem: &Problem,
    methods: &[Method],
    known: &[Known],
) -> String {
    const KNOWN: usize = 4;
    let row = |name: String, error: f64, efficiency: f64| {
        [name, format!("{error:.4e}"), format!("{efficiency:.4}")]
    };
    let mut rows = vec![["method", "error constant", "efficiency"].map(str::to_owned)];
    rows.extend((1..).zip(methods).map(|(number, method)| {
        row(
            number.to_string(),
            method.error,
            problem.efficiency(method.error),
        )
    }));
    rows.extend(
        known
            .iter()
            .take(KNOWN)
            .map(|known| row(known.name.clone(), known.error, known.efficiency)),
    );
    let title = match known.is_empty() {
        true => "The catalogue has no method of this class and order.",
        false => "Beside the most efficient methods of the catalogue of this class and order:",
    };
    format!("{title}\n\n{}", aligned(&rows))
}

/// Errors of methods, for each scene at several costs.
type Errors = Vec<Vec<f64>>;

/// Ratios of errors at equal cost on all scenes: to the most efficient method of the catalogue, and to the one that is best on the scene.
pub(crate) fn trial(trial: &Trial, own: &[Errors], others: &[(&str, Errors)]) -> String {
    let Some((first, _)) = others.first() else {
        return String::new();
    };
    let names: Vec<&str> = others.iter().map(|(name, _)| *name).collect();
    let text = format!(
        "\nErrors at equal cost in long runs, divided by those of {first}, the most efficient method of the catalogue, and by those of the \
         best one on the scene out of {}: geometric means over all costs. Below 1 the method found is better.\n",
        names.join(", ")
    );
    let mut overview = vec![
        [
            "method",
            "better than the first",
            "largest ratio",
            "better than all",
            "largest ratio",
        ]
        .map(str::to_owned),
    ];
    let mut details = String::new();
    for (number, own) in (1..).zip(own) {
        let ratios: Vec<(&str, Vec<f64>)> = others
            .iter()
            .map(|(name, other)| {
                let comparisons = trial.compare(own, other);
                (
                    *name,
                    comparisons
                        .iter()
                        .map(|c| c.ratio().unwrap_or(f64::NAN))
                        .collect(),
                )
            })
            .collect();
        let hardest: Vec<(&str, f64)> = (0..trial.scenes().len())
            .filter_map(|scene| {
                let all = ratios.iter().map(|(name, ratios)| (*name, ratios[scene]));
                all.filter(|(_, ratio)| !ratio.is_nan())
                    .max_by(|(_, x), (_, y)| x.total_cmp(y))
            })
            .collect();
        let of_first = &ratios[0].1;
        let hard: Vec<f64> = hardest.iter().map(|(_, ratio)| *ratio).collect();
        let better = |ratios: &[f64]| {
            let count = ratios.iter().filter(|ratio| **ratio < 1.0).count();
            format!("on {count} of {} scenes", ratios.len())
        };
        let largest = |ratios: &[f64]| format!("{:.3}", ratios.iter().copied().fold(0.0, f64::max));
        overview.push([
            number.to_string(),
            better(of_first),
            largest(of_first),
            better(&hard),
            largest(&hard),
        ]);
        details.push_str(&format!("\nMethod {number}\n\n"));
        let mut rows =
            vec![["scene", first, "best on the scene", "ratio to it"].map(str::to_owned)];
        let scenes = trial.scenes().into_iter().zip(of_first).zip(&hardest);
        rows.extend(scenes.map(|((scene, ratio), (name, hard))| {
            [
                scene.to_owned(),
                format!("{ratio:.3}"),
                (*name).to_owned(),
                format!("{hard:.3}"),
            ]
        }));
        details.push_str(&aligned(&rows));
    }
    format!("{text}\n{}{details}", aligned(&overview))
}
