//! Polynomials over the field of constants of an algebra, with roots from enclosures of the coefficients.

use std::cmp::Ordering;
use std::sync::{Arc, OnceLock};

use num_bigint::BigInt;
use num_rational::BigRational;

use super::Coefficient;
use super::budget::Budget;
use super::isolation::{monotonic, narrow};
use super::polynomial::{RealPolynomial, SHORT};
use crate::algebra::{Ball, Field, Image, Scalar, StageAlgebra};
use crate::arithmetic::interval::Interval;
use crate::arithmetic::polynomial::Polynomial;
use crate::arithmetic::rational::ratio;
use crate::arithmetic::roots::{Root, compare};

/// A polynomial over the field of constants of an algebra.
///
/// A number that the field cannot distinguish from zero is taken to be zero. Results are then verified
/// only to the precision to which the field verifies.
#[derive(Debug)]
pub(super) struct FieldPolynomial<A: StageAlgebra> {
    algebra: Arc<A>,
    budget: Arc<Budget>,
    /// The constant first; the leading coefficient is nonzero.
    coefficients: Vec<Scalar<A>>,
    /// Enclosures of the coefficients for each of [`PRECISIONS`], computed on demand.
    enclosures: [OnceLock<Vec<Ball>>; PRECISIONS.len()],
    /// The positive roots if enclosures separate them, computed on demand.
    roots: OnceLock<Option<Vec<Root>>>,
}

/// Bits of enclosures. Signs that the last enclosures do not determine are found exactly, or stay unknown.
const PRECISIONS: [u32; 6] = [256, 1 << 10, 1 << 12, 1 << 14, 1 << 16, 1 << 18];
/// The number of [`PRECISIONS`] that are tried to separate roots.
const TRIED: usize = 3;
/// Bits of the enclosures that are tried for every point if the coefficients are known to any precision.
const USUAL: u64 = 1 << 12;
/// Bits, beyond those of the point, by which a value near a root is distinguished from zero.
const NEAR: u64 = 1 << 10;
/// Approximate cost of an inverse, in products.
const INVERSE: u64 = 8;
/// Approximate cost of a failed search for roots that are too close, in products of machine words per bit of the enclosures.
const FAILURE: u64 = 1 << 15;

impl<A: StageAlgebra + 'static> Clone for FieldPolynomial<A> {
    fn clone(&self) -> Self {
        FieldPolynomial {
            enclosures: self.enclosures.clone(),
            roots: self.roots.clone(),
            ..self.with(self.coefficients.clone())
        }
    }
}

