//! Conversion of syntax trees to functions and constants.

use num_bigint::BigInt;
use num_rational::BigRational;
use num_traits::{Signed, ToPrimitive};

use super::{Constant, Function};
use crate::error::{Error, ErrorKind};
use crate::expression::{Expression, ExpressionKind, Input, MAX_EXPONENT, Operator, shown};

impl Expression {
    /// The value as a function of `t`.
    ///
    /// Names are `t`, `pi` and `e`; functions are `sin`, `cos`, `tan`, `exp`, `cosh`, `sinh`, `ln`, `sqrt`,
    /// `cbrt`, and `root(p, k)`: the k-th real root of a polynomial in `t`.
    ///
    /// # Errors
    /// Unknown names and functions, divisions by zero or by functions of `t`, functions outside the class of
    /// [`Function`], values that are not real or exceed a limit; each with its position in the text.
    ///
    /// ```
    /// use symplectic_compiler::expression::{Input, parse_list};
    ///
    /// let input = Input { name: "basis", text: "2*sin(t)*cos(t), sqrt(8)*t" };
    /// let functions: Result<Vec<_>, _> = parse_list(input)?.iter().map(|e| e.function(input)).collect();
    /// assert_eq!(functions?.iter().map(|f| f.to_string()).collect::<Vec<_>>(), ["sin(2*t)", "2*sqrt(2)*t"]);
    /// # Ok::<(), symplectic_compiler::Error>(())
    /// ```
    pub fn function(&self, input: Input<'_>) -> Result<Function, Error> {
        let at = |kind: ErrorKind| input.error(&self.span, kind);
        match &self.kind {
            ExpressionKind::Number(value) => Constant::rational(value.clone())
                .map(Function::constant)
                .map_err(at),
            ExpressionKind::Name(name) => match name.as_str() {
                "t" => Ok(Function::variable()),
                "pi" => Ok(Function::constant(Constant::pi())),
                "e" => Constant::one().exp().map(Function::constant).map_err(at),
                _ => Err(self.unknown(input, "name", name, "t, pi, e, numbers")),
            },
            ExpressionKind::Call {
                function,
                arguments,
                ..
            } => self.call(input, function, arguments),
            ExpressionKind::Negate(inner) => inner.function(input)?.negate().map_err(at),
            ExpressionKind::Binary {
                operator: Operator::Power,
                left,
                right,
            } => match &left.kind {
                ExpressionKind::Name(name) if name == "e" => {
                    right.function(input)?.exp().map_err(at)
                }
                _ => left.raised(input, right, at),
            },
            ExpressionKind::Binary {
                operator,
                left,
                right,
            } => {
                let (a, b) = (left.function(input)?, right.function(input)?);
                match operator {
                    Operator::Add => a.add(&b).map_err(at),
                    Operator::Subtract => a.subtract(&b).map_err(at),
                    Operator::Multiply => a.multiply(&b).map_err(at),
                    Operator::Divide | Operator::Power => {
                        let inverse = match b.as_constant() {
                            Some(divisor) => divisor.inverse(),
                            None => Err(ErrorKind::FunctionClass {
                                found: "a divisor that depends on `t`".to_owned(),
                                reason: "quotients of functions have no general integral",
                            }),
                        };
                        let inverse = inverse.map_err(|kind| input.error(&right.span, kind))?;
                        a.scale(&inverse).map_err(at)
                    }
                }
            }
        }
    }

    /// The value as a constant.
    ///
    /// # Errors
    /// Those of [`Self::function`], and [`ErrorKind::Type`] if the value depends on `t`.
    pub fn constant(&self, input: Input<'_>) -> Result<Constant, Error> {
        self.function(input)?.as_constant().ok_or_else(|| {
            let kind = ErrorKind::Type {
                found: "an expression that depends on `t`".to_owned(),
                expected: "a constant".to_owned(),
            };
            input.error(&self.span, kind)
        })
    }

    /// `self^exponent`
    fn raised(
        &self,
        input: Input<'_>,
        exponent: &Expression,
        at: impl Fn(ErrorKind) -> Error,
    ) -> Result<Function, Error> {
        let base = self.function(input)?;
        let power = exponent.constant(input)?;
        let limit = i32::try_from(MAX_EXPONENT).unwrap_or(i32::MAX);
        let whole = power
            .as_rational()
            .filter(|value| value.is_integer())
            .and_then(|value| value.to_integer().to_i32())
            .filter(|n| n.abs() <= limit);
        match (base.as_constant(), whole) {
            (Some(base), Some(n)) => base.power(n).map(Function::constant).map_err(at),
            (None, Some(n)) if !n.is_negative() => base.power(n.unsigned_abs()).map_err(at),
            (constant, _) => {
                let found = shown(&power.to_string());
                let kind = match constant {
                    Some(_) => ErrorKind::Type {
                        found: format!("the exponent {found}"),
                        expected: format!(
                            "a whole number from -{limit} to {limit}, or `sqrt`, `cbrt` or `exp`"
                        ),
                    },
                    None => ErrorKind::Exponent {
                        limit: MAX_EXPONENT,
                        found,
                    },
                };
                Err(input.error(&exponent.span, kind))
            }
        }
    }

