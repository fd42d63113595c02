//! Polynomials over the integers modulo a large number, and rational reconstruction.

use num_bigint::BigInt;
use num_integer::Integer;
use num_rational::BigRational;
use num_traits::{One, Signed, Zero};

/// The integers modulo a number. Polynomials have coefficients from 0 to below the modulus, lowest degree first, the
/// last one not zero.
#[derive(Debug, Clone, PartialEq, Eq)]
pub struct Residues {
    modulus: BigInt,
}

impl Residues {
    /// The integers modulo a positive number.
    pub fn new(modulus: BigInt) -> Self {
        Residues { modulus }
    }

    /// The modulus.
    pub fn modulus(&self) -> &BigInt {
        &self.modulus
    }

    /// An integer polynomial modulo the modulus.
    pub fn reduce<'a>(&self, coefficients: impl IntoIterator<Item = &'a BigInt>) -> Vec<BigInt> {
        let coefficients = coefficients.into_iter();
        self.trimmed(coefficients.map(|c| c.mod_floor(&self.modulus)).collect())
    }

    fn trimmed(&self, mut polynomial: Vec<BigInt>) -> Vec<BigInt> {
        while polynomial.last().is_some_and(Zero::is_zero) {
            polynomial.pop();
        }
        polynomial
    }

    /// The sum `left + sign·right`.
    fn combine(&self, left: &[BigInt], right: &[BigInt], sign: i32) -> Vec<BigInt> {
        let mut result = left.to_vec();
        result.resize(left.len().max(right.len()), BigInt::zero());
        for (x, r) in result.iter_mut().zip(right) {
            *x += r * sign;
            if x.is_negative() {
                *x += &self.modulus;
            } else if *x >= self.modulus {
                *x -= &self.modulus;
            }
        }
        self.trimmed(result)
    }

    /// The sum.
    pub fn add(&self, left: &[BigInt], right: &[BigInt]) -> Vec<BigInt> {
        self.combine(left, right, 1)
    }

    /// The difference.
    pub fn subtract(&self, left: &[BigInt], right: &[BigInt]) -> Vec<BigInt> {
        self.combine(left, right, -1)
    }

    /// The product.
    pub fn multiply(&self, left: &[BigInt], right: &[BigInt]) -> Vec<BigInt> {
        if left.is_empty() || right.is_empty() {
            return Vec::new();
        }
        let mut result = vec![BigInt::zero(); left.len() + right.len() - 1];
        for (i, a) in left.iter().enumerate().filter(|(_, a)| !a.is_zero()) {
            for (x, b) in result[i..].iter_mut().zip(right) {
                *x += a * b;
            }
        }
        // Reduced once at the end: the sums are hardly longer than the products.
        self.reduce(&result)
    }

    /// Quotient and remainder of the division by a monic polynomial.
    pub fn div_rem(&self, dividend: &[BigInt], monic: &[BigInt]) -> (Vec<BigInt>, Vec<BigInt>) {
        let degree = monic.len().saturating_sub(1);
        let mut remainder = dividend.to_vec();
        let mut quotient = vec![BigInt::zero(); dividend.len().saturating_sub(degree)];
        while remainder.len() > degree {
            let top = remainder.pop().unwrap_or_default().mod_floor(&self.modulus);
            let shift = remainder.len() - degree;
            if !top.is_zero() {
                for (x, m) in remainder[shift..].iter_mut().zip(monic) {
                    *x -= &top * m;
                }
            }
            quotient[shift] = top;
        }
        (self.trimmed(quotient), self.reduce(&remainder))
    }

    /// The residue of the least absolute value.
    pub fn symmetric(&self, residue: &BigInt) -> BigInt {
        let positive = residue.mod_floor(&self.modulus);
        if &positive + &positive > self.modulus {
            positive - &self.modulus
        } else {
            positive
        }
    }

    /// The rational `n/d` with this residue and `2n², 2d² ≤` modulus, which is unique if it exists.
    pub fn rational(&self, residue: &BigInt) -> Option<BigRational> {
        let bound = (&self.modulus / 2u32).sqrt();
        // Euclidean algorithm; invariant: r ≡ t·residue.
        let (mut r0, mut r1) = (self.modulus.clone(), residue.mod_floor(&self.modulus));
        let (mut t0, mut t1) = (BigInt::zero(), BigInt::one());
        while r1 > bound {
            let (q, r) = r0.div_rem(&r1);
            let t = t0 - q * &t1;
            (r0, r1, t0, t1) = (r1, r, t1, t);
        }
        let proper = t1.abs() <= bound && r1.gcd(&t1).is_one() && t1.gcd(&self.modulus).is_one();
        proper.then(|| BigRational::new(r1, t1))
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::rational::ratio;
    use proptest::prelude::*;

    proptest! {
        #[test]
        fn rationals_are_reconstructed_from_residues(n in -1000i64..1000, d in 1i64..1000) {
            let residues = Residues::new(BigInt::from(2_147_483_647));
            let value = ratio(n, d);
            let inverse = value.denom().modpow(&BigInt::from(2_147_483_645), residues.modulus());
            prop_assert_eq!(residues.rational(&(value.numer() * inverse)), Some(value));
        }

        #[test]
        fn quotient_and_remainder_by_a_monic_polynomial_multiply_back(a in prop::collection::vec(0i64..97, 0..8), b in prop::collection::vec(0i64..97, 0..5)) {
            let residues = Residues::new(BigInt::from(97));
            let integers = |v: &[i64]| residues.reduce(&v.iter().map(|&x| BigInt::from(x)).collect::<Vec<_>>());
            let a = integers(&a);
            let b = integers(&[b.as_slice(), &[1]].concat());
            let (q, r) = residues.div_rem(&a, &b);
            prop_assert!(r.len() < b.len());
            prop_assert_eq!(residues.add(&residues.multiply(&q, &b), &r), a);
        }
    }
}
