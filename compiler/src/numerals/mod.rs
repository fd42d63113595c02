//! Numbers in texts of other languages, exactly: `1//2`, `0x1.8p-1`, `1.0d0`, `sqrt(2)/3`.

mod constructors;
mod fortran;
mod parser;
mod source;
mod tokens;
mod value;

pub use source::{Source, value_of, zero};
pub use value::{PLACES, Value};

use std::ops::Range;

use crate::certify::Printed;
use crate::expression::Input;
use crate::library::Notation;

/// A number that is computed from printed ones, such as `1 - 2*0.2345678`: exact given these, with the bound of their rounding.
pub fn computed(input: Input<'_>, range: Range<usize>) -> Option<Printed> {
    let value = value_of(input, range, Notation::Julia).ok()?;
    value.constant.as_rational()?;
    value.printed().ok()
}
