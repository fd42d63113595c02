//! Sums, products, powers and quotients of constants.

use std::cmp::Ordering;

use num_bigint::BigInt;
use num_integer::Integer;
use num_rational::BigRational;
use num_traits::{One, Signed, Zero};

use super::size::{check, check_bits, check_rational};
use super::{Constant, MAX_POWER, Tree};
use crate::arithmetic::polynomial::Polynomial;
use crate::arithmetic::rational;
use crate::error::ErrorKind;

impl Constant {
    /// The sum.
    ///
    /// # Errors
    /// Those of [`Constant`].
    pub fn add(&self, other: &Constant) -> Result<Constant, ErrorKind> {
        if let (Some(a), Some(b)) = (self.as_rational(), other.as_rational()) {
            return Self::rational(rational::add(a, b));
        }
        let (a, mut terms) = self.summands();
        let (b, more) = other.summands();
        terms.extend(more);
        linear_combination(rational::add(&a, &b), terms)
    }

    /// The difference.
    ///
    /// # Errors
    /// Those of [`Constant`].
    pub fn subtract(&self, other: &Constant) -> Result<Constant, ErrorKind> {
        self.add(&other.negate()?)
    }

    /// The negated constant.
    ///
    /// # Errors
    /// Those of [`Constant`].
    pub fn negate(&self) -> Result<Constant, ErrorKind> {
        self.scale(&-BigRational::one())
    }

    /// The product with a rational.
    ///
    /// # Errors
    /// Those of [`Constant`].
    pub fn scale(&self, factor: &BigRational) -> Result<Constant, ErrorKind> {
        let (constant, mut terms) = self.summands();
        for (_, q) in &mut terms {
            *q = rational::multiply(q, factor);
        }
        linear_combination(rational::multiply(&constant, factor), terms)
    }

    /// The product.
    ///
    /// # Errors
    /// Those of [`Constant`].
    pub fn multiply(&self, other: &Constant) -> Result<Constant, ErrorKind> {
        if let Some(factor) = self.as_rational() {
            return other.scale(factor);
        }
        if let Some(factor) = other.as_rational() {
            return self.scale(factor);
        }
        let (p, mut factors) = self.factors()?;
        let (q, more) = other.factors()?;
        factors.extend(more);
        product(rational::multiply(&p, &q), factors)
    }

    /// The inverse.
    ///
    /// # Errors
    /// [`ErrorKind::DivisionByZero`], [`ErrorKind::Undecided`]; also those of [`Constant`].
    pub fn inverse(&self) -> Result<Constant, ErrorKind> {
        self.power(-1)
    }

    /// The quotient.
    ///
    /// # Errors
    /// Those of [`Self::inverse`].
    pub fn divide(&self, other: &Constant) -> Result<Constant, ErrorKind> {
        self.multiply(&other.inverse()?)
    }

    /// The power with an integer exponent; `x⁰ = 1`.
    ///
    /// # Errors
    /// Those of [`Self::inverse`] for negative exponents.
    pub fn power(&self, exponent: i32) -> Result<Constant, ErrorKind> {
        if exponent == 0 {
            return Ok(Constant::one());
        }
        check(
            "an exponent",
            exponent.unsigned_abs() as usize,
            MAX_POWER as usize,
        )?;
        let (q, mut factors) = self.factors()?;
        if q.is_zero() {
            return if exponent < 0 {
                Err(ErrorKind::DivisionByZero)
            } else {
                Ok(Constant::zero())
            };
        }
        for (base, power) in &mut factors {
            // Bases with negative exponents are already proved nonzero, and exponentials are nonzero.
            if exponent < 0 && *power > 0 && !matches!(base.tree(), Tree::Exp(_)) {
                match base.separation() {
                    None => return Err(base.undecided()),
                    Some((Ordering::Equal, _)) => return Err(ErrorKind::DivisionByZero),
                    Some(_) => {}
                }
            }
            *power = power.saturating_mul(exponent);
        }
        product(rational_power(&q, exponent)?, factors)
    }

    /// The constant as a sum: the rational part, and the terms with their coefficients.
    pub(super) fn summands(&self) -> (BigRational, Vec<(Constant, BigRational)>) {
        match self.tree() {
            Tree::Rational(value) => (value.clone(), Vec::new()),
            Tree::Sum(constant, terms) => (constant.clone(), terms.clone()),
            _ => (
                BigRational::zero(),
                vec![(self.clone(), BigRational::one())],
            ),
        }
    }

