//! Values of a coordinate or a parameter: a number, several, or random ones.

use toml::Value;

use super::random::MOST_DEVIATIONS;
use super::setup::{Evenly, number};

const EXPECTED: &str = "expected a number, { from, to, count }, { values = [...] }, { uniform = [low, high] } or { normal = [mean, deviation] }";

/// The values of a coordinate or a parameter.
#[derive(Debug, Clone)]
pub(super) enum Spec {
    Values(Vec<f64>),
    Uniform([f64; 2]),
    Normal([f64; 2]),
}

impl Spec {
    /// Reads the values of `name`, which are finite; the error is a message.
    pub(super) fn read(value: &Value, name: &str) -> Result<Self, String> {
        let spec = match Self::find(value) {
            Some(spec) => spec.map_err(|message| format!("`{name}`: {message}"))?,
            None => return Err(format!("`{name}`: {EXPECTED}")),
        };
        let numbers = match &spec {
            Spec::Values(values) => &values[..],
            Spec::Uniform(pair) | Spec::Normal(pair) => pair,
        };
        if let Some(wrong) = numbers.iter().find(|number| !number.is_finite()) {
            return Err(format!("`{name}` has a value that is not finite: {wrong}"));
        }
        match spec.fault() {
            Some(fault) => Err(format!("`{name}`: {fault}")),
            None => Ok(spec),
        }
    }

    fn find(value: &Value) -> Option<Result<Self, String>> {
        if let Some(value) = number(value) {
            return Some(Ok(Spec::Values(vec![value])));
        }
        let table = value.as_table()?;
        let numbers = |key: &str| -> Option<Vec<f64>> {
            let list = table.get(key)?.as_array()?;
            list.iter().map(number).collect()
        };
        let pair = |key: &str| numbers(key).and_then(|list| <[f64; 2]>::try_from(list).ok());
        match table.len() {
            1 => (numbers("values").map(Spec::Values))
                .or_else(|| pair("uniform").map(Spec::Uniform))
                .or_else(|| pair("normal").map(Spec::Normal))
                .map(Ok),
            _ => {
                let range = value.clone().try_into::<Evenly>().ok()?;
                Some(range.numbers().map(Spec::Values))
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
                if !(mean.abs() + MOST_DEVIATIONS * deviation).is_finite() =>
            {
                Some(format!(
                    "the standard deviation {deviation:?} is too large: values overflow"
                ))
            }
            Spec::Uniform(_) | Spec::Normal(_) => None,
        }
    }

    /// Whether the value is drawn for every start.
    pub(super) fn is_random(&self) -> bool {
        !matches!(self, Spec::Values(_))
    }
}
