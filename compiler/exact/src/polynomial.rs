//! Polynomials in one variable with rational coefficients.

use std::cmp::Ordering;
use std::fmt;
use std::ops::{Add, Mul, Neg, Sub};

use num_bigint::BigInt;
use num_rational::BigRational;
use num_traits::{One, Signed, Zero};

use super::common_divisor;
use super::gcd::gcd;

/// A polynomial over the rationals, lowest degree first.
///
/// It is stored as integer coefficients over a common denominator, in lowest terms. So products of long polynomials
/// need no greatest common divisor per term. Equal polynomials have equal representations.
#[derive(Clone, PartialEq, Eq, Hash)]
pub struct Polynomial {
    /// The last numerator is not zero.
    numerators: Vec<BigInt>,
    /// Positive.
    denominator: BigInt,
}

impl Polynomial {
    /// The polynomial with these integer coefficients, lowest degree first, over a denominator that is
    /// not zero.
    pub fn new(mut numerators: Vec<BigInt>, mut denominator: BigInt) -> Self {
        while numerators.last().is_some_and(Zero::is_zero) {
            numerators.pop();
        }
        let mut common = denominator.clone();
        for numerator in &numerators {
            if common.is_one() {
                break;
            }
            common = gcd(&common, numerator);
        }
        if numerators.is_empty() {
            common = denominator.clone();
        }
        if denominator.is_negative() != common.is_negative() {
            common = -common;
        }
        if !common.is_one() {
            denominator /= &common;
            for numerator in &mut numerators {
                *numerator /= &common;
            }
        }
        Polynomial {
            numerators,
            denominator,
        }
    }

    /// The zero polynomial.
    pub fn zero() -> Self {
        Polynomial {
            numerators: Vec::new(),
            denominator: BigInt::one(),
        }
    }

    /// A constant.
    pub fn constant(value: BigRational) -> Self {
        let (numerator, denominator) = value.into();
        Polynomial::new(vec![numerator], denominator)
    }

    /// The constant 1.
    pub fn one() -> Self {
        Polynomial::constant(BigRational::one())
    }

    /// The variable itself.
    pub fn variable() -> Self {
        Polynomial::monomial(1)
    }

    /// The power `xᵏ`.
    pub fn monomial(power: usize) -> Self {
        let mut numerators = vec![BigInt::zero(); power];
        numerators.push(BigInt::one());
        Polynomial::new(numerators, BigInt::one())
    }

    /// The polynomial with these integer coefficients, lowest degree first.
    pub fn from_integers(coefficients: &[i64]) -> Self {
        Polynomial::new(
            coefficients.iter().map(|&c| c.into()).collect(),
            BigInt::one(),
        )
    }

    /// The polynomial with these coefficients, lowest degree first.
    pub fn from_rationals(coefficients: &[BigRational]) -> Self {
        let denominator = coefficients.iter().fold(BigInt::one(), |lcm, c| {
            &lcm / gcd(&lcm, c.denom()) * c.denom()
        });
        let numerators = coefficients
            .iter()
            .map(|c| c.numer() * (&denominator / c.denom()))
            .collect();
        Polynomial::new(numerators, denominator)
    }

    /// The degree; `None` for the zero polynomial.
    pub fn degree(&self) -> Option<usize> {
        self.numerators.len().checked_sub(1)
    }

    /// Whether this is the zero polynomial.
    pub fn is_zero(&self) -> bool {
        self.numerators.is_empty()
    }

    /// The value, if the polynomial is constant.
    pub fn as_constant(&self) -> Option<BigRational> {
        (self.numerators.len() <= 1).then(|| self.coefficient(0))
    }

    /// The coefficient of `xᵏ`.
    pub fn coefficient(&self, power: usize) -> BigRational {
        let numerator = self.numerators.get(power).cloned().unwrap_or_default();
        if self.denominator.is_one() {
            return BigRational::from_integer(numerator);
        }
        let common = gcd(&numerator, &self.denominator);
        BigRational::new_raw(numerator / &common, &self.denominator / common)
    }

    /// All coefficients, lowest degree first.
    pub fn coefficients(&self) -> Vec<BigRational> {
        (0..self.numerators.len())
            .map(|k| self.coefficient(k))
            .collect()
    }

