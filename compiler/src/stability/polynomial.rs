//! Polynomials whose coefficients are real numbers of one field: arithmetic, signs and roots.

use std::cmp::Ordering;
use std::fmt::Debug;

use num_bigint::BigInt;
use num_rational::BigRational;
use num_traits::{Signed, Zero};

use super::Coefficient;
use super::isolation::monotonic;
use crate::algebra::Ball;
use crate::algebra::field::NumberField;
use crate::arithmetic::factor::irreducible_factor_at;
use crate::arithmetic::interval::Interval;
use crate::arithmetic::polynomial::Polynomial;
use crate::arithmetic::rational::ratio;
use crate::arithmetic::roots::{Root, classified, enclose, real_roots};

/// A polynomial in one variable `x` over an ordered field. All operands of an operation are over the same field.
pub(super) trait RealPolynomial: Clone + Debug + Send + Sync + 'static {
    /// A rational constant over the same field.
    fn constant(&self, value: &BigRational) -> Self;
    /// The sum.
    fn add(&self, other: &Self) -> Self;
    /// The difference.
    fn subtract(&self, other: &Self) -> Self;
    /// The product.
    fn multiply(&self, other: &Self) -> Self;
    /// The product with a rational number.
    fn scale(&self, factor: &BigRational) -> Self;
    /// The product with `x`.
    fn shift(&self) -> Self;
    /// The quotient by the constant coefficient of another polynomial, which is nonzero.
    fn over_constant_of(&self, other: &Self) -> Self;
    /// The degree; `None` for zero.
    fn degree(&self) -> Option<usize>;
    /// Quotient and remainder of the division by a nonzero polynomial.
    fn divide(&self, divisor: &Self) -> (Self, Self);
    /// A greatest common divisor.
    fn gcd(&self, other: &Self) -> Self;
    /// A common divisor that has all common positive roots.
    fn common_factor(&self, other: &Self) -> Self {
        self.gcd(other)
    }
    /// The derivative.
    fn derivative(&self) -> Self;
    /// Polynomials `f, g` with `self(iy) = f(y²) + iy g(y²)`.
    fn on_imaginary_axis(&self) -> (Self, Self);
    /// The terms of even degree.
    fn even_part(&self) -> Self;
    /// The sign of the leading coefficient.
    fn leading_sign(&self) -> Ordering;
    /// The sign of the value at a rational point.
    fn sign_at(&self, point: &BigRational) -> Ordering;
    /// The positive roots of a squarefree polynomial in ascending order, if they can be separated.
    fn positive_roots(&self) -> Option<Vec<Root>>;
    /// An enclosure of a root with this number of binary places, whose width tends to zero as `bits` grows.
    fn enclose_root(&self, root: &Root, bits: u32) -> Interval;
    /// The exact form of the square root of a positive root, if it is short.
    fn square_root_text(&self, root: &Root) -> Option<String>;
    /// The coefficients, the constant first.
    fn coefficients(&self) -> Vec<Coefficient>;
    /// The quotient of the leading coefficients.
    fn leading_ratio(&self, other: &Self) -> Coefficient;
    /// The bits beyond which enclosures of roots do not get narrower; `None` if there is no such limit.
    fn finest_bits(&self) -> Option<u32> {
        None
    }
    /// This polynomial, if its coefficients are known to be rational.
    fn as_rational(&self) -> Option<&Polynomial>;

    /// Whether this is the zero polynomial.
    fn is_zero(&self) -> bool {
        self.degree().is_none()
    }

    /// The remainder of the division by a nonzero polynomial.
    fn remainder(&self, divisor: &Self) -> Self {
        self.divide(divisor).1
    }

    /// The quotient of an exact division by a polynomial that is 1 at zero. Unspecified if there is a
    /// remainder.
    fn quotient_from_below(&self, divisor: &Self) -> Self {
        self.divide(divisor).0
    }

    /// Whether a nonzero polynomial divides this one.
    fn is_multiple_of(&self, divisor: &Self) -> bool {
        self.remainder(divisor).is_zero()
    }

    /// The polynomial with the same roots, each once.
    fn squarefree(&self) -> Self {
        if self.degree().unwrap_or(0) < 2 {
            return self.clone();
        }
        self.divide(&self.common_factor(&self.derivative())).0
    }
}

impl RealPolynomial for Polynomial {
    fn constant(&self, value: &BigRational) -> Self {
        Polynomial::constant(value.clone())
    }

