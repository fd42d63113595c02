//! Bounds on the magnitude of constants; they limit the binary places of enclosures.

use std::cmp::Ordering;

use num_bigint::BigInt;
use num_rational::BigRational;
use num_traits::{ToPrimitive, Zero};

use super::enclosure::ARGUMENT_GUARD;
use super::size::check;
use super::{Constant, MAX_MAGNITUDE, MAX_POWER, Tree};
use crate::arithmetic::interval::Interval;
use crate::error::ErrorKind;
use crate::expression::shown;

/// Bounds of the binary logarithm of a number.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub(super) struct Magnitude {
    /// A number `n` with `2ⁿ ≤ |x|`; `None` if unknown, and for zero.
    pub least: Option<i64>,
    /// A number `n` with `|x| ≤ 2ⁿ`.
    pub most: i64,
}

impl Magnitude {
    fn new(least: i64, most: i64) -> Self {
        Magnitude {
            least: Some(least),
            most,
        }
    }

    /// The magnitude of a number with an upper bound only.
    fn below(most: i64) -> Self {
        Magnitude { least: None, most }
    }

    /// The magnitude of a rational number.
    pub fn of_rational(value: &BigRational) -> Self {
        if value.is_zero() {
            return Magnitude::below(-i64::from(u32::MAX));
        }
        let lengths = value.numer().bits() as i64 - value.denom().bits() as i64;
        Magnitude::new(lengths - 1, lengths + 1)
    }

    /// The magnitude of a product.
    fn times(self, other: Magnitude) -> Self {
        let least = self.least.zip(other.least);
        Magnitude {
            least: least.map(|(a, b)| a.saturating_add(b)),
            most: self.most.saturating_add(other.most),
        }
    }

    /// The magnitude of a power with a positive exponent.
    fn power(self, exponent: u32) -> Self {
        let exponent = i64::from(exponent);
        Magnitude {
            least: self.least.map(|n| n.saturating_mul(exponent)),
            most: self.most.saturating_mul(exponent),
        }
    }

    /// The magnitude of the real root of this order.
    fn root(self, order: i64) -> Self {
        Magnitude {
            least: self.least.map(|n| n.div_euclid(order)),
            most: (self.most + order - 1).div_euclid(order),
        }
    }

    /// The logarithm that exceeds the limit, if any.
    fn excess(self) -> Option<i64> {
        let smallest = self.least.unwrap_or(self.most).min(self.most);
        let too_small = (smallest < -MAX_MAGNITUDE).then_some(smallest);
        (self.most > MAX_MAGNITUDE)
            .then_some(self.most)
            .or(too_small)
    }
}

impl Constant {
    /// The error for a constant with a part that is too large or too small.
    fn out_of_bounds(&self, logarithm: i64) -> ErrorKind {
        ErrorKind::Magnitude {
            constant: shown(&self.to_string()),
            logarithm,
            limit: MAX_MAGNITUDE,
        }
    }

    /// Checks that an irrational constant and its parts are within the limits.
    pub(super) fn check_magnitude(&self) -> Result<(), ErrorKind> {
        let mut parts = vec![self.bounds()];
        if let Tree::Product(factors) = self.tree() {
            parts.extend(sides(factors)?);
        }
        if let Tree::Sum(_, terms) = self.tree() {
            let term = |(x, factor): &(Constant, BigRational)| {
                x.bounds().times(Magnitude::of_rational(factor))
            };
            parts.extend(terms.iter().map(term));
        }
        match parts.into_iter().find_map(Magnitude::excess) {
            Some(logarithm) if self.as_rational().is_none() => Err(self.out_of_bounds(logarithm)),
            _ => Ok(()),
        }
    }

    /// A coarse enclosure of an argument of a function.
    ///
    /// # Errors
    /// If it is too large, or loses too many places: these losses add up in nested functions.
    fn enclose_argument(&self) -> Result<Interval, ErrorKind> {
        let most = self.magnitude();
        if most > MAX_MAGNITUDE {
            return Err(self.out_of_bounds(most));
        }
        let interval = self.enclose_with(4, ARGUMENT_GUARD);
        interval.ok_or_else(|| self.undecided())
    }

    /// The bounds; the lower bound by refinement if the tree gives none. A number that is not separated from zero
    /// counts as `2^−MAX_MAGNITUDE`.
    fn refined_bounds(&self) -> Magnitude {
        let bounds = self.bounds();
        let refined = || match self.separation() {
            None => Some(-MAX_MAGNITUDE),
            Some((Ordering::Equal, _)) => None,
            Some((_, least)) => Some(least),
        };
        Magnitude {
            least: bounds.least.or_else(refined),
            ..bounds
        }
    }
}

