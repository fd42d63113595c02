//! Elements of a field of constants as text.

use num_bigint::BigInt;
use num_integer::Integer;
use num_rational::BigRational;
use num_traits::{One, Signed, Zero};

use super::notation::{Term, sum};
use super::{ConstantField, FieldElement, Transcendental};
use crate::arithmetic::polynomial::Polynomial;

impl ConstantField {
    /// An element as text: `1/2 - sqrt(3)/6`, `(pi - 4)/(4*pi)`, `exp(1/2) - 3*exp(-1/2)`.
    ///
    /// Parsed as an expression, the text means the same number.
    pub fn display(&self, element: &FieldElement) -> String {
        if let Some(number) = element.as_algebraic() {
            return self.algebraic().display(&number);
        }
        let Some(x) = self.generator() else {
            return String::new();
        };
        // A denominator that is a power of the exponential becomes negative exponents.
        let power = element.denominator().len() as i64 - 1;
        let rest = &element.denominator()[..power as usize];
        let is_power = rest.iter().all(Polynomial::is_zero);
        if power == 0 || x.has_negative_powers() && is_power {
            return sum(&in_order(self.terms(x, element.numerator(), -power)));
        }
        let numerator = self.terms(x, element.numerator(), 0);
        let denominator = self.terms(x, element.denominator(), 0);
        fraction(numerator, denominator)
    }

    /// The terms of a polynomial in `X`, the highest power first, with shifted exponents.
    fn terms(&self, x: Transcendental, polynomial: &[Polynomial], shift: i64) -> Vec<Term> {
        let mut terms = Vec::new();
        for (k, coefficient) in polynomial.iter().enumerate().rev() {
            let power = x.power(k as i64 + shift);
            for term in self.algebraic().terms(coefficient) {
                if term.coefficient.is_zero() {
                    continue;
                }
                let join = if term.name.is_empty() || power.is_empty() {
                    ""
                } else {
                    "*"
                };
                terms.push(Term {
                    coefficient: term.coefficient,
                    name: format!("{}{join}{power}", term.name),
                });
            }
        }
        terms
    }
}

/// Puts a positive term first if there is one at either end.
fn in_order(mut terms: Vec<Term>) -> Vec<Term> {
    let positive = |term: Option<&Term>| term.is_some_and(|t| t.coefficient.is_positive());
    if !positive(terms.first()) && positive(terms.last()) {
        terms.reverse();
    }
    terms
}

/// A fraction of sums with integer coefficients that have no common divisor.
fn fraction(mut numerator: Vec<Term>, mut denominator: Vec<Term>) -> String {
    let (mut divisor, mut multiple) = (BigInt::zero(), BigInt::one());
    for term in numerator.iter().chain(&denominator) {
        divisor = divisor.gcd(term.coefficient.numer());
        multiple = multiple.lcm(term.coefficient.denom());
    }
    let scale = BigRational::new(multiple, divisor);
    for term in numerator.iter_mut().chain(&mut denominator) {
        term.coefficient *= &scale;
    }
    // One minus sign is better than one for every term.
    let negative = numerator.iter().all(|term| term.coefficient.is_negative());
    if negative {
        for term in &mut numerator {
            term.coefficient = -&term.coefficient;
        }
    }
    let numerator = in_order(numerator);
    let (above, below) = (sum(&numerator), sum(&denominator));
    let above = if numerator.len() > 1 {
        format!("({above})")
    } else {
        above
    };
    // Only a name, a number or a power needs no parentheses after a division sign.
    let is_factor = denominator.len() == 1 && !below.contains('*');
    let below = if is_factor {
        below
    } else {
        format!("({below})")
    };
    format!("{}{above}/{below}", if negative { "-" } else { "" })
}

#[cfg(test)]
mod tests {
    use super::super::NumberField;
    use super::*;
    use crate::arithmetic::rational::ratio;
    use std::num::NonZeroU32;

