//! Rational functions in lowest terms.

use std::cmp::Ordering;
use std::fmt;

use num_rational::BigRational;
use num_traits::{Signed, Zero as _};

use super::polynomial::RealPolynomial;
use crate::algebra::Number;
use crate::arithmetic::polynomial::Polynomial;
use crate::arithmetic::rounding::to_f64;

/// A quotient of coprime polynomials; the denominator is 1 at zero.
#[derive(Debug, Clone)]
pub(super) struct Fraction<P> {
    pub(super) numerator: P,
    pub(super) denominator: P,
}

impl<P: RealPolynomial> Fraction<P> {
    /// A quotient by a polynomial that does not vanish at zero.
    pub(super) fn new(numerator: &P, denominator: &P) -> Self {
        let gcd = numerator.gcd(denominator);
        let (numerator, denominator) = if gcd.degree().unwrap_or(0) > 0 {
            (numerator.divide(&gcd).0, denominator.divide(&gcd).0)
        } else {
            (numerator.clone(), denominator.clone())
        };
        Fraction {
            numerator: numerator.over_constant_of(&denominator),
            denominator: denominator.over_constant_of(&denominator),
        }
    }

    /// Whether the function is this rational number.
    pub(super) fn is(&self, value: &BigRational) -> bool {
        let difference = self.numerator.subtract(&self.denominator.scale(value));
        difference.is_zero()
    }

    /// The sign of the value at a rational point.
    pub(super) fn sign_at(&self, point: &BigRational) -> Ordering {
        let [n, d] = [&self.numerator, &self.denominator].map(|p| p.sign_at(point));
        if d.is_lt() { n.reverse() } else { n }
    }

    pub(super) fn exported(&self, variable: Variable) -> RationalFunction {
        let (mut numerator, mut denominator) = (self.numerator.clone(), self.denominator.clone());
        let mut rational = None;
        if let (Some(n), Some(d)) = (self.numerator.as_rational(), self.denominator.as_rational()) {
            // Coprime integer coefficients.
            let mut all = Polynomial::coefficients(n);
            all.extend(Polynomial::coefficients(d));
            let first = all.iter().rev().find(|c| !c.is_zero()).cloned();
            let joint = Polynomial::from_rationals(&all).primitive();
            let factor = first.map_or_else(BigRational::default, |first| {
                (joint.leading() / first).abs()
            });
            (numerator, denominator) = (
                self.numerator.scale(&factor),
                self.denominator.scale(&factor),
            );
            rational = numerator
                .as_rational()
                .cloned()
                .zip(denominator.as_rational().cloned());
        }
        RationalFunction {
            variable,
            numerator: numerator.coefficients(),
            denominator: denominator.coefficients(),
            rational,
        }
    }
}

/// A real number as text, in the exact form if that is readable, and as a double.
#[derive(Debug, Clone, PartialEq)]
pub struct Coefficient {
    /// The exact form, or the first digits and `…`.
    pub text: String,
    /// The number, if it is known to be rational.
    pub rational: Option<BigRational>,
    /// The nearest double.
    pub value: f64,
}

impl Coefficient {
    pub(super) fn rational(value: BigRational) -> Self {
        Coefficient {
            text: value.to_string(),
            value: to_f64(&value),
            rational: Some(value),
        }
    }

    /// Whether the coefficient is zero, as far as is known. A zero is always known as a rational; a nonzero number may
    /// round to the double zero.
    pub(super) fn is_zero(&self) -> bool {
        self.rational.as_ref().is_some_and(|value| value.is_zero())
    }

    pub(super) fn of(number: &Number<'_>, exact: Option<String>) -> Self {
        if number.is_zero() {
            return Coefficient::rational(BigRational::default());
        }
        // A number that is only enclosed is rational as far as its enclosure tells.
        if let Some(value) = number.short_rational_as_far_as_known() {
            return Coefficient::rational(value);
        }
        Coefficient {
            text: exact.unwrap_or_else(|| format!("{}…", number.decimal(16))),
            rational: None,
            value: number.to_f64(),
        }
    }
}

impl fmt::Display for Coefficient {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        f.write_str(&self.text)
    }
}

/// The variable of a rational function.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum Variable {
    /// `ν²`
    NuSquared,
    /// `ν`: the variable `ν` times a function of `ν²`.
    NuTimesSquared,
    /// `z`
    Z,
}

/// A rational function in lowest terms, for display and export.
#[derive(Debug, Clone, PartialEq)]
pub struct RationalFunction {
    /// The variable.
    pub variable: Variable,
    /// The coefficients of the numerator, the constant first.
    pub numerator: Vec<Coefficient>,
    /// The coefficients of the denominator, the constant first.
    pub denominator: Vec<Coefficient>,
    /// Numerator and denominator with coprime integer coefficients, if the coefficients are known to be rational.
    pub rational: Option<(Polynomial, Polynomial)>,
}

