//! Floating-point enclosures of real numbers.

use std::cmp::Ordering;

use num_bigint::BigInt;
use num_rational::BigRational;
use num_traits::{One, Signed, Zero as _};

use crate::interval::Interval;
use crate::zero::Zero;

/// All numbers `(m + δ)·2ᵉ` with `|δ| ≤ r`.
///
/// Unlike an [`Interval`], whose places are absolute, its width is relative to the size of the number, for tiny and huge
/// numbers alike.
#[derive(Debug, Clone, PartialEq)]
pub struct Ball {
    middle: BigInt,
    radius: BigInt,
    exponent: i64,
    /// The binary logarithm of the largest terms of the sum that this number is, rounded up: smallness is
    /// relative to it.
    scale: i64,
}

/// Binary places of radii.
const RADIUS_BITS: u64 = 32;

impl Ball {
    /// Zero.
    pub fn zero() -> Self {
        Ball {
            middle: BigInt::zero(),
            radius: BigInt::zero(),
            exponent: 0,
            scale: i64::MIN / 4,
        }
    }

    /// Rounds the middle to a number of bits, and the radius up.
    fn rounded(middle: BigInt, radius: BigInt, exponent: i64, bits: u32) -> Self {
        let excess = middle.bits().saturating_sub(u64::from(bits));
        let excess = excess.max(radius.bits().saturating_sub(RADIUS_BITS));
        let mut ball = Ball {
            middle,
            radius,
            exponent,
            scale: 0,
        };
        if excess > 0 {
            ball.middle >>= excess;
            ball.radius = (ball.radius >> excess) + 2;
            ball.exponent += excess as i64;
        }
        ball.scale = ball.magnitude();
        ball
    }

    /// An integer.
    pub fn whole(value: usize) -> Self {
        Ball::dyadic(BigInt::from(value), 0, u32::MAX)
    }

    /// One of −1, 0 and 1.
    pub fn of_sign(sign: Ordering) -> Self {
        match sign {
            Ordering::Less => Ball::whole(1).negate(),
            Ordering::Equal => Ball::zero(),
            Ordering::Greater => Ball::whole(1),
        }
    }

    /// The number `n·2ᵉ`, rounded to this many bits.
    pub fn dyadic(middle: BigInt, exponent: i64, bits: u32) -> Self {
        if middle.is_zero() {
            return Ball::zero();
        }
        Ball::rounded(middle, BigInt::zero(), exponent, bits)
    }

    /// A rational number, rounded to this many bits.
    pub fn quotient(value: &BigRational, bits: u32) -> Self {
        if value.is_zero() {
            return Ball::zero();
        }
        let shift = i64::from(bits) + 2 + value.denom().bits() as i64 - value.numer().bits() as i64;
        let up = shift.max(0) as u64;
        let middle = (value.numer() << up) / value.denom();
        Ball::rounded(middle, BigInt::one(), -(up as i64), bits)
    }

    /// A number that enclosures do not distinguish from zero, which is small relative to 1.
    pub fn undecided(interval: &Interval) -> Self {
        Ball {
            scale: 0,
            ..Ball::around(interval, interval.bits())
        }
    }

    /// An enclosure of an interval, rounded to this many bits.
    pub fn around(interval: &Interval, bits: u32) -> Self {
        let middle = &interval.low + &interval.high;
        let radius = &interval.high - &interval.low;
        Ball::rounded(middle, radius, -i64::from(interval.bits) - 1, bits)
    }

    /// An enclosure with absolute places, at most as narrow as this ball.
    pub fn interval(&self, bits: u32) -> Interval {
        let shift = self.exponent + i64::from(bits);
        let [low, high] = [&self.middle - &self.radius, &self.middle + &self.radius];
        let (low, high) = if shift >= 0 {
            (low << shift, high << shift)
        } else {
            (low >> -shift, -((-high) >> -shift))
        };
        Interval { low, high, bits }
    }

    /// Whether the number equals a rational, if this can be decided.
    pub fn difference(&self, value: &BigRational) -> Zero {
        // Both ends and the number as multiples of a power of two.
        let up = (-self.exponent).max(0);
        let down = self.exponent.max(0);
        let middle = (&self.middle << down) * value.denom() - (value.numer() << up);
        let radius = (&self.radius << down) * value.denom();
        match (middle.abs() <= radius, radius.is_zero()) {
            (false, _) => Zero::No,
            (true, true) => Zero::Yes,
            (true, false) => {
                let bits = -(self.exponent + self.radius.bits() as i64);
                Zero::Within(bits.clamp(0, i64::from(u32::MAX)) as u32)
            }
        }
    }

    /// The sign, if all numbers of the ball have the same sign.
    pub fn sign(&self) -> Option<Ordering> {
        if self.middle.abs() > self.radius {
            return Some(self.middle.cmp(&BigInt::zero()));
        }
        self.radius.is_zero().then_some(Ordering::Equal)
    }

    /// A number `n` with `|x| < 2ⁿ`.
    pub fn magnitude(&self) -> i64 {
        let size = self.middle.abs() + &self.radius;
        match size.is_zero() {
            true => i64::MIN / 4,
            false => size.bits() as i64 + self.exponent,
        }
    }

