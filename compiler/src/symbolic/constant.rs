//! Real constants as expressions.

use std::cmp::Ordering;
use std::fmt;
use std::hash::{Hash, Hasher};
use std::sync::{Arc, OnceLock};

use num_rational::BigRational;
use num_traits::{One, Zero};

use super::magnitude::{Magnitude, magnitude};
use super::root::AlgebraicRoot;
use super::size::{check, check_rational, fineness, size, words};
use super::{MAX_HEIGHT, MAX_SIGN_BITS, MAX_SIZE};
use crate::error::ErrorKind;
use crate::expression::shown;

/// A real number as an expression: `1/2 - sqrt(2)/4`.
///
/// The tree is immutable and shared. It is canonical with respect to rational arithmetic, powers of equal bases and the
/// symmetries of the functions: constants that are equal for these reasons have equal trees. [`Eq`] compares trees;
/// different trees may have the same value.
///
/// Every operation can return three errors. [`ErrorKind::ExpressionSize`]: its result would exceed a limit of
/// [`crate::symbolic`]. [`ErrorKind::Undecided`]: its result depends on whether a constant is zero, and this could not
/// be decided. [`ErrorKind::Magnitude`]: its result would be too large or too small.
#[derive(Clone)]
pub struct Constant(Arc<Node>);

struct Node {
    tree: Tree,
    size: usize,
    height: usize,
    magnitude: Magnitude,
    /// The sign and a lower bound of log₂|x|, computed once by refinement.
    separation: OnceLock<Option<(Ordering, i64)>>,
}

/// The expression of a constant.
#[derive(Debug, Clone, PartialEq, Eq, Hash, PartialOrd, Ord)]
pub(crate) enum Tree {
    /// A rational number.
    Rational(BigRational),
    /// π
    Pi,
    /// An irrational real root of a polynomial.
    Root(AlgebraicRoot),
    /// `√x` with `x > 0`; rational radicands are integers.
    Sqrt(Constant),
    /// `∛x`; rational radicands are positive integers.
    Cbrt(Constant),
    /// `eˣ` with `x ≠ 0`.
    Exp(Constant),
    /// `ln x` with `x > 0`.
    Ln(Constant),
    /// `cos x`
    Cos(Constant),
    /// `sin x`
    Sin(Constant),
    /// `Π xⁿ` in ascending order of the distinct bases, which are neither rational nor products, and whose exponents
    /// are not 0. A base that is a sum has coprime integer coefficients and a positive first term. The base of a
    /// negative exponent is proved nonzero.
    Product(Vec<(Constant, i32)>),
    /// `c + Σ q·x` in ascending order of the distinct terms, which are neither rational nor sums, and whose
    /// coefficients are not zero. It is not a single term with `c = 0, q = 1`.
    Sum(BigRational, Vec<(Constant, BigRational)>),
}

impl Constant {
    /// Builds a constant from a canonical tree and checks the limits.
    pub(super) fn build(tree: Tree) -> Result<Self, ErrorKind> {
        let (size, below) = size(&tree);
        check("the size of a constant", size, MAX_SIZE)?;
        let height = below + 1;
        check("the height of a constant", height, MAX_HEIGHT)?;
        let magnitude = magnitude(&tree)?;
        let constant = Constant(Arc::new(Node {
            tree,
            size,
            height,
            magnitude,
            separation: OnceLock::new(),
        }));
        constant.check_magnitude()?;
        Ok(constant)
    }

    /// A rational number.
    ///
    /// # Errors
    /// [`ErrorKind::ExpressionSize`] for an integer of more than [`MAX_BITS`](crate::expression::MAX_BITS) bits, and
    /// for a fraction of more than [`MAX_FRACTION_BITS`](super::MAX_FRACTION_BITS).
    pub fn rational(value: BigRational) -> Result<Self, ErrorKind> {
        check_rational(&value)?;
        Self::build(Tree::Rational(value))
    }

    /// An integer.
    pub fn whole(value: i64) -> Self {
        let value = BigRational::from_integer(value.into());
        Constant(Arc::new(Node {
            size: 1 + words(&value),
            height: 1,
            magnitude: Magnitude::of_rational(&value),
            tree: Tree::Rational(value),
            separation: OnceLock::new(),
        }))
    }

    /// The number 0.
    pub fn zero() -> Self {
        Self::whole(0)
    }

    /// The number 1.
    pub fn one() -> Self {
        Self::whole(1)
    }

    /// The number π.
    pub fn pi() -> Self {
        Constant(Arc::new(Node {
            tree: Tree::Pi,
            size: 1,
            height: 1,
            magnitude: Magnitude {
                least: Some(1),
                most: 2,
            },
            separation: OnceLock::new(),
        }))
    }

    /// The expression tree.
    pub(crate) fn tree(&self) -> &Tree {
        &self.0.tree
    }

