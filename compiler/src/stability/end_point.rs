//! The end points of intervals: zero, infinity, and square roots of roots of polynomials.

use std::cmp::Ordering;
use std::fmt::{self, Debug};
use std::sync::Arc;

use num_rational::BigRational;
use num_traits::{Signed, Zero};

use super::intervals::SHOWN_DIGITS;
use super::polynomial::RealPolynomial;
use crate::arithmetic::elementary::sqrt;
use crate::arithmetic::enclosure_cache::EnclosureCache;
use crate::arithmetic::interval::Interval;
use crate::arithmetic::rational::ratio;
use crate::arithmetic::roots::Root;
use crate::arithmetic::rounding::{self, Decimal, exact};

/// A positive root of a squarefree polynomial.
#[derive(Debug, Clone)]
pub(super) struct PositiveRoot<P> {
    pub(super) polynomial: Arc<P>,
    pub(super) root: Root,
    finest: EnclosureCache,
}

/// A positive real number that can be enclosed to any precision and compared with rationals.
pub(super) trait PositiveReal: Debug + Send + Sync {
    /// An enclosure with this many binary places. Its width tends to zero as `bits` grows, as far as the number is known.
    fn enclose(&self, bits: u32) -> Interval;
    /// Whether the number equals `value`.
    fn equals(&self, value: &BigRational) -> bool;
}

impl<P: RealPolynomial> PositiveRoot<P> {
    pub(super) fn new(polynomial: &Arc<P>, root: Root) -> Self {
        PositiveRoot {
            polynomial: Arc::clone(polynomial),
            root,
            finest: EnclosureCache::default(),
        }
    }

    pub(super) fn enclose(&self, bits: u32) -> Interval {
        self.finest
            .enclose(bits, |bits| self.polynomial.enclose_root(&self.root, bits))
    }
}

impl<P: RealPolynomial> PositiveReal for PositiveRoot<P> {
    fn enclose(&self, bits: u32) -> Interval {
        PositiveRoot::enclose(self, bits)
    }

    fn equals(&self, value: &BigRational) -> bool {
        match &self.root {
            Root::Rational(root) => root == value,
            // The only root in the interval.
            Root::Irrational(interval) => {
                interval.contains(value) && self.polynomial.sign_at(value).is_eq()
            }
        }
    }
}

/// An end point of an interval of step sizes: zero, infinity, or the square root of an algebraic or otherwise
/// exactly known number.
#[derive(Debug, Clone)]
pub struct EndPoint(Value);

#[derive(Debug, Clone)]
enum Value {
    Zero,
    SquareRoot {
        square: Arc<dyn PositiveReal>,
        text: Option<String>,
    },
    Infinity,
}

impl EndPoint {
    /// The number 0.
    pub const ZERO: EndPoint = EndPoint(Value::Zero);
    /// No bound.
    pub const INFINITY: EndPoint = EndPoint(Value::Infinity);

    /// The square root of a root.
    pub(super) fn square_root_of<P: RealPolynomial>(root: &PositiveRoot<P>) -> Self {
        EndPoint(Value::SquareRoot {
            text: root.polynomial.square_root_text(&root.root),
            square: Arc::new(root.clone()),
        })
    }

    /// The square root of a number without a short exact form.
    pub(super) fn square_root(square: impl PositiveReal + 'static) -> Self {
        EndPoint(Value::SquareRoot {
            square: Arc::new(square),
            text: None,
        })
    }

    /// Whether the end point is zero.
    pub fn is_zero(&self) -> bool {
        matches!(self.0, Value::Zero)
    }

    /// Whether the end point is infinite.
    pub fn is_infinite(&self) -> bool {
        matches!(self.0, Value::Infinity)
    }

    /// The exact form, if it is short: `0`, `2*sqrt(2)`, `infinity`.
    pub fn exact(&self) -> Option<&str> {
        match &self.0 {
            Value::Zero => Some("0"),
            Value::SquareRoot { text, .. } => text.as_deref(),
            Value::Infinity => Some("infinity"),
        }
    }

    /// An enclosure with this number of binary places, whose width tends to zero as `bits` grows; `None` if
    /// infinite.
    pub fn enclose(&self, bits: u32) -> Option<Interval> {
        match &self.0 {
            Value::Zero => Some(Interval::enclosing(&BigRational::zero(), bits)),
            Value::SquareRoot { square, .. } => sqrt(&square.enclose(bits)),
            Value::Infinity => None,
        }
    }

    /// How the end point compares with a rational; `Equal` also if enclosures cannot distinguish them.
    pub fn compare(&self, value: &BigRational) -> Ordering {
        let Value::SquareRoot { square, .. } = &self.0 else {
            return match self.is_zero() {
                true => BigRational::zero().cmp(value),
                false => Ordering::Greater,
            };
        };
        if !value.is_positive() {
            return Ordering::Greater;
        }
        let value = value * value;
        if square.equals(&value) {
            return Ordering::Equal;
        }
        let mut bits = FIRST_BITS;
        let mut width = None;
        loop {
            let interval = square.enclose(bits);
            if interval.low() > value {
                return Ordering::Greater;
            }
            if interval.high() < value {
                return Ordering::Less;
            }
            if is_stuck(&mut width, &interval) {
                return Ordering::Equal;
            }
            bits *= 2;
        }
    }