    fn add(&self, other: &Self) -> Self {
        self + other
    }

    fn subtract(&self, other: &Self) -> Self {
        self - other
    }

    fn multiply(&self, other: &Self) -> Self {
        self * other
    }

    fn scale(&self, factor: &BigRational) -> Self {
        Polynomial::scale(self, factor)
    }

    fn shift(&self) -> Self {
        self * &Polynomial::variable()
    }

    fn over_constant_of(&self, other: &Self) -> Self {
        Polynomial::scale(self, &other.coefficient(0).recip())
    }

    fn degree(&self) -> Option<usize> {
        Polynomial::degree(self)
    }

    fn divide(&self, divisor: &Self) -> (Self, Self) {
        self.div_rem(divisor)
            .unwrap_or_else(|| (Polynomial::zero(), self.clone()))
    }

    fn gcd(&self, other: &Self) -> Self {
        Polynomial::gcd(self, other)
    }

    fn derivative(&self) -> Self {
        Polynomial::derivative(self)
    }

    fn on_imaginary_axis(&self) -> (Self, Self) {
        let all = Polynomial::coefficients(self);
        let part = |first: usize| {
            let chosen = all.iter().skip(first).step_by(2).enumerate();
            let signed = |(k, c): (usize, &BigRational)| if k % 2 == 0 { c.clone() } else { -c };
            Polynomial::from_rationals(&chosen.map(signed).collect::<Vec<_>>())
        };
        (part(0), part(1))
    }

    fn even_part(&self) -> Self {
        let mut coefficients = Polynomial::coefficients(self);
        coefficients
            .iter_mut()
            .skip(1)
            .step_by(2)
            .for_each(|c| *c = BigRational::zero());
        Polynomial::from_rationals(&coefficients)
    }

    fn leading_sign(&self) -> Ordering {
        self.leading().cmp(&BigRational::zero())
    }

    fn sign_at(&self, point: &BigRational) -> Ordering {
        Polynomial::sign_at(self, point)
    }

    /// Uses enclosures, for which a few bits of long coefficients are enough.
    fn positive_roots(&self) -> Option<Vec<Root>> {
        let enclosed = |bits| {
            let coefficients = self.numerators().iter().cloned();
            let balls: Vec<Ball> = coefficients.map(|n| Ball::dyadic(n, 0, bits)).collect();
            monotonic(&balls, bits)
        };
        let Some(intervals) = PRECISIONS.into_iter().find_map(enclosed) else {
            return positive_roots_by_sturm(self);
        };
        let root = |interval: &Interval| {
            let [low, high] = [interval.low(), interval.high()].map(|end| self.sign_at(&end));
            match (low, high) {
                // The lower end belongs to another interval, or is zero.
                (Ordering::Equal, _) => None,
                (_, Ordering::Equal) => Some(Root::Rational(interval.high())),
                (low, high) if low == high => None,
                _ => Some(classified(self, interval)),
            }
        };
        Some(intervals.iter().filter_map(root).collect())
    }

    fn enclose_root(&self, root: &Root, bits: u32) -> Interval {
        enclose(self, root, bits)
    }

    fn square_root_text(&self, root: &Root) -> Option<String> {
        square_root_text(self, root)
    }

    fn coefficients(&self) -> Vec<Coefficient> {
        let coefficients = Polynomial::coefficients(self).into_iter();
        coefficients.map(Coefficient::rational).collect()
    }

    fn leading_ratio(&self, other: &Self) -> Coefficient {
        Coefficient::rational(self.leading() / other.leading())
    }

    fn as_rational(&self) -> Option<&Polynomial> {
        Some(self)
    }
}

/// Bits of the enclosures that separate roots.
const PRECISIONS: [u32; 4] = [256, 1024, 4096, 16384];

/// The positive roots of a polynomial with some very close roots, if the cost is low enough.
fn positive_roots_by_sturm(polynomial: &Polynomial) -> Option<Vec<Root>> {
    let coefficients = polynomial.numerators();
    let longest = coefficients.iter().map(BigInt::bits).max().unwrap_or(0);
    // The coefficients of the remainders are as long as a determinant.
    let words = longest * coefficients.len() as u64 / 64;
    if words * coefficients.len() as u64 > MAX_WORDS {
        return None;
    }
    let positive = |root: &Root| match root {
        Root::Rational(value) => value.is_positive(),
        // A zero would be a rational root, so enough places determine the sign.
        Root::Irrational(interval) => (interval.bits()..)
            .find_map(|bits| enclose(polynomial, root, bits).sign())
            .is_some_and(Ordering::is_gt),
    };
    Some(
        real_roots(polynomial)
            .into_iter()
            .filter(positive)
            .collect(),
    )
}

