//! Enclosures: intervals with dyadic rational ends.

use std::cmp::Ordering;

use num_bigint::BigInt;
use num_integer::Integer;
use num_rational::BigRational;
use num_traits::{One, Signed, Zero};

use super::polynomial::Polynomial;
use super::rational::dyadic;

/// The closed interval `[low, high]·2⁻ᵇⁱᵗˢ`: a certified enclosure of a real number.
///
/// Every operation rounds outward: its result encloses the exact results for all numbers in the operands. The operands
/// of an operation have the same `bits`.
#[derive(Debug, Clone, PartialEq, Eq)]
pub struct Interval {
    /// The lower end, times `2ᵇⁱᵗˢ`.
    pub low: BigInt,
    /// The upper end, times `2ᵇⁱᵗˢ`.
    pub high: BigInt,
    /// Binary places.
    pub bits: u32,
}

/// New number of guard places after an enclosure that is too wide: the width determines it; if it does not, `guard` is
/// doubled.
pub fn more_places(guard: u32, bits: u32, found: Option<&Interval>) -> u32 {
    let width = found.map(Interval::width_bits).filter(|&width| width < 0);
    let missing = width.and_then(|width| u32::try_from(width + i64::from(bits)).ok());
    missing.map_or(guard.saturating_mul(2), |missing| {
        guard.saturating_add(missing.max(8) + 8)
    })
}