    /// The value of the function `name` at arguments.
    fn call(
        &self,
        input: Input<'_>,
        name: &str,
        arguments: &[Expression],
    ) -> Result<Function, Error> {
        let at = |kind: ErrorKind| input.error(&self.span, kind);
        let one: fn(&Function) -> Result<Function, ErrorKind> = match name {
            "sin" => Function::sin,
            "cos" => Function::cos,
            "tan" => Function::tan,
            "exp" => Function::exp,
            "cosh" => Function::cosh,
            "sinh" => Function::sinh,
            "ln" => Function::ln,
            "sqrt" => |x| x.radical("sqrt", Constant::sqrt),
            "cbrt" => |x| x.radical("cbrt", Constant::cbrt),
            "root" => {
                let [polynomial, index] = arguments else {
                    let expected = "a polynomial in t and the number of a root";
                    return Err(at(count(name, expected, arguments.len())));
                };
                return root(input, polynomial, index)
                    .and_then(|value| value.map(Function::constant).map_err(at));
            }
            _ => {
                let known = "sin, cos, tan, exp, cosh, sinh, ln, sqrt, cbrt, root";
                let span = self.span.start..self.span.start + name.len();
                let kind = ErrorKind::Unknown {
                    what: "function",
                    name: shown(name),
                    known: known.to_owned(),
                };
                return Err(input.error(&span, kind));
            }
        };
        let [argument] = arguments else {
            return Err(at(count(name, "one argument", arguments.len())));
        };
        one(&argument.function(input)?).map_err(at)
    }

    /// The value as a rational number.
    ///
    /// # Errors
    /// As [`Self::constant`], and where the value is not known to be rational.
    pub fn rational(&self, input: Input<'_>) -> Result<BigRational, Error> {
        let value = self.constant(input)?;
        value.as_rational().cloned().ok_or_else(|| {
            let kind = ErrorKind::Type {
                found: shown(&value.to_string()),
                expected: "a rational number".to_owned(),
            };
            input.error(&self.span, kind)
        })
    }

    /// The value as a whole number; any size, any sign.
    ///
    /// # Errors
    /// As [`Self::rational`], and where the value is not whole.
    pub fn whole(&self, input: Input<'_>) -> Result<BigInt, Error> {
        let value = self.rational(input)?;
        if !value.is_integer() {
            let kind = ErrorKind::Type {
                found: shown(&value.to_string()),
                expected: "a whole number".to_owned(),
            };
            return Err(input.error(&self.span, kind));
        }
        Ok(value.to_integer())
    }
}

/// The error for a wrong number of arguments.
fn count(name: &str, expected: &str, found: usize) -> ErrorKind {
    ErrorKind::Arguments {
        function: name.to_owned(),
        expected: expected.to_owned(),
        found: format!("{found} argument{}", if found == 1 { "" } else { "s" }),
    }
}

