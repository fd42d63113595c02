//! The real numbers as floating-point enclosures with a fixed number of bits.

use std::cmp::Ordering;
use std::sync::atomic::{AtomicI64, Ordering as Memory};

use num_rational::BigRational;
use num_traits::Zero as _;

use super::{Field, Number, Zero};
use crate::arithmetic::ball::Ball;
use crate::symbolic::Constant;

/// The real numbers, as enclosures with a number of bits.
///
/// A number is taken to be zero if its ball contains zero. The worst precision of all these zeros, relative to the terms of
/// their sums, is recorded.
#[derive(Debug)]
pub struct Balls {
    bits: u32,
    verified: AtomicI64,
}

impl Balls {
    /// Enclosures with this many bits.
    pub fn new(bits: u32) -> Self {
        Balls {
            bits,
            verified: AtomicI64::new(i64::from(bits)),
        }
    }

    /// A lower bound on the binary places to which all numbers taken to be zero vanish.
    pub fn zero_bits(&self) -> u32 {
        self.verified
            .load(Memory::Relaxed)
            .clamp(0, i64::from(u32::MAX)) as u32
    }
}

impl PartialEq for Balls {
    fn eq(&self, other: &Self) -> bool {
        self.bits == other.bits
    }
}

impl Field for Balls {
    type Element = Ball;

    fn rational(&self, value: &BigRational) -> Ball {
        Ball::quotient(value, self.bits)
    }

    fn constant(&self, value: &Constant) -> Option<Ball> {
        let number = super::Real::constant(value.clone());
        Some(Number::Real(number).ball(self.bits))
    }

    fn add(&self, x: &Ball, y: &Ball) -> Ball {
        x.add(y, self.bits)
    }

    fn subtract(&self, x: &Ball, y: &Ball) -> Ball {
        x.add(&y.negate(), self.bits)
    }

    fn multiply(&self, x: &Ball, y: &Ball) -> Ball {
        x.multiply(y, self.bits)
    }

    fn inverse(&self, x: &Ball) -> Option<Ball> {
        x.inverse(self.bits)
    }

    fn verified_bits(&self) -> Option<u32> {
        Some(self.zero_bits())
    }

    fn zero(&self, x: &Ball) -> Zero {
        match x.sign() {
            Some(Ordering::Equal) => Zero::Yes,
            Some(_) => Zero::No,
            None => {
                let bits = x.zero_bits();
                self.verified.fetch_min(bits, Memory::Relaxed);
                Zero::Within(bits.clamp(0, i64::from(u32::MAX)) as u32)
            }
        }
    }

    fn pivot(&self, candidates: &[&Ball]) -> Option<usize> {
        let nonzero = |x: &Ball| x.sign().is_some_and(Ordering::is_ne);
        let found = candidates.iter().enumerate().filter(|(_, x)| nonzero(x));
        found.max_by_key(|(_, x)| x.magnitude()).map(|(k, _)| k)
    }

    fn number(&self, x: &Ball) -> Number<'_> {
        match self.zero(x) {
            Zero::No => Number::Enclosed(x.clone()),
            _ => Number::Rational(BigRational::zero()),
        }
    }

    fn exact(&self, _x: &Ball) -> Option<String> {
        None
    }

    fn enclose(&self, x: &Ball, bits: u32) -> Ball {
        x.with_bits(bits)
    }

    fn finest_bits(&self) -> Option<u32> {
        Some(self.bits)
    }

    fn doubt(&self) {
        self.verified.store(0, Memory::Relaxed);
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::arithmetic::rational::ratio;
    use num_bigint::BigInt;

    #[test]
    fn zero_is_relative_to_the_terms() {
        let balls = Balls::new(200);
        let tiny = ratio(1, 3) / BigRational::from_integer(BigInt::from(10).pow(300));
        let x = balls.rational(&tiny);
        assert_eq!(balls.zero(&x), Zero::No);
        let difference = balls.subtract(&x, &x);
        assert!(matches!(balls.zero(&difference), Zero::Within(bits) if bits > 190));
        // The same difference, for numbers known to fewer places.
        let coarse = Balls::new(40).rational(&tiny);
        assert!(balls.zero(&balls.subtract(&coarse, &x)).may_be());
        assert!((30..45).contains(&balls.zero_bits()));
    }
}
