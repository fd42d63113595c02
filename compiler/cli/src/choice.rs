//! Selection of methods from the catalogue: `symplectic list --class separable --min-order 4 --sort efficiency`.

use std::cmp::Ordering;

use clap::{Args, ValueEnum};
use rayon::prelude::*;
use symplectic_compiler::order::HamiltonianClass;
use symplectic_compiler::{Error, ErrorKind, Evidence, Tableau, catalogue};

use symplectic_terminal::aligned;

/// Selection and sort order of methods.
#[derive(Args)]
pub(crate) struct Choice {
    /// Class of Hamiltonians for orders and errors [default: separable].
    #[arg(long, value_enum)]
    class: Option<Class>,
    /// Smallest order; with `--class perturbed` the smallest orders in ε, ε², …, such as `8,4`. The last one applies to
    /// all higher powers.
    #[arg(long, value_name = "P", value_parser = orders)]
    min_order: Option<Orders>,
    /// Largest order, or orders.
    #[arg(long, value_name = "P", value_parser = orders)]
    max_order: Option<Orders>,
    /// Explicit methods with at most N force evaluations per step.
    #[arg(long, value_name = "N")]
    max_evaluations: Option<usize>,
    /// Sort order. Efficiency is n (C/E)^(1/p): the force evaluations per unit of time for an error E (`--tolerance`),
    /// with n evaluations per step, the error constant C and the order p; fewer are better.
    #[arg(long, value_enum, value_name = "BY")]
    sort: Option<Sort>,
    /// Error for the comparison of efficiency [default: 1e-8].
    #[arg(long, value_name = "E", allow_hyphen_values = true, value_parser = tolerance)]
    tolerance: Option<f64>,
}

#[derive(Debug, Clone, Copy, PartialEq, Eq, ValueEnum)]
enum Class {
    /// Any H(q, p).
    General,
    /// H = T(p) + U(q).
    Separable,
    /// H = p²/2m + U(q).
    Nystrom,
    /// H = H_A + εH_B: splittings with drifts for H_A and kicks for εH_B.
    Perturbed,
}

impl Class {
    /// The class of Hamiltonians, if its order is a single number.
    fn hamiltonians(self) -> Option<HamiltonianClass> {
        match self {
            Class::General => Some(HamiltonianClass::General),
            Class::Separable => Some(HamiltonianClass::Separable),
            Class::Nystrom => Some(HamiltonianClass::Nystrom),
            Class::Perturbed => None,
        }
    }
}

/// An order, or the orders in ε, ε², …; the last one applies to all higher powers.
#[derive(Debug, Clone, PartialEq, Eq, PartialOrd, Ord)]
struct Orders(Vec<usize>);

impl Orders {
    /// Whether each order is at least the corresponding order of `others`.
    fn reach(&self, others: &Orders) -> bool {
        let at = |orders: &Orders, power: usize| {
            let order = orders.0.get(power).or(orders.0.last());
            order.copied().unwrap_or(0)
        };
        let powers = self.0.len().max(others.0.len());
        (0..powers).all(|power| at(self, power) >= at(others, power))
    }
}

fn orders(text: &str) -> Result<Orders, String> {
    let orders: Option<Vec<usize>> = text.split(',').map(|n| n.trim().parse().ok()).collect();
    let orders = orders.map(Orders);
    orders.ok_or_else(|| "expected an order such as 6, or orders such as 8,4".to_owned())
}

#[derive(Debug, Clone, Copy, PartialEq, Eq, ValueEnum)]
enum Sort {
    /// By name.
    Name,
    /// By order, the highest first.
    Order,
    /// By force evaluations per step, the fewest first.
    Evaluations,
    /// By error constant, the smallest first.
    Error,
    /// By evaluations for the tolerance, the fewest first.
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
    /// Whether any option is given.
    pub(crate) fn is_made(&self) -> bool {
        self.class.is_some()
            || self.sort.is_some()
            || self.tolerance.is_some()
            || self.max_evaluations.is_some()
            || self.min_order.is_some()
            || self.max_order.is_some()
    }

    /// Refuses options that do not apply to the class.
    fn check(&self) -> Result<(), Error> {
        let refused = |message: &str| {
            let message = message.to_owned();
            Err(ErrorKind::Definition { message }.into())
        };
        let several = |orders: &Option<Orders>| orders.as_ref().is_some_and(|o| o.0.len() > 1);
        if self.class != Some(Class::Perturbed) {
            if several(&self.min_order) || several(&self.max_order) {
                return refused("several orders need `--class perturbed`: give one order");
            }
            return Ok(());
        }
        if matches!(self.sort, Some(Sort::Error | Sort::Efficiency)) || self.tolerance.is_some() {
            return refused(
                "there is no error constant for `--class perturbed`: leave out `--tolerance`, and sort by name, order or evaluations",
            );
        }
        Ok(())
    }

    /// Whether the number of force evaluations is allowed; tested first, because orders are slower to compute.
    fn takes_evaluations(&self, forces: Option<usize>) -> bool {
        let forces = forces.unwrap_or(usize::MAX);
        self.max_evaluations.is_none_or(|most| forces <= most)
    }

    fn takes_order(&self, order: &Orders) -> bool {
        let (least, most) = (self.min_order.as_ref(), self.max_order.as_ref());
        least.is_none_or(|least| order.reach(least)) && most.is_none_or(|most| most.reach(order))
    }
}

