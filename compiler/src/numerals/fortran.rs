//! Fortran: how a text is recognised, its fixed form, and its `data` statements.

use std::collections::BTreeSet;

use num_bigint::BigInt;
use num_traits::{ToPrimitive, Zero};

use super::source::MAX_NUMBERS;
use super::tokens::{Spanned, Token};
use super::value::Value;
use crate::library::Notation;

/// Whether a text is Fortran. It has no braces outside comments, and one of these: a declaration with ` :: `, a line continued by `&`, a
/// `data` statement, a line that begins with a keyword of Fortran, an element that is assigned a value with an exponent `d`. If the
/// language is otherwise C, an assignment to any element in round brackets is enough, in a text without `;`.
pub(super) fn is_fortran(text: &str, notation: Notation) -> bool {
    let braces = |line: &str| {
        line.split('!')
            .next()
            .is_some_and(|code| code.contains(['{', '}']))
    };
    let possible = matches!(notation, Notation::C | Notation::Julia) && !text.lines().any(braces);
    let c = notation == Notation::C && !text.contains(';');
    possible
        && (text.contains(" :: ")
            || text.lines().any(|line| {
                is_continued(line)
                    || is_declaration(line)
                    || element_value(line).is_some_and(|value| c || has_d_exponent(value))
            }))
}

fn is_continued(line: &str) -> bool {
    let line = line.trim_end();
    line.ends_with('&') && !line.ends_with("&&")
}

fn is_declaration(line: &str) -> bool {
    const KEYWORDS: [&str; 7] = [
        "double precision ",
        "implicit none",
        "implicit real",
        "real*8 ",
        "dimension ",
        "program ",
        "subroutine ",
    ];
    let line = line.trim().to_ascii_lowercase();
    let data = line.strip_prefix("data ").is_some_and(|rest| {
        let name = rest.trim_start().split('/').next().unwrap_or_default();
        let first = |c: char| c.is_ascii_alphabetic();
        rest.matches('/').count() > 1 && name.starts_with(first) && !name.contains('=')
    });
    // `parameter (a1 = 0.5d0)`
    let parameter = line.strip_prefix("parameter").is_some_and(|rest| {
        let inside = rest.trim_start().strip_prefix('(').unwrap_or_default();
        let name = inside.split([')', ',']).next().unwrap_or_default();
        name.starts_with(|c: char| c.is_ascii_alphabetic()) && name.contains('=')
    });
    let keyword = |word: &str| {
        let rest = line.strip_prefix(word);
        rest.is_some_and(|rest| !rest.trim_start().starts_with('='))
    };
    data || parameter || KEYWORDS.iter().any(|word| keyword(word))
}

/// The names of lists with an explicit lower bound, as in `x(0:1)` and `dimension(0:1) :: x`.
pub(super) fn bounded(tokens: &[Spanned]) -> BTreeSet<String> {
    let is = |at: usize, symbol: char| matches!(tokens.get(at), Some(found) if matches!(found.token, Token::Symbol(c) if c == symbol));
    let one = |at: usize| matches!(&tokens[at].token, Token::Number(value) if value.constant.to_string() == "1");
    let mut names = BTreeSet::new();
    // The name before each open bracket, and the first token of the present dimension.
    let mut open: Vec<(Option<&String>, usize)> = Vec::new();
    let mut all = false;
    for (at, found) in tokens.iter().enumerate() {
        match &found.token {
            Token::Line => all = false,
            Token::Name(name) if all => _ = names.insert(name.clone()),
            Token::Symbol('(') => {
                let before = at.checked_sub(1).map(|at| &tokens[at].token);
                let name = match before {
                    Some(Token::Name(name)) => Some(name),
                    _ => None,
                };
                open.push((name, at + 1));
            }
            Token::Symbol(')') => _ = open.pop(),
            Token::Symbol(',') => {
                if let Some((_, first)) = open.last_mut() {
                    *first = at + 1;
                }
            }
            Token::Symbol(':') if !is(at + 1, ':') => {
                if let Some(&(Some(name), first)) = open.last()
                    && first < at
                    && !(first + 1 == at && one(first))
                {
                    all |= name == "dimension";
                    names.insert(name.clone());
                }
            }
            _ => {}
        }
    }
    names
}