/// `(ac, bd)` for `0 ≤ a ≤ b` and `0 ≤ c ≤ d`. For narrow intervals the second product is the first plus products of
/// long with short numbers.
fn products(a: &BigInt, b: &BigInt, c: &BigInt, d: &BigInt) -> (BigInt, BigInt) {
    const SHORT: u64 = 4;
    let low = a * c;
    let (v, w) = (b - a, d - c);
    let shortest = a.bits().min(c.bits());
    if v.bits().max(w.bits()) * SHORT > shortest {
        return (low, b * d);
    }
    // (a + v)(c + w)
    let high = &low + v * d + w * a;
    (low, high)
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

    /// The lower end.
    pub fn low(&self) -> BigRational {
        dyadic(&self.low, self.bits)
    }

    /// The upper end.
    pub fn high(&self) -> BigRational {
        dyadic(&self.high, self.bits)
    }

    /// The middle.
    pub fn middle(&self) -> BigRational {
        dyadic(&(&self.low + &self.high), self.bits + 1)
    }

    /// The common sign of all numbers in the interval; `None` if they differ.
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
        let scaled = value.numer() << self.bits;
        &self.low * value.denom() <= scaled && scaled <= &self.high * value.denom()
    }

    /// The sum.
    #[must_use]
    pub fn add(&self, other: &Interval) -> Interval {
        debug_assert_eq!(self.bits, other.bits);
        Interval {
            low: &self.low + &other.low,
            high: &self.high + &other.high,
            bits: self.bits,
        }
    }

    /// The difference.
    #[must_use]
    pub fn subtract(&self, other: &Interval) -> Interval {
        debug_assert_eq!(self.bits, other.bits);
        Interval {
            low: &self.low - &other.high,
            high: &self.high - &other.low,
            bits: self.bits,
        }
    }

    /// The product.
    #[must_use]
    pub fn multiply(&self, other: &Interval) -> Interval {
        debug_assert_eq!(self.bits, other.bits);
        let (low, high) = if !self.low.is_negative() && !other.low.is_negative() {
            products(&self.low, &self.high, &other.low, &other.high)
        } else if !self.high.is_positive() && !other.low.is_negative() {
            let (low, high) = products(&-&self.high, &-&self.low, &other.low, &other.high);
            (-high, -low)
        } else if !other.high.is_positive() && !self.low.is_negative() {
            return other.multiply(self);
        } else if !self.high.is_positive() && !other.high.is_positive() {
            return self.negate().multiply(&other.negate());
        } else if !other.low.is_negative() {
            (&self.low * &other.high, &self.high * &other.high)
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

    /// The negated interval.
    #[must_use]
    pub fn negate(&self) -> Interval {
        Interval {
            low: -&self.high,
            high: -&self.low,
            bits: self.bits,
        }
    }

    /// The product with a rational.
    #[must_use]
    pub fn scale(&self, factor: &BigRational) -> Interval {
        let (a, b) = (&self.low * factor.numer(), &self.high * factor.numer());
        let (low, high) = if factor.is_negative() { (b, a) } else { (a, b) };
        Interval::quotient(low, high, factor.denom(), self.bits)
    }

    /// The quotient; `None` if the divisor contains zero.
    pub fn divide(&self, other: &Interval) -> Option<Interval> {
        debug_assert_eq!(self.bits, other.bits);
        match other.sign()? {
            Ordering::Equal => None,
            Ordering::Less => self.negate().divide(&other.negate()),
            Ordering::Greater => {
                // The quotient of a negative numerator is least for the smallest divisor, that of a positive one for
                // the largest.
                let over = |end: &BigInt, negative: &BigInt, positive: &BigInt, up: bool| {
                    let divisor = if end.is_negative() {
                        negative
                    } else {
                        positive
                    };
                    let scaled = end << self.bits;
                    if up {
                        -((-scaled).div_floor(divisor))
                    } else {
                        scaled.div_floor(divisor)
                    }
                };
                Some(Interval {
                    low: over(&self.low, &other.low, &other.high, false),
                    high: over(&self.high, &other.high, &other.low, true),
                    bits: self.bits,
                })
            }
        }
    }

    /// The power `xⁿ`.
    #[must_use]
    pub fn power(&self, exponent: u32) -> Interval {
        // A rounding error in a partial power is multiplied by the remaining power, at most |x|ⁿ⁻¹; there are at most
        // 2·log₂ n rounding errors.
        let guard = (self.magnitude_bits().max(0) as u32)
            .saturating_mul(exponent)
            .saturating_add(2 * (32 - exponent.leading_zeros()) + 2);
        let fine = self.with_bits(self.bits.saturating_add(guard));
        let of_end = |end: &BigInt| {
            let point = |value: BigInt| Interval {
                low: value.clone(),
                high: value,
                bits: fine.bits,
            };
            let (mut result, mut square) = (point(BigInt::one() << fine.bits), point(end.clone()));
            let mut rest = exponent;
            while rest > 0 {
                if rest & 1 == 1 {
                    result = result.multiply(&square);
                }
                rest >>= 1;
                if rest > 0 {
                    square = square.multiply(&square);
                }
            }
            result
        };
        let (a, b) = (of_end(&fine.low), of_end(&fine.high));
        let even = exponent.is_multiple_of(2) && exponent > 0;
        let (low, high) = if even && self.low.is_negative() && !self.high.is_negative() {
            (BigInt::zero(), a.high.max(b.high))
        } else {
            (a.low.min(b.low), a.high.max(b.high))
        };
        let bits = fine.bits;
        Interval { low, high, bits }.with_bits(self.bits)
    }

    /// The width `high − low`.
    pub fn width(&self) -> BigRational {
        BigRational::new(&self.high - &self.low, BigInt::one() << self.bits)
    }

    /// A number `n` with a width below `2ⁿ`, the smallest for a positive width.
    pub fn width_bits(&self) -> i64 {
        (&self.high - &self.low).bits() as i64 - i64::from(self.bits)
    }

    /// A number `n` with `|x| < 2ⁿ` for all `x` in the interval.
    pub fn magnitude_bits(&self) -> i64 {
        self.low.bits().max(self.high.bits()) as i64 - i64::from(self.bits)
    }

    /// The interval with another number of binary places, rounded outward if it is smaller.
    #[must_use]
    pub fn with_bits(&self, bits: u32) -> Interval {
        let excess = self.bits.saturating_sub(bits);
        let missing = bits.saturating_sub(self.bits);
        let low: BigInt = &self.low >> excess;
        let high: BigInt = -((-&self.high) >> excess);
        Interval {
            low: low << missing,
            high: high << missing,
            bits,
        }
    }

    /// The nonnegative numbers of the interval; `None` if there are none.
    pub fn nonnegative(&self) -> Option<Interval> {
        (!self.high.is_negative()).then(|| Interval {
            low: self.low.clone().max(BigInt::zero()),
            high: self.high.clone(),
            bits: self.bits,
        })
    }

    /// The value of a polynomial at a number, from enclosures of the powers of the number from 0 up to the degree.
    pub fn combination(powers: &[Interval], polynomial: &Polynomial) -> Interval {
        let bits = powers[0].bits;
        let (mut low, mut high) = (BigInt::zero(), BigInt::zero());
        for (power, n) in powers.iter().zip(polynomial.numerators()) {
            let (a, b) = (&power.low * n, &power.high * n);
            let (below, above) = if n.is_negative() { (b, a) } else { (a, b) };
            low += below;
            high += above;
        }
        Interval::quotient(low, high, polynomial.denominator(), bits)
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
    use crate::rational::ratio;
    use proptest::prelude::*;

    proptest! {
        #[test]
        fn interval_operations_enclose_the_exact_result(a in -50i64..50, b in 1i64..40, c in -50i64..50, d in 1i64..40, spread in 0i64..9) {
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
            let (low, reduced) = (i.low(), BigRational::new(i.low.clone(), BigInt::one() << i.bits));
            prop_assert_eq!((low.numer(), low.denom()), (reduced.numer(), reduced.denom()));
        }

        #[test]
        fn further_operations_enclose_tightly(
            a in -500i64..500, b in 1i64..40, c in -50i64..50, d in 1i64..40, spread in 0i64..9, n in 0u32..12,
        ) {
            let (x, y) = (ratio(a, b), ratio(c, d));
            let mut i = Interval::enclosing(&x, 40);
            i.low -= spread;
            i.high += spread;
            let j = Interval::enclosing(&y, 40);
            prop_assert!(i.negate().contains(&-&x));
            prop_assert!(i.scale(&y).contains(&(&x * &y)));
            match i.divide(&j) {
                None => prop_assert!(c == 0),
                Some(quotient) => {
                    prop_assert!(quotient.contains(&(&x / &y)));
                    prop_assert!(quotient.width_bits() < -40 + 24);
                }
            }
            let power = i.power(n);
            for end in [i.low(), i.high(), x.clone()] {
                prop_assert!(power.contains(&end.pow(n as i32)));
            }
            let ends = [i.low().pow(n as i32), i.high().pow(n as i32)];
            let [low, high] = if ends[0] <= ends[1] { ends } else { let [a, b] = ends; [b, a] };
            let low = if i.sign().is_none() && n % 2 == 0 && n > 0 { BigRational::zero() } else { low };
            let slack = (power.width() - (high - low)) * BigRational::from_integer(BigInt::one() << 40u32);
            prop_assert!(slack <= ratio(4, 1));
            prop_assert_eq!(i.with_bits(50).with_bits(40), i.clone());
            let coarse = i.with_bits(7);
            prop_assert!(coarse.low() <= i.low() && i.high() <= coarse.high());
            prop_assert!((&i.high - &i.low) < BigInt::one() << (i.width_bits() + 40));
        }
    }
}
