//! Functions on `[0, 1]`: sums of products of powers, exponentials and waves.

use std::collections::BTreeMap;
use std::fmt;

use num_bigint::BigInt;
use num_integer::Integer;
use num_rational::BigRational;
use num_traits::{One, Zero};

use super::size::{check, check_bits};
use super::{
    Constant, Frequency, MAX_FRACTION_BITS, MAX_FUNCTION_SIZE, MAX_PRODUCT_SIZE, MAX_TERMS,
};
use crate::arithmetic::polynomial::Polynomial;
use crate::error::ErrorKind;
use crate::expression::{MAX_DEGREE, shown};

/// A factor `cos(β·t)` or `sin(β·t)`, or none.
///
/// The first nonzero part of `β`, the coefficient of π before the rational part, is positive.
#[derive(Debug, Clone, PartialEq, Eq, Hash, PartialOrd, Ord)]
pub enum Wave {
    /// No wave: the factor 1.
    None,
    /// `cos(β·t)` with `β ≠ 0`.
    Cos(Frequency),
    /// `sin(β·t)` with `β ≠ 0`.
    Sin(Frequency),
}

/// A basis function of [`Function`]s. Distinct terms are linearly independent.
#[derive(Debug, Clone, PartialEq, Eq, Hash, PartialOrd, Ord)]
pub enum Term {
    /// `tᵏ·e^(α·t)·wave`
    Product {
        /// `α`
        growth: Frequency,
        /// The wave.
        wave: Wave,
        /// `k`
        power: u32,
    },
    /// `tan(ω·t)` with `0 < |ω| < π/2`, which has no pole on `[0, 1]`.
    Tan(Frequency),
    /// `ln(cos(ω·t))` with `0 < |ω| < π/2`: the integral of the tangent.
    LnCos(Frequency),
}

impl Term {
    /// The power `tᵏ`.
    pub(super) fn power(power: u32) -> Self {
        Term::Product {
            growth: Frequency::zero(),
            wave: Wave::None,
            power,
        }
    }

    /// The exponent, if this is a power of `t`.
    pub fn as_power(&self) -> Option<usize> {
        self.is_power().then_some(self.degree() as usize)
    }

    /// Growth, wave and power of a product.
    pub(super) fn parts(&self) -> Option<(&Frequency, &Wave, u32)> {
        match self {
            Term::Product {
                growth,
                wave,
                power,
            } => Some((growth, wave, *power)),
            Term::Tan(_) | Term::LnCos(_) => None,
        }
    }

    /// Whether this is a power of `t`.
    pub(super) fn is_power(&self) -> bool {
        matches!(self, Term::Product { growth, wave: Wave::None, .. } if growth.is_zero())
    }

    /// Whether this is the function 1.
    pub(super) fn is_one(&self) -> bool {
        self.is_power() && self.degree() == 0
    }

    /// The exponent of `t`.
    fn degree(&self) -> u32 {
        self.parts().map_or(0, |(_, _, power)| power)
    }

    fn size(&self) -> usize {
        1 + match self {
            Term::Product { growth, wave, .. } => {
                growth.size()
                    + match wave {
                        Wave::None => 0,
                        Wave::Cos(frequency) | Wave::Sin(frequency) => frequency.size(),
                    }
            }
            Term::Tan(frequency) | Term::LnCos(frequency) => frequency.size(),
        }
    }
}

/// A linear combination of [`Term`]s with constant coefficients: `t^2*exp(-t/2) - cos(pi*t)`.
///
/// Products of waves are expanded into sums of waves, so equal functions have the same terms. [`Eq`] compares the trees
/// of the coefficients; a coefficient may be an unrecognised zero.
///
/// Every operation returns [`ErrorKind::ExpressionSize`] if its result would exceed a limit of [`crate::symbolic`], and
/// the errors of its operations on [`Constant`]s.
#[derive(Clone, PartialEq, Eq, Hash)]
pub struct Function {
    terms: BTreeMap<Term, Constant>,
    size: usize,
}

impl Function {
    /// The function 0.
    pub fn zero() -> Self {
        Function {
            terms: BTreeMap::new(),
            size: 0,
        }
    }

    /// A constant function.
    pub fn constant(value: Constant) -> Self {
        Self::single(Term::power(0), value)
    }

    /// The function `t`.
    pub fn variable() -> Self {
        Self::single(Term::power(1), Constant::one())
    }

