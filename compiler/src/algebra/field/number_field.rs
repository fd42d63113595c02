//! Real number fields `Q(θ)`.

use std::cmp::Ordering;
use std::sync::OnceLock;

use num_bigint::BigInt;
use num_integer::Integer;
use num_rational::BigRational;
use num_traits::{One, Zero};

use super::Notation;
use super::notation::{Basis, Generator, Term, sum};
use crate::arithmetic::algebraic_number::AlgebraicNumber;
use crate::arithmetic::factor::squarefree_part;
use crate::arithmetic::interval::Interval;
use crate::arithmetic::polynomial::Polynomial;
use crate::arithmetic::power_sums::{from_power_sums, power_sums};
use crate::arithmetic::prime_field::{PrimeField, large_primes};
use crate::arithmetic::residues::Residues;

/// The largest degree of a field.
pub const MAX_DEGREE: usize = 32;

/// A field `Q(θ) ⊂ R` for a real algebraic number `θ`.
///
/// Its elements are represented uniquely as rational polynomials in `θ` of a degree less than that of the
/// field; a rational number is a constant. The methods take reduced elements.
#[derive(Debug, Clone)]
pub struct NumberField {
    primitive: AlgebraicNumber,
    generators: Vec<Generator>,
    /// The basis for printing, computed on demand.
    basis: OnceLock<Basis>,
}

impl NumberField {
    /// The field of the rational numbers.
    pub fn rationals() -> Self {
        NumberField::new(AlgebraicNumber::rational(BigRational::zero()), Vec::new())
    }

    pub(super) fn new(primitive: AlgebraicNumber, generators: Vec<Generator>) -> Self {
        NumberField {
            primitive,
            generators,
            basis: OnceLock::new(),
        }
    }

    pub(super) fn generators_with_notation(&self) -> &[Generator] {
        &self.generators
    }

    /// The number `θ`.
    pub fn primitive_element(&self) -> &AlgebraicNumber {
        &self.primitive
    }

    /// The numbers by which the field was extended, in order, with the notation for each.
    pub fn generators(&self) -> impl Iterator<Item = (&Notation, &Polynomial)> {
        self.generators.iter().map(|g| (&g.notation, &g.value))
    }

    /// The degree over the rationals.
    pub fn degree(&self) -> usize {
        self.primitive.degree()
    }

    /// The irreducible polynomial of `θ`, primitive.
    pub fn modulus(&self) -> &Polynomial {
        self.primitive.polynomial()
    }

    /// A polynomial in `θ` as an element.
    pub fn reduce(&self, polynomial: &Polynomial) -> Polynomial {
        polynomial.remainder(self.modulus())
    }

    /// The product.
    pub fn multiply(&self, left: &Polynomial, right: &Polynomial) -> Polynomial {
        self.reduce(&(left * right))
    }

    /// The power `xⁿ`.
    pub fn power(&self, element: &Polynomial, mut exponent: u32) -> Polynomial {
        let (mut result, mut square) = (Polynomial::one(), element.clone());
        while exponent > 0 {
            if exponent & 1 == 1 {
                result = self.multiply(&result, &square);
            }
            exponent >>= 1;
            if exponent > 0 {
                square = self.multiply(&square, &square);
            }
        }
        result
    }

    /// The inverse; `None` for zero.
    pub fn inverse(&self, element: &Polynomial) -> Option<Polynomial> {
        if let Some(value) = element.as_constant() {
            return (!value.is_zero()).then(|| Polynomial::constant(value.recip()));
        }
        if self.degree() <= EUCLIDEAN_DEGREE {
            return element.inverse_modulo(self.modulus()).ok();
        }
        large_primes().find_map(|prime| self.lifted_inverse(PrimeField::new(prime), element))
    }

