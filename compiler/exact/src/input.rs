//! Texts, the numbers in them, and the places of errors.

use std::ops::Range;

use num_bigint::BigInt;
use num_rational::BigRational;

use crate::error::{Error, ErrorKind, Place};

/// The largest exponent of a power, and of a number such as `1e-300`.
pub const MAX_EXPONENT: u32 = 400;

/// An input text with its name, for messages.
#[derive(Debug, Clone, Copy)]
pub struct Input<'a> {
    /// What the text is, e.g. `basis`.
    pub name: &'a str,
    /// The text.
    pub text: &'a str,
}

/// The character that some programs write at the start of UTF-8 text.
const BYTE_ORDER_MARK: char = '\u{feff}';

/// A text without a byte-order mark at its start.
pub fn without_mark(text: &str) -> &str {
    text.strip_prefix(BYTE_ORDER_MARK).unwrap_or(text)
}

impl<'a> Input<'a> {
    /// The text of a file, without a byte-order mark at its start.
    pub fn of_file(name: &'a str, text: &'a str) -> Self {
        let text = without_mark(text);
        Input { name, text }
    }

    /// A part of the text.
    pub fn place(&self, span: Range<usize>) -> Place {
        Place {
            input: self.name.to_owned(),
            text: self.text.to_owned(),
            span,
        }
    }

    /// An error at a part of the text.
    pub fn error(&self, span: &Range<usize>, kind: ErrorKind) -> Error {
        Error::at(kind, self.place(span.clone()))
    }
}

/// A word of the input as it is repeated in a message: whole if it is short.
pub fn shown(text: &str) -> String {
    const LENGTH: usize = 40;
    if text.chars().count() <= LENGTH {
        return text.to_owned();
    }
    let start: String = text.chars().take(LENGTH).collect();
    format!("{start}…")
}

/// The end of the number that starts at a position: digits, a fraction, an exponent.
pub fn number_end(text: &str, start: usize) -> usize {
    let digits = |from: usize| {
        text[from..]
            .find(|c: char| !c.is_ascii_digit())
            .map_or(text.len(), |n| from + n)
    };
    let mut end = digits(start);
    if text[end..].starts_with('.') {
        end = digits(end + 1);
    }
    if text[end..].starts_with(['e', 'E']) {
        let sign = usize::from(text[end + 1..].starts_with(['+', '-']));
        let exponent = digits(end + 1 + sign);
        if exponent > end + 1 + sign {
            end = exponent;
        }
    }
    end
}

/// The number in `span`, exactly.
pub fn number(input: Input<'_>, span: Range<usize>) -> Result<BigRational, Error> {
    let text = &input.text[span.clone()];
    let (mantissa, exponent) = text.split_once(['e', 'E']).unwrap_or((text, "0"));
    let (whole, fraction) = mantissa.split_once('.').unwrap_or((mantissa, ""));
    let digits: BigInt = format!("{whole}{fraction}").parse().map_err(|_| {
        let kind = ErrorKind::Syntax {
            found: format!("found `{text}`"),
            expected: "a number".to_owned(),
        };
        input.error(&span, kind)
    })?;
    let limit = MAX_EXPONENT as i32;
    let exponent = exponent
        .parse::<i32>()
        .ok()
        .filter(|e| e.abs() <= limit)
        .ok_or_else(|| {
            let kind = ErrorKind::Type {
                found: format!("a number with the exponent {}", shown(exponent)),
                expected: format!("an exponent from -{limit} to {limit}"),
            };
            input.error(&span, kind)
        })?;
    let power = |n: usize| BigInt::from(10u32).pow(n as u32);
    let value = BigRational::new(digits, power(fraction.len()));
    let scale = BigRational::from_integer(power(exponent.unsigned_abs() as usize));
    Ok(if exponent < 0 {
        value / scale
    } else {
        value * scale
    })
}
