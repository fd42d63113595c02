//! Printed digits compared with those of an exact method.

use num_bigint::BigInt;
use num_rational::BigRational;
use num_traits::{One, Signed, Zero};

use super::certificate::Solution;
use super::linear::magnitude;
use super::structure::Target;
use crate::arithmetic::interval::Interval;

/// Whether an exact method of the claimed order, with the structure that was read, has all printed digits. Then
/// each coefficient rounds to its print, and equals a printed fraction or integer.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum Digits {
    /// The method of the certificate has all printed digits.
    All,
    /// It is proved that no method has all printed digits.
    Excluded,
    /// No such method was found; whether there is one is undecided.
    NotFound,
}

/// Bounds on the distance of a coefficient from its print.
#[derive(Debug, Clone)]
pub(super) struct Distance {
    pub at_least: BigRational,
    pub at_most: BigRational,
}

/// The distances of some targets from their prints.
pub(super) fn distances(targets: &[Target], solution: &Solution, bits: u32) -> Vec<Distance> {
    let mut enclosed: Option<Vec<Interval>> = None;
    let distance = |target: &Target| {
        if let Some(value) = target.rational(solution) {
            let exact = (value - &target.printed).abs();
            return Distance {
                at_least: exact.clone(),
                at_most: exact,
            };
        }
        let unknowns = enclosed.get_or_insert_with(|| solution.unknowns(bits));
        let printed = Interval::enclosing(&target.printed, bits);
        let difference = target.enclosed(unknowns, bits).subtract(&printed);
        let in_units = |units| BigRational::new(units, BigInt::one() << bits);
        Distance {
            at_least: in_units(smallest(&difference)),
            at_most: in_units(magnitude(&difference)),
        }
    };
    targets.iter().map(distance).collect()
}

/// The smallest absolute value in an interval, in units of `2⁻ᵇⁱᵗˢ`.
pub(super) fn smallest(interval: &Interval) -> BigInt {
    let straddles = !interval.low.is_positive() && !interval.high.is_negative();
    match straddles {
        true => BigInt::zero(),
        false => interval.low.abs().min(interval.high.abs()),
    }
}