    /// A polynomial in `t`.
    ///
    /// # Errors
    /// [`ErrorKind::ExpressionSize`] for a degree or coefficients beyond the limits.
    pub fn polynomial(polynomial: &Polynomial) -> Result<Self, ErrorKind> {
        let mut function = Self::zero();
        for (power, q) in (0..).zip(polynomial.coefficients()) {
            function.insert(Term::power(power), &Constant::rational(q)?)?;
        }
        Ok(function)
    }

    /// A multiple of one term.
    pub(super) fn single(term: Term, coefficient: Constant) -> Self {
        let mut function = Self::zero();
        if !coefficient.is_trivially_zero() {
            function.size = term.size() + coefficient.size();
            function.terms.insert(term, coefficient);
        }
        function
    }

    /// Adds a multiple of a term.
    pub(crate) fn insert(&mut self, term: Term, coefficient: &Constant) -> Result<(), ErrorKind> {
        if coefficient.is_trivially_zero() {
            return Ok(());
        }
        check("the degree", term.degree() as usize, MAX_DEGREE)?;
        let sum = match self.terms.remove(&term) {
            Some(present) => {
                self.size = self.size.saturating_sub(term.size() + present.size());
                present.add(coefficient)?
            }
            None => coefficient.clone(),
        };
        if !sum.is_trivially_zero() {
            self.size += term.size() + sum.size();
            self.terms.insert(term, sum);
        }
        check("the number of terms", self.terms.len(), MAX_TERMS)?;
        check("the size of a function", self.size, MAX_FUNCTION_SIZE)
    }

    /// The terms with their coefficients, in ascending order.
    pub fn terms(&self) -> impl Iterator<Item = (&Term, &Constant)> {
        self.terms.iter()
    }

    /// Whether there are no terms.
    pub fn is_zero(&self) -> bool {
        self.terms.is_empty()
    }

    /// The value, if the function is constant.
    pub fn as_constant(&self) -> Option<Constant> {
        let mut terms = self.terms.iter();
        match (terms.next(), terms.next()) {
            (None, _) => Some(Constant::zero()),
            (Some((term, value)), None) if term.is_one() => Some(value.clone()),
            _ => None,
        }
    }

    /// The polynomial in `t`, if the function is a polynomial with rational coefficients whose common denominator has
    /// at most [`MAX_FRACTION_BITS`] bits.
    pub fn as_polynomial(&self) -> Option<Polynomial> {
        let mut denominator = BigInt::one();
        for (term, coefficient) in &self.terms {
            let divisor = coefficient.as_rational()?.denom();
            let remainder = &denominator % divisor;
            if !remainder.is_zero() {
                denominator *= divisor / divisor.gcd(&remainder);
            }
            if !term.is_power() || denominator.bits() as usize > MAX_FRACTION_BITS {
                return None;
            }
        }
        let mut numerators = vec![BigRational::zero(); self.degree() + 1];
        for (term, coefficient) in &self.terms {
            let value = coefficient.as_rational()?;
            let numerator = value.numer() * (&denominator / value.denom());
            numerators[term.degree() as usize] = BigRational::from_integer(numerator);
        }
        let scale = BigRational::new(BigInt::one(), denominator);
        Some(Polynomial::from_rationals(&numerators).scale(&scale))
    }

    /// The largest exponent of `t`.
    fn degree(&self) -> usize {
        self.terms.keys().map(Term::degree).max().unwrap_or(0) as usize
    }

    /// The frequency `q` and the constant `c`, if the function is `q·t + c` with `q` in `ℚ + ℚ·π`.
    pub(super) fn linear(&self) -> Option<(Frequency, Constant)> {
        let (mut frequency, mut constant) = (Frequency::zero(), Constant::zero());
        for (term, coefficient) in &self.terms {
            match term.degree() {
                _ if !term.is_power() => return None,
                0 => constant = coefficient.clone(),
                1 => frequency = Frequency::from_constant(coefficient)?,
                _ => return None,
            }
        }
        Some((frequency, constant))
    }

    /// The sum.
    ///
    /// # Errors
    /// Those of [`Function`].
    pub fn add(&self, other: &Function) -> Result<Function, ErrorKind> {
        let mut sum = self.clone();
        for (term, coefficient) in &other.terms {
            sum.insert(term.clone(), coefficient)?;
        }
        Ok(sum)
    }

    /// The difference.
    ///
    /// # Errors
    /// Those of [`Function`].
    pub fn subtract(&self, other: &Function) -> Result<Function, ErrorKind> {
        self.add(&other.negate()?)
    }

    /// The negated function.
    ///
    /// # Errors
    /// Those of [`Function`].
    pub fn negate(&self) -> Result<Function, ErrorKind> {
        self.scale(&Constant::whole(-1))
    }

