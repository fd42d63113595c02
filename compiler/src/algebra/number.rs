//! One coefficient of a tableau: a real number that can be enclosed and correctly rounded.

use std::cmp::Ordering;

use num_bigint::BigInt;
use num_rational::BigRational;
use num_traits::{Signed, Zero as _};

use super::node::{NodeNumber, short_rational};
use super::real::{ROUNDING_BITS, beyond_usual};
use super::{ConstantField, FieldElement, Real, ZERO_BITS};
use crate::arithmetic::ball::Ball;
use crate::arithmetic::interval::Interval;
use crate::arithmetic::polynomial::Polynomial;
use crate::arithmetic::rational::{add, length, ratio};
use crate::arithmetic::rounding::{self, Decimal, exact};
use crate::arithmetic::zero::Zero;

/// A real number: a coefficient of a tableau, or a number computed from coefficients.
#[derive(Debug, Clone)]
pub enum Number<'a> {
    /// A rational.
    Rational(BigRational),
    /// The value of a function of the nodes.
    Node(NodeNumber<'a>),
    /// An element of a constant field.
    Field(&'a ConstantField, FieldElement),
    /// An expression.
    Real(Real),
    /// An enclosure with a limited number of bits.
    Enclosed(Ball),
}

/// The smallest number of binary places of enclosures.
const FIRST_BITS: u32 = 192;

impl Number<'_> {
    /// An enclosure that is narrow relative to the number, or relative to 1 if the number cannot be distinguished from zero.
    pub fn ball(&self, bits: u32) -> Ball {
        match self {
            Number::Rational(value) => return Ball::quotient(value, bits),
            Number::Enclosed(ball) => return ball.clone(),
            _ => {}
        }
        match self.zero() {
            Zero::Yes => return Ball::zero(),
            Zero::Within(_) => return Ball::undecided(&self.enclose(bits)),
            Zero::No => {}
        }
        // A few places give the size of the number, and so the places needed.
        let mut places = 64;
        loop {
            let interval = self.enclose(places);
            let wanted = interval.magnitude_bits() - i64::from(bits);
            let known = interval.sign().is_some();
            if known && interval.width_bits() <= wanted {
                return Ball::around(&interval, bits);
            }
            let needed = u32::try_from(8 - wanted).unwrap_or(0);
            places = if known && needed > places {
                needed
            } else {
                2 * places
            };
        }
    }

    /// An enclosure with at least this many binary places, and at least 192. Its width tends to zero as `bits` grows, except
    /// for a number that is known by a single enclosure only.
    pub fn enclose(&self, bits: u32) -> Interval {
        let bits = bits.max(FIRST_BITS);
        let enclosure = match self {
            Number::Rational(value) => return Interval::enclosing(value, bits),
            Number::Node(number) => number.enclose(bits),
            Number::Field(field, element) => field.enclose(element, bits),
            Number::Real(number) => number.enclose(bits),
            Number::Enclosed(ball) => ball.interval(bits),
        };
        enclosure.with_bits(bits)
    }

    /// The approximate number of machine words of the exact form; 0 if there is none, or if it does not matter.
    pub(crate) fn words(&self) -> u64 {
        let words = |polynomial: &Polynomial| {
            let numerators = polynomial.numerators().iter();
            let bits: u64 = numerators.map(BigInt::bits).sum();
            (bits + polynomial.denominator().bits()) / 64
        };
        match self {
            Number::Rational(value) => (value.numer().bits() + value.denom().bits()) / 64,
            Number::Field(_, element) => {
                let lists = [element.numerator(), element.denominator()];
                lists.into_iter().flatten().map(words).sum()
            }
            _ => 0,
        }
    }

    /// The bits of the denominators of the exact form, none for whole numbers.
    pub(crate) fn denominator_bits(&self) -> u64 {
        let bits = |denominator: &BigInt| denominator.bits() - 1;
        match self {
            Number::Rational(value) => bits(value.denom()),
            Number::Field(_, element) => {
                let lists = [element.numerator(), element.denominator()];
                let polynomials = lists.into_iter().flatten();
                polynomials.map(|c| bits(c.denominator())).sum()
            }
            _ => 0,
        }
    }

    /// The binary places, beyond the usual number, needed to resolve the smallest number that occurs in this one.
    pub(crate) fn fineness(&self) -> u32 {
        match self {
            Number::Rational(value) => beyond_usual(length(value)),
            Number::Field(_, element) => {
                let lists = [element.numerator(), element.denominator()];
                let longest = |p: &Polynomial| {
                    let numerators = p.numerators().iter().map(BigInt::bits);
                    numerators.max().unwrap_or(0).max(p.denominator().bits())
                };
                let places = lists.into_iter().flatten().map(longest);
                beyond_usual(places.max().unwrap_or(0))
            }
            Number::Real(number) => number.fineness(),
            Number::Node(_) | Number::Enclosed(_) => 0,
        }
    }

    /// A number `n` with `|x| < 2ⁿ` if it is positive, and 0 otherwise.
    pub(crate) fn largeness(&self) -> u64 {
        u64::try_from(self.enclose(0).magnitude_bits()).unwrap_or(0)
    }

    /// Whether both have the same representation, which is decided immediately; different representations may be equal numbers.
    pub fn is_same(&self, other: &Self) -> bool {
        match (self, other) {
            (Number::Rational(x), Number::Rational(y)) => x == y,
            (Number::Real(x), Number::Real(y)) => x == y,
            _ => false,
        }
    }

    /// Whether the number equals a rational, if this can be decided.
    pub fn difference(&self, value: &BigRational) -> Zero {
        let equal = match self {
            Number::Rational(known) => known == value,
            Number::Node(number) => number.equals(value),
            Number::Field(_, element) => element.as_rational().as_ref() == Some(value),
            Number::Real(number) => return number.difference(value, ZERO_BITS),
            Number::Enclosed(ball) => return ball.difference(value),
        };
        if equal { Zero::Yes } else { Zero::No }
    }

    /// Whether the number equals a rational for the purpose of rounding: exactly, or to the precision of enclosures with this
    /// many binary places.
    fn is_surely(&self, value: &BigRational, bits: u32) -> bool {
        match self {
            Number::Real(number) => number.difference(value, bits).may_be(),
            Number::Enclosed(ball) => ball.difference(value).may_be(),
            _ => self.difference(value) == Zero::Yes,
        }
    }

    /// Whether the number equals a rational, as far as is known.
    pub fn equals(&self, value: &BigRational) -> bool {
        self.difference(value).may_be()
    }

    /// Whether the number is zero, if this can be decided.
    pub fn zero(&self) -> Zero {
        self.difference(&BigRational::zero())
    }

    /// Whether the number is zero, as far as is known.
    pub fn is_zero(&self) -> bool {
        self.zero().may_be()
    }

    /// The number, if it is known to be a rational with a short numerator and denominator.
    pub fn short_rational(&self) -> Option<BigRational> {
        if let Number::Rational(value) = self {
            return Some(value.clone());
        }
        let candidate = short_rational(&self.enclose(0))?;
        (self.difference(&candidate) == Zero::Yes).then_some(candidate)
    }

    /// [`Number::short_rational`], but also for an enclosed number that equals the rational as far as is known.
    pub(crate) fn short_rational_as_far_as_known(&self) -> Option<BigRational> {
        if let Number::Rational(value) = self {
            return Some(value.clone());
        }
        short_rational(&self.enclose(0)).filter(|candidate| self.equals(candidate))
    }

    /// The sign of the number; `Equal` if the number is not known to differ from zero.
    pub fn sign(&self) -> Ordering {
        if self.is_zero() {
            return Ordering::Equal;
        }
        let mut interval = self.enclose(0);
        loop {
            if let Some(sign) = interval.sign() {
                return sign;
            }
            interval = self.enclose(interval.bits() * 2);
        }
    }

    /// The nearest double, ties to even.
    pub fn to_f64(&self) -> f64 {
        self.round(0, rounding::to_f64, |&double| exact(double))
    }

    /// The nearest single, ties to even; infinite beyond the largest single.
    ///
    /// Not always the single nearest to [`Number::to_f64`].
    pub fn to_f32(&self) -> f32 {
        self.round(0, rounding::to_f32, |&single| exact(single.into()))
    }

    /// The remainder of [`Number::to_f64`]: the double nearest to the number minus `double`, ties to even.
    ///
    /// Together they represent the number to 106 bits, if the remainder is not below the smallest double.
    pub fn low_double(&self, double: f64) -> f64 {
        let double = exact(double);
        // The difference is zero, which no enclosure can prove, or rounds to zero.
        if self.is_surely(&double, ZERO_BITS) {
            return 0.0;
        }
        self.round(
            0,
            |value| rounding::to_f64(&add(value, &-&double)),
            |&low| &double + exact(low),
        )
    }

    /// The number rounded to `digits` significant decimal digits, ties to even.
    pub fn decimal(&self, digits: usize) -> Decimal {
        // A digit takes less than 10/3 bits; numbers much smaller than 1 need more.
        let bits = digits.min(1 << 24) as u32 * 10 / 3 + 64;
        let round = |value: &BigRational| Decimal::round(value, digits);
        self.round(bits, round, Decimal::value)
    }

    /// Rounds by refining the enclosure, if it can be refined, starting with this many binary places, until both ends round to
    /// the same value.
    ///
    /// The refinement ends unless the number is zero or the midpoint of two neighbours of the target format.
    /// This is decided, as far as possible, once an enclosure is narrow and does not exclude it.
    fn round<T: PartialEq>(
        &self,
        bits: u32,
        round: impl Fn(&BigRational) -> T,
        value: impl Fn(&T) -> BigRational,
    ) -> T {
        if let Number::Rational(value) = self {
            return round(value);
        }
        if self.is_surely(&BigRational::zero(), ZERO_BITS) {
            return round(&BigRational::zero());
        }
        let mut interval = self.enclose(bits);
        let mut excluded = None;
        loop {
            let (low, high) = (interval.low(), interval.high());
            let (below, above) = (round(&low), round(&high));
            let decided = interval.sign().is_some();
            if decided && below == above {
                return below;
            }
            let (a, b) = (value(&below), value(&above));
            let middle = (&a + &b) / ratio(2, 1);
            // Ends that are close compared with the distance of what they round to are on both sides of
            // the middle between neighbours. That close, they hardly ever are unless the number is the
            // middle: the exact test is expensive, so it has to be worth it.
            let narrow = (high - low) * exact(2f64.powi(64)) < (b - a).abs();
            if decided && narrow && excluded.as_ref() != Some(&middle) {
                if self.is_surely(&middle, ROUNDING_BITS) {
                    return round(&middle);
                }
                excluded = Some(middle);
            }
            let finer = self.enclose(interval.bits() * 2);
            // The one enclosure there is: whoever made it says how many bits of it mean something.
            if matches!(self, Number::Enclosed(_)) && finer.width() >= interval.width() {
                return round(&finer.middle());
            }
            interval = finer;
        }
    }
}

