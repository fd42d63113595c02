//! The setup file of a run.

use std::collections::BTreeMap;
use std::ops::Range;
use std::path::{Path, PathBuf};

use serde::Deserialize;
use serde::de::{Deserializer, MapAccess, SeqAccess, Visitor, value::MapAccessDeserializer};
use symplectic_compiler::{Error, ErrorKind, Place, did_you_mean};
use toml::{Spanned, Table, Value};

use crate::keys;

/// Largest number of starts of a run, of its times, and of the values of a coordinate.
pub(super) const MAX_COUNT: usize = 1 << 22;

/// The contents of a setup file.
#[derive(Debug, Deserialize)]
#[serde(deny_unknown_fields)]
pub(super) struct Setup {
    /// The formula of the system.
    pub(super) system: Spanned<String>,
    pub(super) method: Spanned<Wanted>,
    pub(super) step_size: Spanned<f64>,
    pub(super) start_time: Option<Spanned<f64>>,
    pub(super) end: Option<Spanned<f64>>,
    pub(super) times: Option<Spanned<Times>>,
    pub(super) section: Option<Spanned<Section>>,
    #[serde(default)]
    pub(super) sums: Sums,
    /// `true` to compute MEGNO and the largest Lyapunov exponent.
    #[serde(default, deserialize_with = "if_true")]
    pub(super) megno: Option<Spanned<bool>>,
    pub(super) solver: Option<Spanned<Iteration>>,
    #[serde(default)]
    pub(super) accept_lower_order: bool,
    /// Leaves out starts whose formulas have no value, or that do not reach their energy.
    #[serde(default)]
    pub(super) skip_impossible_starts: bool,
    /// `true` to move the starts onto the constraints.
    #[serde(default, deserialize_with = "if_true")]
    pub(super) project_starts: Option<Spanned<bool>>,
    /// The |energy error| above which a run warns.
    pub(super) warn_energy_error: Option<Spanned<f64>>,
    #[serde(default)]
    pub(super) parameters: BTreeMap<String, Spanned<Value>>,
    pub(super) starts: Spanned<Starts>,
    pub(super) random: Option<Spanned<Random>>,
    pub(super) output: Output,
}

/// A switch, if it is on.
fn if_true<'de, D: Deserializer<'de>>(deserializer: D) -> Result<Option<Spanned<bool>>, D::Error> {
    let value = Spanned::<bool>::deserialize(deserializer)?;
    Ok(Some(value).filter(|value| *value.get_ref()))
}

/// The method as given.
#[derive(Debug)]
pub(super) enum Wanted {
    /// A name of the catalogue, or of a file.
    Named(String),
    /// The keys of a definition.
    Defined(BTreeMap<String, Spanned<Value>>),
}

impl<'de> Deserialize<'de> for Wanted {
    fn deserialize<D: Deserializer<'de>>(deserializer: D) -> Result<Self, D::Error> {
        struct Any;
        impl<'de> Visitor<'de> for Any {
            type Value = Wanted;

            fn expecting(&self, formatter: &mut std::fmt::Formatter<'_>) -> std::fmt::Result {
                formatter.write_str("the name of a method of the catalogue, the name of a `.toml` or `.json` file, or a table with the keys of `symplectic derive`")
            }

            fn visit_str<E>(self, name: &str) -> Result<Wanted, E> {
                Ok(Wanted::Named(name.to_owned()))
            }

            fn visit_map<A: MapAccess<'de>>(self, map: A) -> Result<Wanted, A::Error> {
                BTreeMap::deserialize(MapAccessDeserializer::new(map)).map(Wanted::Defined)
            }
        }
        deserializer.deserialize_any(Any)
    }
}

/// The summation of steps.
#[derive(Debug, Clone, Copy, Default, PartialEq, Eq, Deserialize)]
#[serde(try_from = "String")]
pub(super) enum Sums {
    #[default]
    Compensated,
    Plain,
}

impl TryFrom<String> for Sums {
    type Error = String;