    /// The leading coefficient; zero for the zero polynomial.
    pub fn leading(&self) -> BigRational {
        self.coefficient(self.numerators.len().saturating_sub(1))
    }

    /// The integer coefficients over the common [`Self::denominator`], lowest degree first.
    pub fn numerators(&self) -> &[BigInt] {
        &self.numerators
    }

    /// The common denominator of all coefficients, positive.
    pub fn denominator(&self) -> &BigInt {
        &self.denominator
    }

    /// The multiple with coprime integer coefficients and a positive leading one.
    pub fn primitive(&self) -> Self {
        let content = self
            .numerators
            .iter()
            .fold(BigInt::zero(), |content, n| gcd(&content, n));
        let content = if self.leading().is_negative() {
            -content
        } else {
            content
        };
        Polynomial {
            numerators: self.numerators.iter().map(|n| n / &content).collect(),
            denominator: BigInt::one(),
        }
    }

    /// The multiple by the common denominator or its negative: integer coefficients, not necessarily coprime, with a
    /// positive leading coefficient.
    pub fn whole_multiple(&self) -> Self {
        let whole = Polynomial {
            numerators: self.numerators.clone(),
            denominator: BigInt::one(),
        };
        if whole.leading().is_negative() {
            -&whole
        } else {
            whole
        }
    }

    /// The product with a number.
    pub fn scale(&self, factor: &BigRational) -> Self {
        let numerators = self.numerators.iter().map(|n| n * factor.numer()).collect();
        Polynomial::new(numerators, &self.denominator * factor.denom())
    }

    /// The power `selfⁿ`.
    pub fn power(&self, exponent: u32) -> Self {
        let (mut result, mut square, mut rest) = (Polynomial::one(), self.clone(), exponent);
        while rest > 0 {
            if rest & 1 == 1 {
                result = &result * &square;
            }
            rest >>= 1;
            if rest > 0 {
                square = &square * &square;
            }
        }
        result
    }

    /// The value at a rational point.
    pub fn evaluate(&self, x: &BigRational) -> BigRational {
        // Homogeneous Horner scheme: integers only, one reduction at the end.
        let mut value = BigInt::zero();
        let mut power = BigInt::one();
        for numerator in self.numerators.iter().rev() {
            value = value * x.numer() + numerator * &power;
            power *= x.denom();
        }
        // `power` has one factor `x.denom()` too many.
        BigRational::new(value * x.denom(), &self.denominator * power)
    }

    /// The sign of the value at a rational point, without bringing the value to lowest terms.
    pub fn sign_at(&self, x: &BigRational) -> Ordering {
        let mut value = BigInt::zero();
        let mut power = BigInt::one();
        for numerator in self.numerators.iter().rev() {
            value = value * x.numer() + numerator * &power;
            power *= x.denom();
        }
        value.cmp(&BigInt::zero())
    }

    /// The composition `self(inner(x))`.
    pub fn compose(&self, inner: &Polynomial) -> Self {
        self.coefficients()
            .iter()
            .rev()
            .fold(Polynomial::zero(), |value, c| {
                &(&value * inner) + &Polynomial::constant(c.clone())
            })
    }

    /// The derivative.
    pub fn derivative(&self) -> Self {
        let numerators = self
            .numerators
            .iter()
            .enumerate()
            .skip(1)
            .map(|(k, n)| n * BigInt::from(k))
            .collect();
        Polynomial::new(numerators, self.denominator.clone())
    }

    /// The antiderivative that vanishes at 0.
    pub fn antiderivative(&self) -> Self {
        let mut coefficients = vec![BigRational::zero()];
        coefficients.extend(
            self.coefficients()
                .into_iter()
                .enumerate()
                .map(|(k, c)| c / BigRational::from_integer(BigInt::from(k + 1))),
        );
        Polynomial::from_rationals(&coefficients)
    }

