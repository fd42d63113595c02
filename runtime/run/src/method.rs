//! The method of a run: from a derived tableau to one that takes steps.

use std::collections::BTreeMap;
use std::path::Path;

use symplectic::Orders;
use symplectic::at_run_time::{RunTimeCoefficients, RunTimeTableau, TableauError};
use symplectic::emitted::{Coefficient, ConstrainedStep, ConstrainedTableau};
use symplectic_compiler::emit::{ConstrainedSteps, Rounded, constrained_steps};
use symplectic_compiler::export::read_text;
use symplectic_compiler::order::HamiltonianClass;
use symplectic_compiler::{
    Definition, Error, Key, Limits, Tableau, catalogue, check, did_you_mean,
};
use symplectic_formula::System;
use toml::{Spanned, Value};

use crate::setup::{File, Setup, Wanted};

/// A method and its definition.
pub(super) struct Method {
    pub(super) tableau: RunTimeTableau,
    pub(super) definition: String,
}

impl Method {
    /// Derives the method of a setup.
    pub(super) fn read(
        file: &File<'_>,
        setup: &Setup,
        system: &System,
        max_stages: Option<u16>,
    ) -> Result<Self, Error> {
        let span = setup.method.span();
        let tableau = derive(file, setup.method.get_ref(), max_stages)
            .map_err(|error| file.placed(span, error))?;
        let holonomic = constraints_of(system);
        let made = stepping(&tableau, holonomic)
            .map_err(|refusal| file.error(setup.method.span(), refusal.to_string()))?;
        Ok(Method {
            tableau: match setup.accept_lower_order {
                true => made.accept_lower_order(),
                false => made,
            },
            definition: tableau.provenance().definition.to_string(),
        })
    }
}

/// Whether the constraints of a system are holonomic; `None` if it has none.
pub fn constraints_of(system: &System) -> Option<bool> {
    let is_constrained = system.is_constrained();
    is_constrained.then_some(!system.constraints.is_empty())
}

/// Why a derived method cannot take steps of a system.
#[derive(Debug, thiserror::Error)]
pub enum Refusal {
    /// It is not symplectic.
    #[error(transparent)]
    Tableau(#[from] TableauError),
    /// It has gradient kicks, which a method of a program that runs has not.
    #[error(
        "`{method}` has gradient kicks, which `symplectic run` and Python do not take: `tableau!` takes them in a Rust program"
    )]
    GradientKicks {
        /// Its name.
        method: String,
    },
    /// It has no steps for the constraints.
    #[error("`{method}` has no steps for {}", instead(*are_holonomic))]
    Constraints {
        /// Its name.
        method: String,
        /// Whether the constraints are holonomic.
        are_holonomic: bool,
    },
}

/// The methods for constraints.
fn instead(are_holonomic: bool) -> &'static str {
    match are_holonomic {
        true => {
            "holonomic constraints: take one that is `constrained`, such as `lobatto-2`, which is RATTLE, `lobatto-3` of order 4, \
             or `{ base = \"lobatto-2\", weights = \"triple_jump(4)\" }`"
        }
        false => {
            "non-holonomic constraints: take one that is `nonholonomic`, such as `gauss-1`, `lobatto-2`, \
             or `{ base = \"gauss-1\", weights = \"triple_jump(4)\" }`"
        }
    }
}

/// A derived method as one that takes steps, with correctly rounded coefficients and its proved orders; with its steps for constraints if there
/// are any, holonomic ones or not.
///
/// Steps for constraints live as long as the program: derive a method once.
///
/// # Errors
///
/// [`Refusal`] of a method that is not symplectic, or has no steps for the constraints.
pub fn stepping(tableau: &Tableau, holonomic: Option<bool>) -> Result<RunTimeTableau, Refusal> {
    if tableau.has_gradient_kicks() {
        let method = tableau
            .name()
            .unwrap_or("a method without a name")
            .to_owned();
        return Err(Refusal::GradientKicks { method });
    }
    let report = tableau.orders();
    let order = |class| u32::try_from(report.class(class).order).unwrap_or(u32::MAX);
    let orders = Orders {
        general: order(HamiltonianClass::General),
        separable: order(HamiltonianClass::Separable),
        nystrom: order(HamiltonianClass::Nystrom),
    };
    let numbers = tableau.to_f64();
    let coefficients = RunTimeCoefficients {
        a: numbers.a,
        a_tilde: numbers.a_tilde,
        b: numbers.b,
        b_tilde: numbers.b_tilde,
        c: numbers.c,
        c_tilde: numbers.c_tilde,
        gradient: numbers.gradient,
    };
    let name = tableau.name().unwrap_or("a method without a name");
    let made = RunTimeTableau::new(name, &coefficients, orders)?;
    let Some(are_holonomic) = holonomic else {
        return Ok(made);
    };
    let [holonomic, nonholonomic] = constrained_steps(tableau);
    let steps = match are_holonomic {
        true => holonomic,
        false => nonholonomic,
    };
    let steps = steps.ok_or_else(|| Refusal::Constraints {
        method: name.to_owned(),
        are_holonomic,
    })?;
    let steps = leaked(&steps);
    Ok(match are_holonomic {
        true => made.with_constrained_steps(steps, &[]),
        false => made.with_constrained_steps(&[], steps),
    })
}