#[cfg(test)]
mod tests {
    use std::borrow::Cow;

    use super::*;
    use crate::algebra::{NodeAlgebra, StageAlgebra, Tensor};
    use num_traits::One;

    /// Nodes 1/2 ∓ √3/6.
    fn algebra() -> NodeAlgebra {
        NodeAlgebra::new(&Polynomial::from_integers(&[1, -6, 6])).expect("nodes")
    }

    #[test]
    fn one_wide_enclosure_is_rounded_to_its_middle() {
        let third = Number::Enclosed(Ball::quotient(&ratio(1, 3), 20));
        assert_eq!(third.decimal(3).to_string(), "0.333");
        assert_eq!(third.decimal(40).to_string().len(), 42);
        assert!((third.to_f64() - 1.0 / 3.0).abs() < 1e-5);
    }

    #[test]
    fn decimals_agree_with_known_digits() {
        let k = algebra();
        let x = k.variable();
        let nodes = NodeAlgebra::values(&k, Cow::Borrowed(&x));
        // 1/2 + √3/6, from the known digits of √3.
        let sqrt3 = "1.73205080756887729352744634150587236694280525381038062805580697945193301690880003708114618675724857567562614142";
        let digits = nodes[1].decimal(60).to_string();
        let six: BigRational = ratio(6, 1);
        let integer: BigInt = sqrt3.replace('.', "").parse().expect("digits");
        let scale = BigInt::from(10).pow(sqrt3.len() as u32 - 2);
        let reference = BigRational::new(integer, scale) / six + ratio(1, 2);
        assert_eq!(digits, Decimal::round(&reference, 60).to_string());
        assert_eq!(nodes[1].to_f64(), 0.5 + 3f64.sqrt() / 6.0);
    }

