//! The tokens of a text.

use num_bigint::BigInt;
use num_rational::BigRational;

use super::super::syntax::Span;
use symplectic_exact::error::{Error, ErrorKind};
use symplectic_exact::input::{Input, number, number_end};

/// The longest text that is read.
const MAX_LENGTH: usize = 1_000_000;

#[derive(Debug, Clone, PartialEq)]
pub(super) enum Token {
    Number(BigRational),
    Name(String),
    Symbol(char),
    /// A raised number: the power in `x²`.
    Raised(BigRational),
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
        } else if raised(first).is_some() {
            let end = rest.find(|c| raised(c).is_none());
            position += end.unwrap_or(rest.len());
            let digits: String = rest[..position - start]
                .chars()
                .filter_map(raised)
                .collect();
            match digits.parse::<BigInt>() {
                Ok(number) => Token::Raised(number.into()),
                Err(_) => {
                    let kind = ErrorKind::Syntax {
                        found: format!("found `{}`", &text[start..position]),
                        expected: "a whole number as a raised power: `x²`, `x⁻¹`".to_owned(),
                    };
                    return Err(input.error(&(start..position), kind));
                }
            }
        } else if first.is_alphabetic() || first == '_' {
            // A raw identifier, `r#type`, means the name `type`.
            let begin = start + if rest.starts_with("r#") { 2 } else { 0 };
            let in_name = |c: char| (c.is_alphanumeric() || c == '_') && raised(c).is_none();
            let end = text[begin..].find(|c| !in_name(c));
            position = begin + end.unwrap_or(text.len() - begin);
            Token::Name(text[begin..position].to_owned())
        } else if "+-−*/^()[]{},;:|<>=.×·√".contains(first) {
            position += first.len_utf8();
            // The minus sign of printed formulas.
            Token::Symbol(if first == '−' { '-' } else { first })
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

/// The digit or the sign that is raised.
fn raised(c: char) -> Option<char> {
    const RAISED: &str = "⁰¹²³⁴⁵⁶⁷⁸⁹⁻";
    let place = RAISED.chars().position(|known| known == c)?;
    "0123456789-".chars().nth(place)
}
