//! Values of a coordinate or a parameter: a number, several, or random ones.

use toml::Value;

use super::setup::{Evenly, number};
use super::starts::MOST;

const EXPECTED: &str = "expected a number, { from, to, count } with a count up to 4194304, { values = [...] }, { uniform = [low, high] } or { normal = [mean, deviation] }";

/// The values of a coordinate or a parameter.
#[derive(Debug, Clone)]
pub(super) enum Spec {
    Values(Vec<f64>),
    Uniform([f64; 2]),
    Normal([f64; 2]),
}

impl Spec {
    /// Reads the values of `name`; the error is a message.
    pub(super) fn read(value: &Value, name: &str) -> Result<Self, String> {
        Self::find(value).ok_or_else(|| format!("`{name}`: {EXPECTED}"))
    }

    fn find(value: &Value) -> Option<Self> {
        if let Some(value) = number(value) {
            return Some(Spec::Values(vec![value]));
        }
        let table = value.as_table()?;
        let numbers = |key: &str| -> Option<Vec<f64>> {
            let list = table.get(key)?.as_array()?;
            list.iter().map(number).collect()
        };
        let pair = |key: &str| numbers(key).and_then(|list| <[f64; 2]>::try_from(list).ok());
        let range = || value.clone().try_into::<Evenly>().ok();
        match table.len() {
            1 => (numbers("values")
                .filter(|list| !list.is_empty())
                .map(Spec::Values))
            .or_else(|| pair("uniform").map(Spec::Uniform))
            .or_else(|| pair("normal").map(Spec::Normal)),
            _ => range()
                .filter(|range| range.count <= MOST)
                .map(Evenly::numbers)
                .filter(|list| !list.is_empty())
                .map(Spec::Values),
        }
    }

    /// Whether all numbers are finite.
    pub(super) fn is_finite(&self) -> bool {
        let numbers = match self {
            Spec::Values(values) => &values[..],
            Spec::Uniform(pair) | Spec::Normal(pair) => pair,
        };
        numbers.iter().all(|number| number.is_finite())
    }

    /// Whether the value is drawn for every start.
    pub(super) fn is_random(&self) -> bool {
        !matches!(self, Spec::Values(_))
    }
}