    /// At these lengths an early enclosure often meets the middle between two decimals by chance.
    #[test]
    fn decimals_next_to_a_tie_are_rounded_correctly() {
        let gauss = crate::derive("polynomial(8)", "gauss(8)").expect("derived");
        for digits in [55, 56, 57, 58, 59, 60, 61, 62, 121, 122, 123] {
            for number in gauss.numbers().iter() {
                // Far more places than it takes, and another route.
                let fine = Decimal::round(&number.enclose(2000).low(), digits);
                assert_eq!(number.decimal(digits), fine);
            }
        }
    }

    #[test]
    fn singles_and_low_doubles_agree_with_another_route() {
        let gauss = crate::derive("polynomial(8)", "gauss(8)").expect("derived");
        for number in gauss.numbers().iter() {
            let fine = number.enclose(2000).low();
            let double = number.to_f64();
            let low = number.low_double(double);
            assert_eq!(number.to_f32(), rounding::to_f32(&fine));
            assert_eq!(low, rounding::to_f64(&(&fine - exact(double))));
            // Half a unit in the last place of a number below 1.
            assert!(low.abs() <= f64::EPSILON / 4.0);
            let rest = (exact(double) + exact(low) - fine).abs();
            assert!(rest <= exact(f64::EPSILON.powi(2) / 16.0));
        }
    }

