//! The tokens of a table in any of the languages.

use std::ops::Range;

use num_bigint::BigInt;

use super::fortran;
use super::value::Value;
use crate::error::{Error, ErrorKind};
use crate::expression::{Input, shown};
use crate::library::Notation;

/// The longest text that is read.
const MAX_LENGTH: usize = 1 << 20;

#[derive(Debug, Clone)]
pub(super) enum Token {
    Number(Value),
    /// A name; for `table->a` and `numpy.array` the last part.
    Name(String),
    /// The text between quotes.
    Text(Range<usize>),
    /// A symbol. `÷` stands for the `//` of fractions, `^` also for `**`, and `=` also for `:=`.
    Symbol(char),
    /// The end of a line.
    Line,
    /// What is wrong with a part that is not a token. It is an error only where a value is read.
    Wrong(ErrorKind),
}

/// A token and its place.
#[derive(Debug, Clone)]
pub(super) struct Spanned {
    pub token: Token,
    pub span: Range<usize>,
    /// Whether there is white space before it.
    pub apart: bool,
}

/// The kind of text.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub(super) enum Kind {
    /// A file, with comments and continued lines.
    File,
    /// A single number, as in quotes.
    Number,
}

/// Reads the tokens of a part of a text.
pub(super) fn tokenize(
    input: Input<'_>,
    range: Range<usize>,
    notation: Notation,
    kind: Kind,
) -> Result<Vec<Spanned>, Error> {
    if input.text.len() > MAX_LENGTH {
        let kind = ErrorKind::ExpressionSize {
            what: "its length",
            size: input.text.len(),
            limit: MAX_LENGTH,
        };
        return Err(input.error(&(0..1), kind));
    }
    let fortran = kind == Kind::File && fortran::is_fortran(input.text, notation);
    let mut reader = Reader {
        input,
        notation,
        kind,
        fortran,
        fixed: fortran && fortran::is_fixed(input.text),
        at: range.start,
        end: range.end,
    };
    let mut tokens = Vec::new();
    let mut apart = true;
    // Whether the line has no tokens yet.
    let mut fresh = true;
    while reader.at < reader.end {
        let start = reader.at;
        let continues = reader.fortran && fresh && !tokens.is_empty();
        if let Some(mark) = reader.continuation().filter(|_| continues) {
            // The previous line continues here.
            while matches!(
                tokens.last(),
                Some(Spanned {
                    token: Token::Line,
                    ..
                })
            ) {
                tokens.pop();
            }
            reader.skip(mark);
            (apart, fresh) = (true, false);
            continue;
        }
        match reader.next(tokens.last(), apart)? {
            Some(token) => {
                let span = start..reader.at;
                let line = matches!(token, Token::Line);
                tokens.push(Spanned { token, span, apart });
                apart = line;
            }
            None => apart = true,
        }
        let read = &input.text[start..reader.at];
        fresh = read.contains('\n') || fresh && read.trim().is_empty();
    }
    Ok(tokens)
}

