//! The method of a run.

use std::collections::BTreeMap;
use std::path::Path;

use symplectic::Orders;
use symplectic::at_run_time::{RunTimeCoefficients, RunTimeTableau};
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
        };
        let name = tableau.name().unwrap_or("a method without a name");
        let made = RunTimeTableau::new(name, &coefficients, orders)
            .map_err(|error| file.error(setup.method.span(), error.to_string()))?;
        let made = match system.is_constrained() {
            true => with_constraints(file, setup, system, (made, &tableau))?,
            false => made,
        };
        Ok(Method {
            tableau: match setup.accept_lower_order {
                true => made.accept_lower_order(),
                false => made,
            },
            definition: tableau.provenance().definition.to_string(),
        })
    }
}

/// A method with its steps for the constraints of a system.
fn with_constraints(
    file: &File<'_>,
    setup: &Setup,
    system: &System,
    (made, tableau): (RunTimeTableau, &Tableau),
) -> Result<RunTimeTableau, Error> {
    let [holonomic, nonholonomic] = constrained_steps(tableau);
    let are_holonomic = !system.constraints.is_empty();
    let (steps, what, instead) = match are_holonomic {
        true => (
            holonomic,
            "holonomic constraints: take one that is `constrained`",
            "`lobatto-2`, which is RATTLE, `lobatto-3` of order 4, or `{ base = \"lobatto-2\", weights = \"triple_jump(4)\" }`",
        ),
        false => (
            nonholonomic,
            "non-holonomic constraints: take one that is `nonholonomic`",
            "`gauss-1`, `lobatto-2`, or `{ base = \"gauss-1\", weights = \"triple_jump(4)\" }`",
        ),
    };
    let Some(steps) = steps else {
        let message = format!(
            "`{}` has no steps for {what}, such as {instead}",
            made.name()
        );
        return Err(file.error(setup.method.span(), message));
    };
    let steps = leaked(&steps);
    Ok(match are_holonomic {
        true => made.with_constrained_steps(steps, &[]),
        false => made.with_constrained_steps(&[], steps),
    })
}

/// Steps as those of an emitted method, which live as long as the program: it has only one method.
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
