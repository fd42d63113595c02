//! Values of a coordinate or a parameter: a number, several, or random ones.

use symplectic_compiler::did_you_mean;
use toml::{Table, Value};

use crate::counted;
use crate::derived::Rule;
use crate::random::MAX_DEVIATIONS;
use crate::setup::{Evenly, found, number};

const EXPECTED: &str = "expected a number, { from, to, count }, { values = [...] }, { uniform = [low, high] } or { normal = [mean, deviation] }";
const OF_COORDINATE: &str = ", a formula in quotes, or for a momentum { energy = ... }";

/// The values of a coordinate or a parameter.
#[derive(Debug, Clone)]
pub(super) enum Spec {
    Values(Vec<f64>),
    Uniform([f64; 2]),
    Normal([f64; 2]),
    /// A coordinate that follows from others.
    Derived(Rule),
}

impl Spec {
    /// Reads the values of a parameter, which are finite; the error is a message.
    pub(super) fn read(value: &Value, name: &str) -> Result<Self, String> {
        Self::find(value)
            .map_err(|message| format!("`{name}`: {message}"))?
            .checked(name)
    }

    /// Reads the values of a coordinate, which may follow from others.
    pub(super) fn of_coordinate(value: &Value, name: &str) -> Result<Self, String> {
        let placed = |message| format!("`{name}`: {message}");
        match value {
            Value::String(text) => Ok(Spec::Derived(Rule::Formula(text.clone()))),
            Value::Table(table) if table.contains_key("energy") => {
                energy(table).map(Spec::Derived).map_err(placed)
            }
            other => {
                let found = Self::find(other).map_err(|message| {
                    let more = match message.ends_with(EXPECTED) {
                        true => OF_COORDINATE,
                        false => "",
                    };
                    placed(message + more)
                });
                found?.checked(name)
            }
        }
    }

    fn checked(self, name: &str) -> Result<Self, String> {
        let numbers = match &self {
            Spec::Values(values) => &values[..],
            Spec::Uniform(pair) | Spec::Normal(pair) => pair,
            Spec::Derived(_) => &[],
        };
        if let Some(wrong) = numbers.iter().find(|number| !number.is_finite()) {
            return Err(format!("`{name}` has a value that is not finite: {wrong}"));
        }
        match self.fault() {
            Some(fault) => Err(format!("`{name}`: {fault}")),
            None => Ok(self),
        }
    }

    fn find(value: &Value) -> Result<Self, String> {
        if let Some(value) = number(value) {
            return Ok(Spec::Values(vec![value]));
        }
        let Some(table) = value.as_table() else {
            return Err(format!("found {}, {EXPECTED}", found(value)));
        };
        let numbers = |key: &str| -> Result<Vec<f64>, String> {
            let list = table[key].as_array();
            let list = list.and_then(|list| list.iter().map(number).collect::<Option<_>>());
            list.ok_or_else(|| format!("`{key}` needs a list of numbers, such as [0.1, 0.2]"))
        };
        let pair = |key: &str| {
            let pair = <[f64; 2]>::try_from(numbers(key)?);
            pair.map_err(|list| {
                format!(
                    "`{key}` has {}, and needs 2",
                    counted(list.len(), "number", "numbers")
                )
            })
        };
        let kinds: [(&str, &[&str]); 4] = [
            ("values", &["values"]),
            ("uniform", &["uniform"]),
            ("normal", &["normal"]),
            ("range", &["from", "to", "count"]),
        ];
        let is_of = |keys: &[&str]| table.keys().any(|key| keys.contains(&key.as_str()));
        let Some((kind, keys)) = kinds.into_iter().find(|(_, keys)| is_of(keys)) else {
            let Some(key) = table.keys().next() else {
                return Err(format!("found an empty table, {EXPECTED}"));
            };
            let known = kinds.into_iter().flat_map(|(_, keys)| keys).copied();
            let advice = did_you_mean(key, known.chain(["energy"]));
            return Err(format!("there is no key `{key}` here, {EXPECTED}{advice}"));
        };
        if let Some(other) = table.keys().find(|key| !keys.contains(&key.as_str())) {
            let (beside, advice) = (keys[0], did_you_mean(other, keys.iter().copied()));
            return Err(format!(
                "there is no key `{other}` beside `{beside}`: {EXPECTED}{advice}"
            ));
        }
        match kind {
            "values" => numbers(kind).map(Spec::Values),
            "uniform" => pair(kind).map(Spec::Uniform),
            "normal" => pair(kind).map(Spec::Normal),
            _ => {
                let range = Evenly::of(table);
                let range = range.map_err(|message| format!("{message}: {EXPECTED}"))?;
                range.numbers().map(Spec::Values)
            }
        }
    }

    /// What is wrong with finite numbers.
    fn fault(&self) -> Option<String> {
        match *self {
            Spec::Values(ref values) => values
                .is_empty()
                .then(|| "the list of values is empty".to_owned()),
            Spec::Uniform([low, high]) if low > high => Some(format!(
                "the lower bound {low:?} is above the upper bound {high:?}"
            )),
            Spec::Uniform([low, high]) if !(high - low).is_finite() => Some(format!(
                "the bounds {low:?} and {high:?} are too far apart: their difference overflows"
            )),
            Spec::Normal([_, deviation]) if deviation < 0.0 => Some(format!(
                "the standard deviation is {deviation:?}: it must not be negative"
            )),
            Spec::Normal([mean, deviation])
                if !(mean.abs() + MAX_DEVIATIONS * deviation).is_finite() =>
            {
                Some(format!(
                    "the standard deviation {deviation:?} is too large: values overflow"
                ))
            }
            Spec::Uniform(_) | Spec::Normal(_) | Spec::Derived(_) => None,
        }
    }

    /// Whether the value is drawn for every start.
    pub(super) fn is_random(&self) -> bool {
        matches!(self, Spec::Uniform(_) | Spec::Normal(_))
    }
}

/// The rule of a momentum on an energy surface.
fn energy(table: &Table) -> Result<Rule, String> {
    if let Some(other) = table
        .keys()
        .find(|key| !["energy", "root"].contains(&key.as_str()))
    {
        let advice = did_you_mean(other, ["energy", "root"]);
        return Err(format!(
            "there is no key `{other}` beside `energy`; known here: `energy`, `root`{advice}"
        ));
    }
    let energy = match &table["energy"] {
        Value::String(text) => text.clone(),
        value => match number(value).filter(|number| number.is_finite()) {
            Some(number) => format!("{number}"),
            None => return Err("`energy` needs a finite number, or a formula in quotes".to_owned()),
        },
    };
    let is_largest = match table.get("root").map(Value::as_str) {
        None | Some(Some("largest")) => true,
        Some(Some("smallest")) => false,
        Some(_) => return Err("`root` must be \"largest\" or \"smallest\"".to_owned()),
    };
    Ok(Rule::Energy { energy, is_largest })
}
