//! The field of the rational numbers.

use num_bigint::BigInt;
use num_integer::Integer;
use num_rational::BigRational;
use num_traits::{One, Zero as _};

use super::{Field, Number, Zero};
use crate::symbolic::Constant;

/// The field of the rational numbers, over which a [`NodeAlgebra`](super::NodeAlgebra) is an algebra.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub struct Rationals;

impl Field for Rationals {
    type Element = BigRational;

    fn rational(&self, value: &BigRational) -> BigRational {
        value.clone()
    }

    fn constant(&self, value: &Constant) -> Option<BigRational> {
        value.as_rational().cloned()
    }

    // Whole numbers are the common case, and need no greatest common divisors.
    fn add(&self, x: &BigRational, y: &BigRational) -> BigRational {
        if x.is_integer() && y.is_integer() {
            return BigRational::from_integer(x.numer() + y.numer());
        }
        x + y
    }

    fn subtract(&self, x: &BigRational, y: &BigRational) -> BigRational {
        if x.is_integer() && y.is_integer() {
            return BigRational::from_integer(x.numer() - y.numer());
        }
        x - y
    }

    fn multiply(&self, x: &BigRational, y: &BigRational) -> BigRational {
        if x.is_integer() && y.is_integer() {
            return BigRational::from_integer(x.numer() * y.numer());
        }
        x * y
    }

    fn inverse(&self, x: &BigRational) -> Option<BigRational> {
        (!x.is_zero()).then(|| x.recip())
    }

    fn verified_bits(&self) -> Option<u32> {
        None
    }

    fn zero(&self, x: &BigRational) -> Zero {
        if x.is_zero() { Zero::Yes } else { Zero::No }
    }

    fn pivot(&self, candidates: &[&BigRational]) -> Option<usize> {
        candidates.iter().position(|x| !x.is_zero())
    }

    fn common_denominator<'a>(
        &self,
        elements: impl Iterator<Item = &'a BigRational>,
    ) -> BigRational {
        let lcm = elements.fold(BigInt::one(), |lcm, x| lcm.lcm(x.denom()));
        BigRational::from_integer(lcm)
    }

    fn number(&self, x: &BigRational) -> Number<'_> {
        Number::Rational(x.clone())
    }

    fn exact(&self, x: &BigRational) -> Option<String> {
        Some(x.to_string())
    }
}
