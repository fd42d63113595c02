//! Greatest common divisors of polynomials over a number field, by modular computation.
//!
//! The Euclidean algorithm over `Q(θ)` has intermediate coefficients much longer than its result. Modulo
//! `p` it runs over `F_p[t]/(m)`; a prime is skipped if that ring has no inverse for a leading
//! coefficient. Common divisors modulo several primes are combined until the rational coefficients
//! recovered from them divide both polynomials (Langemyr, McCallum 1989; Encarnación 1995).

use num_bigint::BigInt;
use num_rational::BigRational;
use num_traits::Zero;

use super::function_ring::FunctionRing;
use crate::arithmetic::polynomial::Polynomial;
use crate::arithmetic::prime_field::{PrimeField, large_primes};
use crate::arithmetic::residues::Residues;

impl FunctionRing<'_> {
    /// The monic greatest common divisor; zero if both are zero.
    pub(super) fn gcd(&self, left: &[Polynomial], right: &[Polynomial]) -> Vec<Polynomial> {
        if left.is_empty() || right.is_empty() {
            let other = if left.is_empty() { right } else { left };
            let inverse = other.last().and_then(|c| self.field.inverse(c));
            return inverse.map_or_else(Vec::new, |inverse| self.scale(other, &inverse));
        }
        if left.len() == 1 || right.len() == 1 {
            return vec![Polynomial::one()];
        }
        let mut combined: Option<Combination> = None;
        for prime in large_primes() {
            let field = PrimeField::new(prime);
            let Some(image) = self.gcd_modulo(field, left, right) else {
                continue;
            };
            if image.len() == 1 {
                return vec![Polynomial::one()];
            }
            match &mut combined {
                // The degree modulo an unlucky prime is too high.
                Some(known) if known.coefficients.len() < image.len() => continue,
                Some(known) if known.coefficients.len() == image.len() => {
                    known.combine(field, &image)
                }
                _ => combined = Some(Combination::new(self.field.degree(), field, &image)),
            }
            let found = combined.as_mut().and_then(Combination::rationals);
            if let Some(candidate) = found
                && self.div_rem(left, &candidate).1.is_empty()
                && self.div_rem(right, &candidate).1.is_empty()
            {
                return candidate;
            }
        }
        // There are more primes than can be unlucky, so this is not reached.
        vec![Polynomial::one()]
    }

    /// The monic greatest common divisor over `F_p[t]/(m)`; `None` for a prime that cannot be used.
    fn gcd_modulo(
        &self,
        field: PrimeField,
        left: &[Polynomial],
        right: &[Polynomial],
    ) -> Option<Vec<Vec<u64>>> {
        let modulus = field.reduce(self.field.modulus())?;
        let reduce = |polynomial: &[Polynomial]| {
            let residues: Option<Vec<Vec<u64>>> =
                polynomial.iter().map(|c| field.reduce(c)).collect();
            residues.filter(|r| r.last().is_some_and(|c| !c.is_empty()))
        };
        let (mut a, mut b) = (reduce(left)?, reduce(right)?);
        if modulus.len() != self.field.degree() + 1 {
            return None;
        }
        if a.iter().chain(&b).all(|c| c.len() <= 1) {
            let flat = |polynomial: Vec<Vec<u64>>| {
                let constant = |c: Vec<u64>| c.first().copied().unwrap_or(0);
                polynomial.into_iter().map(constant).collect::<Vec<_>>()
            };
            let gcd = field.gcd(&flat(a), &flat(b));
            let wrap = |c: u64| if c == 0 { Vec::new() } else { vec![c] };
            return Some(gcd.into_iter().map(wrap).collect());
        }
        let multiply = |x: &[u64], y: &[u64]| field.remainder(&field.multiply(x, y), &modulus);
        while let Some(leading) = b.last() {
            let inverse = field.inverse_modulo(leading, &modulus)?;
            for c in &mut b {
                *c = multiply(c, &inverse);
            }
            while a.len() >= b.len() {
                let Some(top) = a.pop() else { break };
                let shift = a.len() + 1 - b.len();
                for (x, d) in a[shift..].iter_mut().zip(&b) {
                    *x = field.subtract(x, &multiply(&top, d));
                }
            }
            while a.last().is_some_and(Vec::is_empty) {
                a.pop();
            }
            std::mem::swap(&mut a, &mut b);
        }
        Some(a)
    }
}