impl<A: StageAlgebra + 'static> FieldPolynomial<A> {
    /// The polynomial with these coefficients, the constant first.
    pub(super) fn new(
        algebra: &Arc<A>,
        budget: &Arc<Budget>,
        mut coefficients: Vec<Scalar<A>>,
    ) -> Self {
        let field = algebra.constants();
        while coefficients.last().is_some_and(|x| field.zero(x).may_be()) {
            coefficients.pop();
        }
        FieldPolynomial {
            algebra: Arc::clone(algebra),
            budget: Arc::clone(budget),
            coefficients,
            enclosures: Default::default(),
            roots: OnceLock::new(),
        }
    }

    fn with(&self, coefficients: Vec<Scalar<A>>) -> Self {
        FieldPolynomial {
            algebra: Arc::clone(&self.algebra),
            budget: Arc::clone(&self.budget),
            coefficients,
            enclosures: Default::default(),
            roots: OnceLock::new(),
        }
    }

    fn trimmed(&self, coefficients: Vec<Scalar<A>>) -> Self {
        FieldPolynomial::new(&self.algebra, &self.budget, coefficients)
    }

    /// Enclosures of the coefficients, and their precision in bits.
    fn enclosed(&self, precision: usize) -> (&[Ball], u32) {
        let bits = PRECISIONS[precision];
        let enclose = |x| self.field().enclose(x, bits);
        let all = || self.coefficients.iter().map(enclose).collect();
        (self.enclosures[precision].get_or_init(all), bits)
    }

    /// The value at a rational point, enclosed.
    fn value_at(&self, point: &BigRational, precision: usize) -> Option<Ball> {
        let (list, bits) = self.enclosed(precision);
        let point = Ball::quotient(point, bits);
        let list = list.iter().rev().cloned();
        list.reduce(|value, c| value.multiply(&point, bits).add(&c, bits))
    }

    /// The cost of [`FieldPolynomial::value_at`] in products of machine words.
    fn cost_of_value(&self, precision: usize) -> u64 {
        let words = u64::from(PRECISIONS[precision] / 64);
        self.coefficients.len() as u64 * words * words
    }

    /// The value at a rational point, if enclosures determine its sign. They need more bits than a point near a root has.
    fn known_value(&self, point: &BigRational) -> Option<Ball> {
        let needed = match self.field().finest_bits() {
            Some(finest) => u64::from(finest),
            None => USUAL.max(point.denom().bits() + NEAR),
        };
        let is_enough = |&bits: &u32| u64::from(bits) >= needed;
        let tried = PRECISIONS.iter().position(is_enough);
        let tried = tried.map_or(PRECISIONS.len(), |k| k + 1);
        let known = |k| {
            if !self.is_exact() {
                self.budget.spend(self.cost_of_value(k));
            }
            let value = self.value_at(point, k).filter(|_| !self.budget.is_spent());
            value.filter(|value| value.sign().is_some())
        };
        (0..tried).find_map(known)
    }

    /// The positive roots, if they are simple and narrow enclosures separate them.
    fn roots(&self) -> Option<&[Root]> {
        let find = || {
            if self.degree().unwrap_or(0) == 0 {
                return Some(Vec::new());
            }
            let intervals = (0..TRIED).find_map(|k| {
                let (list, bits) = self.enclosed(k);
                let found = monotonic(list, bits);
                if found.is_none() && !self.is_exact() {
                    self.budget.spend(u64::from(bits) * FAILURE);
                }
                found.filter(|_| !self.budget.is_spent())
            });
            Some(
                intervals?
                    .into_iter()
                    .filter_map(|i| self.root_in(i))
                    .collect(),
            )
        };
        self.roots.get_or_init(find).as_deref()
    }

    /// The root in a half-open interval in which the polynomial is monotonic.
    fn root_in(&self, interval: Interval) -> Option<Root> {
        let signs = [interval.low(), interval.high()].map(|end| self.sign_at(&end));
        match signs {
            // The root is the end of another interval, or zero.
            [Ordering::Equal, _] => None,
            [_, Ordering::Equal] => Some(Root::Rational(interval.high())),
            [low, high] if low == high => None,
            _ => Some(Root::Irrational(interval)),
        }
    }

    /// Whether enclosures prove that this polynomial and another have no positive root in common.
    fn is_apart_from(&self, other: &Self) -> bool {
        let (Some(roots), Some(others)) = (self.roots(), other.roots()) else {
            return false;
        };
        let enclosed = |polynomial: &Self, roots: &[Root], bits| -> Vec<Interval> {
            let enclose = |root| polynomial.enclose_root(root, bits);
            roots.iter().map(enclose).collect()
        };
        [64, 256, 1024].into_iter().any(|bits| {
            let (all, others) = (enclosed(self, roots, bits), enclosed(other, others, bits));
            let mut pairs = all.iter().flat_map(|x| others.iter().map(move |y| (x, y)));
            pairs.all(|(x, y)| compare(x, y).is_some())
        })
    }

    fn euclid(&self, other: &Self) -> Self {
        let (mut a, mut b) = (self.signed_monic(), other.signed_monic());
        while !b.is_zero() && !self.budget.is_spent() {
            let remainder = a.remainder(&b).signed_monic();
            (a, b) = (b, remainder);
        }
        a
    }

    /// Whether the arithmetic of the field decides equality with zero.
    fn is_exact(&self) -> bool {
        self.field().verified_bits().is_none()
    }

    /// The product of elements, charged to the budget.
    fn product(&self, x: &Scalar<A>, y: &Scalar<A>) -> Scalar<A> {
        let field = self.field();
        self.budget.spend(field.length(x) * field.length(y));
        if self.budget.is_spent() {
            return self.integer(0);
        }
        field.multiply(x, y)
    }

    /// The coefficients in a finite field, if all are defined there and the leading coefficient is not
    /// zero.
    fn image(&self, image: &Image) -> Option<Vec<u64>> {
        let list: Option<Vec<u64>> = self
            .coefficients
            .iter()
            .map(|x| self.field().image(x, image))
            .collect();
        list.filter(|list| list.last().is_some_and(|&c| c != 0))
    }

    /// A bound on the degree of a greatest common divisor: its degree in a finite field in which the leading
    /// coefficients do not vanish. `None` if there is no such field.
    fn degree_of_gcd(&self, other: &Self) -> Option<usize> {
        let degree = |image: &Image| {
            let (a, b) = (self.image(image)?, other.image(image)?);
            image.field.gcd(&a, &b).len().checked_sub(1)
        };
        self.field().images().iter().filter_map(degree).min()
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
        let product = |x| self.product(x, factor);
        self.trimmed(self.coefficients.iter().map(product).collect())
    }

    /// The polynomial scaled to the leading coefficient ±1.
    fn signed_monic(&self) -> Self {
        let inverse = self.coefficients.last().and_then(|c| {
            self.budget.spend(INVERSE * self.field().length(c).pow(2));
            let affordable = !self.budget.is_spent();
            affordable.then(|| self.field().inverse(c)).flatten()
        });
        let Some(inverse) = inverse else {
            return self.clone();
        };
        let leading = self.coefficients.last();
        let negative = leading.is_some_and(|c| self.field().number(c).sign().is_lt());
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
                *sum = field.add(sum, &self.product(x, y));
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
            // The divisor times this factor cancels the leading term exactly.
            let factor = rest.pop().map(|top| self.product(&top, &inverse));
            let factor = factor.unwrap_or_else(|| self.integer(0));
            let shift = rest.len() - degree;
            for (x, d) in rest[shift..].iter_mut().zip(&divisor.coefficients) {
                *x = field.subtract(x, &self.product(&factor, d));
            }
            quotient.push(factor);
        }
        quotient.reverse();
        (self.trimmed(quotient), self.trimmed(rest))
    }

    fn gcd(&self, other: &Self) -> Self {
        if let (Some(m), Some(n)) = (self.degree(), other.degree()) {
            let bound = if m.min(n) == 0 {
                Some(0)
            } else {
                self.degree_of_gcd(other)
            };
            if bound == Some(0) {
                return self.with(vec![self.integer(1)]);
            }
            let (long, short) = if m < n { (other, self) } else { (self, other) };
            if bound == short.degree() && long.remainder(short).is_zero() {
                return short.signed_monic();
            }
        }
        self.euclid(other)
    }

    /// If zeros are known only from enclosures, the enclosures in Euclid's algorithm lose all their places when numbers
    /// differ much in size. So Euclid's algorithm runs only if enclosures do not separate the roots, and then the
    /// remaining factors must have separate roots.
    fn common_factor(&self, other: &Self) -> Self {
        let constant = [self, other].iter().any(|p| p.degree() == Some(0));
        if self.is_exact() || constant {
            return self.gcd(other);
        }
        if !self.is_zero() && !other.is_zero() && self.is_apart_from(other) {
            return self.with(vec![self.integer(1)]);
        }
        let common = self.gcd(other);
        let is_nothing = |p: &Self| p.is_zero() || common.degree() == Some(0);
        if is_nothing(self) || is_nothing(other) {
            return common;
        }
        let [rest, others] = [self, other].map(|p| p.divide(&common).0);
        if !rest.is_apart_from(&others) {
            self.field().doubt();
        }
        common
    }

    /// If enclosures separate the positive roots, each of them is simple.
    fn squarefree(&self) -> Self {
        let simple = self.degree().unwrap_or(0) < 2 || !self.is_exact() && self.roots().is_some();
        if simple {
            return self.clone();
        }
        self.divide(&self.common_factor(&self.derivative())).0
    }

    /// Divides from the lowest coefficients upwards, which needs only polynomials in the generators of the
    /// field.
    fn quotient_from_below(&self, divisor: &Self) -> Self {
        let length = (self.coefficients.len() + 1).saturating_sub(divisor.coefficients.len());
        let mut rest = self.coefficients.clone();
        for k in 0..length {
            let (done, above) = rest.split_at_mut(k + 1);
            for (x, d) in above.iter_mut().zip(divisor.coefficients.iter().skip(1)) {
                *x = self.field().subtract(x, &self.product(&done[k], d));
            }
        }
        rest.truncate(length);
        self.trimmed(rest)
    }

    fn is_multiple_of(&self, divisor: &Self) -> bool {
        if !self.is_exact() && !self.is_zero() && self.is_apart_from(divisor) {
            return false;
        }
        let rest = |image: &Image| {
            let (a, b) = (self.image(image)?, divisor.image(image)?);
            Some(image.field.remainder(&a, &b))
        };
        let mut rests = self.field().images().iter().filter_map(rest);
        !rests.any(|rest| !rest.is_empty()) && self.remainder(divisor).is_zero()
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
        if let Some(sign) = self.known_value(point).and_then(|value| value.sign()) {
            return sign;
        }
        let field = self.field();
        let point = field.rational(point);
        let value = self
            .coefficients
            .iter()
            .rev()
            .cloned()
            .reduce(|value, c| field.add(&self.product(&value, &point), &c));
        value.map_or(Ordering::Equal, |value| field.number(&value).sign())
    }

    /// Found from enclosures of the coefficients: the polynomial is squarefree, so narrow enclosures separate its
    /// roots.
    fn positive_roots(&self) -> Option<Vec<Root>> {
        if self.budget.is_spent() {
            return None;
        }
        self.roots().map(<[Root]>::to_vec)
    }

    fn enclose_root(&self, root: &Root, bits: u32) -> Interval {
        let Root::Irrational(interval) = root else {
            let value = root.rational().cloned().unwrap_or_default();
            return Interval::enclosing(&value, bits);
        };
        let exact = self.is_exact();
        narrow(interval, bits, |point| match self.known_value(point) {
            None if exact => Some(Ball::of_sign(self.sign_at(point))),
            known => known,
        })
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
        let square = field.subtract(&self.integer(0), &square);
        if let Some(value) = field.number(&square).short_rational() {
            let linear = &Polynomial::variable() - &Polynomial::constant(value.clone());
            return linear.square_root_text(&Root::Rational(value));
        }
        let text = field.exact(&square)?;
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

    fn finest_bits(&self) -> Option<u32> {
        self.field().finest_bits()
    }

    fn as_rational(&self) -> Option<&Polynomial> {
        None
    }
}
