//! A basis with a parameter, from its text.

use num_bigint::BigInt;
use num_rational::BigRational;
use num_traits::{One, ToPrimitive};

use super::waves::{Ring, Waves};
use crate::error::{Error, ErrorKind};
use crate::expression::{Expression, ExpressionKind, Input, Operator, parse_list, shown};
use crate::symbolic::FUNCTIONS;

/// The largest power of `t`.
const LARGEST_POWER: u32 = 16;
/// Names that have a meaning.
const TAKEN: [&str; 3] = ["t", "pi", "e"];

/// The name of the parameter.
///
/// # Errors
/// More than one name, and names that have a meaning.
pub fn parameter(text: &str) -> Result<String, Error> {
    let input = Input {
        name: "parameters",
        text,
    };
    let items = parse_list(input)?;
    let [item] = items.as_slice() else {
        let message = "a method is fitted to one frequency: `parameters: w`".to_owned();
        return Err(input.error(&(0..text.len()), ErrorKind::Definition { message }));
    };
    match &item.kind {
        ExpressionKind::Name(name)
            if !TAKEN.contains(&name.as_str()) && !FUNCTIONS.contains(&name.as_str()) =>
        {
            Ok(name.clone())
        }
        _ => {
            let kind = ErrorKind::Type {
                found: shown(text),
                expected: "the name of a frequency other than t, pi and e, such as `w`".to_owned(),
            };
            Err(input.error(&item.span, kind))
        }
    }
}

/// The functions of a basis: sums of waves in `t`, whose frequencies are multiples of the parameter.
///
/// # Errors
/// Functions outside this class, each at its place; a basis without the parameter.
pub fn basis(text: &str, parameter: &str, ring: &Ring) -> Result<Vec<(String, Waves)>, Error> {
    let input = Input {
        name: "basis",
        text,
    };
    let reader = Reader {
        input,
        parameter,
        ring,
    };
    let items = parse_list(input)?;
    let read = |item: &Expression| {
        let text = input.text.get(item.span.clone()).unwrap_or_default();
        Ok((text.to_owned(), reader.function(item)?))
    };
    let functions: Vec<(String, Waves)> = items.iter().map(read).collect::<Result<_, Error>>()?;
    let is_polynomial =
        |(_, f): &(String, Waves)| f.terms().all(|(wave, _)| wave.frequency.is_zero());
    if functions.iter().all(is_polynomial) {
        let message = format!(
            "the parameter `{parameter}` is in none of the functions: write cos({parameter}*t), sin({parameter}*t), or leave out `parameters`"
        );
        return Err(input.error(&(0..text.len()), ErrorKind::Definition { message }));
    }
    Ok(functions)
}

struct Reader<'a> {
    input: Input<'a>,
    parameter: &'a str,
    ring: &'a Ring,
}

