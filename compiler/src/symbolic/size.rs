//! How large constants are: what bounds the work on them.

use num_bigint::BigInt;
use num_rational::BigRational;
use num_traits::{ToPrimitive, Zero};

use super::{Constant, MAX_FRACTION_BITS, MAX_MAGNITUDE, MAX_POWER, Tree};
use crate::error::ErrorKind;
use crate::expression::MAX_BITS;

/// An error if a size exceeds its limit.
pub(super) fn check(what: &'static str, size: usize, limit: usize) -> Result<(), ErrorKind> {
    if size > limit {
        return Err(ErrorKind::ExpressionSize { what, size, limit });
    }
    Ok(())
}

/// An error if a rational with this many bits is too long.
pub(super) fn check_bits(bits: usize, whole: bool) -> Result<(), ErrorKind> {
    let limit = if whole { MAX_BITS } else { MAX_FRACTION_BITS };
    check("the size of the coefficients in bits", bits, limit)
}

/// An error if a rational is too long.
pub(super) fn check_rational(value: &BigRational) -> Result<(), ErrorKind> {
    let bits = value.numer().bits().max(value.denom().bits());
    check_bits(bits as usize, value.is_integer())
}

/// An error if a number that is not rational may be too large.
pub(super) fn check_magnitude(magnitude: i64) -> Result<(), ErrorKind> {
    check(
        "the binary logarithm of a constant",
        usize::try_from(magnitude).unwrap_or(0),
        MAX_MAGNITUDE as usize,
    )
}

/// The words of a rational.
pub(super) fn words(value: &BigRational) -> usize {
    ((value.numer().bits() + value.denom().bits()) / 64) as usize
}

/// The size of a tree and the largest height in it.
pub(super) fn size(tree: &Tree) -> (usize, usize) {
    // What is costly to enclose counts more.
    const TRANSCENDENTAL: usize = 8;
    match tree {
        Tree::Rational(value) => (1 + words(value), 0),
        Tree::Pi => (1, 0),
        Tree::Root(root) => (TRANSCENDENTAL + root.polynomial.degree().unwrap_or(0), 0),
        Tree::Sqrt(x) => (1 + x.size(), x.height()),
        Tree::Cbrt(x) | Tree::Exp(x) | Tree::Ln(x) | Tree::Cos(x) | Tree::Sin(x) => {
            (TRANSCENDENTAL + x.size(), x.height())
        }
        Tree::Product(factors) => {
            let exponents = factors
                .iter()
                .map(|(_, n)| (n.unsigned_abs() / 64) as usize);
            let size = 1 + factors.len() + exponents.sum::<usize>();
            above(size, factors.iter().map(|(x, _)| x))
        }
        Tree::Sum(constant, terms) => {
            let coefficients = terms.iter().map(|(_, q)| 1 + words(q)).sum::<usize>();
            above(
                1 + words(constant) + coefficients,
                terms.iter().map(|(x, _)| x),
            )
        }
    }
}

/// The sum of a size and those of the parts, and the largest height of a part.
fn above<'a>(size: usize, parts: impl Iterator<Item = &'a Constant>) -> (usize, usize) {
    parts.fold((size, 0), |(size, height), part| {
        (size.saturating_add(part.size()), height.max(part.height()))
    })
}

pub(super) fn magnitude_of_rational(value: &BigRational) -> i64 {
    if value.is_zero() {
        return -i64::from(u32::MAX);
    }
    value.numer().bits() as i64 - value.denom().bits() as i64 + 1
}

/// A number `n` with `|x| ≤ 2ⁿ`, from those of the parts.
pub(super) fn magnitude(tree: &Tree) -> Result<i64, ErrorKind> {
    let length = |n: u64| 64 - i64::from(n.leading_zeros());
    Ok(match tree {
        Tree::Rational(value) => magnitude_of_rational(value),
        Tree::Pi => 2,
        Tree::Root(root) => {
            // The modulus of a root is at most 1 + max|cₖ/cₙ| (Cauchy).
            let bits = root.polynomial.numerators().iter().map(BigInt::bits).max();
            bits.unwrap_or(0) as i64 + 1
        }
        Tree::Sqrt(x) => (x.magnitude() + 1).div_euclid(2),
        Tree::Cbrt(x) => (x.magnitude() + 2).div_euclid(3),
        Tree::Exp(x) => {
            // log₂(eˣ) = x·log₂e < 3/2·x for positive x.
            check_magnitude(x.magnitude())?;
            let interval = x.enclose(4).ok_or_else(|| x.undecided())?;
            let above: BigInt = &interval.high >> 4u32;
            let above = (above.to_i64().unwrap_or(i64::from(u32::MAX)) + 1)
                .clamp(-i64::from(u32::MAX), i64::from(u32::MAX));
            if above > 0 {
                (above * 1443).div_euclid(1000) + 1
            } else {
                (above * 1442).div_euclid(1000) + 1
            }
        }
        Tree::Ln(x) => {
            let (_, least) = x.separation().ok_or_else(|| x.undecided())?;
            length(least.unsigned_abs().max(x.magnitude().unsigned_abs()))
        }
        Tree::Cos(x) | Tree::Sin(x) => {
            check_magnitude(x.magnitude())?;
            0
        }
        Tree::Product(factors) => {
            let mut sum = 0i64;
            for (x, n) in factors {
                check("an exponent", n.unsigned_abs() as usize, MAX_POWER as usize)?;
                let size = if *n > 0 {
                    x.magnitude()
                } else {
                    x.separation().ok_or_else(|| x.undecided())?.1
                };
                sum = sum.saturating_add(size.saturating_mul(i64::from(*n)));
            }
            sum
        }
        Tree::Sum(constant, terms) => {
            let largest = terms
                .iter()
                .map(|(x, q)| x.magnitude().saturating_add(magnitude_of_rational(q)))
                .fold(magnitude_of_rational(constant), i64::max);
            largest.saturating_add(length(terms.len() as u64))
        }
    })
}

#[cfg(test)]
mod tests {
    use crate::symbolic::constant::tests::{constant, value};

    #[test]
    fn magnitudes_bound_the_values() {
        for text in [
            "pi",
            "-e^5",
            "exp(-7/2)",
            "sqrt(1/1000)",
            "1/(pi - 22/7)",
            "ln(10^300)",
            "1000*sqrt(2) + e",
            "root(t^3 - 1000*t - 1, 3)",
            "cbrt(-10^9/7)",
            "exp(1/1000)",
            "exp(-1/1000)",
            "pi^5/exp(2)^3",
        ] {
            let x = constant(text);
            assert!(value(&x).abs() <= 2f64.powi(x.magnitude() as i32), "{text}");
            assert!(
                value(&x).abs() >= 2f64.powi(x.magnitude() as i32 - 9),
                "{text}"
            );
        }
    }
}