    /// A field with `X`, and the quotient of two polynomials in `X` with integer coefficients.
    fn quotient(field: &ConstantField, above: &[i64], below: &[i64]) -> FieldElement {
        let x = field.transcendental().expect("a transcendental number");
        let [above, below] = [above, below].map(|list| {
            list.iter().rev().fold(field.zero(), |value, &c| {
                field.add(&field.multiply(&value, &x), &field.rational(ratio(c, 1)))
            })
        });
        field.divide(&above, &below).expect("not zero")
    }

    #[test]
    fn rational_functions_of_pi_are_written_like_by_hand() {
        let field = ConstantField::new(NumberField::rationals(), Some(Transcendental::Pi));
        let cases: [(&[i64], &[i64], &str); 14] = [
            (&[-2, 1], &[0, 2], "(pi - 2)/(2*pi)"),
            (&[-4, 1], &[0, 4], "(pi - 4)/(4*pi)"),
            (
                &[-4, -2, 1],
                &[0, -4, 2],
                "(pi^2 - 2*pi - 4)/(2*pi^2 - 4*pi)",
            ),
            (&[2], &[0, 1], "2/pi"),
            (&[-2], &[0, 1], "-2/pi"),
            (&[1], &[0, 0, 3], "1/(3*pi^2)"),
            (&[1], &[0, 0, 1], "1/pi^2"),
            (&[4, -1], &[0, 4], "(4 - pi)/(4*pi)"),
            (&[-4, -1], &[0, 4], "-(pi + 4)/(4*pi)"),
            (&[2, 0, 1], &[4], "pi^2/4 + 1/2"),
            (&[1, -2], &[2], "1/2 - pi"),
            (&[0, 2], &[-3, 1], "2*pi/(pi - 3)"),
            (&[0, -2], &[4, -1], "2*pi/(pi - 4)"),
            (&[6, 3], &[4, 2], "3/2"),
        ];
        for (above, below, text) in cases {
            assert_eq!(field.display(&quotient(&field, above, below)), text);
        }
    }

    #[test]
    fn exponentials_have_negative_powers() {
        let two = NonZeroU32::MIN.saturating_add(1);
        let field = ConstantField::new(
            NumberField::rationals(),
            Some(Transcendental::Exponential { denominator: two }),
        );
        let cases: [(&[i64], &[i64], &str); 6] = [
            (&[0, 0, 1], &[1], "e"),
            (&[1], &[0, 0, 1], "exp(-1)"),
            (&[-3, 0, 1], &[0, 2], "exp(1/2)/2 - 3*exp(-1/2)/2"),
            (&[-1, 1], &[-1, 0, 1], "1/(exp(1/2) + 1)"),
            (&[-1, 1], &[3, 0, 1], "(exp(1/2) - 1)/(e + 3)"),
            (&[0, 1], &[3, 0, 2], "exp(1/2)/(2*e + 3)"),
        ];
        for (above, below, text) in cases {
            assert_eq!(field.display(&quotient(&field, above, below)), text);
        }
    }

    #[test]
    fn algebraic_coefficients_are_expanded() {
        let two = Polynomial::from_integers(&[2]);
        let root = NumberField::rationals().square_root(&two).expect("small");
        let field = ConstantField::new(root.field.clone(), Some(Transcendental::Pi));
        let root = field.from_algebraic(&root.number);
        let pi = field.transcendental().expect("pi");
        let product = field.multiply(&root, &pi);
        assert_eq!(field.display(&product), "sqrt(2)*pi");
        let sum = field.add(&field.add(&product, &pi), &field.rational(ratio(-1, 3)));
        assert_eq!(field.display(&sum), "pi + sqrt(2)*pi - 1/3");
        // 1/(√2 π) = √2/(2π)
        let inverse = field.inverse(&product).expect("not zero");
        assert_eq!(field.display(&inverse), "sqrt(2)/(2*pi)");
        let one = NonZeroU32::MIN;
        let tangent = Transcendental::HalfAngleTangent { denominator: one };
        let field = ConstantField::new(NumberField::rationals(), Some(tangent));
        let (sine, cosine) = field.sine_cosine(1).expect("small");
        assert_eq!(field.display(&sine), "2*tan(1/2)/(tan(1/2)^2 + 1)");
        assert_eq!(field.display(&cosine), "(1 - tan(1/2)^2)/(tan(1/2)^2 + 1)");
    }
}
