//! The transcendental numbers over which rational functions are formed.

use std::num::NonZeroU32;

use num_bigint::BigInt;
use num_traits::{One, Zero};

use crate::arithmetic::elementary::{cos, exp, pi, sin};
use crate::arithmetic::interval::Interval;
use crate::arithmetic::rational::ratio;

/// A number `X` that satisfies no equation with algebraic coefficients (Hermite, Lindemann).
#[derive(Debug, Clone, Copy, PartialEq, Eq, Hash)]
pub enum Transcendental {
    /// `X = π`.
    Pi,
    /// `X = exp(1/n)`.
    Exponential {
        /// The number `n`.
        denominator: NonZeroU32,
    },
    /// `X = tan(1/(2n))`; the sines and cosines of all multiples of `1/n` are rational
    /// functions of it.
    HalfAngleTangent {
        /// The number `n`.
        denominator: NonZeroU32,
    },
}

impl Transcendental {
    /// An enclosure with this number of binary places, whose width tends to zero as `bits` grows.
    pub fn enclose(self, bits: u32) -> Interval {
        let unknown = || Interval {
            low: BigInt::zero(),
            high: BigInt::one() << (2 * bits),
            bits,
        };
        let part = |n: i64| Interval::enclosing(&ratio(1, n), bits);
        match self {
            Transcendental::Pi => pi(bits),
            // An argument of at most 1 is in the domain.
            Transcendental::Exponential { denominator } => {
                exp(&part(denominator.get().into())).unwrap_or_else(unknown)
            }
            Transcendental::HalfAngleTangent { denominator } => {
                let angle = part(2 * i64::from(denominator.get()));
                // The cosine is above 0.8: its enclosure contains zero only with very few places.
                sin(&angle).divide(&cos(&angle)).unwrap_or_else(unknown)
            }
        }
    }

    /// The powers `Xᵏ` as text; empty for `k = 0`.
    pub fn power(self, k: i64) -> String {
        if k == 0 {
            return String::new();
        }
        let base = match self {
            Transcendental::Pi => "pi".to_owned(),
            Transcendental::Exponential { denominator } => {
                let exponent = ratio(k, denominator.get().into());
                return if exponent == ratio(1, 1) {
                    "e".to_owned()
                } else {
                    format!("exp({exponent})")
                };
            }
            Transcendental::HalfAngleTangent { denominator } => {
                format!("tan(1/{})", 2 * u64::from(denominator.get()))
            }
        };
        if k == 1 { base } else { format!("{base}^{k}") }
    }

    /// Whether negative powers are written as such.
    pub(super) fn has_negative_powers(self) -> bool {
        matches!(self, Transcendental::Exponential { .. })
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::arithmetic::rounding::to_f64;

    #[test]
    fn enclosures_agree_with_doubles() {
        let three = NonZeroU32::MIN.saturating_add(2);
        for (number, value) in [
            (Transcendental::Pi, std::f64::consts::PI),
            (
                Transcendental::Exponential { denominator: three },
                (1.0 / 3.0f64).exp(),
            ),
            (
                Transcendental::HalfAngleTangent { denominator: three },
                (1.0 / 6.0f64).tan(),
            ),
        ] {
            let interval = number.enclose(200);
            assert!((to_f64(&interval.low()) - value).abs() < 1e-15);
            assert!(interval.high() - interval.low() < ratio(1, 1 << 62));
        }
    }

    #[test]
    fn powers_are_written_in_the_shortest_way() {
        let four = NonZeroU32::MIN.saturating_add(3);
        let exponential = Transcendental::Exponential { denominator: four };
        let shown = [1, 2, 4, -4, 6].map(|k| exponential.power(k));
        assert_eq!(shown, ["exp(1/4)", "exp(1/2)", "e", "exp(-1)", "exp(3/2)"]);
        assert_eq!(Transcendental::Pi.power(2), "pi^2");
        let tangent = Transcendental::HalfAngleTangent { denominator: four };
        assert_eq!(tangent.power(1), "tan(1/8)");
    }
}