    /// Quotient and remainder; `None` if the divisor is zero.
    pub fn div_rem(&self, divisor: &Polynomial) -> Option<(Self, Self)> {
        let degree = divisor.degree()?;
        let leading = &divisor.numerators[degree];
        // Pseudo-division: over the integers, every step multiplies by the divisor's leading coefficient.
        let mut remainder = self.numerators.clone();
        let mut quotient = vec![
            BigInt::zero();
            (self.numerators.len() + 1).saturating_sub(divisor.numerators.len())
        ];
        let mut multiplier = BigInt::one();
        while remainder.len() > degree {
            let top = remainder.pop().unwrap_or_default();
            let shift = remainder.len() - degree;
            if top.is_zero() {
                continue;
            }
            if !leading.is_one() {
                let common = gcd(&top, leading);
                let (top, leading) = (&top / &common, leading / common);
                remainder.iter_mut().for_each(|r| *r *= &leading);
                quotient.iter_mut().for_each(|q| *q *= &leading);
                multiplier *= &leading;
                for (r, d) in remainder[shift..].iter_mut().zip(&divisor.numerators) {
                    *r -= &top * d;
                }
                quotient[shift] += top;
            } else {
                for (r, d) in remainder[shift..].iter_mut().zip(&divisor.numerators) {
                    *r -= &top * d;
                }
                quotient[shift] += top;
            }
        }
        quotient.iter_mut().for_each(|q| *q *= &divisor.denominator);
        let denominator = &self.denominator * multiplier;
        Some((
            Polynomial::new(quotient, denominator.clone()),
            Polynomial::new(remainder, denominator),
        ))
    }

    /// The remainder of the division; `self` if the divisor is zero.
    pub fn remainder(&self, divisor: &Polynomial) -> Self {
        match (self.degree(), divisor.degree()) {
            (Some(n), Some(d)) if n >= d => self
                .div_rem(divisor)
                .map_or_else(|| self.clone(), |(_, r)| r),
            _ => self.clone(),
        }
    }

    /// The greatest common divisor, with coprime integer coefficients; zero if both are zero.
    pub fn gcd(&self, other: &Polynomial) -> Self {
        common_divisor::gcd(self, other)
    }

    /// The inverse modulo another polynomial.
    ///
    /// # Errors
    /// If there is no inverse: the primitive common divisor of both.
    pub fn inverse_modulo(&self, modulus: &Polynomial) -> Result<Self, Self> {
        // Extended Euclidean algorithm; invariant: r ≡ t·self modulo the modulus.
        let (mut r0, mut t0) = (modulus.clone(), Polynomial::zero());
        let (mut r1, mut t1) = (self.remainder(modulus), Polynomial::one());
        while let Some((q, r)) = r0.div_rem(&r1) {
            let t = &t0 - &(&q * &t1);
            (r0, t0, r1, t1) = (r1, t1, r, t);
        }
        match r0.as_constant() {
            Some(constant) if !constant.is_zero() => {
                Ok(t0.scale(&constant.recip()).remainder(modulus))
            }
            _ => Err(r0.primitive()),
        }
    }

    /// The polynomial written with a given name of the variable, highest degree first.
    pub fn display<'a>(&'a self, variable: &'a str) -> impl fmt::Display + 'a {
        struct Display<'a>(&'a Polynomial, &'a str);
        impl fmt::Display for Display<'_> {
            fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
                let mut first = true;
                for (power, c) in self.0.coefficients().into_iter().enumerate().rev() {
                    if c.is_zero() {
                        continue;
                    }
                    f.write_str(match (first, c.is_negative()) {
                        (true, false) => "",
                        (true, true) => "-",
                        (false, false) => " + ",
                        (false, true) => " - ",
                    })?;
                    first = false;
                    let size = c.abs();
                    match (power, size.is_one()) {
                        (0, _) => write!(f, "{size}")?,
                        (_, true) => f.write_str(self.1)?,
                        (_, false) => write!(f, "{size}*{}", self.1)?,
                    }
                    if power > 1 {
                        write!(f, "^{power}")?;
                    }
                }
                if first { f.write_str("0") } else { Ok(()) }
            }
        }
        Display(self, variable)
    }
}

impl fmt::Debug for Polynomial {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        write!(f, "{}", self.display("x"))
    }
}

