//! The irreducible factors of rational polynomials.
//!
//! Zassenhaus' method: factors modulo a prime are lifted to a power of the prime that exceeds twice any coefficient of
//! a true factor, and combined to true factors.

mod hensel;
mod recombination;
mod splitting;

use num_bigint::BigInt;
use num_integer::Integer;
use num_traits::{One, Zero};

use super::polynomial::Polynomial;
use super::prime_field::{PrimeField, large_primes, small_primes};
use super::residues::Residues;
use super::roots::Root;

/// Number of suitable primes to try; the prime with the fewest factors is used.
const PRIMES: usize = 5;

/// The distinct irreducible factors of a polynomial over the rationals, primitive with a positive leading coefficient,
/// sorted by degree.
///
/// A constant has no factors. `None` for the zero polynomial, and if more than 2²⁰ combinations of factors modulo a
/// prime would be needed; this requires more than 20 such factors.
pub fn irreducible_factors(polynomial: &Polynomial) -> Option<Vec<Polynomial>> {
    polynomial.degree()?;
    let mut factors = Vec::new();
    let mut rest = squarefree_part(polynomial);
    if rest.coefficient(0).is_zero() {
        factors.push(Polynomial::variable());
        rest = Polynomial::new(rest.numerators()[1..].to_vec(), BigInt::one());
    }
    match rest.degree() {
        Some(0) => {}
        Some(1) => factors.push(rest),
        _ => factors.extend(zassenhaus(&rest)?),
    }
    factors.sort_by(|a, b| {
        let key = |p: &Polynomial| p.numerators().len();
        key(a)
            .cmp(&key(b))
            .then_with(|| a.numerators().cmp(b.numerators()))
    });
    Some(factors)
}

/// The irreducible factor of a squarefree polynomial that vanishes at one of its isolated roots.
///
/// `None` if factoring exceeds its limit, see [`irreducible_factors`].
pub fn irreducible_factor_at(polynomial: &Polynomial, root: &Root) -> Option<Polynomial> {
    if let Some(value) = root.rational() {
        let linear = &Polynomial::variable() - &Polynomial::constant(value.clone());
        return Some(linear.primitive());
    }
    irreducible_factors(polynomial)?
        .into_iter()
        .find(|factor| root.is_root_of_divisor(factor))
}

/// The product of the distinct irreducible factors, primitive.
pub fn squarefree_part(polynomial: &Polynomial) -> Polynomial {
    let polynomial = polynomial.primitive();
    if is_surely_squarefree(&polynomial) {
        return polynomial;
    }
    let repeated = polynomial.gcd(&polynomial.derivative());
    match polynomial.div_rem(&repeated) {
        Some((quotient, _)) => quotient.primitive(),
        None => polynomial,
    }
}

/// Whether a polynomial is squarefree modulo a large prime, and hence over the rationals.
///
/// A squarefree polynomial fails only if the primes divide its discriminant or its leading coefficient.
pub fn is_surely_squarefree(polynomial: &Polynomial) -> bool {
    large_primes().take(2).any(|prime| {
        let field = PrimeField::new(prime);
        field.reduce(polynomial).is_some_and(|residues| {
            residues.len() == polynomial.numerators().len() && field.is_squarefree(&residues)
        })
    })
}

/// The factorisation modulo a prime, and the possible degrees of true factors from several primes.
struct Modular {
    field: PrimeField,
    factors: Vec<Vec<u64>>,
    /// Whether a true factor can have this degree.
    degrees: Vec<bool>,
}

