//! The text of a table as tokens, in whichever of the languages it is written.

use std::ops::Range;

use num_bigint::BigInt;

use super::value::Value;
use crate::error::{Error, ErrorKind};
use crate::expression::{Input, shown};
use crate::library::Notation;

/// The longest text that is read.
const MAX_LENGTH: usize = 1 << 20;

#[derive(Debug, Clone)]
pub(super) enum Token {
    Number(Value),
    /// A name; of `table->a` and `numpy.array` the last part.
    Name(String),
    /// What stands between quotes.
    Text(Range<usize>),
    /// `÷` is the `//` of fractions, `^` is `**` too, and `=` is `:=` too.
    Symbol(char),
    /// The end of a line.
    Line,
}

/// A token and where it stands.
#[derive(Debug, Clone)]
pub(super) struct Spanned {
    pub token: Token,
    pub span: Range<usize>,
    /// Whether there is white space before it.
    pub apart: bool,
}

/// Reads the tokens of a part of a text.
pub(super) fn tokenize(
    input: Input<'_>,
    range: Range<usize>,
    notation: Notation,
) -> Result<Vec<Spanned>, Error> {
    if input.text.len() > MAX_LENGTH {
        let kind = ErrorKind::ExpressionSize {
            what: "its length",
            size: input.text.len(),
            limit: MAX_LENGTH,
        };
        return Err(input.error(&(0..1), kind));
    }
    let mut reader = Reader {
        input,
        notation,
        at: range.start,
        end: range.end,
    };
    let mut tokens = Vec::new();
    let mut apart = true;
    while reader.at < reader.end {
        let start = reader.at;
        match reader.next()? {
            Some(token) => {
                let span = start..reader.at;
                let line = matches!(token, Token::Line);
                tokens.push(Spanned { token, span, apart });
                apart = line;
            }
            None => apart = true,
        }
    }
    Ok(tokens)
}

struct Reader<'a> {
    input: Input<'a>,
    notation: Notation,
    at: usize,
    end: usize,
}

impl<'a> Reader<'a> {
    fn rest(&self) -> &'a str {
        &self.input.text[self.at..self.end]
    }

    fn skip(&mut self, bytes: usize) {
        self.at = (self.at + bytes).min(self.end);
    }

    /// Skips what is accepted.
    fn run(&mut self, accept: impl Fn(char) -> bool) {
        let rest = self.rest();
        self.skip(rest.find(|c| !accept(c)).unwrap_or(rest.len()));
    }

    /// The next token; `None` for white space and comments.
    fn next(&mut self) -> Result<Option<Token>, Error> {
        let rest = self.rest();
        let Some(first) = rest.chars().next() else {
            return Ok(None);
        };
        let comment = match rest {
            _ if rest.starts_with("/*") => Some("*/"),
            _ if rest.starts_with("(*") && self.notation == Notation::Mathematica => Some("*)"),
            _ if rest.starts_with("//") && self.notation == Notation::C => Some("\n"),
            _ if matches!(first, '#' | '%' | '!') => Some("\n"),
            _ => None,
        };
        if let Some(end) = comment {
            let length = rest.find(end);
            // The end of the line is a token.
            let after = if end == "\n" { 0 } else { end.len() };
            self.skip(length.map_or(rest.len(), |length| length + after));
            return Ok(None);
        }
        if first == '\n' {
            self.skip(1);
            return Ok((self.notation != Notation::C).then_some(Token::Line));
        }
        // Continuation marks of Fortran, Python and Matlab.
        if matches!(first, '&' | '\\') || rest.starts_with("...") {
            self.run(|c| c != '\n');
            self.skip(1);
            return Ok(None);
        }
        if first.is_whitespace() {
            self.skip(first.len_utf8());
            return Ok(None);
        }
        let digit_follows = rest.chars().nth(1).is_some_and(|c| c.is_ascii_digit());
        if first.is_ascii_digit() || first == '.' && digit_follows {
            return self.number().map(|value| Some(Token::Number(value)));
        }
        if first == '"' || first == '\'' {
            return Ok(Some(self.text(first)));
        }
        if first.is_alphabetic() || first == '_' {
            let start = self.at;
            self.run(|c| c.is_alphanumeric() || c == '_');
            let name = self.input.text[start..self.at].to_owned();
            // `table->a`, `numpy.array` and `std::sqrt` are their last parts.
            let rest = self.rest();
            let link = ["->", "::", "."].into_iter().find(|link| {
                rest.strip_prefix(link)
                    .is_some_and(|rest| rest.starts_with(|c: char| c.is_alphabetic() || c == '_'))
            });
            return Ok(match link {
                Some(link) => {
                    self.skip(link.len());
                    self.next()?
                }
                None => Some(Token::Name(name)),
            });
        }
        for (mark, symbol) in [("//", '÷'), ("**", '^'), (":=", '='), ("==", '≡')] {
            if rest.starts_with(mark) {
                self.skip(2);
                return Ok(Some(Token::Symbol(symbol)));
            }
        }
        self.skip(first.len_utf8());
        Ok(Some(Token::Symbol(first)))
    }

    fn text(&mut self, quote: char) -> Token {
        self.skip(1);
        let start = self.at;
        self.run(|c| c != quote && c != '\n');
        let range = start..self.at;
        self.skip(1);
        Token::Text(range)
    }

    /// A number with whatever its language puts behind it.
    fn number(&mut self) -> Result<Value, Error> {
        let start = self.at;
        let text = self.rest();
        let value = match text.strip_prefix("0x").or_else(|| text.strip_prefix("0X")) {
            Some(digits) => {
                let (value, length) = hexadecimal(digits);
                self.skip(2 + length);
                value
            }
            None => {
                let (value, length) = decimal(text);
                self.skip(length);
                value
            }
        };
        self.suffix();
        // `2a1` is a product in Julia.
        let product = self.notation == Notation::Julia;
        let glued = self.rest().starts_with(|c: char| {
            c.is_alphanumeric() && !product || c.is_ascii_digit() || c == '_' || c == '.'
        });
        let value = value.filter(|_| !glued);
        value.ok_or_else(|| {
            self.run(|c| c.is_alphanumeric() || c == '_' || c == '.');
            let span = start..self.at;
            let kind = ErrorKind::Syntax {
                found: format!("found `{}`", shown(&self.input.text[span.clone()])),
                expected: "a number".to_owned(),
            };
            self.input.error(&span, kind)
        })
    }

    /// `_real64`, `f`, `L`, and the precision `` `20 `` of Mathematica.
    fn suffix(&mut self) {
        let rest = self.rest();
        if rest.starts_with('_') {
            self.run(|c| c.is_alphanumeric() || c == '_');
        } else if rest.starts_with('`') {
            self.run(|c| c == '`' || c == '.' || c.is_ascii_digit());
        } else if rest.starts_with(['f', 'F', 'l', 'L']) {
            let single = !rest[1..].starts_with(|c: char| c.is_alphanumeric() || c == '_');
            self.skip(usize::from(single));
        }
    }
}

