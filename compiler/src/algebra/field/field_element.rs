//! The elements of a field of constants.

use num_rational::BigRational;

use crate::arithmetic::polynomial::Polynomial;

/// An element of a [`ConstantField`](super::ConstantField): a reduced fraction of polynomials in `X` with a monic denominator.
/// Equal elements have equal representations.
#[derive(Debug, Clone, PartialEq, Eq, Hash)]
pub struct FieldElement {
    /// The coefficients in `Q(θ)`, lowest degree first, the last one nonzero.
    pub(super) numerator: Vec<Polynomial>,
    pub(super) denominator: Vec<Polynomial>,
}

impl FieldElement {
    pub(super) fn new(numerator: Vec<Polynomial>) -> Self {
        FieldElement {
            numerator,
            denominator: vec![Polynomial::one()],
        }
    }

    /// The numerator: coefficients in `Q(θ)` of the powers of `X`, lowest degree first.
    pub fn numerator(&self) -> &[Polynomial] {
        &self.numerator
    }

    /// The denominator: coefficients in `Q(θ)` of the powers of `X`, lowest degree first, the last one 1.
    pub fn denominator(&self) -> &[Polynomial] {
        &self.denominator
    }

    /// Whether the element is zero.
    pub fn is_zero(&self) -> bool {
        self.numerator.is_empty()
    }

    /// The element as one of `Q(θ)`, if it is free of `X`.
    pub fn as_algebraic(&self) -> Option<Polynomial> {
        match (self.numerator.as_slice(), self.denominator.as_slice()) {
            ([], _) => Some(Polynomial::zero()),
            ([number], [_]) => Some(number.clone()),
            _ => None,
        }
    }

    /// The value, if it is rational.
    pub fn as_rational(&self) -> Option<BigRational> {
        self.as_algebraic()?.as_constant()
    }

    /// Whether the denominator is 1.
    pub(super) fn is_polynomial(&self) -> bool {
        self.denominator.len() == 1
    }
}
