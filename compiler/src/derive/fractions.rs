//! Whether the fractions of a step sum to 1, and those of a processor to 0.

use num_rational::BigRational;

use crate::algebra::{Constants, Field, Number, Reals, Zero};
use crate::symbolic::Constant;

/// The sum of some constants for a message, if it is not 1.
///
/// If no field holds the constants, a sum whose enclosure contains 1 is taken to be 1.
pub fn off_one<'a>(values: impl Iterator<Item = &'a Constant>) -> Option<String> {
    off(1, values)
}

/// The sum of some constants for a message, if it is not `wanted`, as [`off_one`].
pub fn off<'a>(wanted: u8, values: impl Iterator<Item = &'a Constant>) -> Option<String> {
    let values: Vec<&Constant> = values.collect();
    match Constants::containing(values.iter().copied()) {
        Some(field) => off_in(&field, wanted, &values),
        None => off_in(&Reals, wanted, &values),
    }
}

fn off_in<F: Field>(field: &F, wanted: u8, values: &[&Constant]) -> Option<String> {
    let zero = field.rational(&BigRational::default());
    let elements = values.iter().filter_map(|value| field.constant(value));
    let sum = elements.fold(zero, |sum, value| field.add(&sum, &value));
    let wanted = field.rational(&BigRational::from_integer(wanted.into()));
    let rest = field.subtract(&sum, &wanted);
    (field.zero(&rest) == Zero::No).then(|| shown(&field.number(&sum), &field.number(&rest)))
}

/// A short fraction as it is; otherwise the first digits, and its distance from the wanted sum.
fn shown(sum: &Number<'_>, rest: &Number<'_>) -> String {
    const SHORT: usize = 12;
    let exact = sum.short_rational().map(|value| value.to_string());
    match exact.filter(|exact| exact.len() <= SHORT) {
        Some(exact) => exact,
        None => format!("{}… (off by {})", sum.decimal(20), rest.decimal(2)),
    }
}