    /// The product with a constant.
    ///
    /// # Errors
    /// Those of [`Function`].
    pub fn scale(&self, factor: &Constant) -> Result<Function, ErrorKind> {
        let mut scaled = Self::zero();
        for (term, coefficient) in &self.terms {
            scaled.insert(term.clone(), &coefficient.multiply(factor)?)?;
        }
        Ok(scaled)
    }

    /// The product.
    ///
    /// # Errors
    /// [`ErrorKind::FunctionClass`] for products with a tangent or its integral; also those of [`Function`].
    pub fn multiply(&self, other: &Function) -> Result<Function, ErrorKind> {
        if let Some(factor) = other.as_constant() {
            return self.scale(&factor);
        }
        if let Some(factor) = self.as_constant() {
            return other.scale(&factor);
        }
        if let (Some(a), Some(b)) = (self.as_polynomial(), other.as_polynomial()) {
            check("the degree", self.degree() + other.degree(), MAX_DEGREE)?;
            let whole = a.denominator().is_one() && b.denominator().is_one();
            check_bits(bits(&a) + bits(&b), whole)?;
            return Self::polynomial(&(&a * &b));
        }
        let size = self.size * other.terms.len() + other.size * self.terms.len();
        check("the size of a product", size, MAX_PRODUCT_SIZE)?;
        let mut product = Self::zero();
        for (a, p) in &self.terms {
            for (b, q) in &other.terms {
                let (Some((growth, wave, power)), Some((growth_b, wave_b, power_b))) =
                    (a.parts(), b.parts())
                else {
                    return Err(ErrorKind::FunctionClass {
                        found: shown(&format!("{a}*{b}")),
                        reason: "its integral is not an elementary function",
                    });
                };
                let coefficient = p.multiply(q)?;
                for (factor, wave) in wave.multiply(wave_b) {
                    let term = Term::Product {
                        growth: growth.add(growth_b),
                        wave,
                        power: power + power_b,
                    };
                    product.insert(term, &coefficient.scale(&factor)?)?;
                }
            }
        }
        Ok(product)
    }

    /// The power `fⁿ`; `f⁰ = 1`.
    ///
    /// # Errors
    /// Those of [`Self::multiply`].
    pub fn power(&self, exponent: u32) -> Result<Function, ErrorKind> {
        if exponent == 0 {
            return Ok(Self::constant(Constant::one()));
        }
        if let Some(base) = self.as_constant() {
            let exponent = i32::try_from(exponent).unwrap_or(i32::MAX);
            return Ok(Self::constant(base.power(exponent)?));
        }
        let n = exponent as usize;
        check("the degree", self.degree().saturating_mul(n), MAX_DEGREE)?;
        if let Some(base) = self.as_polynomial() {
            let whole = base.denominator().is_one();
            check_bits(bits(&base).saturating_mul(n), whole)?;
            return Self::polynomial(&base.power(exponent));
        }
        let (mut result, mut square, mut rest) =
            (Self::constant(Constant::one()), self.clone(), exponent);
        loop {
            if rest & 1 == 1 {
                result = result.multiply(&square)?;
            }
            rest >>= 1;
            if rest == 0 {
                return Ok(result);
            }
            square = square.multiply(&square)?;
        }
    }
}

/// The length in bits of the longest number in a polynomial.
fn bits(polynomial: &Polynomial) -> usize {
    let numbers = polynomial.numerators().iter();
    let longest = numbers
        .chain([polynomial.denominator()])
        .map(BigInt::bits)
        .max();
    longest.unwrap_or(0) as usize
}

impl Default for Function {
    fn default() -> Self {
        Self::zero()
    }
}

impl From<Constant> for Function {
    fn from(value: Constant) -> Self {
        Self::constant(value)
    }
}

impl fmt::Debug for Function {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        fmt::Display::fmt(self, f)
    }
}

#[cfg(test)]
pub(crate) mod tests {
    use super::*;
    use crate::expression::{Input, parse_list};
    use crate::symbolic::constant::tests::{constant, value};
    use proptest::prelude::*;

    /// Parses a function.
    pub(crate) fn function(text: &str) -> Function {
        let input = Input { name: "test", text };
        parse_list(input)
            .and_then(|list| list[0].function(input))
            .expect(text)
    }

