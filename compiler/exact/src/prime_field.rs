//! The field of `p` elements and polynomials over it, for primes of half a machine word.

use num_bigint::BigInt;
use num_integer::Integer as _;
use num_traits::ToPrimitive;

use super::polynomial::Polynomial;

/// The field of `p` elements. Its polynomials are lists of residues below `p`, lowest degree first, the last one not
/// zero.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub struct PrimeField {
    /// Below 2³¹, so that a product and a sum fit a machine word.
    prime: u64,
}

/// The odd primes in ascending order.
pub fn small_primes() -> impl Iterator<Item = u64> {
    (3..1 << 31).step_by(2).filter(|&n| is_prime(n))
}

/// The largest primes below 2³¹; these are almost always enough.
const LARGEST: [u64; 8] = [
    2_147_483_647,
    2_147_483_629,
    2_147_483_587,
    2_147_483_579,
    2_147_483_563,
    2_147_483_549,
    2_147_483_543,
    2_147_483_497,
];

/// The primes below 2³¹ in descending order: large moduli are rarely unlucky.
pub fn large_primes() -> impl Iterator<Item = u64> {
    let below = (3..LARGEST[7]).rev().skip(1).step_by(2);
    LARGEST.into_iter().chain(below.filter(|&n| is_prime(n)))
}

/// Whether an odd number above 2 is a prime.
fn is_prime(n: u64) -> bool {
    (3..)
        .step_by(2)
        .take_while(|d| d * d <= n)
        .all(|d: u64| !n.is_multiple_of(d))
}

impl PrimeField {
    /// The field with `prime` elements, a prime below 2³¹.
    pub fn new(prime: u64) -> Self {
        debug_assert!(prime < 1 << 31);
        PrimeField { prime }
    }

    /// The number of elements.
    pub fn prime(self) -> u64 {
        self.prime
    }

    /// The residue of an integer.
    pub fn integer(self, value: &BigInt) -> u64 {
        value
            .mod_floor(&BigInt::from(self.prime))
            .to_u64()
            .unwrap_or(0)
    }

    /// The power `aᵉ`.
    pub fn power(self, base: u64, mut exponent: u64) -> u64 {
        let (mut result, mut square) = (1, base);
        while exponent > 0 {
            if exponent & 1 == 1 {
                result = result * square % self.prime;
            }
            square = square * square % self.prime;
            exponent >>= 1;
        }
        result
    }

    /// The inverse of an element that is not zero.
    pub fn inverse(self, element: u64) -> u64 {
        self.power(element, self.prime - 2)
    }

    /// The difference.
    pub fn minus(self, left: u64, right: u64) -> u64 {
        if left < right {
            left + self.prime - right
        } else {
            left - right
        }
    }

    /// A rational polynomial modulo `p`; `None` if `p` divides the denominator.
    pub fn reduce(self, polynomial: &Polynomial) -> Option<Vec<u64>> {
        let denominator = self.integer(polynomial.denominator());
        if denominator == 0 {
            return None;
        }
        let scale = self.inverse(denominator);
        let mut residues = polynomial
            .numerators()
            .iter()
            .map(|n| self.integer(n) * scale % self.prime)
            .collect();
        trim(&mut residues);
        Some(residues)
    }

    /// The difference of polynomials.
    pub fn subtract(self, left: &[u64], right: &[u64]) -> Vec<u64> {
        let mut result = left.to_vec();
        result.resize(left.len().max(right.len()), 0);
        for (x, r) in result.iter_mut().zip(right) {
            *x = self.minus(*x, *r);
        }
        trim(&mut result);
        result
    }

    /// The product of polynomials.
    pub fn multiply(self, left: &[u64], right: &[u64]) -> Vec<u64> {
        if left.is_empty() || right.is_empty() {
            return Vec::new();
        }
        let mut result = vec![0; left.len() + right.len() - 1];
        for (i, &a) in left.iter().enumerate().filter(|(_, a)| **a != 0) {
            for (x, &b) in result[i..].iter_mut().zip(right) {
                *x = (*x + a * b) % self.prime;
            }
        }
        result
    }

    /// The multiple of a polynomial by an element.
    pub fn scale(self, polynomial: &[u64], factor: u64) -> Vec<u64> {
        polynomial.iter().map(|x| x * factor % self.prime).collect()
    }

    /// Quotient and remainder of the division by a polynomial that is not zero.
    pub fn div_rem(self, dividend: &[u64], divisor: &[u64]) -> (Vec<u64>, Vec<u64>) {
        let Some((&leading, rest)) = divisor.split_last() else {
            return (Vec::new(), dividend.to_vec());
        };
        let inverse = if leading == 1 {
            1
        } else {
            self.inverse(leading)
        };
        let mut remainder = dividend.to_vec();
        let mut quotient = vec![0; (dividend.len() + 1).saturating_sub(divisor.len())];
        while remainder.len() > rest.len() {
            let top = remainder.pop().unwrap_or(0) * inverse % self.prime;
            let shift = remainder.len() - rest.len();
            quotient[shift] = top;
            if top != 0 {
                let negative = self.prime - top;
                for (x, &d) in remainder[shift..].iter_mut().zip(rest) {
                    *x = (*x + negative * d) % self.prime;
                }
            }
        }
        trim(&mut quotient);
        trim(&mut remainder);
        (quotient, remainder)
    }