    /// The constant as a product: the rational factor, and the bases with their exponents.
    pub(super) fn factors(&self) -> Result<(BigRational, Vec<(Constant, i32)>), ErrorKind> {
        Ok(match self.tree() {
            Tree::Rational(value) => (value.clone(), Vec::new()),
            Tree::Product(factors) => (BigRational::one(), factors.clone()),
            Tree::Sum(constant, terms) => match terms.as_slice() {
                [(x, factor)] if constant.is_zero() => (factor.clone(), x.factors()?.1),
                _ => {
                    let content = content(constant, terms);
                    let primitive = self.scale(&content.recip())?;
                    (content, vec![(primitive, 1)])
                }
            },
            _ => (BigRational::one(), vec![(self.clone(), 1)]),
        })
    }
}

/// The value of a polynomial at π.
pub(super) fn at_pi(polynomial: &Polynomial) -> Result<Constant, ErrorKind> {
    let coefficients = polynomial.coefficients();
    let mut terms = Vec::with_capacity(coefficients.len());
    for (exponent, q) in (0i32..).zip(&coefficients).skip(1) {
        terms.push((Constant::pi().power(exponent)?, q.clone()));
    }
    linear_combination(polynomial.coefficient(0), terms)
}

/// The power of a nonzero rational.
fn rational_power(base: &BigRational, exponent: i32) -> Result<BigRational, ErrorKind> {
    let bits = rational::length(base) as usize;
    if bits > 1 {
        let bits = bits.saturating_mul(exponent.unsigned_abs() as usize);
        check_bits(bits, base.is_integer() && exponent > 0)?;
    }
    Ok(base.pow(exponent))
}

/// The content of a sum: divided by it, the sum has coprime integer coefficients and a positive first term.
fn content(constant: &BigRational, terms: &[(Constant, BigRational)]) -> BigRational {
    let mut numerator = BigInt::zero();
    let mut denominator = BigInt::one();
    for q in terms.iter().map(|(_, q)| q).chain([constant]) {
        numerator = numerator.gcd(q.numer());
        denominator = denominator.lcm(q.denom());
    }
    let content = BigRational::new(numerator, denominator);
    match terms.first() {
        Some((_, q)) if q.is_negative() => -content,
        _ => content,
    }
}

/// `constant + Σ q·x`, where no `x` is rational or a sum.
fn linear_combination(
    constant: BigRational,
    mut terms: Vec<(Constant, BigRational)>,
) -> Result<Constant, ErrorKind> {
    terms.sort_by(|(x, _), (y, _)| x.cmp(y));
    let mut merged: Vec<(Constant, BigRational)> = Vec::with_capacity(terms.len());
    for (x, q) in terms {
        match merged.last_mut() {
            Some((last, sum)) if *last == x => *sum = rational::add(sum, &q),
            _ => merged.push((x, q)),
        }
    }
    merged.retain(|(_, q)| !q.is_zero());
    match merged.as_slice() {
        [] => Constant::rational(constant),
        [(x, q)] if constant.is_zero() && q.is_one() => Ok(x.clone()),
        _ => {
            for q in merged.iter().map(|(_, q)| q).chain([&constant]) {
                check_rational(q)?;
            }
            Constant::build(Tree::Sum(constant, merged))
        }
    }
}

