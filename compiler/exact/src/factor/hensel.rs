//! Factors modulo a power of `p` from factors modulo `p` (Hensel; von zur Gathen, Gerhard, §15.4).

use num_bigint::BigInt;
use num_traits::One;

use crate::prime_field::PrimeField;
use crate::residues::Residues;

/// Lifts the monic factors of a polynomial modulo `p` to factors modulo a power of `p`.
///
/// `polynomial` is monic modulo the last of `moduli`, which are `p², p⁴, p⁸, …`; modulo `p` the factors
/// are coprime and their product is the polynomial.
pub(super) fn lift(
    field: PrimeField,
    moduli: &[Residues],
    polynomial: Vec<BigInt>,
    factors: &[Vec<u64>],
) -> Vec<Vec<BigInt>> {
    if factors.len() <= 1 {
        return vec![polynomial];
    }
    let (left, right) = factors.split_at(factors.len() / 2);
    let product = |factors: &[Vec<u64>]| factors.iter().fold(vec![1], |p, f| field.multiply(&p, f));
    let (g, h) = lift_pair(field, moduli, &polynomial, &product(left), &product(right));
    let mut lifted = lift(field, moduli, g, left);
    lifted.extend(lift(field, moduli, h, right));
    lifted
}

/// Lifts a factorisation `f = g h` modulo `p` into two coprime monic factors.
fn lift_pair(
    field: PrimeField,
    moduli: &[Residues],
    f: &[BigInt],
    g: &[u64],
    h: &[u64],
) -> (Vec<BigInt>, Vec<BigInt>) {
    let integers = |polynomial: &[u64]| polynomial.iter().map(|&c| c.into()).collect::<Vec<_>>();
    // s g + t h = 1; g is invertible modulo h because they are coprime.
    let s = field.inverse_modulo(g, h).unwrap_or_default();
    let t = field.subtract(&[1], &field.multiply(&s, g));
    let (t, _) = field.div_rem(&t, h);
    let [mut g, mut h, mut s, mut t] = [g, h, &s, &t].map(integers);
    let one = [BigInt::one()];
    for ring in moduli {
        let error = ring.subtract(&ring.reduce(f), &ring.multiply(&g, &h));
        let (q, r) = ring.div_rem(&ring.multiply(&s, &error), &h);
        g = ring.add(
            &g,
            &ring.add(&ring.multiply(&t, &error), &ring.multiply(&q, &g)),
        );
        h = ring.add(&h, &r);
        let error = ring.subtract(
            &ring.add(&ring.multiply(&s, &g), &ring.multiply(&t, &h)),
            &one,
        );
        let (q, r) = ring.div_rem(&ring.multiply(&s, &error), &h);
        s = ring.subtract(&s, &r);
        t = ring.subtract(
            &ring.subtract(&t, &ring.multiply(&t, &error)),
            &ring.multiply(&q, &g),
        );
    }
    (g, h)
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn lifted_factors_multiply_to_the_polynomial() {
        // (x − 1)(x − 2)(x − 4)(x² + 1) modulo 7 from x⁵ + … with other integers behind it.
        let field = PrimeField::new(7);
        let factors = [vec![6, 1], vec![5, 1], vec![3, 1], vec![1, 0, 1]];
        let product = factors.iter().fold(vec![1], |p, f| field.multiply(&p, f));
        let polynomial: Vec<BigInt> = (0..)
            .zip(&product)
            .map(|(k, &c)| BigInt::from(c) + BigInt::from(if k < 5 { 7 * (k + 3) } else { 0 }))
            .collect();
        let mut moduli = vec![Residues::new(BigInt::from(49))];
        for _ in 0..3 {
            let last = moduli[moduli.len() - 1].modulus();
            moduli.push(Residues::new(last * last));
        }
        let ring = moduli[3].clone();
        let lifted = lift(field, &moduli, ring.reduce(&polynomial), &factors);
        let product = lifted
            .iter()
            .fold(vec![BigInt::one()], |p, f| ring.multiply(&p, f));
        assert_eq!(product, polynomial);
        for (lifted, factor) in lifted.iter().zip(&factors) {
            let residues: Vec<u64> = lifted.iter().map(|c| field.integer(c)).collect();
            assert_eq!(&residues, factor);
        }
    }
}