/// The value of `a(1) = 1.0d0`.
fn element_value(line: &str) -> Option<&str> {
    let (target, value) = line.split_once('=')?;
    let (name, index) = target.trim().strip_suffix(')')?.split_once('(')?;
    let named = name
        .trim()
        .bytes()
        .all(|c| c.is_ascii_alphanumeric() || c == b'_');
    let digits = index.trim();
    let number = !digits.is_empty() && digits.bytes().all(|c| c.is_ascii_digit());
    (named && number && !name.trim().is_empty()).then_some(value)
}

/// Whether there is a number such as `1.0d0` or `1D-3`.
fn has_d_exponent(value: &str) -> bool {
    let bytes = value.as_bytes();
    bytes.windows(3).any(|found| {
        let before = found[0].is_ascii_digit() || found[0] == b'.';
        let after = found[2].is_ascii_digit() || matches!(found[2], b'+' | b'-');
        before && matches!(found[1], b'd' | b'D') && after
    })
}

/// Whether a text is in fixed form: its first five columns hold labels only, and a comment begins with `c` or `*` in the first column.
pub(super) fn is_fixed(text: &str) -> bool {
    let comment = |line: &str| line.starts_with(['c', 'C', '*']);
    let label = |line: &str| {
        let columns = line.bytes().take(5);
        let mut columns = columns.filter(|&c| c != b' ');
        columns.all(|c| c.is_ascii_digit()) || line.trim_start().starts_with('!')
    };
    let special = text.lines().any(|line| comment(line) || continues(line));
    special
        && text
            .lines()
            .all(|line| comment(line) || line.starts_with('\t') || label(line))
}

/// Whether a line in fixed form continues the previous line: it has a mark in column 6.
pub(super) fn continues(line: &str) -> bool {
    let mark = line.as_bytes().get(5);
    line.starts_with("     ") && mark.is_some_and(|&mark| mark.is_ascii_graphic() && mark != b'0')
}

/// Writes the statements `data a /1.0, 2.0/, b(1) /3*0.5/` as the assignments `a = [1.0, 2.0], b(1) = …`; a list for several names
/// stays as it is.
pub(super) fn data_statements(tokens: &mut Vec<Spanned>) {
    let is = |tokens: &[Spanned], at: usize, symbol: char| matches!(tokens.get(at), Some(found) if matches!(found.token, Token::Symbol(c) if c == symbol));
    let named = |tokens: &[Spanned], at: usize| matches!(tokens.get(at), Some(found) if matches!(found.token, Token::Name(_)));
    let mut at = 0;
    while at < tokens.len() {
        let data = matches!(&tokens[at].token, Token::Name(name) if name == "data");
        let begins = at == 0 || matches!(tokens[at - 1].token, Token::Line);
        at += 1;
        if !(data && begins) {
            continue;
        }
        // One object after the other: a name, perhaps with an index, and its values between slashes.
        while named(tokens, at) {
            let open = match is(tokens, at + 1, '(') {
                true if is(tokens, at + 3, ')') => at + 4,
                true => break,
                false => at + 1,
            };
            let rest = tokens.get(open + 1..).unwrap_or_default();
            let end = rest
                .iter()
                .position(|token| matches!(token.token, Token::Symbol('/') | Token::Line));
            let close = match end {
                Some(length) if is(tokens, open, '/') && is(tokens, open + 1 + length, '/') => {
                    open + 1 + length
                }
                _ => break,
            };
            let element = open > at + 1;
            let Some(values) = repeated(&tokens[open + 1..close]) else {
                break;
            };
            let written = |token, at: usize| Spanned {
                token,
                span: tokens[at].span.clone(),
                apart: true,
            };
            let mut assignment = vec![written(Token::Symbol('='), open)];
            if !element {
                assignment.push(written(Token::Symbol('['), open));
            }
            assignment.extend(values);
            assignment.push(written(
                if element {
                    Token::Line
                } else {
                    Token::Symbol(']')
                },
                close,
            ));
            at = open + assignment.len();
            tokens.splice(open..=close, assignment);
            at += usize::from(is(tokens, at, ','));
        }
    }
}