/// The factors of a primitive squarefree polynomial that does not vanish at 0.
fn zassenhaus(polynomial: &Polynomial) -> Option<Vec<Polynomial>> {
    let modular = modular_factors(polynomial)?;
    let degree = polynomial.degree()?;
    if !modular.degrees[1..degree].contains(&true) {
        return Some(vec![polynomial.clone()]);
    }
    let leading = polynomial.leading().to_integer();
    // Mignotte: the coefficients of a factor are at most 2ⁿ times the Euclidean norm of the coefficients. Here factors
    // are scaled to the leading coefficient of the polynomial.
    let square: BigInt = polynomial.numerators().iter().map(|n| n * n).sum();
    let bound = ((square.sqrt() + 1u32) * &leading) << (degree + 1);
    let mut modulus = BigInt::from(modular.field.prime());
    let mut moduli = Vec::new();
    while moduli.is_empty() || modulus <= bound {
        modulus = &modulus * &modulus;
        moduli.push(Residues::new(modulus.clone()));
    }
    let ring = Residues::new(modulus);
    let inverse = leading.extended_gcd(ring.modulus()).x;
    let monic: Vec<BigInt> = polynomial
        .numerators()
        .iter()
        .map(|n| n * &inverse)
        .collect();
    let lifted = hensel::lift(
        modular.field,
        &moduli,
        ring.reduce(&monic),
        &modular.factors,
    );
    recombination::recombine(polynomial, &ring, lifted, &modular.degrees)
}

/// Chooses the prime with the fewest factors among several.
fn modular_factors(polynomial: &Polynomial) -> Option<Modular> {
    let degree = polynomial.degree()?;
    let mut degrees = vec![true; degree + 1];
    let mut best = None;
    let mut suitable = 0;
    for prime in small_primes() {
        let field = PrimeField::new(prime);
        let residues = field.reduce(polynomial).unwrap_or_default();
        if residues.len() != degree + 1 || !field.is_squarefree(&residues) {
            continue;
        }
        let parts = splitting::by_degree(field, &field.monic(&residues));
        let mut sums = vec![false; degree + 1];
        sums[0] = true;
        let mut count = 0;
        for (part, size) in &parts {
            for _ in 0..(part.len() - 1) / size {
                count += 1;
                for k in (*size..=degree).rev() {
                    sums[k] |= sums[k - size];
                }
            }
        }
        for (possible, here) in degrees.iter_mut().zip(sums) {
            *possible &= here;
        }
        if best.as_ref().is_none_or(|(fewest, _, _)| count < *fewest) {
            best = Some((count, field, parts));
        }
        suitable += 1;
        if suitable == PRIMES || !degrees[1..degree].contains(&true) {
            break;
        }
    }
    let (_, field, parts) = best?;
    let irreducible = !degrees[1..degree].contains(&true);
    let factors = if irreducible {
        Vec::new()
    } else {
        parts
            .into_iter()
            .flat_map(|(part, size)| splitting::equal_degrees(field, part, size))
            .collect()
    };
    Some(Modular {
        field,
        factors,
        degrees,
    })
}

#[cfg(test)]
mod tests {
    use super::*;
    use proptest::prelude::*;
    use std::time::Instant;

    fn product(factors: &[Polynomial]) -> Polynomial {
        factors.iter().fold(Polynomial::one(), |p, f| &p * f)
    }

    fn factors(polynomial: &Polynomial) -> Vec<Polynomial> {
        irreducible_factors(polynomial).expect("within the bound")
    }

    /// The polynomial whose roots are all sums `±√2 ± √3 ± √5 …`.
    fn swinnerton_dyer(primes: &[i64]) -> Polynomial {
        primes.iter().fold(Polynomial::variable(), |f, &prime| {
            // Π f(x ± √q) = a² − q b² where f(x + √q) = a + b√q.
            let (mut a, mut b) = (Polynomial::zero(), Polynomial::zero());
            let q = Polynomial::from_integers(&[prime]);
            for c in f.coefficients().into_iter().rev() {
                let x = Polynomial::variable();
                let next = &(&(&a * &x) + &(&b * &q)) + &Polynomial::constant(c);
                b = &(&b * &x) + &a;
                a = next;
            }
            &(&a * &a) - &(&(&b * &b) * &q)
        })
    }

    #[test]
    fn cyclotomic_polynomials_are_the_factors_of_powers() {
        for n in 1..=48usize {
            let f = &Polynomial::monomial(n) - &Polynomial::one();
            let found = factors(&f);
            let divisors: Vec<usize> = (1..=n).filter(|d| n % d == 0).collect();
            assert_eq!(found.len(), divisors.len(), "x^{n} - 1");
            assert_eq!(product(&found), f);
            let mut degrees: Vec<usize> = divisors
                .iter()
                .map(|d| (1..=*d).filter(|k| k.gcd(d) == 1).count())
                .collect();
            degrees.sort_unstable();
            let found: Vec<usize> = found.iter().filter_map(Polynomial::degree).collect();
            assert_eq!(found, degrees);
        }
    }

