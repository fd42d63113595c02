//! Enclosures and signs of the elements of a field of constants.

use std::cmp::Ordering;

use num_bigint::BigInt;
use num_traits::One;

use super::number_field::narrow;
use super::{ConstantField, FieldElement};
use crate::arithmetic::interval::Interval;
use crate::arithmetic::polynomial::Polynomial;

impl ConstantField {
    /// An enclosure of an element, at most `2⁻ᵇⁱᵗˢ` wide; it has one binary place more.
    pub fn enclose(&self, element: &FieldElement, bits: u32) -> Interval {
        narrow(bits, |working| self.enclose_roughly(element, working))
    }

    /// An enclosure with this number of binary places, whose width tends to zero as `bits` grows.
    fn enclose_roughly(&self, element: &FieldElement, bits: u32) -> Interval {
        if let Some(number) = element.as_algebraic() {
            return self.algebraic().enclose_roughly(&number, bits);
        }
        let unknown = Interval {
            low: -(BigInt::one() << (2 * bits)),
            high: BigInt::one() << (2 * bits),
            bits,
        };
        let Some(transcendental) = self.generator() else {
            return unknown;
        };
        let x = self
            .finest
            .enclose(bits, |bits| transcendental.enclose(bits));
        let evaluate = |polynomial: &[Polynomial]| {
            let zero = Interval {
                low: BigInt::default(),
                high: BigInt::default(),
                bits,
            };
            polynomial.iter().rev().fold(zero, |value, c| {
                value
                    .multiply(&x)
                    .add(&self.algebraic().enclose_roughly(c, bits))
            })
        };
        let numerator = evaluate(&element.numerator);
        if element.is_polynomial() {
            return numerator;
        }
        // A denominator is nonzero; more places will separate it from zero.
        let denominator = evaluate(&element.denominator);
        numerator.divide(&denominator).unwrap_or(unknown)
    }

    /// The sign of an element.
    pub fn sign(&self, element: &FieldElement) -> Ordering {
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
}

#[cfg(test)]
pub(super) mod tests {
    use super::super::{NumberField, Transcendental};
    use super::*;
    use crate::arithmetic::rational::ratio;
    use crate::arithmetic::rounding::to_f64;
    use num_rational::BigRational;

    /// The value of an element, after a check of the width of its enclosure.
    pub(crate) fn value(field: &ConstantField, element: &FieldElement) -> f64 {
        let interval = field.enclose(element, 100);
        assert!(
            interval.high() - interval.low()
                <= BigRational::new(BigInt::one(), BigInt::one() << 100)
        );
        to_f64(&interval.low())
    }

    #[test]
    fn a_hidden_cancellation_is_resolved() {
        // (π − 355/113)⁻¹ is about −3.7 million.
        let field = ConstantField::new(NumberField::rationals(), Some(Transcendental::Pi));
        let pi = field.transcendental().expect("pi");
        let small = field.subtract(&pi, &field.rational(ratio(355, 113)));
        assert_eq!(field.sign(&small), Ordering::Less);
        let large = field.inverse(&small).expect("not zero");
        let expected = 1.0 / -2.667_641_890_624_223_7e-7;
        assert!((value(&field, &large) / expected - 1.0).abs() < 1e-9);
        assert_eq!(field.inverse(&field.zero()), None);
        assert_eq!(field.power(&field.zero(), -1), None);
        assert_eq!(field.power(&field.zero(), 0), Some(field.one()));
    }
}
