//! Polynomials over the field of constants of an algebra, with Sturm's theorem.

use std::cmp::Ordering;
use std::sync::Arc;

use num_bigint::BigInt;
use num_rational::BigRational;
use num_traits::{One, Zero};

use super::Coefficient;
use super::polynomial::{RealPolynomial, SHORT};
use crate::algebra::{Field, Scalar, StageAlgebra};
use crate::arithmetic::interval::Interval;
use crate::arithmetic::polynomial::Polynomial;
use crate::arithmetic::rational::ratio;
use crate::arithmetic::roots::Root;

/// A polynomial over the field of constants of an algebra.
///
/// Where the field cannot tell a number from zero, it is taken for zero, and what is found is verified
/// only as far as the field verifies.
#[derive(Debug)]
pub(super) struct FieldPolynomial<A: StageAlgebra> {
    algebra: Arc<A>,
    /// The constant first; the last one is not zero.
    coefficients: Vec<Scalar<A>>,
}

impl<A: StageAlgebra> Clone for FieldPolynomial<A> {
    fn clone(&self) -> Self {
        self.with(self.coefficients.clone())
    }
}

impl<A: StageAlgebra> FieldPolynomial<A> {
    /// The polynomial with these coefficients, the constant first.
    pub(super) fn new(algebra: &Arc<A>, mut coefficients: Vec<Scalar<A>>) -> Self {
        let field = algebra.constants();
        while coefficients.last().is_some_and(|x| field.zero(x).may_be()) {
            coefficients.pop();
        }
        FieldPolynomial {
            algebra: Arc::clone(algebra),
            coefficients,
        }
    }

    fn with(&self, coefficients: Vec<Scalar<A>>) -> Self {
        FieldPolynomial {
            algebra: Arc::clone(&self.algebra),
            coefficients,
        }
    }

    fn trimmed(&self, coefficients: Vec<Scalar<A>>) -> Self {
        FieldPolynomial::new(&self.algebra, coefficients)
    }

    fn field(&self) -> &A::Constants {
        self.algebra.constants()
    }

    fn integer(&self, value: i64) -> Scalar<A> {
        self.field().rational(&ratio(value, 1))
    }

    fn combine(
        &self,
        other: &Self,
        operation: impl Fn(&Scalar<A>, &Scalar<A>) -> Scalar<A>,
    ) -> Self {
        let zero = self.integer(0);
        let length = self.coefficients.len().max(other.coefficients.len());
        let at =
            |list: &[Scalar<A>], k: usize| list.get(k).cloned().unwrap_or_else(|| zero.clone());
        let sum = |k| operation(&at(&self.coefficients, k), &at(&other.coefficients, k));
        self.trimmed((0..length).map(sum).collect())
    }

    fn times(&self, factor: &Scalar<A>) -> Self {
        let product = |x| self.field().multiply(x, factor);
        self.trimmed(self.coefficients.iter().map(product).collect())
    }

    /// With the leading coefficient ±1.
    fn signed_monic(&self) -> Self {
        let Some(inverse) = self
            .coefficients
            .last()
            .and_then(|c| self.field().inverse(c))
        else {
            return self.clone();
        };
        let negative = self.field().number(&inverse).sign().is_lt();
        let size = if negative {
            self.field().subtract(&self.integer(0), &inverse)
        } else {
            inverse
        };
        self.times(&size)
    }

    fn coefficient(&self, element: &Scalar<A>) -> Coefficient {
        let number = self.field().number(element);
        Coefficient::of(&number, self.field().exact(element))
    }
}

impl<A: StageAlgebra + 'static> FieldPolynomial<A> {
    /// Sturm's sequence of a squarefree polynomial.
    fn sturm(&self) -> Vec<Self> {
        let mut sequence = vec![self.signed_monic(), self.derivative().signed_monic()];
        while let [.., a, b] = sequence.as_slice()
            && !b.is_zero()
        {
            // Positive multiples do not change signs.
            let next = a.remainder(b).scale(&ratio(-1, 1)).signed_monic();
            sequence.push(next);
        }
        sequence
    }
}

/// The number of sign changes, zeros left out.
fn changes(signs: impl Iterator<Item = Ordering>) -> usize {
    let signs: Vec<Ordering> = signs.filter(|sign| sign.is_ne()).collect();
    signs.windows(2).filter(|pair| pair[0] != pair[1]).count()
}

