//! The size of the leading error term.
//!
//! One step of a method of order `p` has the error
//!
//! ```text
//! h^(p+1) Σ_τ α(τ)/|τ|! · (γ(τ) φ(τ) − 1) F(τ) + O(h^(p+2)),    |τ| = p + 1
//! ```
//!
//! with the elementary weights `φ` and differentials `F` (GNI III.1). As `α(τ)/|τ|! = 1/(γ(τ) σ(τ))`, the
//! coefficient of `F(τ)` is the residual `φ(τ) − 1/γ(τ)` divided by the symmetry `σ(τ)`. The error
//! constant is the Euclidean norm of these coefficients over the trees of the class,
//!
//! ```text
//! ( Σ_τ ((φ(τ) − 1/γ(τ))/σ(τ))² )^½ ,
//! ```
//!
//! which for trees of one colour is the principal error norm of Dormand & Prince (1980).

use num_bigint::BigInt;
use num_rational::BigRational;

use crate::algebra::Number;
use crate::arithmetic::interval::Interval;
use crate::arithmetic::rounding::Decimal;

/// The number of certified digits.
const DIGITS: usize = 12;

/// Binary places of the first enclosures, and the limit beyond which a rounding is left undecided.
const BITS: std::ops::Range<u32> = 192..20_000;

/// One term: a value, its required value, and the weight of the squared difference.
pub(super) struct Term<'a> {
    pub(super) value: Number<'a>,
    pub(super) wanted: BigRational,
    pub(super) weight: BigRational,
}

/// The index of the first residual, value minus required value, that is not negligible: at least `2⁻²⁰` of the largest. Residuals far
/// below the others are those of rounded numbers, or zero.
pub(super) fn leading<'a>(
    residuals: impl Iterator<Item = (&'a Number<'a>, &'a BigRational)>,
) -> usize {
    const NEGLIGIBLE: u64 = 20;
    let size = |(value, wanted): (&Number<'_>, &BigRational)| -> u64 {
        let value = value.enclose(BITS.start).with_bits(BITS.start);
        let residual = value.subtract(&Interval::enclosing(wanted, BITS.start));
        residual.low.bits().max(residual.high.bits())
    };
    let sizes: Vec<u64> = residuals.map(size).collect();
    let largest = sizes.iter().copied().max().unwrap_or(0);
    let leading = |&size: &u64| size + NEGLIGIBLE >= largest;
    sizes.iter().position(leading).unwrap_or(0)
}

/// The square root of the weighted sum of squares to [`DIGITS`] digits; `None` if it is too close to the midpoint of
/// two decimals, or to zero.
pub(super) fn norm(terms: &[Term<'_>]) -> Option<Decimal> {
    let mut bits = BITS.start;
    while bits < BITS.end {
        let square = |term: &Term<'_>| {
            let value = term.value.enclose(bits).with_bits(bits);
            let residual = value.subtract(&Interval::enclosing(&term.wanted, bits));
            let square = residual.multiply(&residual);
            square.multiply(&Interval::enclosing(&term.weight, bits))
        };
        let zero = Interval::enclosing(&BigRational::default(), bits);
        let sum = terms.iter().map(square).fold(zero, |sum, x| sum.add(&x));
        // The product of an interval with itself may extend below zero.
        let low = sum.low.max(BigInt::default());
        let root = |square: BigInt| (square << bits).sqrt();
        let unit = BigInt::from(1) << bits;
        let low = BigRational::new(root(low), unit.clone());
        let high = BigRational::new(root(sum.high) + 1, unit);
        let (low, high) = (Decimal::round(&low, DIGITS), Decimal::round(&high, DIGITS));
        if low == high {
            return Some(low);
        }
        bits *= 2;
    }
    None
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::arithmetic::rational::ratio;

    /// The residual of rounded numbers is skipped, unless there is no other.
    #[test]
    fn leading_residuals_are_not_those_of_roundings() {
        let values = |residuals: &[(i64, i32)]| -> Vec<(Number<'static>, BigRational)> {
            let value =
                |&(numerator, twos)| ratio(1, 4) + ratio(numerator, 1) / ratio(2, 1).pow(twos);
            let number = |residual| (Number::Rational(value(residual)), ratio(1, 4));
            residuals.iter().map(number).collect()
        };
        let leading = |residuals: &[(i64, i32)]| {
            let values = values(residuals);
            leading(values.iter().map(|(value, wanted)| (value, wanted)))
        };
        assert_eq!(leading(&[(1, 66), (1, 60), (-1, 5), (1, 4)]), 2);
        assert_eq!(leading(&[(1, 66), (1, 60)]), 0);
        assert_eq!(leading(&[(1, 100), (-1, 66), (1, 60)]), 1);
    }

    #[test]
    fn norms_are_rounded_correctly() {
        let term = |value: BigRational, weight: i64| Term {
            value: Number::Rational(value),
            wanted: ratio(1, 3),
            weight: ratio(1, weight),
        };
        let norm = |terms: &[Term<'_>]| norm(terms).map(|decimal| decimal.to_string());
        // 3/4 is exact; √(1/9 + 1/81) = √10/9.
        let exact = norm(&[term(ratio(13, 12), 1)]);
        assert_eq!(exact.as_deref(), Some("0.750000000000"));
        let root = norm(&[term(ratio(2, 3), 1), term(ratio(0, 1), 9)]);
        assert_eq!(root.as_deref(), Some("0.351364184463"));
        assert_eq!(norm(&[term(ratio(1, 3), 1)]), None);
    }
}
