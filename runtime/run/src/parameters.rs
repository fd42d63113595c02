//! The parameters of a formula.

use std::ops::Range;

use symplectic_compiler::Error;
use symplectic_formula::evaluate::Real;
use symplectic_formula::syntax::Length;
use symplectic_formula::{Parameter, Shape, System};
use symplectic_tape::{Entry, Values};
use toml::Value;

use crate::counted;
use crate::keys::advice;
use crate::setup::{self, File, Setup};
use crate::starts::Coordinates;

/// A parameter, or an entry of one, that varies between trajectories.
pub(super) struct Varied<'a> {
    /// Its name in results, such as `mu` or `m[1]`.
    pub(super) name: String,
    pub(super) value: &'a Value,
    /// The place of the parameter in the file.
    pub(super) span: Range<usize>,
}

/// The entries of `[parameters]` that are given by a table, as in `{ from = 0, to = 1, count = 11 }`, in the order of the file.
pub(super) fn varied(setup: &Setup) -> Vec<Varied<'_>> {
    fn collect<'a>(name: String, value: &'a Value, span: &Range<usize>, all: &mut Vec<Varied<'a>>) {
        match value {
            Value::Table(_) => all.push(Varied {
                name,
                value,
                span: span.clone(),
            }),
            Value::Array(entries) => {
                for (k, entry) in entries.iter().enumerate() {
                    collect(format!("{name}[{k}]"), entry, span, all);
                }
            }
            _ => (),
        }
    }
    let mut given: Vec<_> = setup.parameters.iter().collect();
    given.sort_by_key(|(_, value)| value.span().start);
    let mut all = Vec::new();
    for (name, value) in given {
        collect(name.clone(), value.get_ref(), &value.span(), &mut all);
    }
    all
}

/// Checks that all names in `[parameters]` are those of the formula, or of formulas of the starts.
pub(super) fn check_names(file: &File<'_>, setup: &Setup, system: &System) -> Result<(), Error> {
    let names: Vec<&str> = system.parameters.iter().map(|p| p.name.as_str()).collect();
    let mut unknown = setup.parameters.iter();
    let is_known = |name: &str| names.contains(&name) || setup.starts_use(name);
    let Some((name, value)) = unknown.find(|(name, _)| !is_known(name)) else {
        return Ok(());
    };
    let there = match names.as_slice() {
        [] => "the formula has none".to_owned(),
        names => format!("the parameters are {}", names.join(", ")),
    };
    let advice = advice(name, names.iter().copied());
    let message = format!("there is no parameter `{name}`; {there}{advice}");
    Err(file.error_at_key(value.span(), message))
}

/// Reads all parameters; their lengths determine the lengths that the formula leaves open. `varied` are the names of those that vary
/// between trajectories.
pub(super) fn read(
    file: &File<'_>,
    setup: &Setup,
    system: &System,
    bodies: usize,
    varied: &[String],
) -> Result<Values, Error> {
    let entry = |name: &str, value: Option<&Value>| match varied.iter().position(|v| v == name) {
        Some(k) => Some(Entry::Varied(k)),
        None => number(value?).map(Entry::Number),
    };
    let mut values = Values {
        bodies,
        pairs: vec![Vec::new(); system.parameters.len()],
        ..Values::default()
    };
    // Lists of pairs first, because they may determine the lengths of arrays.
    for (place, Parameter { name, shape }) in system.parameters.iter().enumerate() {
        if let Shape::Pairs = shape {
            let (value, span) = given(file, setup, name, "a list of pairs of indices")?;
            let pairs = pairs(value, bodies).ok_or_else(|| {
                let message = format!(
                    "`{name}`: expected pairs of indices from 0 to {}, such as [[0, 1], [1, 2]]",
                    bodies.saturating_sub(1)
                );
                file.error(span, message)
            })?;
            values.pairs[place] = pairs;
        }
    }
    for Parameter { name, shape } in &system.parameters {
        let rows = match shape {
            Shape::Pairs => Vec::new(),
            Shape::Number(default) => {
                let own = setup.parameters.get(name);
                let entry = entry(name, own.map(|value| value.get_ref()));
                vec![vec![match (entry, own, default) {
                    (Some(entry), ..) => entry,
                    (None, None, Some(default)) => Entry::Number(<f64 as Real>::number(default)),
                    _ => {
                        let (value, span) = given(file, setup, name, "a number")?;
                        return Err(file.error(span, not_a_number(name, value)));
                    }
                }]]
            }
            Shape::Array(lengths) => {
                let (value, span) = given(file, setup, name, "a list of numbers")?;
                let rows = array(name, value, lengths.len(), entry).ok_or_else(|| {
                    let what = [
                        "a list of finite numbers",
                        "a list of lists of finite numbers",
                    ];
                    let what = what[usize::from(lengths.len() > 1)];
                    let message = match value.as_array() {
                        Some(_) => wrong_entry(name, value, lengths.len())
                            .unwrap_or_else(|| format!("`{name}`: expected {what}")),
                        None => format!("`{name}`: found {}, expected {what}", setup::found(value)),
                    };
                    file.error(span.clone(), message)
                })?;
                let fits = |length: &Length, found: usize, values: &mut Values| {
                    let expected = values.length(system, length);
                    match expected {
                        None => {
                            values.lengths.insert(length.clone(), found);
                            Ok(())
                        }
                        Some(expected) if expected == found => Ok(()),
                        Some(expected) => {
                            let found = counted(found, "entry", "entries");
                            let message = format!("`{name}` has {found}; it needs {expected}");
                            Err(file.error(span.clone(), message))
                        }
                    }
                };
                for (depth, length) in lengths.iter().enumerate() {
                    match depth {
                        0 => fits(length, rows.len(), &mut values)?,
                        _ => rows
                            .iter()
                            .try_for_each(|row| fits(length, row.len(), &mut values))?,
                    }
                }
                rows
            }
        };
        values.parameters.push(rows);
    }
    Ok(values)
}

