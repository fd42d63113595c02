//! Parts of a definition as values, and their errors.

use crate::definition::{Definition, Key};
use crate::error::{Error, ErrorKind};
use crate::expression::{Expression, Input, parse_list, parse_matrix};
use crate::limits::Limits;
use crate::quadrature::check_stages;
use crate::symbolic::Constant;

/// Errors that are reported together.
pub(super) struct Errors(pub Vec<Error>);

impl Errors {
    pub fn note<T>(&mut self, result: Result<T, Error>) -> Option<T> {
        result.map_err(|error| self.push(error)).ok()
    }

    pub fn push(&mut self, error: Error) {
        self.0.push(error);
    }

    pub fn extend(&mut self, errors: Vec<Error>) {
        self.0.extend(errors);
    }
}

/// An error about the combination of the parts.
pub(super) fn misfit(message: String) -> Error {
    ErrorKind::Definition { message }.into()
}

/// An error about one part.
pub(super) fn misfit_at(definition: &Definition, key: Key, message: String) -> Error {
    let text = definition.get(key).unwrap_or_default();
    let input = Input {
        name: key.name(),
        text,
    };
    input.error(&(0..text.len()), ErrorKind::Definition { message })
}

pub(super) fn switch(definition: &Definition, key: Key) -> Result<bool, Error> {
    match definition.get(key) {
        None | Some("false") => Ok(false),
        Some("true") => Ok(true),
        Some(text) => {
            let input = Input {
                name: key.name(),
                text,
            };
            let kind = ErrorKind::Type {
                found: crate::expression::shown(text),
                expected: "`true` or `false`".to_owned(),
            };
            Err(input.error(&(0..text.len()), kind))
        }
    }
}

/// The error for a constant outside the field constructed for it; it does not occur.
pub(super) fn outside() -> ErrorKind {
    ErrorKind::Definition {
        message: "a constant lies outside the field of the coefficients".to_owned(),
    }
}

fn constants(input: Input<'_>, items: &[Expression]) -> Result<Vec<Constant>, Error> {
    items.iter().map(|item| item.constant(input)).collect()
}

pub(super) fn read_vector(key: Key, text: &str) -> Result<Vec<Constant>, Error> {
    let input = Input {
        name: key.name(),
        text,
    };
    constants(input, &parse_list(input)?)
}

pub(super) fn read_matrix(
    key: Key,
    text: &str,
    limits: &Limits,
) -> Result<Vec<Vec<Constant>>, Error> {
    let input = Input {
        name: key.name(),
        text,
    };
    let rows = parse_matrix(input)?;
    let whole = 0..text.len();
    let stages = rows.len();
    check_stages(&stages.into(), limits).map_err(|kind| input.error(&whole, kind))?;
    if let Some((span, row)) = rows.iter().find(|(_, row)| row.len() != stages) {
        let kind = ErrorKind::Type {
            found: format!("a row of {} entries", row.len()),
            expected: format!("a square matrix: {stages} rows of {stages} entries"),
        };
        return Err(input.error(span, kind));
    }
    rows.iter().map(|(_, row)| constants(input, row)).collect()
}