    /// The inverse from its residues modulo a prime, by Newton's iteration modulo powers of the prime.
    ///
    /// `None` if there is no inverse modulo the prime: it divides the norm of the element, or the
    /// leading coefficient of the modulus.
    fn lifted_inverse(&self, field: PrimeField, element: &Polynomial) -> Option<Polynomial> {
        let integral = element.scale(&BigRational::from_integer(element.denominator().clone()));
        let modulus = field.reduce(self.modulus())?;
        let leading = self.modulus().leading().to_integer();
        if modulus.len() != self.degree() + 1 {
            return None;
        }
        let start = field.inverse_modulo(&field.reduce(&integral)?, &modulus)?;
        let mut inverse: Vec<BigInt> = start.into_iter().map(BigInt::from).collect();
        let mut prime_power = BigInt::from(field.prime());
        loop {
            prime_power = &prime_power * &prime_power;
            let ring = Residues::new(prime_power.clone());
            let unit = leading.extended_gcd(&prime_power).x;
            let monic: Vec<BigInt> = self
                .modulus()
                .numerators()
                .iter()
                .map(|n| n * &unit)
                .collect();
            let monic = ring.reduce(&monic);
            let multiply =
                |a: &[BigInt], b: &[BigInt]| ring.div_rem(&ring.multiply(a, b), &monic).1;
            // g(2 − a g) has twice as many correct digits as g.
            let product = multiply(&ring.reduce(integral.numerators()), &inverse);
            let correction = ring.subtract(&[BigInt::from(2)], &product);
            inverse = multiply(&inverse, &correction);
            let rationals: Option<Vec<BigRational>> =
                inverse.iter().map(|c| ring.rational(c)).collect();
            if let Some(rationals) = rationals {
                let candidate = Polynomial::from_rationals(&rationals);
                if self.multiply(&integral, &candidate) == Polynomial::one() {
                    let scale = BigRational::from_integer(element.denominator().clone());
                    return Some(candidate.scale(&scale));
                }
            }
        }
    }

    /// The irreducible polynomial of an element over the rationals, primitive.
    pub fn minimal_polynomial(&self, element: &Polynomial) -> Polynomial {
        let degree = self.degree();
        let sums = power_sums(self.modulus(), degree);
        let mut power = Polynomial::one();
        let mut traces = Vec::with_capacity(degree + 1);
        for _ in 0..=degree {
            traces.push(trace(&power, &sums));
            power = self.multiply(&power, element);
        }
        // The characteristic polynomial is a power of the minimal one.
        squarefree_part(&from_power_sums(&traces, degree))
    }

    /// An enclosure of an element, at most `2⁻ᵇⁱᵗˢ` wide; it has one binary place more.
    pub fn enclose(&self, element: &Polynomial, bits: u32) -> Interval {
        narrow(bits, |working| self.enclose_roughly(element, working))
    }

    /// An enclosure with this number of binary places, whose width tends to zero as `bits` grows.
    pub(super) fn enclose_roughly(&self, element: &Polynomial, bits: u32) -> Interval {
        match element.as_constant() {
            Some(value) => Interval::enclosing(&value, bits),
            None => self.primitive.enclose(bits).evaluate(element),
        }
    }

    /// The sign of an element.
    pub fn sign(&self, element: &Polynomial) -> Ordering {
        if element.is_zero() {
            return Ordering::Equal;
        }
        let mut bits = 64;
        loop {
            if let Some(sign) = self.enclose_roughly(element, bits).sign() {
                return sign;
            }
            bits *= 2;
        }
    }

    fn basis(&self) -> &Basis {
        self.basis
            .get_or_init(|| Basis::new(self, &self.generators))
    }

    /// The terms of an element in the printing basis.
    pub(super) fn terms(&self, element: &Polynomial) -> Vec<Term> {
        let basis = self.basis();
        let term = |(coefficient, name): (BigRational, &String)| Term {
            coefficient,
            name: name.clone(),
        };
        let coordinates = basis.coordinates(element).into_iter();
        coordinates.zip(basis.names()).map(term).collect()
    }

    /// An element as text: `1/2 - sqrt(3)/6`.
    ///
    /// The text is a sum of rational multiples of products of the generators, or of cosines of multiples
    /// of an angle. Parsed as an expression, it means the same number.
    pub fn display(&self, element: &Polynomial) -> String {
        sum(&self.terms(element))
    }
}

/// The largest degree for which the Euclidean algorithm is the faster way to an inverse.
const EUCLIDEAN_DEGREE: usize = 4;

/// `Tr f(θ)` from the traces of the powers of `θ`.
pub(super) fn trace(element: &Polynomial, power_sums: &[BigRational]) -> BigRational {
    let sum: BigRational = element
        .numerators()
        .iter()
        .zip(power_sums)
        .filter(|(n, _)| !n.is_zero())
        .map(|(n, s)| s * n)
        .sum();
    sum / element.denominator()
}

/// Raises the working precision until an enclosure is at most `2⁻ᵇⁱᵗˢ` wide, and rounds it to one binary
/// place more than that.
pub(super) fn narrow(bits: u32, enclose: impl Fn(u32) -> Interval) -> Interval {
    let mut working = bits + 16;
    loop {
        let interval = enclose(working);
        let width = &interval.high - &interval.low;
        // The ends go to multiples of 2⁻ᵇⁱᵗˢ⁻¹, which are at most two apart then.
        if width <= BigInt::one() << (working - bits - 1) {
            return interval.with_bits(bits + 1);
        }
        let excess = width.bits() as u32 + bits + 1 - working;
        working += excess.max(16) + 8;
    }
}