/// The values of a `data` statement with `3*0.5` written three times; `None` if a count is too large.
fn repeated(values: &[Spanned]) -> Option<Vec<Spanned>> {
    let mut written: Vec<Spanned> = Vec::new();
    for item in values.split_inclusive(|token| matches!(token.token, Token::Symbol(','))) {
        let count = match item {
            [
                Spanned {
                    token: Token::Number(count),
                    ..
                },
                Spanned {
                    token: Token::Symbol('*'),
                    ..
                },
                ..,
            ] if count.whole => Some(count),
            _ => None,
        };
        let Some(count) = count else {
            written.extend_from_slice(item);
            continue;
        };
        let count = count.constant.as_rational()?.to_integer().to_usize()?;
        let comma = matches!(item.last(), Some(last) if matches!(last.token, Token::Symbol(',')));
        let single = &item[2..item.len() - usize::from(comma)];
        let room = count
            .checked_mul(single.len() + 1)
            .and_then(|n| n.checked_add(written.len()));
        if room.is_none_or(|n| n > MAX_NUMBERS) {
            return None;
        }
        let separator = Spanned {
            token: Token::Symbol(','),
            span: item[1].span.clone(),
            apart: true,
        };
        for _ in 0..count {
            written.extend_from_slice(single);
            written.push(separator.clone());
        }
        if !comma {
            written.pop();
        }
    }
    Some(written)
}

/// The double whose bits are the hexadecimal digits of `z'3FE0000000000000'`; `None` for NaN, infinity and texts that are not digits.
pub(super) fn double_of_bits(digits: &str) -> Option<Value> {
    // `from_str_radix` reads a sign too.
    let hexadecimal = digits.bytes().all(|c| c.is_ascii_hexdigit());
    let bits = u64::from_str_radix(digits, 16)
        .ok()
        .filter(|_| hexadecimal)?;
    let double = f64::from_bits(bits);
    if !double.is_finite() || digits.len() > 16 {
        return None;
    }
    let exponent = i64::try_from(bits >> 52 & 0x7ff).ok()?;
    let fraction = BigInt::from(bits & ((1 << 52) - 1));
    let (numerator, exponent) = match exponent {
        0 => (fraction, -1074),
        _ => (fraction + (BigInt::from(1) << 52), exponent - 1075),
    };
    if numerator.is_zero() {
        return Value::binary(numerator, 0).ok();
    }
    let numerator = if double < 0.0 { -numerator } else { numerator };
    Value::binary(numerator, exponent).ok()
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn hexadecimal_bits_are_read_as_doubles() {
        for double in [
            0.0,
            1.0,
            -2.0 / 3.0,
            1.0 / 3.0,
            -5e-324,
            f64::MIN_POSITIVE,
            1e300,
        ] {
            let value = double_of_bits(&format!("{:016X}", f64::to_bits(double)));
            let value = value.expect("a double").rational();
            assert_eq!(crate::arithmetic::rounding::to_f64(&value), double);
        }
        for text in [
            "7FF0000000000000",
            "FFF8000000000000",
            "",
            "x",
            "13FE0000000000000",
            "+3FE000000000000",
        ] {
            assert!(double_of_bits(text).is_none(), "{text}");
        }
    }

    #[test]
    fn fortran_is_recognised() {
        for text in [
            "a(1) = 1.0d0\na(2) = 0.0d0",
            "      DATA A /1.0D0, 0.0D0/",
            "double precision a(2)\na(1) = 1",
            "a = [1, &\n 2]",
            "parameter (a1 = 0.5d0, b1 = 1) ! {not C}",
            "parameter(a1 = 0.5d0)",
        ] {
            for notation in [Notation::C, Notation::Julia] {
                assert!(is_fortran(text, notation), "{text}");
            }
        }
        assert!(is_fortran("a(1) = 0.5", Notation::C));
        for text in [
            // Matlab, Julia and C.
            "a(1) = 0.5;\na(2) = 0.5;",
            "a(1) = 0.5",
            "data = a / b / c",
            "dimension = 2\na = [1]",
            "program = \"x\"",
            "parameter = 2",
            "parameter(1) = 2",
            "f(x) = 2d1",
            "a(1) = 1.0d0; b[1] = {2}",
        ] {
            assert!(!is_fortran(text, Notation::Julia), "{text}");
        }
        assert!(is_fixed("c a comment\n      a(1) = 1.0\n     & + 2\n"));
        assert!(!is_fixed("c(1) = 1.0\na(1) = 1.0"));
    }
}