/// Steps as those of an emitted method, which live as long as the program.
fn leaked(steps: &ConstrainedSteps) -> &'static [ConstrainedStep] {
    let coefficient = |number: &Rounded| Coefficient::new(number.double, number.low, number.single);
    let list = |numbers: &Vec<Rounded>| -> &'static [Coefficient] {
        numbers.iter().map(coefficient).collect::<Vec<_>>().leak()
    };
    let rows = |rows: &[Vec<Rounded>]| -> &'static [&'static [Coefficient]] {
        rows.iter().map(list).collect::<Vec<_>>().leak()
    };
    let tableaux = steps.tableaux.iter().map(|tableau| {
        let multipliers = tableau.multipliers.iter();
        let multipliers = multipliers.map(|row| -> &'static [f64] { row.clone().leak() });
        ConstrainedTableau {
            positions: rows(&tableau.positions),
            momenta: rows(&tableau.momenta),
            weights: list(&tableau.weights),
            nodes: list(&tableau.nodes),
            momentum_nodes: list(&tableau.momentum_nodes),
            multipliers: multipliers.collect::<Vec<_>>().leak(),
        }
    });
    let tableaux: &'static [ConstrainedTableau] = tableaux.collect::<Vec<_>>().leak();
    let steps = steps.steps.iter().map(|step| ConstrainedStep {
        start: coefficient(&step.start),
        fraction: coefficient(&step.fraction),
        tableau: &tableaux[step.tableau],
    });
    steps.collect::<Vec<_>>().leak()
}

fn derive(file: &File<'_>, method: &Wanted, max_stages: Option<u16>) -> Result<Tableau, Error> {
    let limits = max_stages.map_or_else(Limits::default, Limits::at_most);
    match method {
        Wanted::Named(name) if name.ends_with(".toml") || name.ends_with(".json") => {
            let path = file.beside(Path::new(name));
            check(&path.display().to_string(), &read_text(&path)?, &limits)
        }
        Wanted::Named(name) => {
            let entry = catalogue::find(name).ok_or_else(|| catalogue::unknown(name))?;
            let limits = max_stages.map_or(entry.limits(), |_| limits);
            Ok(entry.derive_within(&limits)?.named(entry.name))
        }
        Wanted::Defined(parts) => {
            let mut given = Vec::new();
            for (name, value) in parts {
                let key = Key::find(name).ok_or_else(|| {
                    let known: Vec<&str> = Key::ALL.iter().map(|key| key.name()).collect();
                    let message = format!(
                        "a method has no key `{name}`; its keys are {}{}",
                        known.join(", "),
                        did_you_mean(name, known.iter().copied())
                    );
                    file.error_at_key(value.span(), message)
                })?;
                let text = match value.get_ref() {
                    Value::String(text) => text.clone(),
                    Value::Boolean(true) => "true".to_owned(),
                    Value::Boolean(false) => continue,
                    other => other.to_string(),
                };
                given.push((key, text));
            }
            let derived = Definition::new(given).derive(&limits);
            derived.map_err(|error| in_value(file, parts, error))
        }
    }
}

/// Moves the place of an error from a value of the definition to the file.
fn in_value(file: &File<'_>, parts: &BTreeMap<String, Spanned<Value>>, error: Error) -> Error {
    let place = error.place.as_ref();
    let found = place.and_then(|place| Some((parts.get(&place.input)?, place.text.clone())));
    match found {
        Some((value, text)) => file.inside(value.span(), &text, error),
        None => error,
    }
}