    fn try_from(name: String) -> Result<Self, String> {
        match name.as_str() {
            "compensated" => Ok(Sums::Compensated),
            "plain" => Ok(Sums::Plain),
            _ => Err(format!(
                "unknown sums `{name}`, expected `compensated` or `plain`{}",
                did_you_mean(&name, ["compensated", "plain"])
            )),
        }
    }
}

/// The iteration for coupled stages.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Deserialize)]
#[serde(try_from = "String")]
pub(super) enum Iteration {
    FixedPoint,
    Newton,
}

impl TryFrom<String> for Iteration {
    type Error = String;

    fn try_from(name: String) -> Result<Self, String> {
        match name.as_str() {
            "fixed-point" => Ok(Iteration::FixedPoint),
            "newton" => Ok(Iteration::Newton),
            _ => Err(format!(
                "unknown solver `{name}`, expected `fixed-point` or `newton`{}",
                did_you_mean(&name, ["fixed-point", "newton"])
            )),
        }
    }
}

/// The output times.
#[derive(Debug, Clone, Deserialize)]
#[serde(try_from = "Value")]
pub(super) enum Times {
    List(Vec<f64>),
    Range(Evenly),
}

impl TryFrom<Value> for Times {
    type Error = String;

    fn try_from(value: Value) -> Result<Self, String> {
        let found = match &value {
            Value::Array(list) => {
                let wrong = list.iter().position(|entry| number(entry).is_none());
                let Some(wrong) = wrong else {
                    return Ok(Times::List(list.iter().filter_map(number).collect()));
                };
                format!("entry {wrong} is {}", found(&list[wrong]))
            }
            Value::Table(table) => match Evenly::of(table) {
                Ok(range) => return Ok(Times::Range(range)),
                Err(message) => message,
            },
            other => format!("found {}", found(other)),
        };
        Err(format!(
            "expected a list of times, or {{ from, to, count }}; {found}"
        ))
    }
}

/// Equidistant numbers, including both ends.
#[derive(Debug, Clone, Copy, Deserialize)]
#[serde(deny_unknown_fields)]
pub(super) struct Evenly {
    from: f64,
    to: f64,
    count: i64,
}

/// The zeros of an expression at which states are written.
#[derive(Debug, Deserialize)]
#[serde(remote = "Self", deny_unknown_fields)]
pub(super) struct Section {
    /// An expression of the formula language.
    pub(super) of: Spanned<String>,
    #[serde(default)]
    pub(super) direction: Direction,
}

/// The sign changes of a section, in the direction of the steps.
#[derive(Debug, Clone, Copy, Default, PartialEq, Eq, Deserialize)]
#[serde(try_from = "String")]
pub(super) enum Direction {
    #[default]
    Rising,
    Falling,
    Both,
}

impl TryFrom<String> for Direction {
    type Error = String;

    fn try_from(name: String) -> Result<Self, String> {
        match name.as_str() {
            "rising" => Ok(Direction::Rising),
            "falling" => Ok(Direction::Falling),
            "both" => Ok(Direction::Both),
            _ => Err(format!(
                "unknown direction `{name}`, expected `rising`, `falling` or `both`{}",
                did_you_mean(&name, ["rising", "falling", "both"])
            )),
        }
    }
}

/// The number of random starts at each point of the grid of the other coordinates.
#[derive(Debug, Clone, Copy, Deserialize)]
#[serde(remote = "Self", deny_unknown_fields)]
pub(super) struct Random {
    pub(super) seed: u64,
    pub(super) count: usize,
}

/// The destination of the results.
#[derive(Debug, Deserialize)]
#[serde(remote = "Self", deny_unknown_fields)]
pub(super) struct Output {
    /// A file named `.npz`, `.parquet` or `.csv`.
    pub(super) file: Spanned<PathBuf>,
}

/// Reads tables as tables only: by itself `serde` also accepts a list of the values, without their names.
macro_rules! tables {
    ($($table:ident: $expected:literal;)*) => {
        $(impl<'de> Deserialize<'de> for $table {
            fn deserialize<D: Deserializer<'de>>(deserializer: D) -> Result<Self, D::Error> {
                struct Any;
                impl<'de> Visitor<'de> for Any {
                    type Value = $table;

                    fn expecting(
                        &self,
                        formatter: &mut std::fmt::Formatter<'_>,
                    ) -> std::fmt::Result {
                        formatter.write_str($expected)
                    }

                    fn visit_map<A: MapAccess<'de>>(self, map: A) -> Result<$table, A::Error> {
                        $table::deserialize(MapAccessDeserializer::new(map))
                    }
                }
                deserializer.deserialize_any(Any)
            }
        })*
    };
}