    /// The number rounded to `digits` significant decimal digits, ties to even; `infinity` if infinite. Fewer digits are returned if
    /// the number is not known to that many.
    pub fn decimal(&self, digits: usize) -> String {
        let digits = self.known_digits(digits);
        self.round(|value| Decimal::round(value, digits), Decimal::value)
            .map_or_else(|| "infinity".to_owned(), |decimal| decimal.to_string())
    }

    /// The exact form if it is short, and otherwise this many digits.
    pub(super) fn text(&self, digits: usize) -> String {
        match (&self.0, self.exact()) {
            (Value::Infinity, _) => "∞".to_owned(),
            (_, Some(text)) => text.to_owned(),
            (_, None) => format!("{}…", self.decimal(digits)),
        }
    }

    /// The nearest double, ties to even.
    pub fn to_f64(&self) -> f64 {
        self.round(rounding::to_f64, |&double| exact(double))
            .unwrap_or(f64::INFINITY)
    }

    /// The number of digits, at most `digits`, that enclosures determine.
    fn known_digits(&self, digits: usize) -> usize {
        if self.is_zero() {
            return digits;
        }
        let mut bits = FIRST_BITS;
        let mut width = None;
        while let Some(interval) = self.enclose(bits) {
            let known = interval.magnitude_bits() - interval.width_bits();
            // A digit takes between 3 and 4 bits.
            let known = usize::try_from(known).unwrap_or(0);
            if known / 4 >= digits {
                break;
            }
            if is_stuck(&mut width, &interval) {
                return digits.min((known / 4).max(1));
            }
            bits *= 2;
        }
        digits
    }

    /// Rounds by refining the enclosure until both ends round to the same value. They do unless the number
    /// is the midpoint of two neighbours; that is decided exactly.
    fn round<T: PartialEq>(
        &self,
        round: impl Fn(&BigRational) -> T,
        value: impl Fn(&T) -> BigRational,
    ) -> Option<T> {
        let mut bits = FIRST_BITS;
        let mut width = None;
        loop {
            let interval = self.enclose(bits)?;
            let (below, above) = (round(&interval.low()), round(&interval.high()));
            if below == above {
                return Some(below);
            }
            let middle = (value(&below) + value(&above)) / ratio(2, 1);
            if self.compare_is_equal(&middle) {
                return Some(round(&middle));
            }
            if is_stuck(&mut width, &interval) {
                return Some(round(&interval.middle()));
            }
            bits *= 2;
        }
    }

    fn compare_is_equal(&self, value: &BigRational) -> bool {
        match &self.0 {
            Value::Zero => value.is_zero(),
            Value::SquareRoot { square, .. } => square.equals(&(value * value)),
            Value::Infinity => false,
        }
    }
}

/// Whether doubling the places has hardly narrowed the enclosure.
fn is_stuck(width: &mut Option<BigRational>, interval: &Interval) -> bool {
    let now = interval.width();
    let before = width.replace(now.clone());
    before.is_some_and(|before| now.is_positive() && now * ratio(2, 1) > before)
}

/// Binary places of the first enclosures.
const FIRST_BITS: u32 = 128;

impl fmt::Display for EndPoint {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        f.write_str(&self.text(SHOWN_DIGITS))
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::arithmetic::polynomial::Polynomial;

    fn end_point(coefficients: &[i64]) -> EndPoint {
        let polynomial = Polynomial::from_integers(coefficients);
        let root = polynomial.positive_roots().expect("roots").remove(0);
        EndPoint::square_root_of(&PositiveRoot::new(&Arc::new(polynomial), root))
    }

    #[test]
    fn decimals_are_correctly_rounded() {
        let root = end_point(&[-8, 1]);
        assert_eq!(root.decimal(30), "2.82842712474619009760337744842");
        assert_eq!(root.to_f64(), 8f64.sqrt());
        assert_eq!(root.to_string(), "2*sqrt(2)");
        // √(1/16) = 0.25 is a tie at one digit, and a double.
        let tie = end_point(&[-1, 16]);
        assert_eq!((tie.decimal(1), tie.to_f64()), ("0.2".to_owned(), 0.25));
        assert_eq!(tie.exact(), Some("1/4"));
        let cubic = end_point(&[-2, 0, 0, 1]);
        assert_eq!(cubic.to_string(), "1.12246204831…");
        assert_eq!(EndPoint::ZERO.decimal(3), "0");
        assert_eq!(EndPoint::INFINITY.to_f64(), f64::INFINITY);
    }

    #[test]
    fn end_points_compare_with_rationals() {
        let two = end_point(&[-4, 1]);
        assert_eq!(two.compare(&ratio(2, 1)), Ordering::Equal);
        assert_eq!(two.compare(&ratio(-3, 1)), Ordering::Greater);
        let near = ratio(2, 1) + exact(2f64.powi(-300));
        assert_eq!(two.compare(&near), Ordering::Less);
        assert_eq!(EndPoint::ZERO.compare(&ratio(0, 1)), Ordering::Equal);
        assert_eq!(EndPoint::INFINITY.compare(&near), Ordering::Greater);
    }
}
