//! The tableaux of steps of systems with constraints, as the macro emits them.

use crate::number::Coefficient;

/// A step `Φ_{γh}` of a method on a system with constraints, holonomic or not. A method that is not a composition consists of one such
/// step.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct ConstrainedStep {
    /// Where it starts, as a fraction of the whole step.
    pub start: Coefficient,
    /// The fraction γ of the whole step.
    pub fraction: Coefficient,
    /// Its tableau.
    pub tableau: &'static ConstrainedTableau,
}

impl ConstrainedStep {
    /// The step from `start` of size `fraction`.
    pub const fn new(
        start: Coefficient,
        fraction: Coefficient,
        tableau: &'static ConstrainedTableau,
    ) -> Self {
        Self {
            start,
            fraction,
            tableau,
        }
    }
}

/// A symplectic tableau without zero weights. There are two exceptions. Symplectic Euler has the end of the step as a last stage of weight
/// zero; its adjoint has the start as a first stage. For holonomic constraints `a_1j = 0`, `a_sj = b_j`, and the matrix `X = (A Ã)_ik`,
/// `i = 2..s`, `k = 1..s−1`, is regular.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct ConstrainedTableau {
    /// `μ_ij = a_ij/b_j` by rows.
    pub positions: &'static [&'static [Coefficient]],
    /// `μ̃_ij = ã_ij/b_j` by rows, rounded so that `μ̃_ij + μ_ji = 1` exactly.
    pub momenta: &'static [&'static [Coefficient]],
    /// `b_i`
    pub weights: &'static [Coefficient],
    /// `c_i`
    pub nodes: &'static [Coefficient],
    /// `c̃_i`
    pub momentum_nodes: &'static [Coefficient],
    /// `X⁻¹` by rows; empty for non-holonomic constraints.
    pub multipliers: &'static [&'static [f64]],
}
