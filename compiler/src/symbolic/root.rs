//! Real roots of polynomials as constants.

use std::cmp::Ordering;
use std::hash::{Hash, Hasher};
use std::sync::{Arc, Mutex, PoisonError};

use num_bigint::BigInt;
use num_traits::ToPrimitive;

use super::size::check;
use super::{Constant, MAX_ROOT_DEGREE, MAX_ROOT_SIZE, Tree};
use crate::arithmetic::interval::Interval;
use crate::arithmetic::polynomial::Polynomial;
use crate::arithmetic::roots::{self, Root, real_roots};
use crate::error::ErrorKind;
use crate::expression::shown;

/// An irrational real root of a squarefree polynomial with coprime integer coefficients.
#[derive(Debug, Clone)]
pub(crate) struct AlgebraicRoot {
    pub(crate) polynomial: Polynomial,
    /// Its number among the real roots in ascending order, counted from 1.
    pub(crate) index: usize,
    /// Its isolating interval.
    pub(crate) root: Root,
    /// The finest enclosure so far, shared because a root is part of many constants.
    finest: Arc<Mutex<Option<Interval>>>,
}

impl AlgebraicRoot {
    /// The data that identify the root.
    fn key(&self) -> (&[BigInt], usize) {
        (self.polynomial.numerators(), self.index)
    }

    /// An enclosure with this number of binary places, at most two units wide.
    pub(super) fn enclose(&self, bits: u32) -> Interval {
        let mut finest = self.finest.lock().unwrap_or_else(PoisonError::into_inner);
        match &*finest {
            Some(known) if known.bits() >= bits => known.with_bits(bits),
            _ => finest
                .insert(roots::enclose(&self.polynomial, &self.root, bits))
                .clone(),
        }
    }
}

impl PartialEq for AlgebraicRoot {
    fn eq(&self, other: &Self) -> bool {
        self.key() == other.key()
    }
}

impl Eq for AlgebraicRoot {}

impl Hash for AlgebraicRoot {
    fn hash<H: Hasher>(&self, state: &mut H) {
        self.key().hash(state);
    }
}

impl PartialOrd for AlgebraicRoot {
    fn partial_cmp(&self, other: &Self) -> Option<Ordering> {
        Some(self.cmp(other))
    }
}

impl Ord for AlgebraicRoot {
    fn cmp(&self, other: &Self) -> Ordering {
        self.key().cmp(&other.key())
    }
}

impl Constant {
    /// The real root of a polynomial with this index, counted from 1 in ascending order; multiple roots count once.
    ///
    /// # Errors
    /// [`ErrorKind::RootIndex`] if there is no such root, [`ErrorKind::Type`] for a constant polynomial,
    /// [`ErrorKind::ExpressionSize`] for a degree or coefficients beyond the limits.
    pub fn root(polynomial: &Polynomial, index: &BigInt) -> Result<Self, ErrorKind> {
        let degree = polynomial.degree().unwrap_or(0);
        if degree == 0 {
            return Err(ErrorKind::Type {
                found: "a constant".to_owned(),
                expected: "a polynomial of degree at least 1".to_owned(),
            });
        }
        check("the degree", degree, MAX_ROOT_DEGREE)?;
        let primitive = polynomial.primitive();
        let bits = primitive.numerators().iter().map(BigInt::bits).max();
        check(
            "the degree times the bits of a coefficient",
            degree.saturating_mul(bits.unwrap_or(0) as usize),
            MAX_ROOT_SIZE,
        )?;
        let repeated = primitive.gcd(&primitive.derivative());
        let squarefree = primitive
            .div_rem(&repeated)
            .map_or(primitive, |(quotient, _)| quotient.primitive());
        let roots = real_roots(&squarefree);
        let position = (index - 1u32)
            .to_usize()
            .filter(|&position| position < roots.len());
        let Some(position) = position else {
            return Err(ErrorKind::RootIndex {
                polynomial: polynomial.display("t").to_string(),
                index: shown(&index.to_string()),
                real: roots.len(),
            });
        };
        match &roots[position] {
            Root::Rational(value) => Self::rational(value.clone()),
            root => Self::build(Tree::Root(AlgebraicRoot {
                polynomial: squarefree,
                index: position + 1,
                root: root.clone(),
                finest: Arc::default(),
            })),
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::symbolic::constant::tests::value;

    #[test]
    fn roots_are_counted_from_one_in_ascending_order() {
        let cubic = Polynomial::from_integers(&[0, -2, 0, 1]);
        let root = |index: i64| Constant::root(&cubic, &index.into());
        assert_eq!(root(2), Ok(Constant::zero()));
        assert!((value(&root(1).expect("exists")) + 2f64.sqrt()).abs() < 1e-12);
        assert!((value(&root(3).expect("exists")) - 2f64.sqrt()).abs() < 1e-12);
        for index in [-1, 0, 4, i64::MIN] {
            assert!(matches!(
                root(index),
                Err(ErrorKind::RootIndex { real: 3, .. })
            ));
        }
        let constant = Constant::root(&Polynomial::one(), &1.into());
        assert!(matches!(constant, Err(ErrorKind::Type { .. })));
        let long = Constant::root(&Polynomial::monomial(40), &1.into());
        assert!(matches!(long, Err(ErrorKind::ExpressionSize { .. })));
    }
}
