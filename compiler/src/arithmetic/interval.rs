//! Enclosures: intervals whose ends are dyadic rationals.

use std::cmp::Ordering;

use num_bigint::BigInt;
use num_integer::Integer;
use num_rational::BigRational;
use num_traits::{One, Signed, Zero};

use super::polynomial::Polynomial;

/// The closed interval `[low, high]·2⁻ᵇⁱᵗˢ`: a certified enclosure of a real number.
///
/// Every operation rounds outward, so the result encloses the exact result for all numbers in the
/// operands. The operands of an operation have the same `bits`.
#[derive(Debug, Clone, PartialEq, Eq)]
pub struct Interval {
    pub(crate) low: BigInt,
    pub(crate) high: BigInt,
    pub(crate) bits: u32,
}

impl Interval {
    /// The smallest interval with `bits` binary places around a rational.
    pub fn enclosing(value: &BigRational, bits: u32) -> Self {
        Interval::quotient(
            value.numer() << bits,
            value.numer() << bits,
            value.denom(),
            bits,
        )
    }

    /// `[low, high]/divisor`, rounded outward; the divisor is positive.
    fn quotient(low: BigInt, high: BigInt, divisor: &BigInt, bits: u32) -> Self {
        Interval {
            low: low.div_floor(divisor),
            high: -((-high).div_floor(divisor)),
            bits,
        }
    }

    /// The binary places.
    pub fn bits(&self) -> u32 {
        self.bits
    }

    /// The smallest interval with this number of binary places that contains this one.
    #[must_use]
    pub fn rounded(&self, bits: u32) -> Interval {
        let excess = self.bits.saturating_sub(bits);
        let missing = bits.saturating_sub(self.bits);
        let (low, high): (BigInt, BigInt) = (&self.low >> excess, (-&self.high) >> excess);
        Interval {
            low: low << missing,
            high: -high << missing,
            bits,
        }
    }

    /// The lower end.
    pub fn low(&self) -> BigRational {
        BigRational::new(self.low.clone(), BigInt::one() << self.bits)
    }

    /// The upper end.
    pub fn high(&self) -> BigRational {
        BigRational::new(self.high.clone(), BigInt::one() << self.bits)
    }

    /// The sign of all numbers in the interval, if they have the same.
    pub fn sign(&self) -> Option<Ordering> {
        match (
            self.low.cmp(&BigInt::zero()),
            self.high.cmp(&BigInt::zero()),
        ) {
            (Ordering::Equal, Ordering::Equal) => Some(Ordering::Equal),
            (Ordering::Greater, _) => Some(Ordering::Greater),
            (_, Ordering::Less) => Some(Ordering::Less),
            _ => None,
        }
    }

    /// Whether a rational lies in the interval.
    pub fn contains(&self, value: &BigRational) -> bool {
        let scaled = value * BigRational::from_integer(BigInt::one() << self.bits);
        BigRational::from_integer(self.low.clone()) <= scaled
            && scaled <= BigRational::from_integer(self.high.clone())
    }

    /// The sum.
    #[must_use]
    pub fn add(&self, other: &Interval) -> Interval {
        Interval {
            low: &self.low + &other.low,
            high: &self.high + &other.high,
            bits: self.bits,
        }
    }

    /// The difference.
    #[must_use]
    pub fn subtract(&self, other: &Interval) -> Interval {
        Interval {
            low: &self.low - &other.high,
            high: &self.high - &other.low,
            bits: self.bits,
        }
    }

    /// The product.
    #[must_use]
    pub fn multiply(&self, other: &Interval) -> Interval {
        let (low, high) = if !self.low.is_negative() && !other.low.is_negative() {
            (&self.low * &other.low, &self.high * &other.high)
        } else if !other.low.is_negative() {
            let low = &self.low
                * if self.low.is_negative() {
                    &other.high
                } else {
                    &other.low
                };
            let high = &self.high
                * if self.high.is_negative() {
                    &other.low
                } else {
                    &other.high
                };
            (low, high)
        } else {
            let products = [
                &self.low * &other.low,
                &self.low * &other.high,
                &self.high * &other.low,
                &self.high * &other.high,
            ];
            let [mut low, mut high] = [products[0].clone(), products[0].clone()];
            for product in products {
                if product < low {
                    low = product;
                } else if product > high {
                    high = product;
                }
            }
            (low, high)
        };
        // A right shift of a negative number rounds towards minus infinity.
        Interval {
            low: low >> self.bits,
            high: -((-high) >> self.bits),
            bits: self.bits,
        }
    }

    /// The values of a polynomial on this interval.
    pub fn evaluate(&self, polynomial: &Polynomial) -> Interval {
        let zero = Interval {
            low: BigInt::zero(),
            high: BigInt::zero(),
            bits: self.bits,
        };
        let value = polynomial.numerators().iter().rev().fold(zero, |value, n| {
            let n = n << self.bits;
            let product = value.multiply(self);
            Interval {
                low: product.low + &n,
                high: product.high + n,
                bits: self.bits,
            }
        });
        Interval::quotient(value.low, value.high, polynomial.denominator(), self.bits)
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::arithmetic::rational::ratio;
    use proptest::prelude::*;

    proptest! {
        #[test]
        fn operations_enclose(a in -50i64..50, b in 1i64..40, c in -50i64..50, d in 1i64..40, spread in 0i64..9) {
            let (x, y) = (ratio(a, b), ratio(c, d));
            let around = |v: &BigRational| {
                let mut i = Interval::enclosing(v, 12);
                i.low -= spread;
                i.high += spread;
                i
            };
            let (i, j) = (around(&x), around(&y));
            prop_assert!(i.contains(&x) && j.contains(&y));
            prop_assert!(i.add(&j).contains(&(&x + &y)));
            prop_assert!(i.subtract(&j).contains(&(&x - &y)));
            prop_assert!(i.multiply(&j).contains(&(&x * &y)));
            let p = Polynomial::from_rationals(&[ratio(1, 3), ratio(-2, 5), ratio(7, 2)]);
            prop_assert!(i.evaluate(&p).contains(&p.evaluate(&x)));
            prop_assert!(i.sign().is_none_or(|s| s == x.cmp(&BigRational::zero())));
        }
    }
}
