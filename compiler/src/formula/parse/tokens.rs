//! The tokens of a text.

use num_rational::BigRational;

use super::super::syntax::Span;
use crate::error::{Error, ErrorKind};
use crate::expression::{Input, number, number_end};

/// The longest text that is read.
const MAX_LENGTH: usize = 1_000_000;

#[derive(Debug, Clone, PartialEq)]
pub(super) enum Token {
    Number(BigRational),
    Name(String),
    Symbol(char),
    End,
}

pub(super) fn tokenize(input: Input<'_>) -> Result<Vec<(Token, Span)>, Error> {
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
        let rest = &text[start..];
        let digit_follows = rest[first.len_utf8()..].starts_with(|c: char| c.is_ascii_digit());
        let token = if first.is_whitespace() {
            position += first.len_utf8();
            continue;
        } else if rest.starts_with("//") {
            position = rest.find('\n').map_or(text.len(), |end| start + end);
            continue;
        } else if first.is_ascii_digit()
            || (first == '.' && digit_follows && !text[..start].ends_with('.'))
        {
            // `0..n` is a range.
            let digits = rest.find(|c: char| !c.is_ascii_digit());
            let whole = start + digits.unwrap_or(rest.len());
            position = match text[whole..].starts_with("..") {
                true => whole,
                false => number_end(text, start),
            };
            Token::Number(number(input, start..position)?)
        } else if first.is_alphabetic() || first == '_' {
            // A raw identifier, `r#type`, means the name `type`.
            let begin = start + if rest.starts_with("r#") { 2 } else { 0 };
            let end = text[begin..].find(|c: char| !(c.is_alphanumeric() || c == '_'));
            position = begin + end.unwrap_or(text.len() - begin);
            Token::Name(text[begin..position].to_owned())
        } else if "+-*/^()[]{},;:|<>=.×·".contains(first) {
            position += first.len_utf8();
            Token::Symbol(first)
        } else {
            let kind = ErrorKind::Syntax {
                found: format!("found `{first}`"),
                expected: "a number, a name or one of + - * / ^ ( ) [ ] | , ; :".to_owned(),
            };
            return Err(input.error(&(start..start + first.len_utf8()), kind));
        };
        tokens.push((token, start..position));
    }
    tokens.push((Token::End, text.len()..text.len()));
    Ok(tokens)
}
