//! The size of constants, which bounds the work on them.

use num_rational::BigRational;

use super::{Constant, MAX_FRACTION_BITS, Tree};
use crate::arithmetic::rational::length;
use crate::error::ErrorKind;
use crate::expression::MAX_BITS;

/// Checks a size against its limit.
pub(super) fn check(what: &'static str, size: usize, limit: usize) -> Result<(), ErrorKind> {
    if size > limit {
        return Err(ErrorKind::ExpressionSize { what, size, limit });
    }
    Ok(())
}

/// Checks the number of bits of an integer or a fraction.
pub(super) fn check_bits(bits: usize, whole: bool) -> Result<(), ErrorKind> {
    let limit = if whole { MAX_BITS } else { MAX_FRACTION_BITS };
    check("the size of the coefficients in bits", bits, limit)
}

/// Checks the length of a rational.
pub(super) fn check_rational(value: &BigRational) -> Result<(), ErrorKind> {
    check_bits(length(value) as usize, value.is_integer())
}

/// The number of 64-bit words of a rational.
pub(super) fn words(value: &BigRational) -> usize {
    ((value.numer().bits() + value.denom().bits()) / 64) as usize
}

/// The number of binary places that an enclosure needs to resolve every part of a constant next to numbers of order 1.
///
/// Large numbers count like their inverses: cancellation, as in `√(n² + 1) − n`, leaves a number of that size.
pub(super) fn fineness(constant: &Constant) -> u64 {
    // For a number that is large, or small because of its parts or by cancellation.
    let extent = || {
        let separated = constant.separation().map_or(0, |(_, least)| -least);
        u64::try_from(separated.max(constant.magnitude())).unwrap_or(0)
    };
    let of_parts = match constant.tree() {
        Tree::Rational(value) => return length(value),
        Tree::Pi | Tree::Root(_) => 0,
        Tree::Sqrt(x) | Tree::Cbrt(x) | Tree::Exp(x) | Tree::Ln(x) => fineness(x),
        // The cosine of a small argument differs from 1 by about its square.
        Tree::Cos(x) | Tree::Sin(x) => fineness(x).saturating_mul(2),
        Tree::Product(factors) => {
            let power =
                |(x, n): &(Constant, i32)| fineness(x).saturating_mul(u64::from(n.unsigned_abs()));
            factors.iter().map(power).fold(0, u64::saturating_add)
        }
        Tree::Sum(constant, terms) => {
            let term =
                |(x, factor): &(Constant, BigRational)| fineness(x).saturating_add(length(factor));
            let terms = terms.iter().map(term).max();
            length(constant).max(terms.unwrap_or(0))
        }
    };
    of_parts.max(extent())
}

/// The size of a tree and the largest height of its parts.
pub(super) fn size(tree: &Tree) -> (usize, usize) {
    // The weight of operations that are costly to enclose.
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

/// The sum of a size and the sizes of the parts, and the largest height of a part.
fn above<'a>(size: usize, parts: impl Iterator<Item = &'a Constant>) -> (usize, usize) {
    parts.fold((size, 0), |(size, height), part| {
        (size.saturating_add(part.size()), height.max(part.height()))
    })
}