    /// The size, at most `MAX_SIZE`: the number of operations plus the words of rationals.
    pub fn size(&self) -> usize {
        self.0.size
    }

    /// The number of binary places that an enclosure needs to resolve every part of the constant next to numbers of
    /// order 1.
    pub(crate) fn fineness(&self) -> u64 {
        fineness(self)
    }

    /// The height of the tree; it bounds the depth of every recursion.
    pub(super) fn height(&self) -> usize {
        self.0.height
    }

    /// A number `n` with `|x| ≤ 2ⁿ`, from the tree without an enclosure.
    pub fn magnitude(&self) -> i64 {
        self.0.magnitude.most
    }

    /// The bounds of the binary logarithm that follow from the tree.
    pub(super) fn bounds(&self) -> Magnitude {
        self.0.magnitude
    }

    pub(super) fn separation_cell(&self) -> &OnceLock<Option<(Ordering, i64)>> {
        &self.0.separation
    }

    /// The address of the tree, as a key for tables of computed values.
    pub(super) fn identity(&self) -> usize {
        Arc::as_ptr(&self.0) as usize
    }

    /// The value, if the constant is known to be rational.
    pub fn as_rational(&self) -> Option<&BigRational> {
        match self.tree() {
            Tree::Rational(value) => Some(value),
            _ => None,
        }
    }

    /// Whether the tree is the number 0. Other trees can also have the value 0.
    pub fn is_trivially_zero(&self) -> bool {
        self.as_rational().is_some_and(Zero::is_zero)
    }

    /// Whether the tree is the number 1.
    pub(super) fn is_trivially_one(&self) -> bool {
        self.as_rational().is_some_and(One::is_one)
    }

    /// The rationals `(q₀, q₁)` with the value `q₀ + q₁·π`, if the constant has this form.
    pub fn linear_in_pi(&self) -> Option<(BigRational, BigRational)> {
        match self.tree() {
            Tree::Rational(value) => Some((value.clone(), BigRational::zero())),
            Tree::Pi => Some((BigRational::zero(), BigRational::one())),
            Tree::Sum(constant, terms) => match terms.as_slice() {
                [(x, factor)] if *x.tree() == Tree::Pi => Some((constant.clone(), factor.clone())),
                _ => None,
            },
            _ => None,
        }
    }

    /// The error for a constant that could not be proved zero or nonzero.
    pub(crate) fn undecided(&self) -> ErrorKind {
        ErrorKind::Undecided {
            constant: shown(&self.to_string()),
            bits: MAX_SIGN_BITS,
        }
    }
}

impl PartialEq for Constant {
    fn eq(&self, other: &Self) -> bool {
        Arc::ptr_eq(&self.0, &other.0) || self.size() == other.size() && self.tree() == other.tree()
    }
}

impl Eq for Constant {}

impl Hash for Constant {
    fn hash<H: Hasher>(&self, state: &mut H) {
        self.tree().hash(state);
    }
}

impl PartialOrd for Constant {
    fn partial_cmp(&self, other: &Self) -> Option<Ordering> {
        Some(self.cmp(other))
    }
}

impl Ord for Constant {
    /// An order of trees, not of values.
    fn cmp(&self, other: &Self) -> Ordering {
        if Arc::ptr_eq(&self.0, &other.0) {
            return Ordering::Equal;
        }
        self.tree().cmp(other.tree())
    }
}

impl fmt::Debug for Constant {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        fmt::Display::fmt(self, f)
    }
}

#[cfg(test)]
pub(crate) mod tests {
    use super::*;
    use crate::arithmetic::rational::ratio;
    use crate::arithmetic::rounding::to_f64;
    use crate::expression::{Input, parse_list};

    /// Parses a constant.
    pub(crate) fn constant(text: &str) -> Constant {
        let input = Input { name: "test", text };
        parse_list(input)
            .and_then(|list| list[0].constant(input))
            .expect(text)
    }

    /// The value as a double.
    pub(crate) fn value(constant: &Constant) -> f64 {
        let interval = constant.enclose(80).expect("can be enclosed");
        to_f64(&interval.middle())
    }

    #[test]
    fn rational_and_linear_in_pi_constants_are_recognised_by_their_form() {
        let linear = |text: &str| {
            let parts = constant(text).linear_in_pi();
            parts.map(|(rational, pi)| format!("{rational} {pi}"))
        };
        assert_eq!(linear("pi/3 + pi/6"), Some("0 1/2".to_owned()));
        assert_eq!(linear("2*(1 - pi/4) - pi"), Some("2 -3/2".to_owned()));
        assert_eq!(linear("pi - pi"), Some("0 0".to_owned()));
        assert_eq!(linear("pi^2"), None);
        assert_eq!(linear("pi + e"), None);
        assert_eq!(
            constant("sqrt(4) + cos(pi)").as_rational(),
            Some(&ratio(1, 1))
        );
    }
}
