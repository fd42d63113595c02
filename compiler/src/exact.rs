//! Exact coefficients, in the strongest algebra that holds them.

use crate::algebra::{Constants, Dense, NodeAlgebra, Number, Reals, StageAlgebra};
use crate::coefficients::Coefficients;
use crate::partitioned::{LowerTriangular, Partitioned};

/// An expression over the coefficients, whichever algebra holds them.
macro_rules! over_algebra {
    ($exact:expr, $pair:ident => $body:expr) => {{
        let exact: &crate::exact::Exact = $exact;
        match exact {
            crate::exact::Exact::Nodes($pair) => $body,
            crate::exact::Exact::Field($pair) => $body,
            crate::exact::Exact::Reals($pair) => $body,
        }
    }};
}
pub(crate) use over_algebra;

/// The coefficients in the algebra that holds them.
#[derive(Debug, Clone, PartialEq)]
pub enum Exact {
    /// Functions of the nodes.
    Nodes(Partitioned<NodeAlgebra>),
    /// Numbers in a constant field.
    Field(Partitioned<Dense<Constants>>),
    /// Expressions.
    Reals(Partitioned<Dense<Reals>>),
}

/// How the coefficients of a tableau are known.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum Tier {
    /// As functions of the nodes, which are all roots of one rational polynomial: all equations are
    /// decided.
    NodeAlgebra,
    /// As elements of a field of algebraic numbers, or of rational functions of one transcendental number
    /// over it: all equations are decided.
    ConstantField,
    /// As expressions that are enclosed as narrowly as needed: equations are refuted, or verified to
    /// [`ZERO_BITS`](crate::algebra::ZERO_BITS) binary places.
    Enclosure,
}

impl Tier {
    /// The name in exports.
    pub fn name(self) -> &'static str {
        match self {
            Tier::NodeAlgebra => "node algebra",
            Tier::ConstantField => "constant field",
            Tier::Enclosure => "enclosure",
        }
    }
}

impl Exact {
    /// The number of stages.
    pub fn stages(&self) -> usize {
        over_algebra!(self, pair => pair.algebra.stages())
    }

    /// Whether it is a splitting with gradient kicks.
    pub fn has_gradient_kicks(&self) -> bool {
        over_algebra!(self, pair => pair.gradient.is_some())
    }

    /// Which matrices of a splitting are lower triangular; `None` for other methods.
    pub fn lower_triangular(&self) -> Option<LowerTriangular> {
        over_algebra!(self, pair => pair.lower_triangular())
    }

    /// All coefficients as numbers that can be enclosed and correctly rounded.
    pub fn numbers(&self) -> Coefficients<Number<'_>> {
        over_algebra!(self, pair => pair.numbers())
    }

    /// The coefficients with positions and momenta exchanged.
    pub fn exchanged(self) -> Self {
        match self {
            Exact::Nodes(pair) => Exact::Nodes(pair.exchanged()),
            Exact::Field(pair) => Exact::Field(pair.exchanged()),
            Exact::Reals(pair) => Exact::Reals(pair.exchanged()),
        }
    }

    /// The coefficients for momenta, for positions too.
    pub fn partner_alone(&self) -> Self {
        match self {
            Exact::Nodes(pair) => Exact::Nodes(pair.partner_alone()),
            Exact::Field(pair) => Exact::Field(pair.partner_alone()),
            Exact::Reals(pair) => Exact::Reals(pair.partner_alone()),
        }
    }

    /// The adjoint method.
    pub fn adjoint(&self) -> Self {
        match self {
            Exact::Nodes(pair) => Exact::Nodes(pair.adjoint()),
            Exact::Field(pair) => Exact::Field(pair.adjoint()),
            Exact::Reals(pair) => Exact::Reals(pair.adjoint()),
        }
    }
}