struct Reader<'a> {
    input: Input<'a>,
    notation: Notation,
    kind: Kind,
    fortran: bool,
    /// Whether columns have a meaning in Fortran.
    fixed: bool,
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

    /// The bytes up to the first character of a line of Fortran that continues the previous line, if this line does.
    fn continuation(&self) -> Option<usize> {
        let rest = self.rest();
        if rest.starts_with('&') {
            return Some(1);
        }
        (self.fixed && self.begins_line() && fortran::continues(rest.lines().next()?)).then_some(6)
    }

    fn begins_line(&self) -> bool {
        self.input.text[..self.at].is_empty() || self.input.text[..self.at].ends_with('\n')
    }

    /// Skips the accepted characters.
    fn run(&mut self, accept: impl Fn(char) -> bool) {
        let rest = self.rest();
        self.skip(rest.find(|c| !accept(c)).unwrap_or(rest.len()));
    }

    fn wrong(&self, span: Range<usize>, message: &str) -> Error {
        let message = message.to_owned();
        self.input.error(&span, ErrorKind::Document { message })
    }

    /// Skips a multi-line comment or text.
    fn block(&mut self, open: &str, close: &str) -> Result<(), Error> {
        let nests = matches!(open, "#=" | "(*");
        let (start, mut depth) = (self.at, 1_usize);
        self.skip(open.len());
        while depth > 0 {
            let rest = self.rest();
            if rest.starts_with(close) {
                depth -= 1;
                self.skip(close.len());
            } else if nests && rest.starts_with(open) {
                depth += 1;
                self.skip(open.len());
            } else if let Some(next) = rest.chars().next() {
                self.skip(next.len_utf8());
            } else {
                let span = start..start + open.len();
                return Err(self.wrong(span, &format!("`{open}` has no `{close}` behind it")));
            }
        }
        Ok(())
    }

    /// Skips a comment, if one begins here.
    fn comment(&mut self, first: char, last: Option<&Spanned>) -> Result<bool, Error> {
        if self.kind == Kind::Number {
            return Ok(false);
        }
        let rest = self.rest();
        // `%` is an operator in Julia, except where a number cannot end.
        let begins = || match last.map(|last| &last.token) {
            None | Some(Token::Line) => true,
            Some(Token::Symbol(c)) => matches!(c, ';' | ',' | '['),
            Some(_) => false,
        };
        let blocks: &[(&str, &str)] = match self.notation {
            Notation::C => &[("/*", "*/")],
            Notation::Julia => &[("#=", "=#"), ("%{", "%}")],
            Notation::Python => &[],
            Notation::Mathematica => &[("(*", "*)")],
        };
        let block = blocks.iter().find(|(open, _)| rest.starts_with(open));
        if let Some((open, close)) = block.filter(|(open, _)| *open != "%{" || begins()) {
            self.block(open, close)?;
            return Ok(true);
        }
        let line = match (self.notation, first) {
            (Notation::C, '#') => true,
            (Notation::C, '/') => rest.starts_with("//"),
            (Notation::Julia | Notation::Python, '#') => true,
            (Notation::Julia, '%') => begins(),
            _ => false,
        };
        let column = self.fixed && matches!(first, 'c' | 'C' | '*') && self.begins_line();
        let line = line || self.fortran && first == '!' || column;
        if !line {
            return Ok(false);
        }
        // The end of the line is a token.
        self.run(|c| c != '\n');
        while self.notation == Notation::C
            && self.input.text[..self.at]
                .trim_end_matches('\r')
                .ends_with('\\')
            && self.at < self.end
        {
            self.skip(1);
            self.run(|c| c != '\n');
        }
        Ok(true)
    }

    /// Skips the continuation mark of Fortran, Python and Matlab, if there is one here.
    fn continued(&mut self, first: char) -> bool {
        if self.kind == Kind::Number {
            return false;
        }
        let rest = self.rest();
        let (mark, comments): (usize, &[char]) = match (self.notation, first) {
            (Notation::C | Notation::Julia, '&') if self.fortran => (1, &['!']),
            (_, '\\') => (1, &[]),
            (Notation::Julia, '.') if rest.starts_with("...") => (3, &['%', '#']),
            _ => return false,
        };
        let line = rest[mark..].split('\n').next().unwrap_or_default();
        let blank = line.trim_start();
        if blank.is_empty() || blank.starts_with(comments) {
            self.skip(mark + line.len() + 1);
            return true;
        }
        // `...` within a line splices the entries of a list.
        if mark == 3 {
            self.skip(mark);
        }
        mark == 3
    }

    /// The next token; `None` for white space and comments.
    fn next(&mut self, last: Option<&Spanned>, apart: bool) -> Result<Option<Token>, Error> {
        let Some(first) = self.rest().chars().next() else {
            return Ok(None);
        };
        if self.comment(first, last)? {
            return Ok(None);
        }
        if first == '\n' {
            self.skip(1);
            let ends = self.notation != Notation::C || self.fortran;
            return Ok(ends.then_some(Token::Line));
        }
        if self.continued(first) {
            return Ok(None);
        }
        let rest = self.rest();
        for quotes in ["\"\"\"", "'''"] {
            let known = match self.notation {
                Notation::Python => true,
                Notation::Julia => quotes.starts_with('"'),
                Notation::C | Notation::Mathematica => false,
            };
            if known && self.kind == Kind::File && rest.starts_with(quotes) {
                self.block(quotes, quotes)?;
                return Ok(Some(Token::Symbol('"')));
            }
        }
        if first.is_whitespace() {
            self.skip(first.len_utf8());
            return Ok(None);
        }
        let wrong = |error: Error| Token::Wrong(*error.kind);
        let digit_follows = rest.chars().nth(1).is_some_and(|c| c.is_ascii_digit());
        if first.is_ascii_digit() || first == '.' && digit_follows {
            return Ok(Some(self.number().map_or_else(wrong, Token::Number)));
        }
        // `'` directly after a matrix transposes it.
        let transposed = self.notation == Notation::Julia
            && !self.fortran
            && first == '\''
            && !apart
            && last.is_some_and(|last| match last.token {
                Token::Symbol(c) => matches!(c, ')' | ']' | '}' | '.' | '\''),
                Token::Name(_) | Token::Number(_) => true,
                Token::Text(_) | Token::Line | Token::Wrong(_) => false,
            });
        if first == '"' || first == '\'' && !transposed {
            return Ok(Some(self.text(first).unwrap_or_else(wrong)));
        }
        if first.is_alphabetic() || first == '_' {
            loop {
                let start = self.at;
                self.run(|c| c.is_alphanumeric() || c == '_');
                let name = start..self.at;
                // `table->a`, `numpy.array` and `std::sqrt` are reduced to their last parts.
                let rest = self.rest();
                // `a.b` is a product in Mathematica, and `a::Vector` gives a type in Julia.
                let links: &[&str] = match self.notation {
                    Notation::Mathematica => &[],
                    Notation::Julia => &["->", "."],
                    Notation::C | Notation::Python => &["->", "::", "."],
                };
                let link = links.iter().find(|link| {
                    rest.strip_prefix(**link).is_some_and(|rest| {
                        rest.starts_with(|c: char| c.is_alphabetic() || c == '_')
                    })
                });
                match link {
                    Some(link) => self.skip(link.len()),
                    None => {
                        let name = &self.input.text[name];
                        let plain = match self.fortran {
                            true => name.to_ascii_lowercase(),
                            false => name.to_owned(),
                        };
                        return Ok(Some(Token::Name(plain)));
                    }
                }
            }
        }
        let marks = [
            ("//", '÷', true),
            ("**", '^', true),
            (":=", '=', true),
            ("==", '≡', true),
            ("(/", '[', self.fortran),
            ("/)", ']', self.fortran),
        ];
        for (mark, symbol, known) in marks {
            if known && rest.starts_with(mark) {
                self.skip(2);
                return Ok(Some(Token::Symbol(symbol)));
            }
        }
        self.skip(first.len_utf8());
        Ok(Some(Token::Symbol(first)))
    }

    /// The text between quotes, on one line.
    fn text(&mut self, quote: char) -> Result<Token, Error> {
        let open = self.at..self.at + 1;
        self.skip(1);
        let start = self.at;
        loop {
            self.run(|c| c != quote && c != '\n' && c != '\\');
            if !self.rest().starts_with('\\') {
                break;
            }
            self.skip(1);
            let escaped = self.rest().chars().next();
            self.skip(escaped.map_or(0, char::len_utf8));
        }
        let range = start..self.at;
        if !self.rest().starts_with(quote) {
            return Err(self.wrong(open, &format!("`{quote}` has no `{quote}` in this line")));
        }
        self.skip(1);
        Ok(Token::Text(range))
    }

    /// A number with the suffix of its language.
    fn number(&mut self) -> Result<Value, Error> {
        let start = self.at;
        let text = self.rest();
        let hexadecimal_digits = text.strip_prefix("0x").or_else(|| text.strip_prefix("0X"));
        let mut value = match hexadecimal_digits {
            Some(digits) if self.notation != Notation::Mathematica => {
                let (value, length) = hexadecimal(digits);
                self.skip(2 + length);
                value
            }
            _ => {
                let (value, length) = decimal(text, self.exponents());
                self.skip(length);
                value
            }
        };
        // `010` is 8 in C.
        let digits = &self.input.text[start..self.at];
        let octal = self.notation == Notation::C
            && !self.fortran
            && digits.len() > 1
            && digits.starts_with('0')
            && digits.bytes().all(|byte| byte.is_ascii_digit());
        self.suffix();
        if self.at > start + digits.len()
            && let Some(value) = &mut value
        {
            value.whole = false;
        }
        // `2a1` is a product in Julia.
        let product = self.notation == Notation::Julia && !self.fortran;
        let glued = self.rest().starts_with(|c: char| {
            c.is_alphanumeric() && !product
                || c.is_ascii_digit()
                || matches!(c, '_' | '.' | '`')
                || c == '\'' && self.notation == Notation::C
        });
        let value = value.filter(|_| !glued && !octal);
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

    /// The exponent marks: `e`, `d` in Fortran, `f` in Julia and `*^` in Mathematica.
    fn exponents(&self) -> &'static [&'static str] {
        match self.notation {
            _ if self.fortran => &["e", "E", "d", "D"],
            Notation::C | Notation::Python => &["e", "E"],
            Notation::Julia => &["e", "E", "f"],
            Notation::Mathematica => &["*^"],
        }
    }

    /// Skips `_real64` in Fortran, `f` and `L` in C, and the precision `` `20 `` in Mathematica.
    fn suffix(&mut self) {
        let rest = self.rest();
        if self.fortran {
            if rest.starts_with('_') {
                self.run(|c| c.is_alphanumeric() || c == '_');
            }
        } else if self.notation == Notation::Mathematica && rest.starts_with('`') {
            self.run(|c| c == '`' || c == '.' || c.is_ascii_digit());
        } else if self.notation == Notation::C && rest.starts_with(['f', 'F', 'l', 'L']) {
            let single = !rest[1..].starts_with(|c: char| c.is_alphanumeric() || c == '_');
            self.skip(usize::from(single));
        }
    }
}

/// A decimal with an exponent after one of the marks, and its length.
fn decimal(text: &str, marks: &[&str]) -> (Option<Value>, usize) {
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
    let mark = marks.iter().find(|mark| text[end..].starts_with(**mark));
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

/// The part after `0x` of a hexadecimal floating constant, and its length.
fn hexadecimal(text: &str) -> (Option<Value>, usize) {
    /// Numbers of a table have no more digits.
    const MAX_DIGITS: usize = 64;
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
    let numerator = (digits.len() <= MAX_DIGITS)
        .then(|| BigInt::parse_bytes(digits.as_bytes(), 16))
        .flatten();
    let places = i64::try_from(places).unwrap_or(0);
    let value =
        numerator.and_then(|numerator| Value::binary(numerator, exponent - 4 * places).ok());
    let whole = whole == end;
    (value.map(|value| value.with_whole(whole)), end)
}
