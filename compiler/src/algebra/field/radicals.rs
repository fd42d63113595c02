//! Square and cube roots of the elements of a number field.

use std::cmp::Ordering;

use num_bigint::BigInt;
use num_integer::Integer;
use num_rational::BigRational;
use num_traits::{One, Zero};

use super::{Extension, Notation, NumberField};
use crate::arithmetic::interval::Interval;
use crate::arithmetic::polynomial::Polynomial;
use crate::arithmetic::rational::ratio;

impl NumberField {
    /// The field with the square root of an element.
    ///
    /// `None` for a negative element, and in the cases of [`NumberField::adjoin`].
    pub fn square_root(&self, element: &Polynomial) -> Option<Extension> {
        match self.sign(element) {
            Ordering::Less => None,
            Ordering::Equal => Some(self.containing(Polynomial::zero())),
            Ordering::Greater => self.radical(element, 2),
        }
    }

    /// The field with the cube root of an element.
    ///
    /// `None` in the cases of [`NumberField::adjoin`].
    pub fn cube_root(&self, element: &Polynomial) -> Option<Extension> {
        match self.sign(element) {
            Ordering::Less => {
                let mut extension = self.radical(&-element, 3)?;
                extension.number = -&extension.number;
                Some(extension)
            }
            Ordering::Equal => Some(self.containing(Polynomial::zero())),
            Ordering::Greater => self.radical(element, 3),
        }
    }

    /// The field with a root of a positive element.
    fn radical(&self, element: &Polynomial, degree: u32) -> Option<Extension> {
        // Powers of rationals are taken out of the root: ⁿ√(sⁿ x) = s ⁿ√x.
        let content = content(self.terms(element).iter().map(|term| &term.coefficient));
        let (outside, inside) = split_power(&content, degree);
        let radicand = element.scale(&(BigRational::from_integer(inside) / content));
        if radicand == Polynomial::one() {
            return Some(self.containing(Polynomial::constant(outside)));
        }
        if degree == 2
            && let Some(square) = radicand.as_constant()
            && let Some(root) = self.known_square_root(&square)
        {
            return Some(self.containing(root.scale(&outside)));
        }
        let function = if degree == 2 { "sqrt" } else { "cbrt" };
        let name = format!("{function}({})", self.display(&radicand));
        let mut equation = vec![Polynomial::zero(); degree as usize + 1];
        equation[0] = -&radicand;
        equation[degree as usize] = Polynomial::one();
        let enclose = |bits| root(&self.enclose_roughly(&radicand, bits), degree);
        let mut extension = self.adjoin_root(&equation, &enclose, Notation::Powers(name))?;
        extension.number = extension.number.scale(&outside);
        Some(extension)
    }

    /// The square root of a rational, if it is a rational multiple of a product of generators that are
    /// square roots of rationals.
    ///
    /// [`NumberField::adjoin_root`] also finds these, but slowly in a field with many square roots.
    fn known_square_root(&self, radicand: &BigRational) -> Option<Polynomial> {
        let mut products = vec![(Polynomial::one(), BigRational::one())];
        for (_, value) in self.generators() {
            if let Some(square) = self.multiply(value, value).as_constant() {
                let longer: Vec<_> = products
                    .iter()
                    .map(|(x, s)| (self.multiply(x, value), s * &square))
                    .collect();
                products.extend(longer);
            }
        }
        products.iter().find_map(|(product, square)| {
            // √r = √(r p²)/|p| = √(r p²) |p|/p²
            let (outside, inside) = split_power(&(radicand * square), 2);
            inside.is_one().then(|| {
                let root = product.scale(&(outside / square));
                if self.sign(&root) == Ordering::Less {
                    -&root
                } else {
                    root
                }
            })
        })
    }
}

/// The positive rational such that the quotients of these rationals by it are coprime integers.
fn content<'a>(values: impl Iterator<Item = &'a BigRational>) -> BigRational {
    let (numerator, denominator) = values.fold((BigInt::zero(), BigInt::one()), |(n, d), x| {
        (n.gcd(x.numer()), d.lcm(x.denom()))
    });
    if numerator.is_zero() {
        BigRational::one()
    } else {
        BigRational::new(numerator, denominator)
    }
}

/// Writes a positive rational as `sⁿ k` with a whole number `k` free of the n-th powers of small primes.
fn split_power(value: &BigRational, degree: u32) -> (BigRational, BigInt) {
    // ⁿ√(a/b) = ⁿ√(a bⁿ⁻¹)/b
    let mut inside = value.numer() * value.denom().pow(degree - 1);
    let mut outside = BigRational::new(BigInt::one(), value.denom().clone());
    let whole = inside.nth_root(degree);
    if whole.pow(degree) == inside {
        return (outside * BigRational::from_integer(whole), BigInt::one());
    }
    for prime in 2u32..2000 {
        let power = BigInt::from(prime).pow(degree);
        while (&inside % &power).is_zero() {
            inside /= &power;
            outside *= ratio(prime.into(), 1);
        }
    }
    (outside, inside)
}