    /// Random functions as text.
    pub(crate) fn texts() -> impl Strategy<Value = String> {
        let factor = prop::sample::select(vec![
            "t",
            "t^2",
            "exp(-t/2)",
            "exp(t)",
            "sin(3*t)",
            "cos(pi*t)",
            "cos(pi*t/2 - 1)",
            "exp(t - pi*t/3)",
            "(1 + t)^2",
            "cosh(t/3)",
            "sqrt(2)",
            "(pi - 4)/(4*pi)",
            "7/3",
            "sin((1 + pi)*t + pi/4)",
        ]);
        let product = prop::collection::vec(factor, 1..4).prop_map(|factors| factors.join("*"));
        prop::collection::vec((product, any::<bool>()), 1..4).prop_map(|terms| {
            let signed = terms
                .into_iter()
                .map(|(term, minus)| format!("{} {term}", if minus { "-" } else { "+" }));
            signed.collect::<Vec<_>>().join(" ")
        })
    }

    #[test]
    fn equal_functions_are_equal() {
        let cases = [
            ("cos(t)^2 + sin(t)^2", "1"),
            ("2*sin(t)*cos(t)", "sin(2*t)"),
            ("cos(t)*cos(t) - sin(t)^2", "cos(2*t)"),
            ("exp(t)*exp(-t)", "1"),
            ("cosh(t)^2 - sinh(t)^2", "1"),
            ("cos(t + pi/2)", "-sin(t)"),
            ("sin(-t)", "-sin(t)"),
            ("cos(-pi*t)", "cos(pi*t)"),
            ("tan(-t)", "-tan(t)"),
            ("exp(2*t + 1)", "e*exp(t)^2"),
            ("e^(2*t)", "exp(2*t)"),
            ("(t - sqrt(2))*(t + sqrt(2))", "t^2 - 2"),
            ("t/2 + t/3 - 5*t/6", "0"),
            ("cos(t - t)", "1"),
            ("(t + cos(t))^3", "(t + cos(t))*(t + cos(t))*(t + cos(t))"),
            ("(pi + t)^0", "1"),
        ];
        for (a, b) in cases {
            assert_eq!(function(a), function(b), "{a} = {b}");
        }
        assert_eq!(
            function("t^2 - t/3")
                .as_polynomial()
                .map(|p| p.display("t").to_string()),
            Some("t^2 - 1/3*t".to_owned())
        );
        assert_eq!(function("t*sqrt(2)").as_polynomial(), None);
        assert_eq!(
            function("cos(t) - cos(t) + pi").as_constant(),
            Some(constant("pi"))
        );
    }

    #[test]
    fn products_with_tangents_and_large_functions_are_refused() {
        let (tangent, t) = (function("tan(t)"), Function::variable());
        assert!(matches!(
            tangent.multiply(&t),
            Err(ErrorKind::FunctionClass { .. })
        ));
        assert!(matches!(
            tangent.power(2),
            Err(ErrorKind::FunctionClass { .. })
        ));
        assert_eq!(
            tangent.scale(&Constant::whole(2)),
            Ok(function("tan(t) + tan(t)"))
        );
        assert!(matches!(
            t.power(257),
            Err(ErrorKind::ExpressionSize { .. })
        ));
        let waves = function("cos(t) + cos(pi*t) + exp(t)");
        assert!(matches!(
            waves.power(400),
            Err(ErrorKind::ExpressionSize { .. })
        ));
        let many = function("1 + cos(t)").power(400);
        assert!(matches!(many, Err(ErrorKind::ExpressionSize { .. })));
    }

    proptest! {
        #[test]
        fn operations_agree_with_values(a in texts(), b in texts(), n in 0i64..8) {
            let (f, g) = (function(&a), function(&b));
            let node = Constant::rational(BigRational::new(n.into(), 7.into())).expect("small");
            let at = |f: &Function| value(&f.evaluate(&node).expect("small"));
            let close = |x: f64, y: f64| (x - y).abs() <= 1e-9 * (1.0 + x.abs());
            prop_assert!(close(at(&f.add(&g).expect("small")), at(&f) + at(&g)));
            prop_assert!(close(at(&f.subtract(&g).expect("small")), at(&f) - at(&g)));
            // The value of a product of long sums may exceed the size of a constant.
            let product = f.multiply(&g).expect("small");
            match product.evaluate(&node) {
                Ok(product) => prop_assert!(close(value(&product), at(&f) * at(&g))),
                Err(kind) => {
                    let large = matches!(kind, ErrorKind::ExpressionSize { .. });
                    prop_assert!(large && product.terms().count() > 30, "{}", kind);
                }
            }
            // The printed function parses to the same function.
            prop_assert_eq!(function(&f.to_string()), f);
        }
    }
}