    #[test]
    fn polynomials_that_split_modulo_every_prime_are_irreducible() {
        let start = Instant::now();
        for primes in [[2, 3, 5].as_slice(), &[2, 3, 5, 7], &[2, 3, 5, 7, 11]] {
            let f = swinnerton_dyer(primes);
            assert_eq!(f.degree(), Some(1 << primes.len()));
            assert_eq!(factors(&f), [f]);
        }
        assert!(start.elapsed().as_secs() < 20);
        // Too many combinations: the limit is reported.
        assert_eq!(
            irreducible_factors(&swinnerton_dyer(&[2, 3, 5, 7, 11, 13])),
            None
        );
    }

    #[test]
    fn multiplicities_and_contents_are_left_out() {
        let f = [[2, 1].as_slice(), &[0, 1], &[-2, 0, 1], &[5, 3]].map(Polynomial::from_integers);
        let power = &(&(&f[0].power(3) * &f[1].power(2)) * &f[2].power(2)) * &f[3];
        let found = factors(&power.scale(&crate::rational::ratio(-6, 35)));
        let mut expected = f.to_vec();
        expected.sort_by_key(|f| (f.numerators().len(), f.numerators().to_vec()));
        assert_eq!(found, expected);
        assert_eq!(factors(&Polynomial::from_integers(&[7])), []);
        assert_eq!(irreducible_factors(&Polynomial::zero()), None);
    }

    #[test]
    fn polynomials_with_large_coefficients_are_factored() {
        let big = |n: &str| -> BigInt { n.parse().expect("digits") };
        let f = Polynomial::new(
            vec![
                big("123456789012345678901234567890123456789"),
                big("-98765432109876543210"),
                big("1000000000000000000000000000057"),
            ],
            BigInt::one(),
        );
        let g = Polynomial::new(
            vec![
                big("340282366920938463463374607431768211507"),
                big("3"),
                big("17"),
                big("6"),
            ],
            BigInt::one(),
        );
        let found = factors(&(&f * &g));
        assert_eq!(product(&found), &f * &g);
        assert!(found.contains(&f) || found.len() > 2);
    }

    #[test]
    fn the_factor_at_a_root_is_found() {
        let f =
            &Polynomial::from_integers(&[-2, 0, 1]) * &Polynomial::from_integers(&[-1, -1, 0, 1]);
        let f = &f * &Polynomial::from_integers(&[1, 2]);
        let at = |k: usize| {
            let root = &crate::roots::real_roots(&f)[k];
            irreducible_factor_at(&f, root)
                .expect("within the bound")
                .display("t")
                .to_string()
        };
        assert_eq!(
            [at(0), at(1), at(2), at(3)],
            ["t^2 - 2", "2*t + 1", "t^3 - t - 1", "t^2 - 2"]
        );
    }

    fn primitive() -> impl Strategy<Value = Polynomial> {
        prop::collection::vec(-30i64..30, 2..7)
            .prop_map(|c| Polynomial::from_integers(&c))
            .prop_filter("not a constant", |f| f.degree() > Some(0))
            .prop_map(|f| f.primitive())
    }

    proptest! {
        #[test]
        fn factors_of_products_are_the_factors(a in primitive(), b in primitive(), c in primitive()) {
            let mut separate: Vec<Polynomial> = [&a, &b, &c].into_iter().flat_map(factors).collect();
            separate.sort_by_key(|f| (f.numerators().len(), f.numerators().to_vec()));
            separate.dedup();
            let together = factors(&(&(&a * &b) * &c));
            prop_assert_eq!(&together, &separate);
            for factor in &together {
                prop_assert_eq!(factors(factor), vec![factor.clone()]);
            }
            prop_assert_eq!(product(&together), squarefree_part(&(&(&a * &b) * &c)));
        }
    }
}
