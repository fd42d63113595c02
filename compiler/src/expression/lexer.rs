//! Text to tokens.

use std::ops::Range;

use num_rational::BigRational;

use super::{Input, MAX_LENGTH};
use crate::error::{Error, ErrorKind};
use symplectic_exact::input::{number, number_end};

/// The names with hyphens, those of quadrature rules: `radau-left(3)` is a call, not a difference.
const HYPHENATED: [&str; 4] = [
    "clenshaw-curtis",
    "newton-cotes",
    "radau-left",
    "radau-right",
];

#[derive(Debug, Clone, PartialEq)]
pub(super) enum Token {
    Number(BigRational),
    Name(String),
    Symbol(char),
    End,
}

impl Token {
    /// The token as it is named in a message.
    pub(super) fn describe(&self, text: &str) -> String {
        match self {
            Token::End => "the input ends".to_owned(),
            _ => format!("found `{text}`"),
        }
    }
}

pub(super) fn tokenize(input: Input<'_>) -> Result<Vec<(Token, Range<usize>)>, Error> {
    let text = input.text;
    if text.len() > MAX_LENGTH {
        let kind = ErrorKind::ExpressionSize {
            what: "its length",
            size: text.len(),
            limit: MAX_LENGTH,
        };
        return Err(input.error(&(0..1), kind));
    }
    let mut tokens = Vec::new();
    let mut position = 0;
    while let Some(first) = text[position..].chars().next() {
        let start = position;
        let run = |from: usize, accept: fn(char) -> bool| {
            text[from..]
                .find(|c| !accept(c))
                .map_or(text.len(), |length| from + length)
        };
        let token = if first.is_whitespace() {
            position += first.len_utf8();
            continue;
        } else if first.is_ascii_digit() || first == '.' {
            position = number_end(text, position);
            Token::Number(number(input, start..position)?)
        } else if first.is_alphabetic() || first == '_' {
            position = run(position, |c| c.is_alphanumeric() || c == '_');
            let found =
                |name: &&&str| text[start..].starts_with(**name) && name.len() > position - start;
            if let Some(name) = HYPHENATED.iter().find(found) {
                position = start + name.len();
            }
            Token::Name(text[start..position].to_owned())
        } else if "+-*/^(),[]".contains(first) {
            position += 1;
            Token::Symbol(first)
        } else {
            let kind = ErrorKind::Syntax {
                found: format!("found `{first}`"),
                expected: "a number, a name or one of + - * / ^ ( ) [ ] ,".to_owned(),
            };
            return Err(input.error(&(start..start + first.len_utf8()), kind));
        };
        tokens.push((token, start..position));
    }
    tokens.push((Token::End, text.len()..text.len()));
    Ok(tokens)
}
