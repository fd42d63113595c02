//! Real roots of rational polynomials in number fields.

use std::cmp::Ordering;

use super::{Extension, Notation, NumberField};
use crate::arithmetic::algebraic_number::AlgebraicNumber;
use crate::arithmetic::polynomial::Polynomial;
use crate::arithmetic::rational::ratio;

impl NumberField {
    /// The field with the real root of a polynomial with this index; the smallest root has
    /// index 1.
    ///
    /// Roots of quadratic factors are written with square roots, others as `root(t^3 - t - 1, 1)`.
    /// `None` if there are fewer real roots, and in the cases of [`NumberField::adjoin`].
    pub fn real_root(&self, polynomial: &Polynomial, index: usize) -> Option<Extension> {
        let number = AlgebraicNumber::real_root(polynomial, index)?;
        if number.degree() == 2 {
            return self.quadratic_root(&number);
        }
        let name = format!("root({}, {index})", polynomial.display("t"));
        self.adjoin(&number, Notation::Powers(name))
    }

    /// `(−b ± √(b² − 4ac))/(2a)`
    fn quadratic_root(&self, number: &AlgebraicNumber) -> Option<Extension> {
        let [c, b, a] = [0, 1, 2].map(|k| number.polynomial().coefficient(k));
        let discriminant = &b * &b - ratio(4, 1) * &a * c;
        let mut extension = self.square_root(&Polynomial::constant(discriminant))?;
        // The sign is that of 2ax + b, which is nonzero.
        let derivative = number.polynomial().derivative();
        let mut bits = 64;
        let sign = loop {
            if let Some(sign) = number.enclose(bits).evaluate(&derivative).sign() {
                break sign;
            }
            bits *= 2;
        };
        let root = match sign {
            Ordering::Less => -&extension.number,
            _ => extension.number,
        };
        let sum = &root - &Polynomial::constant(b);
        extension.number = sum.scale(&(ratio(2, 1) * a).recip());
        Some(extension)
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn roots_are_written_in_the_shortest_way() {
        let shown = |coefficients: &[i64], index| {
            let polynomial = Polynomial::from_integers(coefficients);
            let found = NumberField::rationals().real_root(&polynomial, index)?;
            Some(found.field.display(&found.number))
        };
        let some = |text: &str| Some(text.to_owned());
        assert_eq!(shown(&[1, -6, 6], 1), some("1/2 - sqrt(3)/6"));
        assert_eq!(shown(&[1, -6, 6], 2), some("1/2 + sqrt(3)/6"));
        assert_eq!(shown(&[-1, -1, 0, 1], 1), some("root(t^3 - t - 1, 1)"));
        // (t − 2)(t² − 2)
        assert_eq!(shown(&[4, -2, -2, 1], 3), some("2"));
        assert_eq!(shown(&[4, -2, -2, 1], 1), some("-sqrt(2)"));
        assert_eq!(shown(&[4, -2, -2, 1], 4), None);
        assert_eq!(shown(&[1, 0, 1], 1), None);
    }
}