impl Reader<'_> {
    fn function(&self, expression: &Expression) -> Result<Waves, Error> {
        let ring = self.ring;
        match &expression.kind {
            ExpressionKind::Number(value) => Ok(ring.constant(ring.rational(value.clone()))),
            ExpressionKind::Name(name) if name == "t" => {
                let [zero, one] = [BigRational::default(), BigRational::one()];
                Ok(ring.wave(1, ring.rational(zero), false, ring.rational(one)))
            }
            ExpressionKind::Negate(inner) => {
                Ok(ring.subtract(&Waves::default(), &self.function(inner)?))
            }
            ExpressionKind::Call {
                function,
                arguments,
                ..
            } if matches!(function.as_str(), "cos" | "sin") => {
                let frequency = match arguments.as_slice() {
                    [argument] => self.frequency(argument),
                    _ => None,
                };
                let frequency = frequency.ok_or_else(|| self.unsupported(expression))?;
                let one = ring.rational(BigRational::one());
                Ok(ring.wave(0, ring.rational(frequency), function == "sin", one))
            }
            ExpressionKind::Binary {
                operator,
                left,
                right,
            } => {
                let f = self.function(left)?;
                let number = || right.rational(self.input);
                match operator {
                    Operator::Add => Ok(ring.add(&f, &self.function(right)?)),
                    Operator::Subtract => Ok(ring.subtract(&f, &self.function(right)?)),
                    Operator::Multiply => {
                        self.bounded(expression, ring.multiply(&f, &self.function(right)?))
                    }
                    Operator::Divide => {
                        let divisor = number()?;
                        if divisor == BigRational::default() {
                            return Err(self.input.error(&right.span, ErrorKind::DivisionByZero));
                        }
                        Ok(ring.scale(&f, &ring.rational(divisor.recip()), 0))
                    }
                    Operator::Power => {
                        let exponent = number()?;
                        let exponent = exponent
                            .is_integer()
                            .then(|| exponent.to_integer().to_u32());
                        let exponent = exponent.flatten().filter(|&n| n <= LARGEST_POWER);
                        let exponent = exponent.ok_or_else(|| self.unsupported(expression))?;
                        let mut power = ring.one();
                        for _ in 0..exponent {
                            power = self.bounded(expression, ring.multiply(&power, &f))?;
                        }
                        Ok(power)
                    }
                }
            }
            ExpressionKind::Name(_) | ExpressionKind::Call { .. } => {
                Err(self.unsupported(expression))
            }
        }
    }

    /// A function whose powers of `t` are small enough.
    fn bounded(&self, place: &Expression, function: Waves) -> Result<Waves, Error> {
        let largest = function.terms().map(|(wave, _)| wave.power).max();
        match largest.is_none_or(|k| k.unsigned_abs() <= LARGEST_POWER) {
            true => Ok(function),
            false => Err(self.unsupported(place)),
        }
    }

    /// The factor `q`, if an expression is `q` times the parameter times `t`.
    fn frequency(&self, expression: &Expression) -> Option<BigRational> {
        let monomial = self.monomial(expression)?;
        (monomial.1 == 1 && monomial.2 == 1).then_some(monomial.0)
    }

    /// A product of a number and of powers of `t` and of the parameter.
    fn monomial(&self, expression: &Expression) -> Option<(BigRational, u32, u32)> {
        let none = || BigRational::from_integer(BigInt::one());
        match &expression.kind {
            ExpressionKind::Number(value) => Some((value.clone(), 0, 0)),
            ExpressionKind::Name(name) if name == "t" => Some((none(), 1, 0)),
            ExpressionKind::Name(name) if name == self.parameter => Some((none(), 0, 1)),
            ExpressionKind::Negate(inner) => {
                let (q, t, w) = self.monomial(inner)?;
                Some((-q, t, w))
            }
            ExpressionKind::Binary {
                operator: Operator::Multiply,
                left,
                right,
            } => {
                let ((q, t, w), (r, u, x)) = (self.monomial(left)?, self.monomial(right)?);
                Some((q * r, t + u, w + x))
            }
            ExpressionKind::Binary {
                operator: Operator::Divide,
                left,
                right,
            } => {
                let ((q, t, w), (r, u, x)) = (self.monomial(left)?, self.monomial(right)?);
                let divides = r != BigRational::default() && (u, x) == (0, 0);
                divides.then(|| (q / r, t, w))
            }
            _ => None,
        }
    }

    fn unsupported(&self, expression: &Expression) -> Error {
        let text = self.input.text.get(expression.span.clone());
        let w = self.parameter;
        let message = format!(
            "`{}` is not supported in a basis with `parameters`: its functions are sums of rational multiples of t^k, \
             t^k*cos(q*{w}*t) and t^k*sin(q*{w}*t), with q rational and k up to {LARGEST_POWER}; with a number for {w}, \
             on the command line by `--at {w}=3`, all functions are",
            shown(text.unwrap_or_default())
        );
        self.input
            .error(&expression.span, ErrorKind::Definition { message })
    }
}
