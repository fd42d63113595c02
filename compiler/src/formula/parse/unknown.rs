//! Unknown notation, and what was probably meant.

use super::tokens::Token;
use super::{Parser, VECTOR_FUNCTIONS, is_function};
use crate::error::{Error, ErrorKind};
use crate::expression::Input;
use crate::formula::function::ELEMENTARY;
use crate::formula::syntax::{Definition, Name};

impl Parser<'_> {
    /// The notation here for what is written as in Rust or Python.
    pub(super) fn instead(&self) -> Option<String> {
        let power = "`^` for a power: `x^2`";
        let before = self.next.checked_sub(1).map(|last| &self.tokens[last]);
        match (self.peek(), self.ahead(1)) {
            (Token::Symbol('.'), Token::Name(name)) if name == "powi" || name == "powf" => {
                Some(power.to_owned())
            }
            (Token::Symbol('.'), Token::Name(name)) if is_function(name) => {
                Some(format!("the function before its argument: `{name}(x)`"))
            }
            (Token::Symbol('*'), _) => {
                let star = before.filter(|(token, _)| *token == Token::Symbol('*'));
                let adjacent = star.is_some_and(|(_, span)| span.end == self.span().start);
                adjacent.then(|| power.to_owned())
            }
            _ => None,
        }
    }

    /// The name directly before the present token.
    pub(super) fn name_before(&self) -> Option<Name> {
        let (token, span) = self.tokens.get(self.next.checked_sub(1)?)?;
        match token {
            Token::Name(text) if span.end == self.span().start => Some(Name {
                text: text.clone(),
                span: span.clone(),
            }),
            _ => None,
        }
    }
}

/// The error for a length that is not declared.
pub fn unknown_length(input: Input<'_>, definition: &Definition, name: &Name) -> Error {
    let known = definition.lengths.iter().map(|length| length.text.as_str());
    let known = known.collect::<Vec<_>>().join(", ");
    let kind = ErrorKind::Unknown {
        what: "length",
        name: name.text.clone(),
        known: match known.as_str() {
            "" => format!(
                "none; write `{}<{}>`, or `..` for a length that is known at run time only",
                definition.name.text, name.text
            ),
            _ => known,
        },
    };
    input.error(&name.span, kind)
}

/// The error for a function that is not known.
pub fn unknown_function(input: Input<'_>, name: &Name) -> Error {
    let functions = || ELEMENTARY.iter().map(|(function, _)| *function);
    let all: Vec<&str> = ["sqrt"]
        .into_iter()
        .chain(functions())
        .chain(VECTOR_FUNCTIONS)
        .collect();
    let advice = match suggestion(&name.text, &all) {
        Some(meant) => format!("did you mean `{meant}`?"),
        None => {
            let name = &name.text;
            format!(
                "define your own before H, `let {name}(x) = …;`, or name one of Rust, `extern fn {name} with …;`"
            )
        }
    };
    let kind = ErrorKind::Unknown {
        what: "function",
        name: name.text.clone(),
        known: format!("{}; {advice}", all.join(", ")),
    };
    input.error(&name.span, kind)
}

/// The name that was probably meant: what this language calls a function of another one, or the nearest of the known names.
pub fn suggestion<'a>(name: &str, known: &[&'a str]) -> Option<&'a str> {
    const OTHER_NAMES: [(&str, &str); 7] = [
        ("log", "ln"),
        ("arcsin", "asin"),
        ("arccos", "acos"),
        ("arctan", "atan"),
        ("arctan2", "atan2"),
        ("magnitude", "norm"),
        ("length", "norm"),
    ];
    if let Some((_, own)) = OTHER_NAMES.iter().find(|(other, _)| *other == name) {
        return Some(own);
    }
    let close = known
        .iter()
        .map(|other| (edits(name, other), *other))
        .min()?;
    let length = name.chars().count();
    (close.0 < length && close.0 <= 1.max((length + 1) / 3)).then_some(close.1)
}

/// The number of insertions, deletions, changes and exchanges of neighbours that turn one word into another.
fn edits(from: &str, to: &str) -> usize {
    let (from, to): (Vec<char>, Vec<char>) = (from.chars().collect(), to.chars().collect());
    let mut rows = vec![vec![0; to.len() + 1]; from.len() + 1];
    for i in 0..=from.len() {
        for j in 0..=to.len() {
            let mut least = i.max(j);
            if i > 0 && j > 0 {
                let change = rows[i - 1][j - 1] + usize::from(from[i - 1] != to[j - 1]);
                least = change.min(rows[i - 1][j] + 1).min(rows[i][j - 1] + 1);
                if i > 1 && j > 1 && from[i - 1] == to[j - 2] && from[i - 2] == to[j - 1] {
                    least = least.min(rows[i - 2][j - 2] + 1);
                }
            }
            rows[i][j] = least;
        }
    }
    rows[from.len()][to.len()]
}

#[cfg(test)]
mod tests {
    use super::{edits, suggestion};

    #[test]
    fn suggestions_are_near() {
        let known = ["cos", "exp", "ln", "omega", "sqrt"];
        for (name, meant) in [
            ("cso", Some("cos")),
            ("log", Some("ln")),
            ("omgea", Some("omega")),
            ("sqr", Some("sqrt")),
            ("erf", None),
            ("foo", None),
            ("x", None),
        ] {
            assert_eq!(suggestion(name, &known), meant, "{name}");
        }
        assert_eq!(edits("", "abc"), 3);
    }
}