tables! {
    Section: "one table, such as `section = { of = \"x\" }`";
    Random: "a table such as `{ seed = 1, count = 1000 }`";
    Output: "a table with the key `file`";
}

/// Start values by coordinate.
pub(super) type Grid = BTreeMap<String, Spanned<Value>>;

/// The starts as given.
#[derive(Debug)]
pub(super) enum Starts {
    /// A CSV or Parquet file.
    File(PathBuf),
    /// A sequence of grids.
    Grids(Vec<Grid>),
}

impl<'de> Deserialize<'de> for Starts {
    fn deserialize<D: Deserializer<'de>>(deserializer: D) -> Result<Self, D::Error> {
        struct Any;
        impl<'de> Visitor<'de> for Any {
            type Value = Starts;

            fn expecting(&self, formatter: &mut std::fmt::Formatter<'_>) -> std::fmt::Result {
                formatter.write_str("a table with the coordinates, a list of such tables, or the name of a CSV or Parquet file")
            }

            fn visit_str<E>(self, name: &str) -> Result<Starts, E> {
                Ok(Starts::File(name.into()))
            }

            fn visit_seq<A: SeqAccess<'de>>(self, mut list: A) -> Result<Starts, A::Error> {
                let mut grids = Vec::new();
                while let Some(grid) = list.next_element()? {
                    grids.push(grid);
                }
                Ok(Starts::Grids(grids))
            }

            fn visit_map<A: MapAccess<'de>>(self, map: A) -> Result<Starts, A::Error> {
                let grid = Grid::deserialize(MapAccessDeserializer::new(map))?;
                Ok(Starts::Grids(vec![grid]))
            }
        }
        deserializer.deserialize_any(Any)
    }
}

impl Setup {
    /// Whether a formula of the starts has a name.
    pub(super) fn starts_use(&self, name: &str) -> bool {
        fn uses(value: &Value, name: &str) -> bool {
            match value {
                Value::String(text) => text
                    .split(|c: char| !c.is_alphanumeric() && c != '_')
                    .any(|word| word.trim_start_matches(|c: char| c.is_ascii_digit()) == name),
                Value::Array(list) => list.iter().any(|value| uses(value, name)),
                Value::Table(table) => table.values().any(|value| uses(value, name)),
                _ => false,
            }
        }
        match self.starts.get_ref() {
            Starts::File(_) => false,
            Starts::Grids(grids) => {
                let mut values = grids.iter().flat_map(|grid| grid.values());
                values.any(|value| uses(value.get_ref(), name))
            }
        }
    }

    /// The time of the starts.
    pub(super) fn start(&self) -> f64 {
        self.start_time.as_ref().map_or(0.0, |time| *time.get_ref())
    }
}

impl Evenly {
    /// Reads a table; the error is a message.
    pub(super) fn of(table: &Table) -> Result<Self, String> {
        let keys = ["from", "to", "count"];
        if let Some(other) = table.keys().find(|key| !keys.contains(&key.as_str())) {
            let advice = did_you_mean(other, keys);
            return Err(format!("there is no key `{other}` beside `from`{advice}"));
        }
        if let Some(missing) = keys.iter().find(|key| !table.contains_key(**key)) {
            return Err(format!("the key `{missing}` is missing"));
        }
        let range = Value::Table(table.clone()).try_into::<Self>();
        range.map_err(|_| "`from` and `to` need numbers, and `count` a whole number".to_owned())
    }