/// The numbers in `[parameters]` that only formulas of the starts use, and the number of the trajectory.
pub(super) fn further(
    file: &File<'_>,
    setup: &Setup,
    system: &System,
    coordinates: &Coordinates,
) -> Result<Vec<(String, Entry)>, Error> {
    let own: Vec<&str> = system.parameters.iter().map(|p| p.name.as_str()).collect();
    let mut further = Vec::new();
    let others = setup.parameters.iter();
    for (name, value) in others.filter(|(name, _)| !own.contains(&name.as_str())) {
        let place = coordinates
            .parameters
            .iter()
            .position(|known| known == name);
        let entry = match place {
            Some(place) => Some(Entry::Varied(place)),
            None => number(value.get_ref()).map(Entry::Number),
        };
        let is_taken = ["t", "pi", "q", "p", "v", "H", "L"].contains(&name.as_str());
        if is_taken || coordinates.all().any(|known| known == name) {
            let message = format!("`{name}` has another meaning: give the parameter another name");
            return Err(file.error_at_key(value.span(), message));
        }
        let entry =
            entry.ok_or_else(|| file.error(value.span(), not_a_number(name, value.get_ref())))?;
        further.push((name.clone(), entry));
    }
    let is_taken =
        own.contains(&NUMBER) || coordinates.with_parameters().any(|name| name == NUMBER);
    if setup.starts_use(NUMBER) && !is_taken {
        further.push((
            NUMBER.to_owned(),
            Entry::Varied(coordinates.parameters.len()),
        ));
    }
    Ok(further)
}

/// The name of the number of the trajectory.
const NUMBER: &str = "trajectory";

fn not_a_number(name: &str, value: &Value) -> String {
    let found = match setup::number(value) {
        Some(number) => number.to_string(),
        None => setup::found(value).to_owned(),
    };
    format!(
        "`{name}`: found {found}, expected a finite number, or several by a table such as {{ values = [1, 2] }}"
    )
}

/// What is wrong with the first wrong entry of an array.
fn wrong_entry(name: &str, value: &Value, dimensions: usize) -> Option<String> {
    let entries = value.as_array()?.iter().enumerate();
    let mut entries = entries.map(|(k, entry)| (format!("{name}[{k}]"), entry));
    match dimensions {
        1 => {
            let is_wrong = |entry: &Value| !entry.is_table() && number(entry).is_none();
            let (name, wrong) = entries.find(|(_, entry)| is_wrong(entry))?;
            Some(not_a_number(&name, wrong))
        }
        _ => entries.find_map(|(name, row)| match row.as_array() {
            Some(_) => wrong_entry(&name, row, dimensions - 1),
            None => Some(format!(
                "`{name}`: found {}, expected a list of finite numbers",
                setup::found(row)
            )),
        }),
    }
}

/// A finite number.
fn number(value: &Value) -> Option<f64> {
    setup::number(value).filter(|number| number.is_finite())
}

/// The value of a parameter without a default.
fn given<'a>(
    file: &File<'_>,
    setup: &'a Setup,
    name: &str,
    what: &str,
) -> Result<(&'a Value, Range<usize>), Error> {
    match setup.parameters.get(name) {
        Some(value) => Ok((value.get_ref(), value.span())),
        None => Err(file.error(
            setup.system.span(),
            format!("the parameter `{name}` has no value: give {what} in `[parameters]`"),
        )),
    }
}

fn pairs(value: &Value, bodies: usize) -> Option<Vec<[usize; 2]>> {
    let index = |value: &Value| {
        let index = usize::try_from(value.as_integer()?).ok()?;
        (index < bodies).then_some(index)
    };
    let pair = |value: &Value| match value.as_array()?.as_slice() {
        [first, second] => Some([index(first)?, index(second)?]),
        _ => None,
    };
    value.as_array()?.iter().map(pair).collect()
}

/// The rows of an array, from its entries by name.
fn array(
    name: &str,
    value: &Value,
    dimensions: usize,
    entry: impl Fn(&str, Option<&Value>) -> Option<Entry>,
) -> Option<Vec<Vec<Entry>>> {
    let row = |(k, value): (usize, &Value)| -> Option<Vec<Entry>> {
        let name = format!("{name}[{k}]");
        match dimensions {
            1 => Some(vec![entry(&name, Some(value))?]),
            _ => {
                let entries = value.as_array()?.iter().enumerate();
                entries
                    .map(|(k, value)| entry(&format!("{name}[{k}]"), Some(value)))
                    .collect()
            }
        }
    };
    value.as_array()?.iter().enumerate().map(row).collect()
}