    #[test]
    fn low_doubles_of_doubles_are_zero() {
        let k = algebra();
        let c1_c2 = Tensor::from_products(&k, &[(k.variable(), k.variable())]);
        // c_1 c_2 = 1/6: the double 1/4 hidden in it, then a hair more than that.
        let hair = BigRational::new(One::one(), BigInt::one() << 300);
        for more in [BigRational::zero(), hair] {
            let shift = Polynomial::constant(ratio(1, 12) + &more);
            let hidden = c1_c2.add(&Tensor::from_products(&k, &[(shift, Polynomial::one())]));
            let quarter = &NodeAlgebra::entries(&k, &hidden)[0][1];
            assert_eq!(quarter.to_f64(), 0.25);
            assert_eq!(exact(quarter.low_double(0.25)), more);
        }
    }

    #[test]
    fn ties_and_zeros_of_irrational_nodes_are_decided() {
        let k = algebra();
        // x(1 − x) = 1/6 at both nodes, hidden; reduced by hand it would be a constant, so hide it
        // among two indices instead: x·(1 − y) on the antidiagonal y = 1 − x gives x² = x − 1/6.
        let x = k.variable();
        let product = Tensor::from_products(&k, &[(x.clone(), x.clone())]);
        let entries = NodeAlgebra::entries(&k, &product);
        // c_1 c_2 = 1/6 exactly.
        assert!(entries[0][1].equals(&ratio(1, 6)));
        assert!(!entries[0][0].equals(&ratio(1, 6)));
        let shifted = product.subtract(&Tensor::from_products(
            &k,
            &[(
                Polynomial::constant(ratio(1, 6) - ratio(1, 4)),
                Polynomial::one(),
            )],
        ));
        let quarter = &NodeAlgebra::entries(&k, &shifted)[0][1];
        // 1/4 to one digit is a tie; to even it is 0.2. Its neighbours are not ties.
        assert_eq!(quarter.decimal(1).to_string(), "0.2");
        let hair = BigRational::new(One::one(), BigInt::one() << 500);
        let above = shifted.add(&Tensor::from_products(
            &k,
            &[(Polynomial::constant(hair.clone()), Polynomial::one())],
        ));
        assert_eq!(
            NodeAlgebra::entries(&k, &above)[0][1]
                .decimal(1)
                .to_string(),
            "0.3"
        );
        let double_tie = exact(1.0) + exact(f64::EPSILON) / ratio(2, 1) - ratio(1, 4);
        let tie = shifted.add(&Tensor::from_products(
            &k,
            &[(Polynomial::constant(double_tie.clone()), Polynomial::one())],
        ));
        assert_eq!(NodeAlgebra::entries(&k, &tie)[0][1].to_f64(), 1.0);
        let above = tie.add(&Tensor::from_products(
            &k,
            &[(Polynomial::constant(hair), Polynomial::one())],
        ));
        assert_eq!(
            NodeAlgebra::entries(&k, &above)[0][1].to_f64(),
            1.0 + f64::EPSILON
        );
        let zero = shifted.subtract(&Tensor::from_products(
            &k,
            &[(Polynomial::constant(ratio(1, 4)), Polynomial::one())],
        ));
        assert!(NodeAlgebra::entries(&k, &zero)[0][1].is_zero());
        assert_eq!(
            NodeAlgebra::entries(&k, &zero)[0][1].decimal(5).to_string(),
            "0"
        );
        assert_eq!(NodeAlgebra::entries(&k, &zero)[0][0].sign(), Ordering::Less);
    }
}
