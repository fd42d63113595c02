//! Greatest common divisors of rational polynomials, from their images modulo primes (Brown).
//!
//! Modulo a prime that divides neither leading coefficient, the degree of the common divisor is at least the true one.
//! So a constant image modulo one prime proves coprimality, without arithmetic of long numbers.

use num_bigint::BigInt;
use num_integer::Integer;
use num_traits::{One, Zero};

use super::gcd::gcd as gcd_of_numbers;
use super::polynomial::Polynomial;
use super::prime_field::{PrimeField, large_primes};
use super::residues::Residues;

/// The greatest common divisor, with coprime integer coefficients; zero if both are zero.
pub(super) fn gcd(a: &Polynomial, b: &Polynomial) -> Polynomial {
    let (Some(m), Some(n)) = (a.degree(), b.degree()) else {
        let other = if a.is_zero() { b } else { a };
        return if other.is_zero() {
            other.clone()
        } else {
            other.primitive()
        };
    };
    if m.min(n) == 0 || image(a, b, first_prime()).is_some_and(|image| image.len() == 1) {
        return Polynomial::one();
    }
    let (a, b) = (a.primitive(), b.primitive());
    let leading = gcd_of_numbers(&a.leading().to_integer(), &b.leading().to_integer());
    let mut found = Candidate::default();
    for prime in large_primes().map(PrimeField::new) {
        let Some(image) = image(&a, &b, prime) else {
            continue;
        };
        if image.len() == 1 {
            break;
        }
        if found.takes(prime, &prime.scale(&image, prime.integer(&leading))) {
            let divisor = found.polynomial();
            if divides(&divisor, &a) && divides(&divisor, &b) {
                return divisor;
            }
        }
    }
    Polynomial::one()
}

fn first_prime() -> PrimeField {
    PrimeField::new(large_primes().next().unwrap_or(3))
}

/// The monic common divisor modulo a prime; `None` if the prime divides a leading coefficient.
fn image(a: &Polynomial, b: &Polynomial, prime: PrimeField) -> Option<Vec<u64>> {
    let reduced = |p: &Polynomial| {
        let residues = p.numerators().iter().map(|n| prime.integer(n));
        let residues: Vec<u64> = residues.collect();
        residues
            .last()
            .is_some_and(|&top| top != 0)
            .then_some(residues)
    };
    Some(prime.gcd(&reduced(a)?, &reduced(b)?))
}

/// A common divisor modulo a product of primes.
struct Candidate {
    residues: Vec<BigInt>,
    modulus: BigInt,
}

impl Default for Candidate {
    fn default() -> Self {
        Candidate {
            residues: Vec::new(),
            modulus: BigInt::one(),
        }
    }
}

impl Candidate {
    /// Combines the image modulo another prime; returns whether it agrees with the previous residues.
    fn takes(&mut self, prime: PrimeField, image: &[u64]) -> bool {
        let p = BigInt::from(prime.prime());
        if self.residues.is_empty() || image.len() < self.residues.len() {
            self.residues = image.iter().map(|&c| BigInt::from(c)).collect();
            self.modulus = p;
            return false;
        }
        // An unlucky prime: the degree of its image is too large.
        if image.len() > self.residues.len() {
            return false;
        }
        let inverse = prime.inverse(prime.integer(&self.modulus));
        let ring = Residues::new(self.modulus.clone());
        let mut same = true;
        for (known, &wanted) in self.residues.iter_mut().zip(image) {
            *known = ring.symmetric(known);
            let digit = prime.minus(wanted, prime.integer(known)) * inverse % prime.prime();
            if digit != 0 {
                same = false;
                *known += &self.modulus * digit;
            }
        }
        self.modulus *= p;
        same
    }

    /// The primitive polynomial with the residues of least absolute value.
    fn polynomial(&self) -> Polynomial {
        let ring = Residues::new(self.modulus.clone());
        let numerators = self.residues.iter().map(|c| ring.symmetric(c)).collect();
        Polynomial::new(numerators, BigInt::one()).primitive()
    }
}

/// Whether a primitive polynomial divides a polynomial with integer coefficients; by Gauss's lemma the quotient is
/// integral.
fn divides(divisor: &Polynomial, polynomial: &Polynomial) -> bool {
    let Some((leading, rest)) = divisor.numerators().split_last() else {
        return false;
    };
    let mut remainder = polynomial.numerators().to_vec();
    while remainder.len() > rest.len() {
        let (factor, left) = remainder.pop().unwrap_or_default().div_rem(leading);
        if !left.is_zero() {
            return false;
        }
        let shift = remainder.len() - rest.len();
        for (x, d) in remainder[shift..].iter_mut().zip(rest) {
            *x -= &factor * d;
        }
    }
    remainder.iter().all(Zero::is_zero)
}

#[cfg(test)]
mod tests {
    use super::*;
    use proptest::prelude::*;

    fn by_euclid(a: &Polynomial, b: &Polynomial) -> Polynomial {
        let (mut a, mut b) = (a.clone(), b.clone());
        while !b.is_zero() {
            let r = a.remainder(&b);
            a = b;
            b = if r.is_zero() { r } else { r.primitive() };
        }
        if a.is_zero() { a } else { a.primitive() }
    }

    proptest! {
        #[test]
        fn modular_gcd_of_polynomials_equals_the_euclidean_one(
            a in prop::collection::vec(-9i64..9, 0..5),
            b in prop::collection::vec(-9i64..9, 0..5),
            common in prop::collection::vec(-1i64 << 40..1 << 40, 0..5),
            power in 0u32..4,
        ) {
            let [a, b, common] = [a, b, common].map(|c| Polynomial::from_integers(&c));
            // Long coefficients need several primes.
            let common = common.power(power);
            let (a, b) = (&a * &common, &b * &common);
            prop_assert_eq!(gcd(&a, &b), by_euclid(&a, &b));
        }
    }
}