impl RationalFunction {
    /// The value at a number, rounded: at `ν` or at `z`.
    pub fn value_at(&self, point: f64) -> f64 {
        let (x, factor) = match self.variable {
            Variable::NuSquared => (point * point, 1.0),
            Variable::NuTimesSquared => (point * point, point),
            Variable::Z => (point, 1.0),
        };
        let evaluate =
            |list: &[Coefficient]| list.iter().rev().fold(0.0, |value, c| value * x + c.value);
        factor * evaluate(&self.numerator) / evaluate(&self.denominator)
    }

    fn polynomial(&self, coefficients: &[Coefficient], odd: bool) -> String {
        let (name, step) = match self.variable {
            Variable::Z => ("z", 1),
            _ => ("ν", 2),
        };
        let mut terms: Vec<(bool, String)> = Vec::new();
        for (k, c) in coefficients.iter().enumerate() {
            if c.is_zero() {
                continue;
            }
            let power = k * step + usize::from(odd);
            let sum = c.text.contains(' ');
            let (negative, size) = match c.text.strip_prefix('-') {
                Some(size) if !sum => (true, size.to_owned()),
                _ if sum => (false, format!("({})", c.text)),
                _ => (false, c.text.clone()),
            };
            let variable = match power {
                0 => String::new(),
                1 => name.to_owned(),
                _ => format!("{name}{}", superscript(power)),
            };
            let term = match (power, size.as_str()) {
                (0, _) => size,
                (_, "1") => variable,
                _ if size.bytes().all(|b| b.is_ascii_digit()) => format!("{size}{variable}"),
                _ => format!("{size} {variable}"),
            };
            terms.push((negative, term));
        }
        // Descending, unless that order begins with a minus sign and the ascending order does not.
        if terms.last().is_some_and(|(negative, _)| !negative)
            || terms.first().is_some_and(|(negative, _)| *negative)
        {
            terms.reverse();
        }
        let mut text = String::new();
        for (index, (negative, term)) in terms.iter().enumerate() {
            text.push_str(match (index, negative) {
                (0, false) => "",
                (0, true) => "−",
                (_, false) => " + ",
                (_, true) => " − ",
            });
            text.push_str(term);
        }
        if text.is_empty() {
            "0".to_owned()
        } else {
            text
        }
    }
}

impl fmt::Display for RationalFunction {
    /// `(ν⁴ − 22ν² + 48)/(ν² + 24)`
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        let numerator = self.polynomial(&self.numerator, self.variable == Variable::NuTimesSquared);
        let denominator = self.polynomial(&self.denominator, false);
        let grouped = |text: &str| {
            if text.contains(' ') {
                format!("({text})")
            } else {
                text.to_owned()
            }
        };
        match denominator.as_str() {
            "1" => f.write_str(&numerator),
            _ => write!(f, "{}/{}", grouped(&numerator), grouped(&denominator)),
        }
    }
}

/// An exponent in superscript digits.
pub(crate) fn superscript(power: usize) -> String {
    const DIGITS: [char; 10] = ['⁰', '¹', '²', '³', '⁴', '⁵', '⁶', '⁷', '⁸', '⁹'];
    let digits = power.to_string();
    digits
        .bytes()
        .map(|b| DIGITS[usize::from(b - b'0')])
        .collect()
}

#[cfg(test)]
mod tests {
    use super::*;

    fn shown(numerator: &[i64], denominator: &[i64], variable: Variable) -> String {
        let [n, d] = [numerator, denominator].map(Polynomial::from_integers);
        Fraction::new(&n, &d).exported(variable).to_string()
    }

    #[test]
    fn rational_functions_are_written_like_by_hand() {
        assert_eq!(shown(&[4, -2], &[2], Variable::NuSquared), "2 − ν²");
        assert_eq!(
            shown(&[48, -22, 1], &[24, 1], Variable::NuSquared),
            "(ν⁴ − 22ν² + 48)/(ν² + 24)"
        );
        assert_eq!(
            shown(&[6, -1], &[6], Variable::NuTimesSquared),
            "(6ν − ν³)/6"
        );
        assert_eq!(shown(&[0], &[3], Variable::Z), "0");
        assert_eq!(shown(&[-1, 0, 1], &[1, 1], Variable::Z), "z − 1");
        assert_eq!(shown(&[-1, -1], &[1], Variable::Z), "−z − 1");
    }
}
