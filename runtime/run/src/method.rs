//! The method of a run.

use std::collections::BTreeMap;
use std::path::Path;

use symplectic::{Orders, RunTimeCoefficients, RunTimeTableau};
use symplectic_compiler::export::read_text;
use symplectic_compiler::order::HamiltonianClass;
use symplectic_compiler::{
    Definition, Error, Key, Limits, Tableau, catalogue, check, did_you_mean,
};
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
        Ok(Method {
            tableau: match setup.accept_lower_order {
                true => made.accept_lower_order(),
                false => made,
            },
            definition: tableau.provenance().definition.to_string(),
        })
    }
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