    /// The remainder of the division by a polynomial that is not zero.
    pub fn remainder(self, dividend: &[u64], divisor: &[u64]) -> Vec<u64> {
        self.div_rem(dividend, divisor).1
    }

    /// The multiple with the leading coefficient 1.
    pub fn monic(self, polynomial: &[u64]) -> Vec<u64> {
        match polynomial.last() {
            Some(&leading) if leading != 1 => self.scale(polynomial, self.inverse(leading)),
            _ => polynomial.to_vec(),
        }
    }

    /// The monic greatest common divisor; zero if both are zero.
    pub fn gcd(self, left: &[u64], right: &[u64]) -> Vec<u64> {
        let (mut a, mut b) = (left.to_vec(), right.to_vec());
        while !b.is_empty() {
            let r = self.remainder(&a, &b);
            a = std::mem::replace(&mut b, r);
        }
        self.monic(&a)
    }

    /// The inverse of a polynomial modulo another one; `None` if they have a common divisor.
    pub fn inverse_modulo(self, polynomial: &[u64], modulus: &[u64]) -> Option<Vec<u64>> {
        // Extended Euclidean algorithm; invariant: r ≡ t·polynomial modulo the modulus.
        let (mut r0, mut t0) = (modulus.to_vec(), Vec::new());
        let (mut r1, mut t1) = (self.remainder(polynomial, modulus), vec![1]);
        while !r1.is_empty() {
            let (q, r) = self.div_rem(&r0, &r1);
            let t = self.subtract(&t0, &self.multiply(&q, &t1));
            (r0, t0, r1, t1) = (r1, t1, r, t);
        }
        match r0.as_slice() {
            [unit] => Some(self.scale(&t0, self.inverse(*unit))),
            _ => None,
        }
    }

    /// The derivative.
    pub fn derivative(self, polynomial: &[u64]) -> Vec<u64> {
        let mut result = (0..)
            .zip(polynomial)
            .skip(1)
            .map(|(k, x): (u64, _)| k % self.prime * x % self.prime)
            .collect();
        trim(&mut result);
        result
    }

    /// Whether a polynomial has no multiple factor.
    pub fn is_squarefree(self, polynomial: &[u64]) -> bool {
        self.gcd(polynomial, &self.derivative(polynomial)).len() == 1
    }

    /// The power `fᵉ` modulo another polynomial.
    pub fn power_modulo(self, base: &[u64], mut exponent: u64, modulus: &[u64]) -> Vec<u64> {
        let mut square = self.remainder(base, modulus);
        let mut result = vec![1];
        while exponent > 0 {
            if exponent & 1 == 1 {
                result = self.remainder(&self.multiply(&result, &square), modulus);
            }
            exponent >>= 1;
            if exponent > 0 {
                square = self.remainder(&self.multiply(&square, &square), modulus);
            }
        }
        result
    }
}

/// Removes leading zeros.
fn trim(polynomial: &mut Vec<u64>) {
    while polynomial.last() == Some(&0) {
        polynomial.pop();
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use proptest::prelude::*;

    #[test]
    fn primes_are_found_from_both_ends() {
        let small: Vec<u64> = small_primes().take(6).collect();
        assert_eq!(small, [3, 5, 7, 11, 13, 17]);
        let large: Vec<u64> = large_primes().take(12).collect();
        let odd = (3..1u64 << 31).rev().step_by(2);
        assert_eq!(
            large,
            odd.filter(|&n| is_prime(n)).take(12).collect::<Vec<_>>()
        );
    }

    proptest! {
        #[test]
        fn arithmetic_agrees_with_its_definition(
            a in prop::collection::vec(0u64..101, 0..8),
            b in prop::collection::vec(0u64..101, 1..6),
        ) {
            let field = PrimeField::new(101);
            let (mut a, mut b) = (a, b);
            trim(&mut a);
            trim(&mut b);
            prop_assume!(!b.is_empty());
            let (q, r) = field.div_rem(&a, &b);
            prop_assert!(r.len() < b.len());
            prop_assert_eq!(field.subtract(&field.subtract(&a, &field.multiply(&q, &b)), &r), Vec::<u64>::new());
            match field.inverse_modulo(&a, &b) {
                Some(inverse) => {
                    let product = field.remainder(&field.multiply(&a, &inverse), &b);
                    prop_assert_eq!(product, if b.len() == 1 { vec![] } else { vec![1] });
                }
                None => prop_assert!(field.gcd(&a, &b).len() != 1),
            }
            let cube = field.multiply(&field.multiply(&a, &a), &a);
            prop_assert_eq!(field.power_modulo(&a, 3, &b), field.remainder(&cube, &b));
        }
    }
}
