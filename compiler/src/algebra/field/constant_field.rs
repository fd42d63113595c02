//! Rational functions of one transcendental number over a real number field.

use num_rational::BigRational;

use super::function_ring::FunctionRing;
use super::{Extension, FieldElement, NumberField, Transcendental};
use crate::arithmetic::enclosure_cache::EnclosureCache;
use crate::arithmetic::polynomial::Polynomial;

/// The largest multiple of an angle, and the largest power of an exponential, that is formed.
const MAX_MULTIPLE: u32 = 400;

/// A field of constants: `Q(θ)` with real algebraic `θ`, or the rational functions of a transcendental
/// number `X` over it.
///
/// A rational function of `X` vanishes only if it is the zero function, so exact arithmetic with functions
/// is exact arithmetic with numbers.
#[derive(Debug, Clone)]
pub struct ConstantField {
    algebraic: NumberField,
    transcendental: Option<Transcendental>,
    /// The enclosure of `X`.
    pub(super) finest: EnclosureCache,
}

impl ConstantField {
    /// The field of real algebraic numbers `Q(θ)`, or the rational functions over it.
    pub fn new(algebraic: NumberField, transcendental: Option<Transcendental>) -> Self {
        ConstantField {
            algebraic,
            transcendental,
            finest: EnclosureCache::default(),
        }
    }

    /// The field of the rational numbers.
    pub fn rationals() -> Self {
        ConstantField::new(NumberField::rationals(), None)
    }

    /// The algebraic numbers of this field.
    pub fn algebraic(&self) -> &NumberField {
        &self.algebraic
    }

    /// The number `X`, if there is one.
    pub fn generator(&self) -> Option<Transcendental> {
        self.transcendental
    }

    /// The same field over a larger number field.
    pub fn extended(&self, extension: &Extension) -> Self {
        ConstantField {
            algebraic: extension.field.clone(),
            transcendental: self.transcendental,
            finest: self.finest.clone(),
        }
    }

    /// An element of the field before an extension, as an element of the extended field.
    pub fn embed(extension: &Extension, element: &FieldElement) -> FieldElement {
        let embed = |list: &[Polynomial]| list.iter().map(|c| extension.embed(c)).collect();
        FieldElement {
            numerator: embed(&element.numerator),
            denominator: embed(&element.denominator),
        }
    }

