//! The parameters of a formula.

use symplectic_compiler::Error;
use symplectic_compiler::formula::evaluate::Real;
use symplectic_compiler::formula::syntax::Length;
use symplectic_compiler::formula::{Parameter, Shape, System};
use toml::Value;

use super::setup::{self, File, Setup};
use super::values::Values;

/// Reads all parameters; their lengths determine the lengths that the formula leaves open.
pub(super) fn read(
    file: &File<'_>,
    setup: &Setup,
    system: &System,
    bodies: usize,
) -> Result<Values, Error> {
    let mut values = Values {
        bodies,
        pairs: vec![Vec::new(); system.parameters.len()],
        ..Values::default()
    };
    let known = |name: &String| {
        system
            .parameters
            .iter()
            .any(|parameter| parameter.name == *name)
    };
    if let Some((name, value)) = setup.parameters.iter().find(|(name, _)| !known(name)) {
        let names: Vec<&str> = system.parameters.iter().map(|p| p.name.as_str()).collect();
        let there = match names.as_slice() {
            [] => "the formula has none".to_owned(),
            names => format!("the parameters are {}", names.join(", ")),
        };
        let message = format!("there is no parameter `{name}`; {there}");
        return Err(file.error(value.span(), message));
    }
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
            Shape::Number(default) => match (setup.parameters.get(name), default) {
                (None, Some(default)) => vec![vec![<f64 as Real>::number(default)]],
                _ => {
                    let (value, span) = given(file, setup, name, "a number")?;
                    let refused =
                        || file.error(span, format!("`{name}`: expected a finite number"));
                    vec![vec![number(value).ok_or_else(refused)?]]
                }
            },
            Shape::Array(lengths) => {
                let (value, span) = given(file, setup, name, "a list of numbers")?;
                let rows = array(value, lengths.len()).ok_or_else(|| {
                    let what = [
                        "a list of finite numbers",
                        "a list of lists of finite numbers",
                    ];
                    let what = what[usize::from(lengths.len() > 1)];
                    file.error(span.clone(), format!("`{name}`: expected {what}"))
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
                            let message =
                                format!("`{name}` has {found} entries, but {expected} are needed");
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
) -> Result<(&'a Value, std::ops::Range<usize>), Error> {
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

fn array(value: &Value, dimensions: usize) -> Option<Vec<Vec<f64>>> {
    let row = |value: &Value| -> Option<Vec<f64>> {
        match dimensions {
            1 => Some(vec![number(value)?]),
            _ => value.as_array()?.iter().map(number).collect(),
        }
    };
    value.as_array()?.iter().map(row).collect()
}