/// The n-th roots of the non-negative numbers in an interval.
fn root(interval: &Interval, degree: u32) -> Interval {
    let scaled = |end: &BigInt| end.max(&BigInt::zero()) << (interval.bits * (degree - 1));
    Interval {
        low: scaled(&interval.low).nth_root(degree),
        high: scaled(&interval.high).nth_root(degree) + 1u32,
        bits: interval.bits,
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    fn integer(value: i64) -> Polynomial {
        Polynomial::from_integers(&[value])
    }

    /// The field with the square roots of some integers, and these roots.
    fn with_square_roots(values: &[i64]) -> (NumberField, Vec<Polynomial>) {
        let mut field = NumberField::rationals();
        let mut roots: Vec<Polynomial> = Vec::new();
        for &value in values {
            let extension = field.square_root(&integer(value)).expect("small");
            roots = roots.iter().map(|x| extension.embed(x)).collect();
            roots.push(extension.number.clone());
            field = extension.field;
        }
        (field, roots)
    }

    #[test]
    fn products_of_roots_are_roots_of_products() {
        let (field, roots) = with_square_roots(&[2, 3, 6]);
        assert_eq!(field.degree(), 4);
        assert_eq!(field.multiply(&roots[0], &roots[1]), roots[2]);
        assert_eq!(
            field.display(&roots[2].scale(&ratio(1, 5))),
            "sqrt(2)*sqrt(3)/5"
        );
        assert_eq!(
            field.minimal_polynomial(&roots[2]),
            Polynomial::from_integers(&[-6, 0, 1])
        );
        let inverse = field.inverse(&(&roots[0] + &roots[1])).expect("not zero");
        assert_eq!(field.display(&inverse), "-sqrt(2) + sqrt(3)");
    }

    #[test]
    fn powers_leave_the_root() {
        let (field, roots) = with_square_roots(&[8, 18, 49]);
        assert_eq!(field.degree(), 2);
        let shown: Vec<String> = roots.iter().map(|x| field.display(x)).collect();
        assert_eq!(shown, ["2*sqrt(2)", "3*sqrt(2)", "7"]);
        let q = NumberField::rationals();
        let third = q
            .square_root(&Polynomial::constant(ratio(1, 3)))
            .expect("small");
        assert_eq!(third.field.display(&third.number), "sqrt(3)/3");
        let cube = q
            .cube_root(&Polynomial::constant(ratio(-16, 27)))
            .expect("small");
        assert_eq!(cube.field.display(&cube.number), "-2*cbrt(2)/3");
        let square = cube.field.power(&cube.number, 2);
        assert_eq!(cube.field.display(&square), "4*cbrt(2)^2/9");
    }

    #[test]
    fn many_square_roots_are_related_quickly() {
        let (field, roots) = with_square_roots(&[2, 3, 5, 7, 11, 210, 66]);
        assert_eq!(field.degree(), 32);
        assert_eq!(field.display(&roots[5]), "sqrt(2)*sqrt(3)*sqrt(5)*sqrt(7)");
        assert_eq!(field.multiply(&roots[6], &roots[6]), integer(66));
        // The generator is the negative root here.
        let number = crate::arithmetic::algebraic_number::AlgebraicNumber::real_root(
            &Polynomial::from_integers(&[-3, 0, 1]),
            1,
        );
        let q = NumberField::rationals();
        let negative = q.adjoin(&number.expect("a root"), Notation::Powers("r".to_owned()));
        let negative = negative.expect("small").field;
        let root = negative.square_root(&integer(12)).expect("small");
        assert_eq!(negative.display(&root.number), "-2*r");
    }

    #[test]
    fn square_roots_of_field_elements_extend_the_field_only_if_needed() {
        let (k, roots) = with_square_roots(&[2]);
        // √(8 + 4√2) = 2 √(2 + √2)
        let nested = k
            .square_root(&(&integer(8) + &roots[0].scale(&ratio(4, 1))))
            .expect("small");
        assert_eq!(nested.field.degree(), 4);
        assert_eq!(nested.field.display(&nested.number), "2*sqrt(2 + sqrt(2))");
        // √(3 + 2√2) = 1 + √2
        let inside = k
            .square_root(&(&integer(3) + &roots[0].scale(&ratio(2, 1))))
            .expect("small");
        assert_eq!(inside.field, k);
        assert_eq!(k.display(&inside.number), "1 + sqrt(2)");
        // ∛(7 + 5√2) = 1 + √2
        let inside = k
            .cube_root(&(&integer(7) + &roots[0].scale(&ratio(5, 1))))
            .expect("small");
        assert_eq!(k.display(&inside.number), "1 + sqrt(2)");
        assert_eq!(k.square_root(&-&roots[0]), None);
        assert_eq!(
            k.square_root(&Polynomial::zero()).expect("small").number,
            Polynomial::zero()
        );
        // √2 is √(2 + √2)² − 2 in the larger field.
        let again = nested.field.square_root(&integer(2)).expect("small");
        assert_eq!(again.field, nested.field);
        assert_eq!(again.number, nested.embed(&roots[0]));
    }

    #[test]
    fn enclosures_and_signs_agree_with_doubles() {
        let (field, roots) = with_square_roots(&[2, 3, 5, 7]);
        assert_eq!(field.degree(), 16);
        let sum = roots.iter().fold(Polynomial::zero(), |sum, x| &sum + x);
        let value = 2f64.sqrt() + 3f64.sqrt() + 5f64.sqrt() + 7f64.sqrt();
        for bits in [10, 50, 400] {
            let interval = field.enclose(&sum, bits);
            assert!(
                interval.high() - interval.low()
                    <= BigRational::new(BigInt::one(), BigInt::one() << bits)
            );
            let low = crate::arithmetic::rounding::to_f64(&interval.low());
            assert!((low - value).abs() < 1e-2);
        }
        let hidden = &sum - &Polynomial::constant(crate::arithmetic::rounding::exact(value));
        assert_ne!(field.sign(&hidden), Ordering::Equal);
        assert_eq!(field.sign(&-&sum), Ordering::Less);
        let inverse = field.inverse(&sum).expect("not zero");
        assert_eq!(field.multiply(&inverse, &sum), Polynomial::one());
    }
}
