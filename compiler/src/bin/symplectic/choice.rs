//! Choosing among the methods of the catalogue: `symplectic list --class separable --min-order 4 --sort efficiency`.

use std::cmp::Ordering;

use clap::{Args, ValueEnum};
use symplectic_compiler::order::HamiltonianClass;
use symplectic_compiler::{Error, Evidence, Tableau, catalogue};

use crate::list::aligned;

/// Which methods are listed, and in what order.
#[derive(Args)]
pub(crate) struct Choice {
    /// The Hamiltonians that orders and errors are for [default: separable].
    #[arg(long, value_enum)]
    class: Option<Class>,
    /// Methods of at least this order.
    #[arg(long, value_name = "P")]
    min_order: Option<usize>,
    /// Methods of at most this order.
    #[arg(long, value_name = "P")]
    max_order: Option<usize>,
    /// Explicit methods with at most so many force evaluations a step.
    #[arg(long, value_name = "N")]
    max_evaluations: Option<usize>,
    /// The order of the methods. Efficiency is n (C/E)^(1/p), the force evaluations in a unit of time for an error of E
    /// (`--tolerance`) from n evaluations a step, the error constant C and the order p: few are good.
    #[arg(long, value_enum, value_name = "BY")]
    sort: Option<Sort>,
    /// The error at which efficiency is compared [default: 1e-8].
    #[arg(long, value_name = "E", allow_hyphen_values = true, value_parser = tolerance)]
    tolerance: Option<f64>,
}

#[derive(Debug, Clone, Copy, PartialEq, Eq, ValueEnum)]
enum Class {
    /// Every H(q, p).
    General,
    /// H = T(p) + U(q).
    Separable,
    /// H = p²/2m + U(q).
    Nystrom,
}

impl From<Class> for HamiltonianClass {
    fn from(class: Class) -> Self {
        match class {
            Class::General => HamiltonianClass::General,
            Class::Separable => HamiltonianClass::Separable,
            Class::Nystrom => HamiltonianClass::Nystrom,
        }
    }
}

#[derive(Debug, Clone, Copy, PartialEq, Eq, ValueEnum)]
enum Sort {
    /// By name.
    Name,
    /// The highest order first.
    Order,
    /// The fewest evaluations first.
    Evaluations,
    /// The smallest error constant first.
    Error,
    /// The fewest evaluations for the tolerance first.
    Efficiency,
}

fn tolerance(text: &str) -> Result<f64, String> {
    let value = text
        .parse()
        .ok()
        .filter(|value: &f64| value.is_normal() && *value > 0.0);
    value.ok_or_else(|| "expected a positive number such as 1e-8".to_owned())
}

impl Choice {
    /// Whether anything is asked for.
    pub(crate) fn is_made(&self) -> bool {
        let limits = [self.min_order, self.max_order, self.max_evaluations];
        self.class.is_some()
            || self.sort.is_some()
            || self.tolerance.is_some()
            || limits.iter().any(Option::is_some)
    }

    /// Whether a method evaluates seldom enough; the first question, because orders take longer.
    fn takes_evaluations(&self, forces: Option<usize>) -> bool {
        let forces = forces.unwrap_or(usize::MAX);
        self.max_evaluations.is_none_or(|most| forces <= most)
    }

    fn takes_order(&self, order: usize) -> bool {
        self.min_order.is_none_or(|least| order >= least)
            && self.max_order.is_none_or(|most| order <= most)
    }
}

/// What methods are compared by.
struct Method {
    name: String,
    title: String,
    order: usize,
    /// What is known of the order: proved, or verified; of that order or more.
    evidence: String,
    /// Force evaluations a step; `None` for methods that solve for their stages.
    forces: Option<usize>,
    error_constant: Option<f64>,
    cost: Option<f64>,
}

impl Method {
    fn new(
        entry: catalogue::Entry,
        tableau: &Tableau,
        class: HamiltonianClass,
        tolerance: f64,
    ) -> Self {
        let report = tableau.orders();
        let found = report.class(class);
        let known = match found.evidence {
            Evidence::Verified { .. } => "verified",
            Evidence::Certified => "certified",
            Evidence::Proved | Evidence::Refuted => "proved",
        };
        let at_least = if found.refuted_by.is_none() {
            "≥, "
        } else {
            ""
        };
        // A decimal in the notation of doubles.
        let constant = found.error_constant.as_ref().map(ToString::to_string);
        Method {
            name: entry.name,
            title: entry.title,
            order: found.order,
            evidence: format!("{at_least}{known}"),
            forces: tableau.evaluations().map(|evaluations| evaluations.forces),
            error_constant: constant.and_then(|constant| constant.parse().ok()),
            cost: tableau.evaluations_for(class, tolerance),
        }
    }

    fn row(self) -> [String; 7] {
        let or_dash = |text: Option<String>| text.unwrap_or_else(|| "–".to_owned());
        [
            self.name,
            self.order.to_string(),
            self.evidence,
            or_dash(self.forces.map(|forces| forces.to_string())),
            or_dash(
                self.error_constant
                    .map(|constant| format!("{constant:.3e}")),
            ),
            or_dash(self.cost.map(|cost| format!("{cost:.1}"))),
            self.title,
        ]
    }
}

/// The methods that are asked for, with what they are compared by.
pub(crate) fn table(choice: &Choice) -> Result<String, Error> {
    let class = choice
        .class
        .map_or(HamiltonianClass::Separable, HamiltonianClass::from);
    let tolerance = choice.tolerance.unwrap_or(1e-8);
    let mut methods = Vec::new();
    for entry in catalogue::entries() {
        let tableau = entry.derive()?;
        let forces = tableau.evaluations().map(|evaluations| evaluations.forces);
        if choice.takes_evaluations(forces) {
            let method = Method::new(entry, &tableau, class, tolerance);
            if choice.takes_order(method.order) {
                methods.push(method);
            }
        }
    }
    // What is not known comes last.
    let smaller = |x: Option<f64>, y: Option<f64>| {
        let [x, y] = [x, y].map(|value| value.unwrap_or(f64::INFINITY));
        x.total_cmp(&y)
    };
    match choice.sort {
        None => {}
        Some(Sort::Name) => methods.sort_by(|x, y| x.name.cmp(&y.name)),
        Some(Sort::Order) => methods.sort_by_key(|method| std::cmp::Reverse(method.order)),
        Some(Sort::Evaluations) => {
            methods.sort_by_key(|method| method.forces.unwrap_or(usize::MAX));
        }
        Some(Sort::Error) => methods.sort_by(|x, y| {
            // Error constants compare within one order.
            let orders: Ordering = y.order.cmp(&x.order);
            orders.then(smaller(x.error_constant, y.error_constant))
        }),
        Some(Sort::Efficiency) => methods.sort_by(|x, y| smaller(x.cost, y.cost)),
    }
    let cost = format!("cost at {tolerance:e}");
    let mut rows = vec![
        [
            "name",
            "order",
            "",
            "forces",
            "error constant",
            &cost,
            "title",
        ]
        .map(str::to_owned),
    ];
    rows.extend(methods.into_iter().map(Method::row));
    let mut text = format!(
        "Methods for {class} H. Forces: evaluations a step, of methods that are explicit for separable H.\n\
         Cost: evaluations in a unit of time for an error of {tolerance:e}, forces × (error constant / error)^(1/order).\n\n"
    );
    text.push_str(&aligned(&rows));
    Ok(text)
}