fn words(evidence: Evidence) -> &'static str {
    match evidence {
        Evidence::Verified { .. } => "verified",
        Evidence::Undecided { .. } => "not decided",
        Evidence::Certified => "certified",
        Evidence::Proved | Evidence::Refuted => "proved",
    }
}

/// The data for the comparison of methods.
struct Method {
    name: String,
    title: String,
    order: Orders,
    /// The order as printed.
    shown: String,
    /// Evidence for the order: proved or verified; "≥" if only a lower bound is known.
    evidence: String,
    /// Force evaluations per step; `None` for implicit methods.
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
        let known = words(found.evidence);
        let at_least = if found.refuted_by.is_none() {
            "≥, "
        } else {
            ""
        };
        // The decimal parses as a double.
        let constant = found.error_constant.as_ref().map(ToString::to_string);
        Method {
            name: entry.name,
            title: entry.title,
            order: Orders(vec![found.order]),
            shown: found.order.to_string(),
            evidence: format!("{at_least}{known}"),
            forces: tableau.evaluations().map(|evaluations| evaluations.cost()),
            error_constant: constant.and_then(|constant| constant.parse().ok()),
            cost: tableau.evaluations_for(class, tolerance),
        }
    }

    /// A splitting, with its orders for perturbed systems.
    fn perturbed(entry: catalogue::Entry, tableau: &Tableau) -> Option<Self> {
        let found = tableau.perturbed_order()?;
        let mut known: Vec<&str> = found.powers.iter().map(|p| words(p.evidence)).collect();
        known.dedup();
        Some(Method {
            name: entry.name,
            title: entry.title,
            order: Orders(found.orders()),
            shown: found.numbers(),
            evidence: known.join(", "),
            forces: tableau.evaluations().map(|evaluations| evaluations.cost()),
            error_constant: None,
            cost: None,
        })
    }

    fn row(self) -> [String; 7] {
        let or_dash = |text: Option<String>| text.unwrap_or_else(|| "–".to_owned());
        [
            self.name,
            self.shown,
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

/// The table of the selected methods.
pub(crate) fn table(choice: &Choice) -> Result<String, Error> {
    choice.check()?;
    let class = choice.class.unwrap_or(Class::Separable).hamiltonians();
    let tolerance = choice.tolerance.unwrap_or(1e-8);
    let chosen = |entry: catalogue::Entry| -> Result<Option<Method>, Error> {
        let tableau = entry.derive()?;
        let forces = tableau.evaluations().map(|evaluations| evaluations.cost());
        if !choice.takes_evaluations(forces) {
            return Ok(None);
        }
        let method = match class {
            // Gradient kicks are for quadratic T only.
            Some(class) if !tableau.orders().class(class).exists() => None,
            Some(class) => Some(Method::new(entry, &tableau, class, tolerance)),
            None => Method::perturbed(entry, &tableau),
        };
        Ok(method.filter(|method| choice.takes_order(&method.order)))
    };
    let entries: Vec<_> = catalogue::entries().collect();
    let methods: Result<Vec<_>, Error> = entries.into_par_iter().map(chosen).collect();
    let mut methods: Vec<Method> = methods?.into_iter().flatten().collect();
    // Unknown values come last.
    let smaller = |x: Option<f64>, y: Option<f64>| {
        let [x, y] = [x, y].map(|value| value.unwrap_or(f64::INFINITY));
        x.total_cmp(&y)
    };
    match choice.sort {
        None => {}
        Some(Sort::Name) => methods.sort_by(|x, y| x.name.cmp(&y.name)),
        Some(Sort::Order) => methods.sort_by_key(|method| std::cmp::Reverse(method.order.clone())),
        Some(Sort::Evaluations) => {
            methods.sort_by_key(|method| method.forces.unwrap_or(usize::MAX));
        }
        Some(Sort::Error) => methods.sort_by(|x, y| {
            // Error constants are comparable only for equal orders.
            let orders: Ordering = y.order.cmp(&x.order);
            orders.then(smaller(x.error_constant, y.error_constant))
        }),
        Some(Sort::Efficiency) => methods.sort_by(|x, y| smaller(x.cost, y.cost)),
    }
    let Some(class) = class else {
        return Ok(perturbed(methods));
    };
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
    let gradient = match class {
        HamiltonianClass::Nystrom => " A gradient kick counts as two.",
        _ => "",
    };
    let mut text = format!(
        "Methods for {class} H. Forces: force evaluations per step, for methods that are explicit for separable H.{gradient}\n\
         Cost: force evaluations per unit of time for an error of {tolerance:e}, forces × (error constant / error)^(1/order).\n\n"
    );
    text.push_str(&aligned(&rows));
    Ok(text)
}

/// The table of splittings for perturbed systems.
fn perturbed(methods: Vec<Method>) -> String {
    let mut rows = vec![["name", "order", "", "forces", "title"].map(str::to_owned)];
    rows.extend(methods.into_iter().map(|method| {
        let [name, order, evidence, forces, _, _, title] = method.row();
        [name, order, evidence, forces, title]
    }));
    let mut text = String::from(
        "Splittings for H = H_A + εH_B with drifts for H_A and kicks for εH_B; with `exchange: true` the other way round.\n\
         Order: (s1, s2, …) for local errors of O(ε h^(s1+1) + ε² h^(s2+1) + …), the last order for all higher powers of ε.\n\n",
    );
    text.push_str(&aligned(&rows));
    text
}