    /// A number `n` with `2ⁿ ≤ |x|`, unless `x` may be zero.
    pub fn least_magnitude(&self) -> Option<i64> {
        let least = self.middle.abs() - &self.radius;
        let exponent = || least.bits() as i64 - 1 + self.exponent;
        least.is_positive().then(exponent)
    }

    /// A ball around zero that contains this one.
    #[must_use]
    pub fn size(&self) -> Self {
        Ball {
            middle: self.middle.abs(),
            ..self.clone()
        }
    }

    /// The product with a power of two.
    #[must_use]
    pub fn shifted(&self, places: i64) -> Self {
        Ball {
            exponent: self.exponent + places,
            scale: self.scale + places,
            ..self.clone()
        }
    }

    /// The number, rounded to this many bits.
    #[must_use]
    pub fn with_bits(&self, bits: u32) -> Self {
        let rounded = Ball::rounded(
            self.middle.clone(),
            self.radius.clone(),
            self.exponent,
            bits,
        );
        Ball {
            scale: self.scale,
            ..rounded
        }
    }

    /// The sum, rounded to this many bits.
    #[must_use]
    pub fn add(&self, other: &Self, bits: u32) -> Self {
        let exact = |x: &Self| x.middle.is_zero() && x.radius.is_zero();
        if exact(self) {
            return other.clone();
        }
        if exact(other) {
            return self.clone();
        }
        let (high, low) = if self.exponent < other.exponent {
            (other, self)
        } else {
            (self, other)
        };
        let distance = high.exponent - low.exponent;
        let mut sum = if distance > 4 * i64::from(bits) && low.magnitude() < high.exponent {
            Ball::rounded(high.middle.clone(), &high.radius + 1, high.exponent, bits)
        } else {
            let middle = (&high.middle << distance) + &low.middle;
            let radius = (&high.radius << distance) + &low.radius;
            Ball::rounded(middle, radius, low.exponent, bits)
        };
        sum.scale = self.scale.max(other.scale);
        sum
    }

    /// The product, rounded to this many bits.
    #[must_use]
    pub fn multiply(&self, other: &Self, bits: u32) -> Self {
        let middle = &self.middle * &other.middle;
        let radius = self.middle.abs() * &other.radius
            + other.middle.abs() * &self.radius
            + &self.radius * &other.radius;
        if middle.is_zero() && radius.is_zero() {
            return Ball::zero();
        }
        let exponent = self.exponent + other.exponent;
        let mut product = Ball::rounded(middle, radius, exponent, bits);
        if self.sign().is_none() || other.sign().is_none() {
            product.scale = self.scale + other.scale;
        }
        product
    }

    /// The inverse, rounded to this many bits; `None` if zero is in the ball.
    pub fn inverse(&self, bits: u32) -> Option<Self> {
        let size = self.middle.abs();
        let least = &size - &self.radius;
        if !least.is_positive() {
            return None;
        }
        let places = size.bits() + u64::from(bits) + 4;
        let unit = BigInt::one() << places;
        let middle = &unit / &self.middle;
        let radius = &unit * &self.radius / (size * least) + 2;
        let exponent = -self.exponent - places as i64;
        Some(Ball::rounded(middle, radius, exponent, bits))
    }

    /// The ball with the opposite numbers.
    #[must_use]
    pub fn negate(&self) -> Self {
        Ball {
            middle: -&self.middle,
            ..self.clone()
        }
    }

    /// The binary places to which a ball that contains zero vanishes, relative to the terms of the sum that
    /// it is.
    pub fn zero_bits(&self) -> i64 {
        self.scale - self.magnitude()
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::rational::ratio;
    use proptest::prelude::*;

    proptest! {
        #[test]
        fn ball_operations_enclose_the_exact_result(a in -99i64..99, b in 1i64..40, c in -99i64..99, d in 1i64..40, k in -90i64..90) {
            let (x, y) = (ratio(a, b), ratio(c, d));
            let scale = if k < 0 { ratio(1, 1) / ratio(2, 1).pow(-k as i32) } else { ratio(2, 1).pow(k as i32) };
            let (i, j) = (Ball::quotient(&x, 40), Ball::quotient(&y, 40).shifted(k));
            let y = y * scale;
            prop_assert!(i.add(&j, 40).interval(200).contains(&(&x + &y)));
            prop_assert!(i.multiply(&j, 40).interval(200).contains(&(&x * &y)));
            prop_assert!(i.add(&i.negate(), 40).sign().is_none_or(Ordering::is_eq));
            match j.inverse(40) {
                None => prop_assert!(c == 0),
                Some(inverse) => {
                    let wide = inverse.interval(200).with_bits(20);
                    prop_assert!(wide.contains(&y.recip()));
                    prop_assert!(inverse.interval(200).contains(&y.recip()));
                    prop_assert!(inverse.radius.bits() < 10 && inverse.middle.bits() >= 39);
                }
            }
        }
    }
}
