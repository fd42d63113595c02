//! Polynomials in one variable over a number field.

use num_rational::BigRational;

use super::NumberField;
use crate::arithmetic::polynomial::Polynomial;

/// The polynomials in `X` over a number field: lists of coefficients, lowest degree first, the last one
/// nonzero.
#[derive(Debug, Clone, Copy)]
pub(super) struct FunctionRing<'a> {
    pub(super) field: &'a NumberField,
}

/// The polynomial with the same coefficients, if they all are rational.
///
/// Its arithmetic with integers over one denominator is much faster.
pub(super) fn as_rational(polynomial: &[Polynomial]) -> Option<Polynomial> {
    if let [constant] = polynomial {
        return (constant.degree() <= Some(0)).then(|| constant.clone());
    }
    let coefficients: Option<Vec<BigRational>> =
        polynomial.iter().map(Polynomial::as_constant).collect();
    Some(Polynomial::from_rationals(&coefficients?))
}

fn from_rational(polynomial: &Polynomial) -> Vec<Polynomial> {
    polynomial
        .coefficients()
        .into_iter()
        .map(Polynomial::constant)
        .collect()
}

fn trimmed(mut polynomial: Vec<Polynomial>) -> Vec<Polynomial> {
    while polynomial.last().is_some_and(Polynomial::is_zero) {
        polynomial.pop();
    }
    polynomial
}

impl FunctionRing<'_> {
    pub(super) fn add(&self, left: &[Polynomial], right: &[Polynomial]) -> Vec<Polynomial> {
        let (long, short) = if left.len() < right.len() {
            (right, left)
        } else {
            (left, right)
        };
        let mut sum = long.to_vec();
        for (x, y) in sum.iter_mut().zip(short) {
            *x = &*x + y;
        }
        trimmed(sum)
    }

    pub(super) fn negate(&self, polynomial: &[Polynomial]) -> Vec<Polynomial> {
        polynomial.iter().map(|c| -c).collect()
    }

    pub(super) fn scale(&self, polynomial: &[Polynomial], factor: &Polynomial) -> Vec<Polynomial> {
        if *factor == Polynomial::one() {
            return polynomial.to_vec();
        }
        polynomial
            .iter()
            .map(|c| self.field.multiply(c, factor))
            .collect()
    }

    pub(super) fn multiply(&self, left: &[Polynomial], right: &[Polynomial]) -> Vec<Polynomial> {
        match (left, right) {
            ([], _) | (_, []) => return Vec::new(),
            ([factor], other) | (other, [factor]) => return self.scale(other, factor),
            _ => {}
        }
        if let (Some(a), Some(b)) = (as_rational(left), as_rational(right)) {
            return from_rational(&(&a * &b));
        }
        let mut product = vec![Polynomial::zero(); left.len() + right.len() - 1];
        for (i, a) in left.iter().enumerate().filter(|(_, a)| !a.is_zero()) {
            for (x, b) in product[i..].iter_mut().zip(right) {
                *x = &*x + &(a * b);
            }
        }
        product.iter().map(|c| self.field.reduce(c)).collect()
    }

    /// Quotient and remainder of the division by a nonzero polynomial.
    pub(super) fn div_rem(
        &self,
        dividend: &[Polynomial],
        divisor: &[Polynomial],
    ) -> (Vec<Polynomial>, Vec<Polynomial>) {
        let Some((leading, rest)) = divisor.split_last() else {
            return (Vec::new(), dividend.to_vec());
        };
        if dividend.len() < divisor.len() {
            return (Vec::new(), dividend.to_vec());
        }
        if let (Some(a), Some(b)) = (as_rational(dividend), as_rational(divisor))
            && let Some((q, r)) = a.div_rem(&b)
        {
            return (from_rational(&q), from_rational(&r));
        }
        // Not zero, so it has an inverse.
        let inverse = self.field.inverse(leading).unwrap_or_else(Polynomial::one);
        let mut remainder = dividend.to_vec();
        let mut quotient = vec![Polynomial::zero(); dividend.len() - rest.len()];
        while remainder.len() > rest.len() {
            let top = remainder.pop().unwrap_or_else(Polynomial::zero);
            let top = self.field.multiply(&top, &inverse);
            let shift = remainder.len() - rest.len();
            if !top.is_zero() {
                for (x, d) in remainder[shift..].iter_mut().zip(rest) {
                    *x = &*x - &self.field.multiply(&top, d);
                }
            }
            quotient[shift] = top;
        }
        (trimmed(quotient), trimmed(remainder))
    }

    /// The quotient of an exact division.
    pub(super) fn divide(
        &self,
        dividend: &[Polynomial],
        divisor: &[Polynomial],
    ) -> Vec<Polynomial> {
        if let [constant] = divisor
            && let Some(inverse) = self.field.inverse(constant)
        {
            return self.scale(dividend, &inverse);
        }
        self.div_rem(dividend, divisor).0
    }
}

#[cfg(test)]
pub(super) mod tests {
    use super::*;
    use proptest::prelude::*;

    /// `Q(√2)`.
    pub(crate) fn field() -> NumberField {
        let two = Polynomial::from_integers(&[2]);
        NumberField::rationals()
            .square_root(&two)
            .expect("small")
            .field
    }

    /// Polynomials over `Q(√2)`.
    pub(crate) fn polynomial(length: usize) -> impl Strategy<Value = Vec<Polynomial>> {
        let coefficient = (-9i64..9, -2i64..2, 1i64..4).prop_map(|(a, b, d)| {
            Polynomial::from_integers(&[a, b]).scale(&crate::arithmetic::rational::ratio(1, d))
        });
        prop::collection::vec(coefficient, 0..length).prop_map(trimmed)
    }

    proptest! {
        #[test]
        fn division_leaves_a_smaller_remainder(a in polynomial(6), b in polynomial(4)) {
            let k = field();
            let ring = FunctionRing { field: &k };
            prop_assume!(!b.is_empty());
            let (q, r) = ring.div_rem(&a, &b);
            prop_assert!(r.len() < b.len());
            prop_assert_eq!(ring.add(&ring.multiply(&q, &b), &r), a.clone());
            prop_assert_eq!(ring.divide(&ring.multiply(&a, &b), &b), a);
        }
    }
}