/// `q·Π xⁿ`, with bases as in [`Tree::Product`] except that they may be unordered and repeated.
fn product(mut q: BigRational, mut factors: Vec<(Constant, i32)>) -> Result<Constant, ErrorKind> {
    if q.is_zero() {
        return Ok(Constant::zero());
    }
    factors.sort_by(|(x, _), (y, _)| x.cmp(y));
    let mut merged: Vec<(Constant, i32)> = Vec::with_capacity(factors.len());
    for (x, n) in factors {
        match merged.last_mut() {
            Some((last, sum)) if *last == x => *sum = sum.saturating_add(n),
            _ => merged.push((x, n)),
        }
    }
    // The remaining factors, and the replacements of their powers.
    let mut kept: Vec<(Constant, i32)> = Vec::with_capacity(merged.len());
    let mut replaced: Vec<Constant> = Vec::new();
    let mut exponent = Constant::zero();
    let mut radicand = BigInt::one();
    for (base, n) in merged {
        let (inner, order) = match base.tree() {
            _ if n == 0 => continue,
            Tree::Exp(x) => {
                exponent = exponent.add(&x.scale(&BigRational::from_integer(n.into()))?)?;
                continue;
            }
            Tree::Sqrt(x) => (x, 2),
            Tree::Cbrt(x) => (x, 3),
            _ => {
                kept.push((base, n));
                continue;
            }
        };
        let (whole, rest) = n.div_mod_floor(&order);
        if whole != 0 {
            replaced.push(inner.power(whole)?);
        }
        match inner.as_rational() {
            Some(x) if order == 2 && rest == 1 => {
                // √m·√n = g·√(m/g·n/g) with g = gcd(m, n).
                let common = radicand.gcd(x.numer());
                radicand = radicand / &common * (x.numer() / &common);
                q *= BigRational::from_integer(common);
            }
            _ if rest > 0 => kept.push((base, rest)),
            _ => {}
        }
    }
    for part in [
        exponent.exp()?,
        Constant::rational(BigRational::from_integer(radicand))?.sqrt()?,
    ] {
        match part.tree() {
            Tree::Exp(_) | Tree::Sqrt(_) => kept.push((part, 1)),
            _ if part.is_trivially_one() => {}
            _ => replaced.push(part),
        }
    }
    kept.sort_by(|(x, _), (y, _)| x.cmp(y));
    let rest = match kept.as_slice() {
        [] => Constant::one(),
        [(x, 1)] => x.clone(),
        _ => Constant::build(Tree::Product(kept))?,
    };
    // The replacements have smaller trees, so the recursion terminates.
    let mut result = rest;
    for part in &replaced {
        result = result.multiply(part)?;
    }
    result.scale(&q)
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::symbolic::constant::tests::{constant, value};
    use proptest::prelude::*;

    #[test]
    fn equal_values_have_equal_trees() {
        let cases = [
            ("pi/3 + pi/6", "pi/2"),
            ("2*(pi/4)", "pi/2"),
            ("sqrt(2)*sqrt(3)", "sqrt(6)"),
            ("sqrt(6)*sqrt(10)", "2*sqrt(15)"),
            ("1/sqrt(2)", "sqrt(2)/2"),
            ("sqrt(8)^3", "16*sqrt(2)"),
            ("cbrt(4)*cbrt(4)*cbrt(4)", "4"),
            ("1/cbrt(2)", "cbrt(2)^2/2"),
            ("exp(1/2)*exp(1/2)", "e"),
            ("e^3/exp(3)", "1"),
            ("(2*pi - 8)/(8*pi)", "(pi - 4)/(4*pi)"),
            ("(4 - pi)*3", "-3*(pi - 4)"),
            ("1/(1 + pi)*(2 + 2*pi)", "2"),
            ("pi*e/pi", "e"),
            ("(sqrt(pi)*e)^2", "pi*e^2"),
            ("0*pi", "0"),
            ("(pi + e) - e", "pi"),
            ("sqrt(1 + pi)^4/(1 + pi)", "1 + pi"),
        ];
        for (a, b) in cases {
            assert_eq!(constant(a), constant(b), "{a} = {b}");
        }
    }

    #[test]
    fn operations_refuse_division_by_zero_and_huge_results() {
        let pi = Constant::pi();
        assert_eq!(Constant::zero().inverse(), Err(ErrorKind::DivisionByZero));
        assert!(matches!(pi.power(3000), Err(ErrorKind::Magnitude { .. })));
        assert!(matches!(
            pi.power(i32::MIN),
            Err(ErrorKind::ExpressionSize { .. })
        ));
        let power = Constant::whole(3).power(60_000);
        assert!(matches!(power, Err(ErrorKind::ExpressionSize { .. })));
        let zero = constant("(e - pi)*(e + pi) - e^2 + pi^2");
        assert!(matches!(zero.inverse(), Err(ErrorKind::Undecided { .. })));
        assert!(matches!(pi.divide(&zero), Err(ErrorKind::Undecided { .. })));
        // A growing computation ends with an error of size.
        let mut x = pi;
        let ended = (0..20_000).find_map(|k| {
            match x.add(
                &Constant::whole(k)
                    .sin()
                    .and_then(|y| y.multiply(&x))
                    .expect("small"),
            ) {
                Ok(next) => {
                    x = next;
                    None
                }
                Err(kind) => Some(kind),
            }
        });
        assert!(
            matches!(ended, Some(ErrorKind::ExpressionSize { .. })),
            "{ended:?}"
        );
    }

    proptest! {
        #[test]
        fn operations_agree_with_doubles(
            parts in prop::collection::vec((0usize..8, 0usize..8, 0usize..4), 1..6),
        ) {
            let atoms = ["pi", "sqrt(2)", "-3/4", "exp(1/3)", "1 - sqrt(3)", "cbrt(5)", "cos(1)", "pi/6 - 2/7"];
            let mut x = constant(atoms[parts[0].0]);
            let mut expected = value(&x);
            for (a, b, operation) in parts {
                let y = constant(atoms[a]).multiply(&constant(atoms[b]).sin().expect("small")).expect("small");
                let v = value(&y);
                (x, expected) = match operation {
                    0 => (x.add(&y).expect("small"), expected + v),
                    1 => (x.subtract(&y).expect("small"), expected - v),
                    2 => (x.multiply(&y).expect("small"), expected * v),
                    _ if y.is_trivially_zero() => continue,
                    _ => (x.divide(&y).expect("not zero"), expected / v),
                };
            }
            prop_assert!((value(&x) - expected).abs() <= 1e-9 * (1.0 + expected.abs()));
            // The printed constant parses to the same tree.
            prop_assert_eq!(constant(&x.to_string()), x);
        }
    }
}
