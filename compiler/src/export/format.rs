//! The number of the format in which a file is written.

use std::ops::Range;

use crate::error::{Error, ErrorKind};
use crate::export::entries::first_line;
use crate::expression::Input;

/// The number of a format.
///
/// Files without a number have format 1. Every later version of this library reads every older format.
///
/// | format | change |
/// |--:|---|
/// | 1 | the first; a file may lack facts that were not written then |
/// | 2 | the file has its format, every property, the orders and the stability; adjoints and compositions of `constrained` methods are so too, and compositions that keep their order are `nonholonomic` |
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub struct Format(u64);

impl Format {
    /// The format that is written.
    pub const CURRENT: Self = Self(2);

    /// Whether files of this format may lack facts.
    pub fn is_older(self) -> bool {
        self.0 < Self::CURRENT.0
    }

    /// The format that a file states.
    ///
    /// # Errors
    /// [`ErrorKind::Document`] for a format of a later version, and for numbers that are none.
    pub fn read(
        file: Input<'_>,
        stated: Option<(Range<usize>, Option<u64>)>,
    ) -> Result<Self, Error> {
        let Some((span, number)) = stated else {
            return Ok(Self(1));
        };
        let error = |message: String| {
            file.error(
                &first_line(file.text, span.clone()),
                ErrorKind::Document { message },
            )
        };
        match number {
            Some(number @ 1..) if number <= Self::CURRENT.0 => Ok(Self(number)),
            Some(later @ 1..) => Err(error(format!(
                "format {later} belongs to a later version of `symplectic`: this version reads the formats 1 to {}; install the later version, or \
                 export the method again from its definition",
                Self::CURRENT.0
            ))),
            _ if file.text[span.clone()].contains("symplectic certificate") => Err(error(
                "this is a certificate, not a tableau: check it with `python3 tableaux/check_certificate.py FILE`"
                    .to_owned(),
            )),
            _ => Err(error(format!(
                "`format` is a whole number from 1 to {}",
                Self::CURRENT.0
            ))),
        }
    }
}

impl std::fmt::Display for Format {
    fn fmt(&self, f: &mut std::fmt::Formatter<'_>) -> std::fmt::Result {
        self.0.fmt(f)
    }
}
