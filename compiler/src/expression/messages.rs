//! Messages about expressions.

use super::{Expression, Input, shown};
use crate::error::{Error, ErrorKind};

impl Expression {
    /// An error about a name that is not known.
    pub(crate) fn unknown(
        &self,
        input: Input<'_>,
        what: &'static str,
        name: &str,
        known: &str,
    ) -> Error {
        let kind = match IMAGINARY.contains(&name) {
            true => complex(),
            false => ErrorKind::Unknown {
                what,
                name: shown(name),
                known: known.to_owned(),
            },
        };
        input.error(&self.span, kind)
    }
}

/// What people call the square root of −1.
const IMAGINARY: [&str; 4] = ["i", "I", "j", "im"];

/// The error for a coefficient that is not real.
pub(crate) fn complex() -> ErrorKind {
    let message = "coefficients are real: methods with complex weights, also of positive real part, need complex states and are not supported";
    ErrorKind::Definition {
        message: message.to_owned(),
    }
}

/// Whether a printed number has an imaginary part: it ends with a digit and the imaginary unit.
pub(crate) fn is_complex(printed: &str) -> bool {
    let unit = IMAGINARY.iter().find_map(|unit| printed.strip_suffix(unit));
    let number = unit.map(|rest| rest.trim_end_matches(['*', ' ']));
    number.is_some_and(|number| number.ends_with(|last: char| last.is_ascii_digit() || last == '.'))
}

#[cfg(test)]
mod tests {
    use super::super::parse_list;
    use super::*;

    fn evaluate(text: &str) -> Result<Vec<String>, String> {
        let input = Input {
            name: "basis",
            text,
        };
        let all = parse_list(input).and_then(|list| {
            list.iter()
                .map(|e| e.function(input))
                .collect::<Result<Vec<_>, _>>()
        });
        all.map(|list| list.iter().map(ToString::to_string).collect())
            .map_err(|e| e.to_string())
    }

    #[test]
    fn complex_coefficients_are_refused_with_the_reason() {
        let refused = "coefficients are real: methods with complex weights";
        for text in ["1/2 + i*sqrt(3)/6", "1/4 - I/4", "j"] {
            assert!(evaluate(text).expect_err(text).contains(refused), "{text}");
        }
        for text in ["0.5-0.14i", "0.5 + 3*I", "1.j"] {
            assert!(is_complex(text), "{text}");
        }
        for text in ["0.5", "pi", "1/2", "i"] {
            assert!(!is_complex(text), "{text}");
        }
    }

    #[test]
    fn expressions_have_the_usual_precedence() {
        let cases = [
            ("1, t, t^2 - t/3", vec!["1", "t", "t^2 - 1/3*t"]),
            ("[0.5, 1e-3, .25e1,]", vec!["1/2", "1/1000", "5/2"]),
            ("-t^2, (-t)^2, 2^3^0", vec!["-t^2", "t^2", "2"]),
            ("1 - 2 - 3, 12/2/3, 2*-t", vec!["-4", "2", "-2*t"]),
            ("(1+t)^3", vec!["t^3 + 3*t^2 + 3*t + 1"]),
            ("t-t", vec!["0"]),
        ];
        for (text, expected) in cases {
            assert_eq!(
                evaluate(text).as_deref(),
                Ok(expected
                    .iter()
                    .map(|s| s.to_string())
                    .collect::<Vec<_>>()
                    .as_slice()),
                "{text}"
            );
        }
    }

    #[test]
    fn wrong_expressions_are_named_at_their_place() {
        let cases = [
            ("1, 2/0", "basis, column 6: division by zero"),
            ("(1, t", "basis, column 1: `(` has no matching `)`"),
            (
                "(1, t)",
                "basis, column 3: found `,`, expected an operator or `)`",
            ),
            (
                "[1 t]",
                "basis, column 4: found `t`, expected an operator, `,` or `]`",
            ),
            ("(1 + t", "basis, column 1: `(` has no matching `)`"),
            ("1 + t)", "basis, column 6: `)` has no matching `(`"),
            ("[1, t", "basis, column 1: `[` has no matching `]`"),
            ("foo(t)", "basis, column 1: unknown function `foo`"),
            ("1, y", "basis, column 4: unknown name `y`"),
            (
                "t^-1",
                "basis, column 3: the exponent must be a whole number from 0 to 400, found -1",
            ),
            (
                "t^t",
                "basis, column 3: found an expression that depends on `t`",
            ),
            ("1/t", "basis, column 3: a divisor that depends on `t`"),
            ("2t", "basis, column 2: found `t`, expected an operator"),
            ("1 $ 2", "basis, column 3: found `$`"),
            ("", "basis, column 1: the input ends, expected a number"),
            ("1,,2", "basis, column 3: found `,`"),
            ("1\n+ €", "basis, line 2, column 3: found `€`"),
            (
                "t^400",
                "basis, column 1: this is too large: the degree 400 exceeds the limit 256",
            ),
            ("((9^400)^400)^400", "basis, column 1: this is too large"),
            (
                "1e999999999999",
                "basis, column 1: found a number with the exponent 999999999999, expected an exponent from -400 to 400",
            ),
            (".", "basis, column 1: found `.`, expected a number"),
        ];
        for (text, message) in cases {
            let error = evaluate(text).expect_err(text);
            assert!(error.starts_with(message), "{text}: {error}");
        }
    }

    #[test]
    fn nesting_and_length_are_bounded() {
        for text in [
            "(".repeat(5000),
            "-".repeat(5000),
            "1+".repeat(5000),
            "t^".repeat(5000),
            "f(".repeat(5000),
            "1,".repeat(200_000),
            (0..32).fold("1".to_owned(), |e, _| {
                format!("({e}){}{}", "*1".repeat(256), "+1".repeat(256))
            }),
        ] {
            assert!(evaluate(&text).is_err());
        }
    }

    proptest::proptest! {
        /// Every text has an answer, and every error refers to a part of the text.
        #[test]
        fn any_text_has_an_answer(
            tokens in proptest::collection::vec(
                proptest::sample::select(vec![
                    "t", "1", "0.5", "2e9", "7", "+", "-", "*", "/", "^", "(", ")", "[", "]", ",", " ", "\n", "ψ",
                    "gauss", "lobatto(3)", "polynomial", "radau-left(", "1e", ".", "$", "é",
                ]),
                0..14,
            ),
        ) {
            let text = tokens.concat();
            let limits = crate::Limits { stages: 6 };
            let errors = [crate::Basis::parse(&text, &limits).err(), crate::QuadratureRule::parse(&text, &limits).err()];
            for place in errors.into_iter().flatten().filter_map(|error| error.place) {
                proptest::prop_assert!(place.text.get(place.span.clone()).is_some(), "{:?}", place);
            }
        }
    }
}
