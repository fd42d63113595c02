//! Images of a field of constants in prime fields, which prove that an element is nonzero.

use super::field::{ConstantField, FieldElement};
use crate::arithmetic::polynomial::Polynomial;
use crate::arithmetic::prime_field::{PrimeField, large_primes};

/// A homomorphism from `Q(θ)(X)` to the field with `p` elements: `θ` is mapped to a root of its equation
/// modulo `p`, and `X` to some residue. It is defined if the denominator is not mapped to zero.
#[derive(Debug, Clone, Copy)]
pub struct Image {
    /// The field of the images.
    pub field: PrimeField,
    theta: u64,
    x: u64,
}

/// The number of primes that are tried: for a field of degree `n`, at least one prime in `n!` has a root.
const PRIMES: usize = 200;

impl Image {
    /// Several images; none if there is no root modulo the first primes.
    pub fn several(field: &ConstantField, count: usize) -> Vec<Image> {
        let modulus = field.algebraic().modulus();
        let primes = large_primes().take(PRIMES).map(PrimeField::new);
        let found = primes.filter_map(|prime| {
            let residues = prime.reduce(modulus)?;
            let theta = (Some(residues.len()) == modulus.degree().map(|d| d + 1))
                .then(|| root(prime, &residues))??;
            Some((prime, theta))
        });
        let image = |(k, (field, theta)): (u64, (PrimeField, u64))| Image {
            field,
            theta,
            // Some residue that is not a small number.
            x: (k + 1) * 1_234_567_891 % field.prime(),
        };
        (0..).zip(found).map(image).take(count).collect()
    }

    /// The image of an element; `None` if a denominator is mapped to zero.
    pub fn of(&self, element: &FieldElement) -> Option<u64> {
        let denominator = self.polynomial(element.denominator())?;
        if denominator == 0 {
            return None;
        }
        let inverse = self.field.inverse(denominator);
        Some(self.polynomial(element.numerator())? * inverse % self.field.prime())
    }

    fn polynomial(&self, list: &[Polynomial]) -> Option<u64> {
        let evaluate = |list: &[u64], point: u64| {
            let horner = |value: u64, c: &u64| (value * point + c) % self.field.prime();
            list.iter().rev().fold(0, horner)
        };
        let coefficient = |c| Some(evaluate(&self.field.reduce(c)?, self.theta));
        let list: Option<Vec<u64>> = list.iter().map(coefficient).collect();
        Some(evaluate(&list?, self.x))
    }
}

/// A root of a polynomial, if there is one (Cantor, Zassenhaus).
fn root(field: PrimeField, polynomial: &[u64]) -> Option<u64> {
    let p = field.prime();
    let variable = [0, 1];
    // The product of x − a over all roots a.
    let power = field.power_modulo(&variable, p, polynomial);
    let difference = field.subtract(&power, &field.remainder(&variable, polynomial));
    let mut split = field.gcd(polynomial, &difference);
    for shift in 1..64 {
        if split.len() <= 2 {
            break;
        }
        let half = field.power_modulo(&[shift, 1], (p - 1) / 2, &split);
        let part = field.gcd(&split, &field.subtract(&half, &[1]));
        if part.len() > 1 && part.len() < split.len() {
            split = part;
        }
    }
    match split.as_slice() {
        [constant, 1] => Some(field.minus(0, *constant)),
        _ => None,
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::algebra::field::{NumberField, Transcendental};
    use crate::arithmetic::rational::ratio;

    #[test]
    fn modular_images_are_homomorphisms() {
        let two = Polynomial::from_integers(&[2]);
        let algebraic = NumberField::rationals().square_root(&two).expect("small");
        let algebraic = algebraic.field.cosine(7).expect("small").field;
        let field = ConstantField::new(algebraic, Some(Transcendental::Pi));
        let pi = field.transcendental().expect("pi");
        let theta = field.from_algebraic(&Polynomial::variable());
        let x = field.add(&field.multiply(&pi, &theta), &field.rational(ratio(1, 3)));
        let y = field.inverse(&field.subtract(&x, &pi)).expect("not zero");
        let images = Image::several(&field, 3);
        assert_eq!(images.len(), 3);
        for image in images {
            let p = image.field.prime();
            let [a, b] = [&x, &y].map(|e| image.of(e).expect("defined"));
            assert_eq!(image.of(&field.multiply(&x, &y)), Some(a * b % p));
            assert_eq!(image.of(&field.add(&x, &y)), Some((a + b) % p));
            assert_ne!(image.of(&theta), Some(0));
            assert_eq!(image.of(&field.zero()), Some(0));
        }
    }
}