/// A decimal with the exponents `e`, `d` of Fortran, `f` of Julia and `*^` of Mathematica, and its length.
fn decimal(text: &str) -> (Option<Value>, usize) {
    let digits = |from: usize| {
        let rest = &text[from..];
        from + rest
            .find(|c: char| !c.is_ascii_digit())
            .unwrap_or(rest.len())
    };
    let mut end = digits(0);
    if text[end..].starts_with('.') {
        end = digits(end + 1);
    }
    let mantissa = &text[..end];
    let mark = ["*^", "e", "E", "d", "D", "f"]
        .into_iter()
        .find(|mark| text[end..].starts_with(mark));
    let mut exponent = "";
    if let Some(mark) = mark {
        let start = end + mark.len();
        let signed = start + usize::from(text[start..].starts_with(['+', '-']));
        if digits(signed) > signed {
            end = digits(signed);
            exponent = text[start..end].trim_start_matches('+');
        }
    }
    let number = match exponent {
        "" => mantissa.to_owned(),
        exponent => format!("{mantissa}e{exponent}"),
    };
    (Value::decimal(&number).ok(), end)
}

/// What stands behind `0x` in a hexadecimal floating constant, and its length.
fn hexadecimal(text: &str) -> (Option<Value>, usize) {
    /// More digits are no number of a table.
    const MOST: usize = 64;
    let hex = |from: usize| {
        let rest = &text[from..];
        from + rest
            .find(|c: char| !c.is_ascii_hexdigit())
            .unwrap_or(rest.len())
    };
    let whole = hex(0);
    let mut end = whole;
    if text[end..].starts_with('.') {
        end = hex(end + 1);
    }
    let digits = text[..end].replace('.', "");
    let places = digits.len() - whole;
    let mut exponent = 0;
    if text[end..].starts_with(['p', 'P']) {
        let start = end + 1 + usize::from(text[end + 1..].starts_with(['+', '-']));
        let rest = &text[start..];
        let stop = start
            + rest
                .find(|c: char| !c.is_ascii_digit())
                .unwrap_or(rest.len());
        match text[end + 1..stop].parse::<i64>() {
            Ok(found) if found.abs() <= 2000 => exponent = found,
            _ => return (None, stop),
        }
        end = stop;
    }
    let numerator = (digits.len() <= MOST)
        .then(|| BigInt::parse_bytes(digits.as_bytes(), 16))
        .flatten();
    let places = i64::try_from(places).unwrap_or(0);
    let value =
        numerator.and_then(|numerator| Value::binary(numerator, exponent - 4 * places).ok());
    (value, end)
}