/// The bounds of a number from the bounds of its parts.
pub(super) fn magnitude(tree: &Tree) -> Result<Magnitude, ErrorKind> {
    let length = |n: u64| 64 - i64::from(n.leading_zeros());
    Ok(match tree {
        Tree::Rational(value) => Magnitude::of_rational(value),
        Tree::Pi => Magnitude::new(1, 2),
        Tree::Root(root) => {
            // The modulus of a root is at most 1 + max|cₖ/cₙ| (Cauchy).
            let bits = root.polynomial.numerators().iter().map(BigInt::bits).max();
            Magnitude::below(bits.unwrap_or(0) as i64 + 1)
        }
        Tree::Sqrt(x) => x.bounds().root(2),
        Tree::Cbrt(x) => x.bounds().root(3),
        Tree::Exp(x) => {
            let interval = x.enclose_argument()?;
            let whole = |end: BigInt| {
                let limit = i64::from(u32::MAX);
                end.to_i64()
                    .unwrap_or(if end < BigInt::zero() { -limit } else { limit })
            };
            let (below, above) = (
                whole(&interval.low >> 4u32),
                whole(interval.high >> 4u32) + 1,
            );
            // log₂(eˣ) = x·log₂e with 1.442 < log₂e < 1.443.
            let times =
                |x: i64, factors: [i64; 2]| (x * factors[usize::from(x > 0)]).div_euclid(1000);
            Magnitude::new(times(below, [1443, 1442]), times(above, [1442, 1443]) + 1)
        }
        Tree::Ln(x) => {
            let (_, least) = x.separation().ok_or_else(|| x.undecided())?;
            Magnitude::below(length(
                least.unsigned_abs().max(x.magnitude().unsigned_abs()),
            ))
        }
        Tree::Cos(x) | Tree::Sin(x) => {
            x.enclose_argument()?;
            Magnitude::below(0)
        }
        Tree::Product(factors) => {
            let [above, below] = sides(factors)?;
            let least = below.least.unwrap_or(below.most);
            Magnitude {
                least: above.least.map(|n| n.saturating_sub(below.most)),
                most: above.most.saturating_sub(least),
            }
        }
        Tree::Sum(constant, terms) => {
            let term =
                |(x, q): &(Constant, BigRational)| x.bounds().times(Magnitude::of_rational(q));
            match terms.as_slice() {
                [single] if constant.is_zero() => term(single),
                _ => {
                    let constant = Magnitude::of_rational(constant).most;
                    let largest = terms.iter().map(|t| term(t).most).fold(constant, i64::max);
                    Magnitude::below(largest.saturating_add(length(terms.len() as u64)))
                }
            }
        }
    })
}

/// The bounds of the products of the factors with positive and with negative exponents.
fn sides(factors: &[(Constant, i32)]) -> Result<[Magnitude; 2], ErrorKind> {
    let mut sides = [Magnitude::new(0, 0); 2];
    for (x, n) in factors {
        check("an exponent", n.unsigned_abs() as usize, MAX_POWER as usize)?;
        let bounds = x.refined_bounds();
        if *n < 0 && x.separation().is_none_or(|(sign, _)| sign.is_eq()) {
            return Err(x.undecided());
        }
        let side = &mut sides[usize::from(*n < 0)];
        *side = side.times(bounds.power(n.unsigned_abs()));
    }
    Ok(sides)
}

#[cfg(test)]
mod tests {
    use crate::expression::{Input, parse_list};
    use crate::symbolic::constant::tests::{constant, value};

    #[test]
    fn magnitudes_bound_the_values() {
        for text in [
            "pi",
            "-e^5",
            "exp(-7/2)",
            "sqrt(1/1000)",
            "sqrt(pi/1000)",
            "1/(pi - 22/7)",
            "ln(10^300)",
            "1000*sqrt(2) + e",
            "root(t^3 - 1000*t - 1, 3)",
            "cbrt(-10^9/7)",
            "cbrt(-pi*10^9/7)",
            "exp(1/1000)",
            "exp(-1/1000)",
            "pi^5/exp(2)^3",
        ] {
            let x = constant(text);
            let size = value(&x).abs();
            assert!(size <= 2f64.powi(x.magnitude() as i32), "{text}");
            assert!(size >= 2f64.powi(x.magnitude() as i32 - 9), "{text}");
            if let Some(least) = x.bounds().least {
                assert!(size >= 2f64.powi(least as i32), "{text}");
            }
        }
    }

    #[test]
    fn constants_that_are_too_large_or_too_small_are_refused() {
        let read = |text: &str| {
            let input = Input { name: "test", text };
            parse_list(input).and_then(|list| list[0].constant(input))
        };
        for text in [
            "exp(2800)",
            "exp(-2800)",
            "(pi^400)^4",
            "(pi^400)^-4",
            "pi*(10^400)^3",
            "pi/(10^400)^3",
            "(pi - 355/113)^150",
            "(pi - 355/113)^-150",
        ] {
            assert!(read(text).is_ok(), "{text}");
        }
        let refused = [
            ("exp(99999999999)", "too large"),
            ("exp(-99999999999)", "too small"),
            ("exp(10^400)", "too large"),
            ("exp(-10^400)", "too small"),
            ("exp(2900)", "too large"),
            ("exp(-2900)", "too small"),
            ("exp(-exp(30))", "too small"),
            (
                "(1 + pi)^400*(2 + pi)^400*(3 + pi)^400*(4 + pi)^400",
                "too large",
            ),
            (
                "(1 + pi)^-400*(2 + pi)^-400*(3 + pi)^-400*(4 + pi)^-400",
                "too small",
            ),
            ("((pi - 355/113)^300)", "too small"),
            ("((pi - 355/113)^-300)", "too large"),
            ("pi*(10^400)^4", "too large"),
            ("pi/(10^400)^4", "too small"),
            ("cos((9^400)^40)", "too large"),
        ];
        for (text, what) in refused {
            let message = read(text).expect_err(text).to_string();
            assert!(
                message.contains(what) && message.contains("2^"),
                "{text}: {message}"
            );
        }
    }
}