/// `root(polynomial, index)`; the inner error concerns both arguments together.
fn root(
    input: Input<'_>,
    polynomial: &Expression,
    index: &Expression,
) -> Result<Result<Constant, ErrorKind>, Error> {
    let wrong = |place: &Expression, found: String, expected: &str| {
        let kind = ErrorKind::Type {
            found,
            expected: expected.to_owned(),
        };
        input.error(&place.span, kind)
    };
    let function = polynomial.function(input)?;
    let rational = function.as_polynomial().ok_or_else(|| {
        let expected = "a polynomial in t with rational coefficients";
        wrong(polynomial, shown(&function.to_string()), expected)
    })?;
    let number = index.constant(input)?;
    let number = number
        .as_rational()
        .filter(|value| value.is_integer())
        .map(BigRational::to_integer)
        .ok_or_else(|| {
            let expected = "a whole number, the number of a root,";
            wrong(index, shown(&number.to_string()), expected)
        })?;
    Ok(Constant::root(&rational, &number))
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::expression::parse_list;

    fn read(text: &str) -> Result<Vec<String>, Error> {
        let input = Input {
            name: "basis",
            text,
        };
        parse_list(input)?
            .iter()
            .map(|e| Ok(e.function(input)?.to_string()))
            .collect()
    }

    #[test]
    fn functions_are_read() {
        let cases = [
            ("1, t, cos(pi*t)", "1, t, cos(pi*t)"),
            ("t^2*exp(-t/2), e^t/e", "t^2*exp(-t/2), exp(-1)*exp(t)"),
            ("1/2 - sqrt(2)/4, 2^-3, pi^-1", "1/2 - sqrt(2)/4, 1/8, 1/pi"),
            (
                "root(t^3 - t - 1, 1), root((t - 1)*(t - 2), 2)",
                "root(t^3 - t - 1, 1), 2",
            ),
            ("2*sin(t)*cos(t), sqrt(8)*t", "sin(2*t), 2*sqrt(2)*t"),
            ("tan(pi/4), cbrt(27), sinh(0*t)", "1, 3, 0"),
            ("(1 + sqrt(2))*t^2/2", "(1/2 + sqrt(2)/2)*t^2"),
        ];
        for (text, expected) in cases {
            assert_eq!(
                read(text).map(|list| list.join(", ")).as_deref(),
                Ok(expected)
            );
        }
    }

    #[test]
    fn wrong_functions_are_named_at_their_place() {
        let supported = "; supported are sums of products of t^k and sin, cos, exp, cosh, sinh of q*t + c with q rational, a rational multiple of pi or a sum of both, and constant multiples of tan(q*t) with |q| < pi/2";
        let cases = [
            ("1, 2/0", "column 6: division by zero"),
            ("t/(pi - pi)", "column 3: division by zero"),
            (
                "1/((e - pi)*(e + pi) - e^2 + pi^2)",
                "column 3: cannot decide whether exp(2) + (pi - e)*(pi + e) - pi^2 is zero (|x| < 2^-4096)",
            ),
            (
                "1 + sqrt(-1)",
                "column 5: sqrt(-1) is not a real number: `sqrt` needs an argument ≥ 0",
            ),
            (
                "ln(1 - e)",
                "column 1: ln(1 - e) is not a real number: `ln` needs an argument > 0",
            ),
            ("tan(pi/2)", "column 1: tan(pi/2) is not a real number"),
            (
                "t + cos(cos(t))",
                "column 5: cos(cos(t)) is not supported: its argument is not q*t + c",
            ),
            ("exp(t^2)", "column 1: exp(t^2) is not supported"),
            (
                "1/(1+t)",
                "column 3: a divisor that depends on `t` is not supported",
            ),
            (
                "sqrt(t)",
                "column 1: sqrt(t) is not supported: a root takes a constant here",
            ),
            (
                "t*tan(t)",
                "column 1: t*tan(t) is not supported: its integral is not an elementary function",
            ),
            (
                "tan(2*t)",
                "column 1: tan(2*t) is not supported: it has a pole between 0 and 1",
            ),
            (
                "sin(sqrt(2)*t)",
                "column 1: sin(sqrt(2)*t) is not supported",
            ),
            (
                "root(t^2 + 1, 1)",
                "column 1: root(t^2 + 1, 1) does not exist: the polynomial has no real roots",
            ),
            (
                "root(t^2 - 2, 3)",
                "column 1: root(t^2 - 2, 3) does not exist: the polynomial has 2 distinct real roots, numbered from 1 to 2",
            ),
            (
                "root(t^3 - 2, 0)",
                "column 1: root(t^3 - 2, 0) does not exist: the polynomial has one real root",
            ),
            (
                "root(pi*t, 1)",
                "column 6: found pi*t, expected a polynomial in t with rational coefficients",
            ),
            (
                "root(t^2 - 2, 1/2)",
                "column 15: found 1/2, expected a whole number",
            ),
            (
                "root(3, 1)",
                "column 1: found a constant, expected a polynomial of degree at least 1",
            ),
            (
                "root(t)",
                "column 1: `root` takes a polynomial in t and the number of a root, found 1 argument",
            ),
            (
                "sin(1, 2)",
                "column 1: `sin` takes one argument, found 2 arguments",
            ),
            (
                "cos()",
                "column 1: `cos` takes one argument, found 0 arguments",
            ),
            (
                "1 + foo(t)",
                "column 5: unknown function `foo`; known here: sin, cos",
            ),
            (
                "y",
                "column 1: unknown name `y`; known here: t, pi, e, numbers",
            ),
            (
                "t^-1",
                "column 3: the exponent must be a whole number from 0 to 400, found -1",
            ),
            (
                "t^t",
                "column 3: found an expression that depends on `t`, expected a constant",
            ),
            (
                "2^(1/2)",
                "column 3: found the exponent 1/2, expected a whole number from -400 to 400, or `sqrt`, `cbrt` or `exp`",
            ),
            ("0^-1", "column 1: division by zero"),
            ("exp(10^9)", "column 1: exp(1000000000) is too large"),
            (
                "t + exp(-10^9)",
                "column 5: exp(-1000000000) is too small: it, or a part of it, is about 2^-1443000000, and constants that are not rational lie between 2^-4096 and 2^4096; write 0 if that is meant",
            ),
            (
                "t^400",
                "column 1: this is too large: the degree 400 exceeds the limit 256",
            ),
            ("((9^400)^400)^400", "column 1: this is too large"),
        ];
        for (text, message) in cases {
            let error = read(text).expect_err(text).to_string();
            let start = format!("basis, {message}");
            assert!(error.starts_with(&start), "{text}: {error}");
            if error.contains("not supported") {
                assert!(error.ends_with(supported), "{text}: {error}");
            }
        }
        let input = Input {
            name: "nodes",
            text: "1 + t",
        };
        let error = parse_list(input).expect("an expression")[0].constant(input);
        assert_eq!(
            error.map_err(|e| e.to_string()),
            Err(
                "nodes, column 1: found an expression that depends on `t`, expected a constant"
                    .to_owned()
            )
        );
    }

    #[test]
    fn hostile_texts_have_an_answer_soon() {
        let repeated = |part: &str, count: usize| vec![part; count].join("+");
        let texts = [
            format!("1/({}-2)", repeated("sin(exp(1/3)+7)", 250)),
            format!("({})^400", repeated("cos(pi*t)*t", 200)),
            format!("{}1{}", "exp(-".repeat(60), ")".repeat(60)),
            format!("{}1{}", "1/(1+sqrt(".repeat(30), "))".repeat(30)),
            format!("{}t{}", "cosh(".repeat(20), ")".repeat(20)),
            format!("{}1{}", "cosh(".repeat(30), ")".repeat(30)),
            "(t*9^300+1)^100*(t*9^300+1)^100".to_owned(),
            "(exp(-1000)-exp(-1001))^-4*(exp(-2000)-exp(-1999))^-1".to_owned(),
            "1/((1 - pi)*(1 + pi) + pi^2 - 1 + exp(-2800))".to_owned(),
            "root((t^2-2)^16*(10^9*t-1)^16,1)".to_owned(),
            "root(t^16-(1000*t-1)^2,2)+root(t^30-t-1,1)".to_owned(),
            format!("[{}]", vec!["(sqrt(2)+cos(t)+sin(pi*t))^20"; 32].join(",")),
            "(1+pi)^400*(1-pi)^400/(2-e)^400".to_owned(),
            format!("sin({})^2", "9^400*".repeat(30) + "1"),
            "1/(e-2.71828182845904523536028747135266249775724709369995957)".to_owned(),
        ];
        let rows = |from: usize| {
            let row = |r: usize| {
                (0..60)
                    .map(|k| format!("sin({})", from + 60 * r + k))
                    .collect::<Vec<_>>()
                    .join("+")
            };
            format!("(({})+({}))", row(0), row(1))
        };
        let texts = texts.into_iter().chain([
            format!("1/(({0}-1)*({0}+1)-{0}^2+1)", rows(1)),
            format!("1/{}7{}", "9^400/".repeat(12), "+1/7".repeat(200)),
            format!("t/{}7{}", "9^400/".repeat(12), "+t^2/7".repeat(200)),
            format!("{}7{}", "9^400*".repeat(77), "+3".repeat(170)),
            format!("{}7{}", "9^400/".repeat(77), "+3".repeat(170)),
        ]);
        let start = std::time::Instant::now();
        for text in texts {
            let before = start.elapsed();
            let _ = read(&text);
            let spent = start.elapsed() - before;
            assert!(spent.as_secs() < 20, "{spent:?}: {text}");
        }
    }

    proptest::proptest! {
        /// Any text gives a result or an error quickly; the result parses back, and the error points to a part of the
        /// text.
        #[test]
        fn any_text_has_an_answer(
            tokens in proptest::collection::vec(
                proptest::sample::select(vec![
                    "t", "1", "0.5", "2e9", "7", "+", "-", "*", "/", "^", "(", ")", ",", " ", "pi", "e", "sin(",
                    "cos(", "tan(", "exp(", "cosh(", "sqrt(", "cbrt(", "root(", "ln(", "t^2", "pi*t", "))", "ψ",
                ]),
                0..16,
            ),
        ) {
            let text = tokens.concat();
            let start = std::time::Instant::now();
            match read(&text) {
                Ok(list) => {
                    for printed in &list {
                        proptest::prop_assert_eq!(read(printed), Ok(vec![printed.clone()]), "{}", text);
                    }
                }
                Err(error) => {
                    let place = error.place.expect("a place");
                    proptest::prop_assert!(place.text.get(place.span.clone()).is_some(), "{:?}", place);
                }
            }
            proptest::prop_assert!(start.elapsed().as_secs() < 10, "{}", text);
        }
    }
}
