//! Frequencies and rates of growth.

use num_rational::BigRational;
use num_traits::{One, Signed, Zero};

use super::size::words;
use super::{Constant, Wave};
use crate::arithmetic::polynomial::Polynomial;
use crate::error::ErrorKind;

/// The number `rational + pi·π`. As π is irrational, equal numbers have equal parts.
#[derive(Debug, Clone, PartialEq, Eq, Hash, PartialOrd, Ord)]
pub struct Frequency {
    /// The rational part.
    pub rational: BigRational,
    /// The coefficient of π.
    pub pi: BigRational,
}

impl Frequency {
    /// The number 0.
    pub fn zero() -> Self {
        Self::from_rational(BigRational::zero())
    }

    /// A rational frequency.
    pub fn from_rational(rational: BigRational) -> Self {
        Frequency {
            rational,
            pi: BigRational::zero(),
        }
    }

    /// The frequency equal to a constant of the form `q₀ + q₁·π`; `None` for other constants.
    pub fn from_constant(constant: &Constant) -> Option<Self> {
        constant
            .linear_in_pi()
            .map(|(rational, pi)| Frequency { rational, pi })
    }

    /// The value.
    ///
    /// # Errors
    /// [`ErrorKind::ExpressionSize`] for rationals that are too long.
    pub fn to_constant(&self) -> Result<Constant, ErrorKind> {
        Constant::pi()
            .scale(&self.pi)?
            .add(&Constant::rational(self.rational.clone())?)
    }

    /// The value as a polynomial in π.
    pub(super) fn to_polynomial(&self) -> Polynomial {
        Polynomial::from_rationals(&[self.rational.clone(), self.pi.clone()])
    }

    /// Whether this is 0.
    pub fn is_zero(&self) -> bool {
        self.rational.is_zero() && self.pi.is_zero()
    }

    /// The sum.
    #[must_use]
    pub fn add(&self, other: &Frequency) -> Self {
        Frequency {
            rational: &self.rational + &other.rational,
            pi: &self.pi + &other.pi,
        }
    }

    /// The difference.
    #[must_use]
    pub fn subtract(&self, other: &Frequency) -> Self {
        self.add(&other.negate())
    }

    /// The negated number.
    #[must_use]
    pub fn negate(&self) -> Self {
        Frequency {
            rational: -&self.rational,
            pi: -&self.pi,
        }
    }

    /// The number of words of its rationals.
    pub(super) fn size(&self) -> usize {
        words(&self.rational) + words(&self.pi)
    }

    /// Of `±self` the one whose first nonzero part is positive, and whether it is `−self`.
    ///
    /// The parts decide, not the value: it suffices that both signs lead to the same choice.
    pub(super) fn normalise(&self) -> (Self, bool) {
        let first = if self.pi.is_zero() {
            &self.rational
        } else {
            &self.pi
        };
        if first.is_negative() {
            (self.negate(), true)
        } else {
            (self.clone(), false)
        }
    }
}

/// A rational multiple of a wave.
pub(super) type Scaled = (BigRational, Wave);

impl Wave {
    /// `factor·cos(frequency·t)`
    pub(super) fn cos(factor: BigRational, frequency: &Frequency) -> Scaled {
        let (frequency, _) = frequency.normalise();
        if frequency.is_zero() {
            (factor, Wave::None)
        } else {
            (factor, Wave::Cos(frequency))
        }
    }

    /// `factor·sin(frequency·t)`
    pub(super) fn sin(factor: BigRational, frequency: &Frequency) -> Scaled {
        let (frequency, negated) = frequency.normalise();
        if frequency.is_zero() {
            (BigRational::zero(), Wave::None)
        } else {
            let factor = if negated { -factor } else { factor };
            (factor, Wave::Sin(frequency))
        }
    }

    /// The product as a sum of waves; some factors may be 0.
    pub(super) fn multiply(&self, other: &Wave) -> Vec<Scaled> {
        let half = || BigRational::new(1.into(), 2.into());
        match (self, other) {
            (Wave::None, wave) | (wave, Wave::None) => vec![(BigRational::one(), wave.clone())],
            (Wave::Cos(a), Wave::Cos(b)) => vec![
                Wave::cos(half(), &a.subtract(b)),
                Wave::cos(half(), &a.add(b)),
            ],
            (Wave::Sin(a), Wave::Sin(b)) => vec![
                Wave::cos(half(), &a.subtract(b)),
                Wave::cos(-half(), &a.add(b)),
            ],
            (Wave::Sin(a), Wave::Cos(b)) | (Wave::Cos(b), Wave::Sin(a)) => vec![
                Wave::sin(half(), &a.add(b)),
                Wave::sin(half(), &a.subtract(b)),
            ],
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::arithmetic::rational::ratio;
    use crate::arithmetic::rounding::to_f64;
    use proptest::prelude::*;

    fn value(wave: &Wave, t: f64) -> f64 {
        let number = |f: &Frequency| to_f64(&f.rational) + to_f64(&f.pi) * std::f64::consts::PI;
        match wave {
            Wave::None => 1.0,
            Wave::Cos(f) => (number(f) * t).cos(),
            Wave::Sin(f) => (number(f) * t).sin(),
        }
    }

    proptest! {
        #[test]
        fn products_of_waves_are_sums(a in -9i64..9, b in -9i64..9, c in -9i64..9, d in -9i64..9, k in 0usize..4) {
            let frequency = |a, b| Frequency { rational: ratio(a, 2), pi: ratio(b, 3) };
            let (f, g) = (frequency(a, b), frequency(c, d));
            let one = || ratio(1, 1);
            let ((p, u), (q, v)) = (
                if k % 2 == 0 { Wave::cos(one(), &f) } else { Wave::sin(one(), &f) },
                if k / 2 == 0 { Wave::cos(one(), &g) } else { Wave::sin(one(), &g) },
            );
            let scaled: f64 = to_f64(&(&p * &q));
            let sum: f64 = u.multiply(&v).iter().map(|(q, wave)| to_f64(q) * value(wave, 0.7)).sum();
            prop_assert!((sum * scaled - scaled * value(&u, 0.7) * value(&v, 0.7)).abs() < 1e-12);
            let constant = f.to_constant().expect("small");
            prop_assert_eq!(Frequency::from_constant(&constant), Some(f));
        }
    }
}
