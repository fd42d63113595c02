//! Unknown notation, and what was probably meant.

use super::tokens::Token;
use super::{Parser, VECTOR_FUNCTIONS, is_function};
use crate::function::ELEMENTARY;
use crate::syntax::{Definition, Name};
use symplectic_exact::error::{Error, ErrorKind};
use symplectic_exact::input::Input;

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
    let own = OTHER_NAMES.iter().find(|(other, _)| *other == name);
    match own {
        Some((_, own)) => Some(own),
        None => symplectic_exact::suggestion::suggestion(name, known),
    }
}

#[cfg(test)]
mod tests {
    use super::suggestion;

    #[test]
    fn names_of_other_languages_are_known() {
        let known = ["cos", "exp", "ln", "omega", "sqrt"];
        assert_eq!(suggestion("log", &known), Some("ln"));
        assert_eq!(suggestion("cso", &known), Some("cos"));
    }
}