/// A polynomial modulo a product of primes.
struct Combination {
    modulus: BigInt,
    /// One list of coefficients for each power of `X`.
    coefficients: Vec<Vec<BigInt>>,
    primes: usize,
    /// The number of primes at which rational coefficients are reconstructed again.
    attempt: usize,
}

impl Combination {
    fn new(degree: usize, field: PrimeField, image: &[Vec<u64>]) -> Self {
        let mut combination = Combination {
            modulus: BigInt::from(1),
            coefficients: vec![vec![BigInt::zero(); degree]; image.len()],
            primes: 0,
            attempt: 1,
        };
        combination.combine(field, image);
        combination
    }

    /// Chinese remainders.
    fn combine(&mut self, field: PrimeField, image: &[Vec<u64>]) {
        let inverse = field.inverse(field.integer(&self.modulus));
        for (known, image) in self.coefficients.iter_mut().zip(image) {
            for (k, x) in known.iter_mut().enumerate() {
                let residue = image.get(k).copied().unwrap_or(0);
                let difference = field.minus(residue, field.integer(x)) % field.prime();
                *x += &self.modulus * (difference * inverse % field.prime());
            }
        }
        self.modulus *= field.prime();
        self.primes += 1;
    }

    /// The rational coefficients recovered from the residues, if they are all short enough.
    fn rationals(&mut self) -> Option<Vec<Polynomial>> {
        if self.primes < self.attempt {
            return None;
        }
        self.attempt = self.primes + self.primes / 3 + 1;
        let ring = Residues::new(self.modulus.clone());
        let rational = |list: &Vec<BigInt>| {
            let list: Option<Vec<BigRational>> = list.iter().map(|c| ring.rational(c)).collect();
            Some(Polynomial::from_rationals(&list?))
        };
        self.coefficients.iter().map(rational).collect()
    }
}

#[cfg(test)]
mod tests {
    use super::super::NumberField;
    use super::super::function_ring::tests::{field, polynomial};
    use super::*;
    use proptest::prelude::*;

    proptest! {
        #[test]
        fn the_gcd_divides_and_holds_common_factors(a in polynomial(4), b in polynomial(4), c in polynomial(4)) {
            let k = field();
            let ring = FunctionRing { field: &k };
            prop_assume!(![&a, &b, &c].iter().any(|f| f.is_empty()));
            let (ac, bc) = (ring.multiply(&a, &c), ring.multiply(&b, &c));
            let gcd = ring.gcd(&ac, &bc);
            prop_assert_eq!(gcd.last(), Some(&Polynomial::one()));
            for multiple in [&ac, &bc] {
                prop_assert!(ring.div_rem(multiple, &gcd).1.is_empty());
            }
            prop_assert!(ring.div_rem(&gcd, &c).1.is_empty());
        }
    }

    #[test]
    fn long_polynomials_are_fast() {
        let q = NumberField::rationals();
        let ring = FunctionRing { field: &q };
        let mut state = 1u64;
        let mut polynomial = |length: usize| -> Vec<Polynomial> {
            let mut next = || {
                state = state
                    .wrapping_mul(6_364_136_223_846_793_005)
                    .wrapping_add(1);
                Polynomial::from_integers(&[(state >> 40) as i64 + 1])
            };
            (0..length).map(|_| next()).collect()
        };
        let [a, b, c] = [30, 30, 31].map(&mut polynomial);
        let (ac, bc) = (ring.multiply(&a, &c), ring.multiply(&b, &c));
        let start = std::time::Instant::now();
        let gcd = ring.gcd(&ac, &bc);
        assert!(start.elapsed().as_millis() < 500);
        assert_eq!(ring.scale(&gcd, &c[30]), c);
    }
}
