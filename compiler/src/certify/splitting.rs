//! Explicit splittings as printed.

use num_bigint::BigInt;
use num_rational::BigRational;
use num_traits::{One, Signed};

use super::CertifyError;
use super::printed::{Printed, power_of_ten};
use super::structure::Coefficient;
use crate::arithmetic::rational::ratio;
use crate::arithmetic::rounding::Decimal;

/// The largest number of stages of a splitting, and of weights of a composition.
pub const MAX_STAGES: usize = 64;
/// The largest absolute value of a coefficient.
const MAX_COEFFICIENT: u32 = 1000;
/// Decimal places of the tolerance. Differences up to `10^−10` are attributed to the precision of a paper's computation;
/// differences beyond `10^−3` are never attributed to short digits.
const TOLERANCE_PLACES: std::ops::RangeInclusive<u32> = 3..=10;

/// A splitting: for `i = 1, …, n`, `p -= kick[i] h ∂U/∂q(q)`, then `q += drift[i] h ∂T/∂p(p)`.
///
/// With gradient kicks, for quadratic `T`, the first is `p += h (kick[i] f + 2 gradient[i] h² f′ M⁻¹ f)` with `f = −∂U/∂q`.
#[derive(Debug, Clone, PartialEq, Eq)]
pub struct Splitting {
    /// The coefficients of the kicks.
    pub kick: Vec<Printed>,
    /// The coefficients of the drifts, as many as kicks.
    pub drift: Vec<Printed>,
    /// The weights of gradient kicks, as many as kicks; empty for a splitting without such kicks.
    pub gradient: Vec<Printed>,
}

impl Splitting {
    /// Reads the printed coefficients.
    ///
    /// # Errors
    /// [`CertifyError::NotANumber`], [`CertifyError::Lengths`] for lists of different length,
    /// [`CertifyError::Stages`] for no stages or more than [`MAX_STAGES`], and [`CertifyError::TooLarge`].
    pub fn parse(kick: &[&str], drift: &[&str]) -> Result<Self, CertifyError> {
        let read = |texts: &[&str]| -> Result<Vec<Printed>, CertifyError> {
            texts.iter().map(|text| Printed::parse(text)).collect()
        };
        let splitting = Splitting {
            kick: read(kick)?,
            drift: read(drift)?,
            gradient: Vec::new(),
        };
        splitting.check()?;
        Ok(splitting)
    }

    pub(super) fn check(&self) -> Result<(), CertifyError> {
        if self.kick.len() != self.drift.len() {
            return Err(CertifyError::Lengths {
                kicks: self.kick.len(),
                drifts: self.drift.len(),
            });
        }
        if !self.gradient.is_empty() {
            if self.gradient.len() != self.kick.len() {
                return Err(CertifyError::GradientLengths {
                    kicks: self.kick.len(),
                    weights: self.gradient.len(),
                });
            }
            check(&self.gradient, Coefficient::Gradient)?;
        }
        check(&self.kick, Coefficient::Kick)?;
        check(&self.drift, Coefficient::Drift)
    }
}

/// Checks the number and the size of printed coefficients.
pub(super) fn check(
    list: &[Printed],
    name: impl Fn(usize) -> Coefficient,
) -> Result<(), CertifyError> {
    if !(1..=MAX_STAGES).contains(&list.len()) {
        return Err(CertifyError::Stages {
            count: list.len(),
            limit: MAX_STAGES,
        });
    }
    let limit = BigRational::from_integer(MAX_COEFFICIENT.into());
    for (index, printed) in list.iter().enumerate() {
        if printed.value().abs() > limit {
            return Err(CertifyError::TooLarge {
                coefficient: name(index).to_string(),
                value: Decimal::round(printed.value(), 6).to_string(),
                limit: MAX_COEFFICIENT,
            });
        }
    }
    Ok(())
}

/// The allowed distance of the digits from those of an exact method: `10^−10`, or ten units of the last decimal place of
/// the longest coefficient if there are fewer places.
pub(super) fn tolerance<'a>(all: impl Iterator<Item = &'a Printed>) -> BigRational {
    let places = all.filter_map(Printed::places).max();
    let (fewest, most) = (*TOLERANCE_PLACES.start(), *TOLERANCE_PLACES.end());
    let places = places.map_or(most, |n| n.saturating_sub(1).clamp(fewest, most));
    BigRational::new(BigInt::one(), power_of_ten(places))
}

/// The sum of the printed values, if it differs from 1 by more than the tolerance times the number of values.
pub(super) fn wrong_sum(list: &[Printed], tolerance: &BigRational) -> Option<BigRational> {
    let sum: BigRational = list.iter().map(Printed::value).sum();
    let bound = tolerance * ratio(list.len().try_into().unwrap_or(i64::MAX), 1);
    ((&sum - BigRational::one()).abs() > bound).then_some(sum)
}