    fn ring(&self) -> FunctionRing<'_> {
        FunctionRing {
            field: &self.algebraic,
        }
    }

    /// The element 0.
    pub fn zero(&self) -> FieldElement {
        FieldElement::new(Vec::new())
    }

    /// The element 1.
    pub fn one(&self) -> FieldElement {
        FieldElement::new(vec![Polynomial::one()])
    }

    /// A rational number.
    pub fn rational(&self, value: BigRational) -> FieldElement {
        self.from_algebraic(&Polynomial::constant(value))
    }

    /// A polynomial in `θ`.
    pub fn from_algebraic(&self, element: &Polynomial) -> FieldElement {
        let element = self.algebraic.reduce(element);
        FieldElement::new(if element.is_zero() {
            Vec::new()
        } else {
            vec![element]
        })
    }

    /// The number `X`; `None` if the field has no transcendental number.
    pub fn transcendental(&self) -> Option<FieldElement> {
        self.transcendental
            .map(|_| FieldElement::new(vec![Polynomial::zero(), Polynomial::one()]))
    }

    /// `exp(k/n)` where `X = exp(1/n)`; `None` for another `X`, and for `|k| > 400`.
    pub fn exponential(&self, k: i32) -> Option<FieldElement> {
        let Some(Transcendental::Exponential { .. }) = self.transcendental else {
            return None;
        };
        if k.unsigned_abs() > MAX_MULTIPLE {
            return None;
        }
        self.power(&self.transcendental()?, k)
    }

    /// `(sin(k/n), cos(k/n))` where `X = tan(1/(2n))`; `None` for another `X`, and for `|k| > 400`.
    pub fn sine_cosine(&self, k: i32) -> Option<(FieldElement, FieldElement)> {
        let Some(Transcendental::HalfAngleTangent { .. }) = self.transcendental else {
            return None;
        };
        let size = k.unsigned_abs();
        if size > MAX_MULTIPLE {
            return None;
        }
        // exp(iφ) = ((1 + iX)/(1 − iX)) = (1 + iX)²/(1 + X²) for φ = 1/n.
        let (mut cosine, mut sine) = (Polynomial::one(), Polynomial::zero());
        let x = Polynomial::variable();
        for _ in 0..2 * size {
            (cosine, sine) = (&cosine - &(&x * &sine), &sine + &(&x * &cosine));
        }
        let denominator = Polynomial::from_integers(&[1, 0, 1]).power(size);
        if k < 0 {
            sine = -&sine;
        }
        let coefficients = |p: &Polynomial| -> Vec<Polynomial> {
            let coefficients = p.coefficients().into_iter();
            coefficients.map(Polynomial::constant).collect()
        };
        // |(1 + iX)²ᵏ| = (1 + X²)ᵏ: the parts have only constant common divisors with it.
        let fraction = |numerator: &Polynomial| {
            self.reduced(coefficients(numerator), coefficients(&denominator))
        };
        Some((fraction(&sine), fraction(&cosine)))
    }

    /// A fraction in lowest terms; the denominator is nonzero.
    fn reduced(&self, numerator: Vec<Polynomial>, denominator: Vec<Polynomial>) -> FieldElement {
        let ring = self.ring();
        let gcd = ring.gcd(&numerator, &denominator);
        if gcd.len() <= 1 {
            return self.monic(numerator, denominator);
        }
        self.monic(
            ring.divide(&numerator, &gcd),
            ring.divide(&denominator, &gcd),
        )
    }

    /// A fraction of coprime polynomials.
    fn monic(&self, numerator: Vec<Polynomial>, denominator: Vec<Polynomial>) -> FieldElement {
        if numerator.is_empty() {
            return self.zero();
        }
        match denominator.last().and_then(|c| self.algebraic.inverse(c)) {
            Some(inverse) if inverse != Polynomial::one() => {
                let ring = self.ring();
                FieldElement {
                    numerator: ring.scale(&numerator, &inverse),
                    denominator: ring.scale(&denominator, &inverse),
                }
            }
            _ => FieldElement {
                numerator,
                denominator,
            },
        }
    }

    /// The sum.
    pub fn add(&self, left: &FieldElement, right: &FieldElement) -> FieldElement {
        let ring = self.ring();
        if left.is_polynomial() && right.is_polynomial() {
            return FieldElement::new(ring.add(&left.numerator, &right.numerator));
        }
        if left.denominator == right.denominator {
            let sum = ring.add(&left.numerator, &right.numerator);
            return self.reduced(sum, left.denominator.clone());
        }
        // Henrici: only common divisors of the denominators can remain.
        let gcd = ring.gcd(&left.denominator, &right.denominator);
        let [a, b] = [left, right].map(|x| ring.divide(&x.denominator, &gcd));
        let sum = ring.add(
            &ring.multiply(&left.numerator, &b),
            &ring.multiply(&right.numerator, &a),
        );
        let common = ring.gcd(&sum, &gcd);
        let product = ring.multiply(&a, &right.denominator);
        if common.len() <= 1 {
            return self.monic(sum, product);
        }
        self.monic(ring.divide(&sum, &common), ring.divide(&product, &common))
    }

    /// The element with the opposite sign.
    pub fn negate(&self, element: &FieldElement) -> FieldElement {
        FieldElement {
            numerator: self.ring().negate(&element.numerator),
            denominator: element.denominator.clone(),
        }
    }

    /// The difference.
    pub fn subtract(&self, left: &FieldElement, right: &FieldElement) -> FieldElement {
        self.add(left, &self.negate(right))
    }

    /// The product.
    pub fn multiply(&self, left: &FieldElement, right: &FieldElement) -> FieldElement {
        let ring = self.ring();
        if left.is_zero() || right.is_zero() {
            return self.zero();
        }
        if left.is_polynomial() && right.is_polynomial() {
            return FieldElement::new(ring.multiply(&left.numerator, &right.numerator));
        }
        // Only a numerator and the other denominator can have a common divisor.
        let cancel = |numerator: &[Polynomial], denominator: &[Polynomial]| {
            let gcd = ring.gcd(numerator, denominator);
            (ring.divide(numerator, &gcd), ring.divide(denominator, &gcd))
        };
        let (a, d) = cancel(&left.numerator, &right.denominator);
        let (c, b) = cancel(&right.numerator, &left.denominator);
        FieldElement {
            numerator: ring.multiply(&a, &c),
            denominator: ring.multiply(&b, &d),
        }
    }

    /// The inverse; `None` for zero.
    pub fn inverse(&self, element: &FieldElement) -> Option<FieldElement> {
        (!element.is_zero())
            .then(|| self.monic(element.denominator.clone(), element.numerator.clone()))
    }

    /// The quotient; `None` if the divisor is zero.
    pub fn divide(&self, left: &FieldElement, right: &FieldElement) -> Option<FieldElement> {
        Some(self.multiply(left, &self.inverse(right)?))
    }

    /// The power `xⁿ`; `None` for a negative power of zero.
    pub fn power(&self, element: &FieldElement, exponent: i32) -> Option<FieldElement> {
        let base = if exponent < 0 {
            self.inverse(element)?
        } else {
            element.clone()
        };
        // Powers of coprime polynomials are coprime.
        let ring = self.ring();
        let power = |base: &[Polynomial]| {
            let (mut result, mut square) = (vec![Polynomial::one()], base.to_vec());
            let mut rest = exponent.unsigned_abs();
            while rest > 0 {
                if rest & 1 == 1 {
                    result = ring.multiply(&result, &square);
                }
                rest >>= 1;
                if rest > 0 {
                    square = ring.multiply(&square, &square);
                }
            }
            result
        };
        Some(FieldElement {
            numerator: power(&base.numerator),
            denominator: power(&base.denominator),
        })
    }
}

