//! Checks of the parameters of a system from a formula.

use crate::error::Error;

/// The number of bodies in vectors of this dimension, with `components` for each body.
///
/// # Errors
///
/// [`Error::DimensionFactor`].
pub const fn bodies(dimension: usize, components: usize) -> Result<usize, Error> {
    match dimension.checked_rem(components) {
        Some(0) => Ok(dimension / components),
        _ => Err(Error::DimensionFactor {
            dimension,
            factor: components,
        }),
    }
}

/// Checks that there are as many bodies as the formula names.
///
/// # Errors
///
/// [`Error::TooFewBodies`].
pub const fn check_bodies(bodies: usize, least: usize) -> Result<(), Error> {
    match bodies < least {
        true => Err(Error::TooFewBodies { bodies, least }),
        false => Ok(()),
    }
}

/// Checks that a parameter is a number.
///
/// # Errors
///
/// [`Error::ParameterNotANumber`].
pub const fn check_number(parameter: &'static str, value: f64) -> Result<(), Error> {
    match value.is_nan() {
        true => Err(Error::ParameterNotANumber { parameter }),
        false => Ok(()),
    }
}

/// Checks that all entries of a parameter are numbers.
///
/// # Errors
///
/// [`Error::ParameterNotANumber`].
pub fn check_numbers(parameter: &'static str, values: &[f64]) -> Result<(), Error> {
    let mut values = values.iter();
    values.try_for_each(|&value| check_number(parameter, value))
}

/// Checks the length of a parameter.
///
/// # Errors
///
/// [`Error::ParameterLength`].
pub const fn check_length(
    parameter: &'static str,
    found: usize,
    expected: usize,
) -> Result<(), Error> {
    match found == expected {
        true => Ok(()),
        false => Err(Error::ParameterLength {
            parameter,
            found,
            expected,
        }),
    }
}

/// Checks that all pairs are pairs of bodies.
///
/// # Errors
///
/// [`Error::PairOutOfRange`].
pub fn check_pairs(
    parameter: &'static str,
    pairs: &[(usize, usize)],
    bodies: usize,
) -> Result<(), Error> {
    let outside = |&(_, &(first, second)): &(usize, &(usize, usize))| first.max(second) >= bodies;
    match pairs.iter().enumerate().find(outside) {
        None => Ok(()),
        Some((index, &pair)) => Err(Error::PairOutOfRange {
            parameter,
            index,
            pair,
            bodies,
        }),
    }
}