    /// The numbers; the error is a message.
    pub(super) fn numbers(self) -> Result<Vec<f64>, String> {
        let Evenly { from, to, count } = self;
        let count = usize::try_from(count).ok();
        let Some(count) = count.filter(|count| (1..=MAX_COUNT).contains(count)) else {
            return Err(format!(
                "the count is {}: it must be from 1 to {MAX_COUNT}",
                self.count
            ));
        };
        let last = (count - 1).max(1);
        let overflows = !((to - from) * last as f64).is_finite();
        let number = |k: usize| {
            let part = k as f64 / last as f64;
            match overflows {
                _ if k == last => to,
                true => from * (1.0 - part) + to * part,
                // Exact for whole numbers in equal distances.
                false => from + (to - from) * k as f64 / last as f64,
            }
        };
        Ok((0..count).map(number).collect())
    }
}

impl Times {
    /// The times in order; the error is a message.
    pub(super) fn list(&self) -> Result<Vec<f64>, String> {
        match self {
            Times::List(times) => Ok(times.clone()),
            Times::Range(range) => range.numbers(),
        }
    }
}

/// A file with its text, for the positions of errors.
pub(super) struct File<'a> {
    pub(super) path: &'a Path,
    pub(super) text: &'a str,
}

impl File<'_> {
    /// Reads the setup.
    pub(super) fn read(&self) -> Result<Setup, Error> {
        toml::from_str(self.text).map_err(|error| {
            let message = error.message();
            match error.span() {
                Some(span) => self.error(span.clone(), keys::explained(self.text, &span, message)),
                None => ErrorKind::Document {
                    message: message.to_owned(),
                }
                .into(),
            }
        })
    }

    /// An error at a position.
    pub(super) fn error(&self, span: Range<usize>, message: impl Into<String>) -> Error {
        let kind = ErrorKind::Document {
            message: message.into(),
        };
        self.at(span, kind)
    }

    /// An error at the key of a value.
    pub(super) fn error_at_key(&self, value: Range<usize>, message: impl Into<String>) -> Error {
        let span = keys::key_of(self.text, &value).unwrap_or(value);
        self.error(span, message)
    }

    /// An error with this position, unless it has one.
    pub(super) fn placed(&self, span: Range<usize>, error: Error) -> Error {
        match error.place {
            None => self.at(span, *error.kind),
            Some(_) => error,
        }
    }

    /// An error of any kind at a position.
    pub(super) fn at(&self, span: Range<usize>, kind: ErrorKind) -> Error {
        let place = Place {
            input: self.path.display().to_string(),
            text: self.text.to_owned(),
            span,
        };
        Error::at(kind, place)
    }

    /// An error in a string of this file; its position refers to the file if the string occurs there literally.
    pub(super) fn inside(&self, span: Range<usize>, text: &str, error: Error) -> Error {
        let literally = |written: &str| {
            let offset = written.find(text)?;
            let around = [&written[..offset], &written[offset + text.len()..]].concat();
            // Not `u` in `"\u0075"`.
            let is_literal = around.chars().all(|c| "\"'\r\n".contains(c));
            is_literal.then_some(offset)
        };
        let written = self.text.get(span.clone()).and_then(literally);
        match (written, &error.place) {
            (Some(offset), Some(place)) => {
                let offset = span.start + offset;
                let span = offset + place.span.start..offset + place.span.end;
                self.at(span, *error.kind)
            }
            (None, Some(_)) => error,
            (_, None) => self.at(span, *error.kind),
        }
    }

    /// The path of a file named in this file, relative to its folder unless absolute.
    pub(super) fn beside(&self, name: &Path) -> PathBuf {
        self.path.parent().unwrap_or(Path::new("")).join(name)
    }
}

/// The type of a value, in words.
pub(super) fn found(value: &Value) -> &'static str {
    match value {
        Value::String(_) => "a string",
        Value::Integer(_) | Value::Float(_) => "a number",
        Value::Boolean(_) => "a boolean",
        Value::Datetime(_) => "a date or time",
        Value::Array(list) if list.is_empty() => "an empty list",
        Value::Array(_) => "a list",
        Value::Table(_) => "a table",
    }
}

/// A float or an integer.
pub(super) fn number(value: &Value) -> Option<f64> {
    value
        .as_float()
        .or_else(|| value.as_integer().map(|whole| whole as f64))
}