impl PartialEq for ConstantField {
    fn eq(&self, other: &Self) -> bool {
        self.algebraic == other.algebraic && self.transcendental == other.transcendental
    }
}

impl Eq for ConstantField {}

#[cfg(test)]
mod tests {
    use super::super::constant_enclosure::tests::value;
    use super::*;
    use crate::arithmetic::rational::ratio;
    use proptest::prelude::*;
    use std::cmp::Ordering;
    use std::num::NonZeroU32;

    #[test]
    fn sines_and_cosines_have_their_values_and_relations() {
        let three = NonZeroU32::MIN.saturating_add(2);
        let field = ConstantField::new(
            NumberField::rationals(),
            Some(Transcendental::HalfAngleTangent { denominator: three }),
        );
        for k in -7..=7 {
            let (sine, cosine) = field.sine_cosine(k).expect("small");
            let angle = f64::from(k) / 3.0;
            assert!((value(&field, &sine) - angle.sin()).abs() < 1e-14);
            assert!((value(&field, &cosine) - angle.cos()).abs() < 1e-14);
            let sum = field.add(
                &field.multiply(&sine, &sine),
                &field.multiply(&cosine, &cosine),
            );
            assert_eq!(sum, field.one());
        }
        let (sine, cosine) = field.sine_cosine(1).expect("small");
        let double = field.multiply(
            &field.rational(ratio(2, 1)),
            &field.multiply(&sine, &cosine),
        );
        assert_eq!(Some(double), field.sine_cosine(2).map(|pair| pair.0));
        assert_eq!(field.sine_cosine(401), None);
        assert_eq!(field.exponential(1), None);
    }

    #[test]
    fn exponentials_multiply() {
        let two = NonZeroU32::MIN.saturating_add(1);
        let field = ConstantField::new(
            NumberField::rationals(),
            Some(Transcendental::Exponential { denominator: two }),
        );
        let e = |k| field.exponential(k).expect("small");
        assert_eq!(field.multiply(&e(-3), &e(5)), e(2));
        assert_eq!(field.divide(&e(1), &e(1)), Some(field.one()));
        assert!((value(&field, &e(-3)) - (-1.5f64).exp()).abs() < 1e-15);
        assert_eq!(field.sign(&field.subtract(&e(1), &e(2))), Ordering::Less);
    }

    type Coefficients = Vec<(i64, i64)>;

    fn element() -> impl Strategy<Value = (Coefficients, Coefficients)> {
        let list = |n| prop::collection::vec((-5i64..5, -2i64..2), n);
        (list(0..4), list(1..4))
    }

    proptest! {
        #[test]
        fn the_field_axioms_hold(a in element(), b in element(), c in element()) {
            let two = Polynomial::from_integers(&[2]);
            let algebraic = NumberField::rationals().square_root(&two).expect("small").field;
            let field = ConstantField::new(algebraic, Some(Transcendental::Pi));
            let x = field.transcendental().expect("pi");
            let polynomial = |list: &[(i64, i64)]| list.iter().fold(field.zero(), |sum, &(u, v)| {
                field.add(&field.multiply(&sum, &x), &field.from_algebraic(&Polynomial::from_integers(&[u, v])))
            });
            let make = |(n, d): &(Coefficients, Coefficients)| field.divide(&polynomial(n), &polynomial(d));
            let (Some(a), Some(b), Some(c)) = (make(&a), make(&b), make(&c)) else { return Ok(()) };
            prop_assert_eq!(field.add(&a, &b), field.add(&b, &a));
            prop_assert_eq!(field.add(&field.add(&a, &b), &c), field.add(&a, &field.add(&b, &c)));
            prop_assert_eq!(field.multiply(&field.multiply(&a, &b), &c), field.multiply(&a, &field.multiply(&b, &c)));
            prop_assert_eq!(
                field.multiply(&field.add(&a, &b), &c),
                field.add(&field.multiply(&a, &c), &field.multiply(&b, &c))
            );
            prop_assert_eq!(field.subtract(&field.add(&a, &b), &b), a.clone());
            if !b.is_zero() {
                let quotient = field.divide(&a, &b).expect("not zero");
                prop_assert_eq!(field.multiply(&quotient, &b), a.clone());
            }
            prop_assert_eq!(field.power(&a, 3), Some(field.multiply(&a, &field.multiply(&a, &a))));
            let product = field.multiply(&a, &c);
            let sign = |x: &FieldElement| field.sign(x) as i32;
            prop_assert_eq!(sign(&product), sign(&a) * sign(&c));
        }
    }
}
