//! Bases of the space in which the velocities are approximated.

use num_rational::BigRational;
use num_traits::{One, Signed, Zero};

use crate::arithmetic::matrix::left_kernel;
use crate::arithmetic::polynomial::Polynomial;
use crate::error::{Error, ErrorKind};
use crate::expression::{Expression, ExpressionKind, Input, parse_list};
use crate::limits::Limits;
use crate::quadrature::{check_stages, count};

/// Linearly independent functions `ψ_1, …, ψ_s` on `[0, 1]`, polynomials in `t` (LZ §4).
#[derive(Debug, Clone, PartialEq, Eq)]
pub struct Basis {
    name: String,
    functions: Vec<Polynomial>,
}

impl Basis {
    /// Reads `polynomial(3)`, which is `1, t, t^2`, or a list of polynomials in `t`.
    ///
    /// # Errors
    /// Wrong expressions, unknown bases, too many functions, linearly dependent functions, each at its
    /// place in the text.
    ///
    /// ```
    /// use symplectic_compiler::{Basis, Limits};
    ///
    /// let basis = Basis::parse("1, t - 1/2, t^2", &Limits::default())?;
    /// assert_eq!(basis.len(), 3);
    /// let error = Basis::parse("1 + t, 2 + 2*t", &Limits::default()).unwrap_err();
    /// assert_eq!(
    ///     error.to_string(),
    ///     "basis, column 1: the basis functions are linearly dependent: 2*(t + 1) - (2*t + 2) = 0; leave one of them out"
    /// );
    /// # Ok::<(), symplectic_compiler::Error>(())
    /// ```
    pub fn parse(text: &str, limits: &Limits) -> Result<Self, Error> {
        let input = Input {
            name: "basis",
            text,
        };
        let items = parse_list(input)?;
        if let [
            item @ Expression {
                kind:
                    ExpressionKind::Call {
                        function,
                        name,
                        arguments,
                    },
                ..
            },
        ] = items.as_slice()
        {
            if function != "polynomial" {
                let kind = ErrorKind::Unknown {
                    what: "basis",
                    name: function.clone(),
                    known: "polynomial, or a list of polynomials in t".to_owned(),
                };
                return Err(input.error(name, kind));
            }
            let size = count(input, item, function, arguments)?;
            if !size.is_positive() {
                let kind = ErrorKind::TooFewStages {
                    rule: "polynomial",
                    stages: size.to_string(),
                    minimum: 1,
                };
                return Err(input.error(&item.span, kind));
            }
            let size = check_stages(&size, limits).map_err(|kind| input.error(&item.span, kind))?;
            return Ok(Self::monomials(size));
        }
        let whole = 0..text.len();
        check_stages(&items.len().into(), limits).map_err(|kind| input.error(&whole, kind))?;
        let functions = items
            .iter()
            .map(|item| item.polynomial(input))
            .collect::<Result<Vec<_>, _>>()?;
        Self::new(functions).map_err(|kind| input.error(&whole, kind))
    }

    /// The basis `1, t, …, t^(s−1)`.
    pub fn monomials(size: usize) -> Self {
        Basis {
            name: format!("polynomial({size})"),
            functions: (0..size).map(Polynomial::monomial).collect(),
        }
    }

    /// A basis of given functions.
    ///
    /// # Errors
    /// [`ErrorKind::DependentBasis`].
    pub fn new(functions: Vec<Polynomial>) -> Result<Self, ErrorKind> {
        let rows: Vec<Vec<BigRational>> = functions.iter().map(Polynomial::coefficients).collect();
        if let Some(coefficients) = left_kernel(&rows) {
            return Err(ErrorKind::DependentBasis {
                combination: combination(&functions, &coefficients),
            });
        }
        let name = functions
            .iter()
            .map(|f| f.display("t").to_string())
            .collect::<Vec<_>>()
            .join(", ");
        Ok(Basis { name, functions })
    }

    /// The basis as it is written: `polynomial(3)` or the list of its functions.
    pub fn name(&self) -> &str {
        &self.name
    }

    /// The functions.
    pub fn functions(&self) -> &[Polynomial] {
        &self.functions
    }

    /// The number of functions.
    pub fn len(&self) -> usize {
        self.functions.len()
    }

    /// Whether there are none.
    pub fn is_empty(&self) -> bool {
        self.functions.is_empty()
    }
}

/// A linear combination as text, scaled to coprime integer coefficients: `2*(t + 1) - (2*t + 2)`.
pub(crate) fn combination(functions: &[Polynomial], coefficients: &[BigRational]) -> String {
    let scaled = Polynomial::from_rationals(coefficients)
        .primitive()
        .coefficients();
    let flip = scaled
        .iter()
        .find(|c| !c.is_zero())
        .is_some_and(Signed::is_negative);
    let single = scaled.iter().filter(|c| !c.is_zero()).count() == 1;
    let mut text = String::new();
    for (function, c) in functions.iter().zip(&scaled).filter(|(_, c)| !c.is_zero()) {
        let sign = match (text.is_empty(), c.is_negative() != flip) {
            (true, _) => "",
            (false, false) => " + ",
            (false, true) => " - ",
        };
        let factor = if c.abs().is_one() {
            String::new()
        } else {
            format!("{}*", c.abs())
        };
        let function = function.display("t").to_string();
        let function = if function.contains(' ') && !single {
            format!("({function})")
        } else {
            function
        };
        text.push_str(&format!("{sign}{factor}{function}"));
    }
    text
}

#[cfg(test)]
mod tests {
    use super::*;

    fn error(text: &str) -> String {
        Basis::parse(text, &Limits::default())
            .expect_err(text)
            .to_string()
    }

    #[test]
    fn wrong_bases_are_refused_with_the_reason() {
        let cases = [
            (
                "polynomial(0)",
                "basis, column 1: `polynomial(0)` does not exist: `polynomial(s)` needs s ≥ 1",
            ),
            (
                "polynomial(99)",
                "basis, column 1: 99 stages exceed the limit of 32",
            ),
            (
                "fourier(3)",
                "basis, column 1: unknown basis `fourier`; known here: polynomial",
            ),
            (
                "polynomial(2, 3)",
                "basis, column 1: `polynomial` takes one number",
            ),
            (
                "1, t, 1 - t",
                "basis, column 1: the basis functions are linearly dependent: 1 - t - (-t + 1) = 0",
            ),
            (
                "0, t",
                "basis, column 1: the basis functions are linearly dependent: 0 = 0",
            ),
            (
                "1, polynomial(2)",
                "basis, column 4: unknown function `polynomial`",
            ),
        ];
        for (text, message) in cases {
            assert!(error(text).starts_with(message), "{text}: {}", error(text));
        }
    }
}
