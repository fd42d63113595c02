//! Factors over the field of `p` elements (Cantor, Zassenhaus 1981).

use crate::prime_field::PrimeField;

/// The linear map `h ↦ hᵖ` on polynomials modulo `modulus`.
struct Frobenius<'a> {
    field: PrimeField,
    modulus: &'a [u64],
    /// The images of the powers of the variable.
    images: Vec<Vec<u64>>,
}

impl<'a> Frobenius<'a> {
    fn new(field: PrimeField, modulus: &'a [u64]) -> Self {
        let step = field.power_modulo(&[0, 1], field.prime(), modulus);
        let mut images = vec![vec![1]];
        for k in 1..modulus.len().saturating_sub(1) {
            images.push(field.remainder(&field.multiply(&images[k - 1], &step), modulus));
        }
        Frobenius {
            field,
            modulus,
            images,
        }
    }

    fn apply(&self, polynomial: &[u64]) -> Vec<u64> {
        let mut result = vec![0; self.modulus.len() - 1];
        for (&c, image) in polynomial
            .iter()
            .zip(&self.images)
            .filter(|(c, _)| **c != 0)
        {
            for (x, i) in result.iter_mut().zip(image) {
                *x = (*x + c * i) % self.field.prime();
            }
        }
        while result.last() == Some(&0) {
            result.pop();
        }
        result
    }
}

/// Splits a monic squarefree polynomial into the products of its irreducible factors of equal degree, each with this
/// degree.
pub(super) fn by_degree(field: PrimeField, polynomial: &[u64]) -> Vec<(Vec<u64>, usize)> {
    let frobenius = Frobenius::new(field, polynomial);
    let mut rest = polynomial.to_vec();
    let mut parts = Vec::new();
    // x to the power pᵈ. The irreducible divisors of x^(pᵈ) − x are those whose degree divides d.
    let mut power = vec![0, 1];
    for degree in 1.. {
        if rest.len() <= 2 * degree {
            break;
        }
        power = frobenius.apply(&field.remainder(&power, polynomial));
        let part = field.gcd(&rest, &field.subtract(&power, &[0, 1]));
        if part.len() > 1 {
            rest = field.div_rem(&rest, &part).0;
            parts.push((part, degree));
        }
    }
    if rest.len() > 1 {
        let degree = rest.len() - 1;
        parts.push((rest, degree));
    }
    parts
}

/// Splits a monic product of distinct irreducible factors of the same degree; `p` is odd.
pub(super) fn equal_degrees(field: PrimeField, product: Vec<u64>, degree: usize) -> Vec<Vec<u64>> {
    let mut pending = vec![product];
    let mut factors = Vec::new();
    // A fixed pseudorandom sequence (Knuth's multiplier): it affects the run time only, not the result.
    let mut state = 0u64;
    let mut draw = |prime: u64| {
        state = state
            .wrapping_mul(6_364_136_223_846_793_005)
            .wrapping_add(1_442_695_040_888_963_407);
        (state >> 33) % prime
    };
    while let Some(product) = pending.pop() {
        if product.len() == degree + 1 {
            factors.push(product);
            continue;
        }
        let frobenius = Frobenius::new(field, &product);
        loop {
            let mut power: Vec<u64> = (1..product.len()).map(|_| draw(field.prime())).collect();
            // The power (pᵈ − 1)/2 is 1 or −1 modulo each factor, with equal probability.
            let mut norm = vec![1];
            for _ in 0..degree {
                norm = field.remainder(&field.multiply(&norm, &power), &product);
                power = frobenius.apply(&power);
            }
            let half = field.power_modulo(&norm, (field.prime() - 1) / 2, &product);
            let part = field.gcd(&product, &field.subtract(&half, &[1]));
            if 1 < part.len() && part.len() < product.len() {
                pending.push(field.div_rem(&product, &part).0);
                pending.push(part);
                break;
            }
        }
    }
    factors
}

#[cfg(test)]
mod tests {
    use super::*;
    use proptest::prelude::*;

    #[test]
    fn the_field_itself_is_found() {
        // x^p − x has every element as a root; x^(p²) − x also contains all irreducible quadratic factors.
        let field = PrimeField::new(5);
        let mut f = vec![0; 26];
        (f[1], f[25]) = (4, 1);
        let parts = by_degree(field, &f);
        assert_eq!(
            parts
                .iter()
                .map(|(f, d)| (f.len() - 1, *d))
                .collect::<Vec<_>>(),
            [(5, 1), (20, 2)]
        );
        for (part, degree) in parts {
            let factors = equal_degrees(field, part.clone(), degree);
            let product = factors.iter().fold(vec![1], |p, f| field.multiply(&p, f));
            assert_eq!(product, part);
            assert!(factors.iter().all(|f| f.len() == degree + 1));
        }
    }

    proptest! {
        #[test]
        fn factors_multiply_back_and_are_irreducible(mut f in prop::collection::vec(0u64..7, 1..12)) {
            let field = PrimeField::new(7);
            f.push(1);
            prop_assume!(field.is_squarefree(&f));
            let mut product = vec![1];
            for (part, degree) in by_degree(field, &f) {
                for factor in equal_degrees(field, part, degree) {
                    prop_assert_eq!(by_degree(field, &factor), vec![(factor.clone(), degree)]);
                    product = field.multiply(&product, &factor);
                }
            }
            prop_assert_eq!(product, f);
        }
    }
}