impl<A: StageAlgebra + 'static> RealPolynomial for FieldPolynomial<A> {
    fn constant(&self, value: &BigRational) -> Self {
        self.trimmed(vec![self.field().rational(value)])
    }

    fn add(&self, other: &Self) -> Self {
        self.combine(other, |x, y| self.field().add(x, y))
    }

    fn subtract(&self, other: &Self) -> Self {
        self.combine(other, |x, y| self.field().subtract(x, y))
    }

    fn multiply(&self, other: &Self) -> Self {
        if self.is_zero() || other.is_zero() {
            return self.with(Vec::new());
        }
        let field = self.field();
        let length = self.coefficients.len() + other.coefficients.len() - 1;
        let mut product = vec![self.integer(0); length];
        for (i, x) in self.coefficients.iter().enumerate() {
            for (sum, y) in product[i..].iter_mut().zip(&other.coefficients) {
                *sum = field.add(sum, &field.multiply(x, y));
            }
        }
        self.trimmed(product)
    }

    fn scale(&self, factor: &BigRational) -> Self {
        self.times(&self.field().rational(factor))
    }

    fn shift(&self) -> Self {
        let mut coefficients = vec![self.integer(0)];
        coefficients.extend(self.coefficients.iter().cloned());
        self.trimmed(coefficients)
    }

    fn over_constant_of(&self, other: &Self) -> Self {
        let inverse = other
            .coefficients
            .first()
            .and_then(|c| self.field().inverse(c));
        inverse.map_or_else(|| self.clone(), |inverse| self.times(&inverse))
    }

    fn degree(&self) -> Option<usize> {
        self.coefficients.len().checked_sub(1)
    }

    fn divide(&self, divisor: &Self) -> (Self, Self) {
        let field = self.field();
        let inverse = divisor.coefficients.last().and_then(|c| field.inverse(c));
        let (Some(inverse), Some(degree)) = (inverse, divisor.degree()) else {
            return (self.with(Vec::new()), self.clone());
        };
        let mut rest = self.coefficients.clone();
        let mut quotient = Vec::new();
        while rest.len() > degree {
            // The divisor times this takes the leading term away, exactly.
            let factor = rest.pop().map(|top| field.multiply(&top, &inverse));
            let factor = factor.unwrap_or_else(|| self.integer(0));
            let shift = rest.len() - degree;
            for (x, d) in rest[shift..].iter_mut().zip(&divisor.coefficients) {
                *x = field.subtract(x, &field.multiply(&factor, d));
            }
            quotient.push(factor);
        }
        quotient.reverse();
        (self.trimmed(quotient), self.trimmed(rest))
    }

    fn gcd(&self, other: &Self) -> Self {
        let (mut a, mut b) = (self.signed_monic(), other.signed_monic());
        while !b.is_zero() {
            let remainder = a.remainder(&b).signed_monic();
            (a, b) = (b, remainder);
        }
        a
    }

    fn derivative(&self) -> Self {
        let term = |(k, x): (usize, &Scalar<A>)| {
            let factor = BigRational::from_integer(BigInt::from(k));
            self.field().multiply(x, &self.field().rational(&factor))
        };
        self.trimmed(
            self.coefficients
                .iter()
                .enumerate()
                .skip(1)
                .map(term)
                .collect(),
        )
    }

    fn on_imaginary_axis(&self) -> (Self, Self) {
        let part = |first: usize| {
            let chosen = self.coefficients.iter().skip(first).step_by(2).enumerate();
            let signed = |(k, c): (usize, &Scalar<A>)| {
                if k % 2 == 0 {
                    c.clone()
                } else {
                    self.field().subtract(&self.integer(0), c)
                }
            };
            self.trimmed(chosen.map(signed).collect())
        };
        (part(0), part(1))
    }

    fn even_part(&self) -> Self {
        let mut coefficients = self.coefficients.clone();
        let odd = coefficients.iter_mut().skip(1).step_by(2);
        odd.for_each(|c| *c = self.integer(0));
        self.trimmed(coefficients)
    }

    fn leading_sign(&self) -> Ordering {
        let leading = self.coefficients.last();
        leading.map_or(Ordering::Equal, |c| self.field().number(c).sign())
    }

    fn sign_at(&self, point: &BigRational) -> Ordering {
        let field = self.field();
        let point = field.rational(point);
        let value = self
            .coefficients
            .iter()
            .rev()
            .cloned()
            .reduce(|value, c| field.add(&field.multiply(&value, &point), &c));
        value.map_or(Ordering::Equal, |value| field.number(&value).sign())
    }

    /// By Sturm's theorem, which holds over every ordered field.
    fn positive_roots(&self) -> Vec<Root> {
        if self.degree().unwrap_or(0) == 0 {
            return Vec::new();
        }
        let sequence = self.sturm();
        let dyadic =
            |value: &BigInt, bits: u32| BigRational::new(value.clone(), BigInt::one() << bits);
        let count = |value: &BigInt, bits: u32| {
            let point = dyadic(value, bits);
            changes(sequence.iter().map(|p| p.sign_at(&point)))
        };
        let beyond = changes(sequence.iter().map(Self::leading_sign));
        let mut bound = BigInt::one();
        while count(&bound, 0) != beyond {
            bound <<= 1;
        }
        let mut roots = Vec::new();
        // Half-open intervals (low, high]·2⁻ᵇⁱᵗˢ, the leftmost on top.
        let mut pending = vec![(BigInt::zero(), bound, 0u32)];
        while let Some((low, high, bits)) = pending.pop() {
            let inside = count(&low, bits).saturating_sub(count(&high, bits));
            let ends = [&low, &high].map(|end| self.sign_at(&dyadic(end, bits)));
            match (inside, ends) {
                (0, _) => {}
                (1, [_, Ordering::Equal]) => roots.push(Root::Rational(dyadic(&high, bits))),
                // A lower end that is another root has to be left behind.
                (1, [sign, _]) if sign.is_ne() => {
                    roots.push(Root::Irrational(Interval { low, high, bits }))
                }
                _ => {
                    let (low, high) = (low << 1, high << 1);
                    let middle: BigInt = (&low + &high) >> 1;
                    pending.push((middle.clone(), high, bits + 1));
                    pending.push((low, middle, bits + 1));
                }
            }
        }
        roots
    }

    fn enclose_root(&self, root: &Root, bits: u32) -> Interval {
        let Root::Irrational(interval) = root else {
            let value = root.rational().cloned().unwrap_or_default();
            return Interval::enclosing(&value, bits);
        };
        let Interval {
            mut low,
            mut high,
            bits: mut places,
        } = interval.clone();
        let below = self.sign_at(&interval.low());
        while places < bits || &high - &low > BigInt::one() << (places - bits) {
            (low, high, places) = (low << 1, high << 1, places + 1);
            let middle: BigInt = (&low + &high) >> 1;
            let point = BigRational::new(middle.clone(), BigInt::one() << places);
            match self.sign_at(&point) {
                Ordering::Equal => return Interval::enclosing(&point, bits),
                sign if sign == below => low = middle,
                _ => high = middle,
            }
        }
        let excess = places - bits;
        Interval {
            low: low >> excess,
            high: -((-high) >> excess),
            bits,
        }
    }

    fn square_root_text(&self, root: &Root) -> Option<String> {
        if let Some(value) = root.rational() {
            let linear = &Polynomial::variable() - &Polynomial::constant(value.clone());
            return linear.square_root_text(root);
        }
        let [constant, slope] = self.coefficients.as_slice() else {
            return None;
        };
        let field = self.field();
        let square = field.multiply(constant, &field.inverse(slope)?);
        let text = field.exact(&field.subtract(&self.integer(0), &square))?;
        (text.len() <= SHORT).then(|| format!("sqrt({text})"))
    }

    fn coefficients(&self) -> Vec<Coefficient> {
        self.coefficients
            .iter()
            .map(|x| self.coefficient(x))
            .collect()
    }

    fn leading_ratio(&self, other: &Self) -> Coefficient {
        let field = self.field();
        let zero = || self.integer(0);
        let top = self.coefficients.last().cloned().unwrap_or_else(zero);
        let inverse = other.coefficients.last().and_then(|c| field.inverse(c));
        self.coefficient(&field.multiply(&top, &inverse.unwrap_or_else(zero)))
    }

    fn as_rational(&self) -> Option<&Polynomial> {
        None
    }
}