/// The words of all remainders in Sturm's sequence beyond which the search takes seconds.
const MAX_WORDS: u64 = 1 << 13;

/// Number of coefficients beyond which quadratic roots are not searched for: factoring would take longer than
/// everything else.
const LONGEST: usize = 12;
/// Length of coefficients, in bits, beyond which quadratic roots are not searched for either.
const LONGEST_COEFFICIENT: u64 = 1 << 13;

/// The square root of a positive root that is rational or quadratic: `2*sqrt(2)`, `sqrt(5 - sqrt(5))`.
fn square_root_text(polynomial: &Polynomial, root: &Root) -> Option<String> {
    let rationals = NumberField::rationals();
    let text = match root {
        Root::Rational(value) => {
            let extension = rationals.square_root(&Polynomial::constant(value.clone()))?;
            extension.field.display(&extension.number)
        }
        Root::Irrational(interval) => {
            let mut coefficients = polynomial.numerators().iter();
            let long = coefficients.any(|n| n.bits() > LONGEST_COEFFICIENT);
            if long || polynomial.degree()? > LONGEST {
                return None;
            }
            let factor = irreducible_factor_at(polynomial, root)?;
            if factor.degree() != Some(2) {
                return None;
            }
            let [c, b, a] = [0, 1, 2].map(|k| factor.coefficient(k));
            let discriminant = &b * &b - ratio(4, 1) * &a * c;
            let half = (ratio(2, 1) * &a).recip();
            let centre = -b * &half;
            let extension = rationals.square_root(&Polynomial::constant(discriminant))?;
            // The isolating interval holds one of the two roots. Either it is on one side of the centre, or
            // the sign of the value at the centre tells on which side the root is.
            let above = match (interval.low() >= centre, interval.high() <= centre) {
                (true, _) => true,
                (_, true) => false,
                _ => {
                    factor.evaluate(&interval.low()).is_positive()
                        == factor.evaluate(&centre).is_positive()
                }
            };
            let offset = extension.number.scale(&half.abs());
            let centre = Polynomial::constant(centre);
            let square = if above {
                &centre + &offset
            } else {
                &centre - &offset
            };
            let extension = extension.field.square_root(&square)?;
            extension.field.display(&extension.number)
        }
    };
    (text.len() <= SHORT).then_some(text)
}

/// Greatest length of an exact form that counts as readable.
pub(super) const SHORT: usize = 40;

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn square_roots_of_roots_are_written() {
        let texts = |coefficients: &[i64]| -> Vec<Option<String>> {
            let polynomial = Polynomial::from_integers(coefficients);
            let roots = polynomial.positive_roots().expect("roots");
            roots
                .iter()
                .map(|root| polynomial.square_root_text(root))
                .collect()
        };
        let some = |text: &str| Some(text.to_owned());
        assert_eq!(texts(&[0, -8, 1]), [some("2*sqrt(2)")]);
        assert_eq!(texts(&[-9, 4]), [some("3/2")]);
        assert_eq!(texts(&[-2, 0, 1]), [some("sqrt(sqrt(2))")]);
        assert_eq!(
            texts(&[20, -10, 1]),
            [some("sqrt(5 - sqrt(5))"), some("sqrt(5 + sqrt(5))")]
        );
        // (√2 ± 1)²
        assert_eq!(
            texts(&[1, -6, 1]),
            [some("-1 + sqrt(2)"), some("1 + sqrt(2)")]
        );
        assert_eq!(texts(&[-2, 0, 0, 1]), [None]);
        // A quadratic factor of a longer polynomial: (x² − 3)(x³ − 2)
        assert_eq!(texts(&[6, 0, -2, -3, 0, 1]), [None, some("sqrt(sqrt(3))")]);
    }

    #[test]
    fn a_polynomial_on_the_imaginary_axis_splits_into_real_and_imaginary() {
        // (1 + x + x² + x³ + x⁴)(iy) = 1 − y² + y⁴ + iy(1 − y²)
        let (f, g) = Polynomial::from_integers(&[1; 5]).on_imaginary_axis();
        assert_eq!(f, Polynomial::from_integers(&[1, -1, 1]));
        assert_eq!(g, Polynomial::from_integers(&[1, -1]));
    }
}