/// `left + sign·right`, over the least common denominator.
fn combine(left: &Polynomial, right: &Polynomial, sign: i32) -> Polynomial {
    let common = gcd(&left.denominator, &right.denominator);
    let denominator = &left.denominator / common * &right.denominator;
    let (l, r) = (
        &denominator / &left.denominator,
        &denominator / &right.denominator * sign,
    );
    let length = left.numerators.len().max(right.numerators.len());
    let numerators = (0..length)
        .map(
            |k| match (left.numerators.get(k), right.numerators.get(k)) {
                (Some(a), Some(b)) => a * &l + b * &r,
                (Some(a), None) => a * &l,
                (None, Some(b)) => b * &r,
                (None, None) => BigInt::zero(),
            },
        )
        .collect();
    Polynomial::new(numerators, denominator)
}

impl Add for &Polynomial {
    type Output = Polynomial;
    fn add(self, other: &Polynomial) -> Polynomial {
        combine(self, other, 1)
    }
}

impl Sub for &Polynomial {
    type Output = Polynomial;
    fn sub(self, other: &Polynomial) -> Polynomial {
        combine(self, other, -1)
    }
}

impl Mul for &Polynomial {
    type Output = Polynomial;
    fn mul(self, other: &Polynomial) -> Polynomial {
        if self.is_zero() || other.is_zero() {
            return Polynomial::zero();
        }
        let mut numerators =
            vec![BigInt::zero(); self.numerators.len() + other.numerators.len() - 1];
        for (i, a) in self
            .numerators
            .iter()
            .enumerate()
            .filter(|(_, a)| !a.is_zero())
        {
            for (sum, b) in numerators[i..].iter_mut().zip(&other.numerators) {
                *sum += a * b;
            }
        }
        Polynomial::new(numerators, &self.denominator * &other.denominator)
    }
}

impl Neg for &Polynomial {
    type Output = Polynomial;
    fn neg(self) -> Polynomial {
        Polynomial {
            numerators: self.numerators.iter().map(|n| -n).collect(),
            denominator: self.denominator.clone(),
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::rational::ratio;
    use proptest::prelude::*;

    fn polynomial() -> impl Strategy<Value = Polynomial> {
        prop::collection::vec((-20i64..20, 1i64..12), 0..7).prop_map(|c| {
            Polynomial::from_rationals(&c.iter().map(|&(n, d)| ratio(n, d)).collect::<Vec<_>>())
        })
    }

    proptest! {
        #[test]
        fn division_leaves_a_smaller_remainder(a in polynomial(), b in polynomial()) {
            match a.div_rem(&b) {
                None => prop_assert!(b.is_zero()),
                Some((q, r)) => {
                    prop_assert_eq!(&(&q * &b) + &r, a);
                    prop_assert!(r.degree() < b.degree());
                }
            }
        }

        #[test]
        fn the_antiderivative_differentiates_back(a in polynomial()) {
            prop_assert_eq!(a.antiderivative().derivative(), a);
        }

        #[test]
        fn evaluation_is_a_homomorphism(a in polynomial(), b in polynomial(), n in -9i64..9, d in 1i64..9) {
            let x = ratio(n, d);
            prop_assert_eq!((&a * &b).evaluate(&x), a.evaluate(&x) * b.evaluate(&x));
            prop_assert_eq!((&a - &b).evaluate(&x), a.evaluate(&x) - b.evaluate(&x));
            prop_assert_eq!(a.compose(&b).evaluate(&x), a.evaluate(&b.evaluate(&x)));
        }

        #[test]
        fn the_gcd_divides_and_holds_common_factors(a in polynomial(), b in polynomial(), c in polynomial()) {
            prop_assume!(!a.is_zero() && !b.is_zero() && !c.is_zero());
            let gcd = (&a * &c).gcd(&(&b * &c));
            prop_assert!((&a * &c).remainder(&gcd).is_zero());
            prop_assert!(gcd.remainder(&c).is_zero());
        }
    }

    #[test]
    fn prints_like_mathematics() {
        let p = Polynomial::from_rationals(&[ratio(-1, 2), ratio(1, 1), ratio(0, 1), ratio(-7, 3)]);
        assert_eq!(p.display("t").to_string(), "-7/3*t^3 + t - 1/2");
        assert_eq!(Polynomial::zero().display("t").to_string(), "0");
    }
}