impl PartialEq for NumberField {
    fn eq(&self, other: &Self) -> bool {
        self.primitive == other.primitive && self.generators == other.generators
    }
}

impl Eq for NumberField {}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::arithmetic::rational::ratio;
    use crate::arithmetic::rounding::to_f64;
    use num_traits::Signed;
    use proptest::prelude::*;

    /// Fields below and above [`EUCLIDEAN_DEGREE`].
    fn fields() -> Vec<NumberField> {
        let two = Polynomial::from_integers(&[2]);
        let q = NumberField::rationals();
        let k = q.square_root(&two).expect("small").field;
        let cube = k.cube_root(&two).expect("small").field;
        let cosine = k.cosine(7).expect("small").field;
        vec![q, k, cube, cosine]
    }

    proptest! {
        #[test]
        fn elements_have_inverses_equations_and_enclosures(
            coefficients in prop::collection::vec((-9i64..10, 1i64..5), 6),
            bits in 1u32..300,
        ) {
            let rationals: Vec<BigRational> = coefficients.iter().map(|&(n, d)| ratio(n, d)).collect();
            for field in fields() {
                let x = field.reduce(&Polynomial::from_rationals(&rationals));
                match field.inverse(&x) {
                    None => prop_assert!(x.is_zero()),
                    Some(inverse) => {
                        prop_assert_eq!(field.multiply(&x, &inverse), Polynomial::one());
                        prop_assert_eq!(field.sign(&x), field.sign(&inverse));
                    }
                }
                let minimal = field.minimal_polynomial(&x);
                let value = minimal.coefficients().into_iter().rev().fold(Polynomial::zero(), |value, c| {
                    &field.multiply(&value, &x) + &Polynomial::constant(c)
                });
                prop_assert!(value.is_zero());
                prop_assert_eq!(minimal.degree() == Some(1), x.degree() <= Some(0));
                let interval = field.enclose(&x, bits);
                prop_assert_eq!(interval.bits(), bits + 1);
                prop_assert!(interval.high() - interval.low() <= BigRational::new(BigInt::one(), BigInt::one() << bits));
                let double = to_f64(&field.enclose(&x, 80).low());
                prop_assert!(to_f64(&interval.low()) <= double + 1e-12 && double - 1e-12 <= to_f64(&interval.high()));
            }
        }

        #[test]
        fn a_displayed_element_has_the_value_of_the_number(coefficients in prop::collection::vec((-9i64..10, 1i64..5), 6)) {
            let rationals: Vec<BigRational> = coefficients.iter().map(|&(n, d)| ratio(n, d)).collect();
            for field in fields() {
                let x = field.reduce(&Polynomial::from_rationals(&rationals));
                let value = |name: &str| -> f64 {
                    name.split('*').filter(|f| !f.is_empty()).map(|factor| match factor {
                        "sqrt(2)" => 2f64.sqrt(),
                        "cbrt(2)" => 2f64.cbrt(),
                        "cbrt(2)^2" => 4f64.cbrt(),
                        "cos(pi/7)" => (std::f64::consts::PI / 7.0).cos(),
                        // The factors of `cos(2*pi/7)`.
                        "cos(2" => (2.0 * std::f64::consts::PI / 7.0).cos(),
                        "pi/7)" => 1.0,
                        other => panic!("{other}"),
                    }).product()
                };
                let sum: f64 = field.terms(&x).iter().map(|t| to_f64(&t.coefficient) * value(&t.name)).sum();
                let expected = to_f64(&field.enclose(&x, 60).low());
                prop_assert!((sum - expected).abs() < 1e-9 * (1.0 + expected.abs()));
            }
        }
    }

    #[test]
    fn a_tiny_number_has_a_sign_and_a_long_inverse() {
        let k = &fields()[1];
        // (1 − √2)¹⁰⁰ is about 10⁻³⁸.
        let tiny = k.power(&(&Polynomial::one() - &Polynomial::variable()), 100);
        assert_eq!(k.sign(&tiny), Ordering::Greater);
        assert_eq!(k.sign(&-&tiny), Ordering::Less);
        let inverse = k.inverse(&tiny).expect("not zero");
        assert!(k.enclose(&inverse, 10).low().is_positive());
        assert_eq!(k.inverse(&Polynomial::zero()), None);
        assert_eq!(k.sign(&Polynomial::zero()), Ordering::Equal);
    }

    #[test]
    fn fields_are_equal_if_their_generators_are() {
        assert_eq!(fields(), fields());
        assert_ne!(fields()[2], fields()[3]);
    }
}
