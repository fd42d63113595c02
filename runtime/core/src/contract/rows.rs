//! The coefficients of coupled stages by rows, for tableaux that are known only at run time.

use alloc::vec::Vec;

/// An evaluation and its use.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Evaluation {
    /// What is evaluated.
    pub kind: Kind,
    /// Its time, as a fraction of the step.
    pub time: f64,
    /// Its factor besides the step size: its weight, or 1 if the weight is zero.
    pub factor: f64,
    /// Whether it enters the result of the step.
    pub counts: bool,
}

/// What is evaluated.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Kind {
    /// ∂H/∂p, which makes a drift.
    Velocity,
    /// −∂H/∂q, which makes a kick.
    Force,
}

/// Coupled stages by rows of coefficients, those of a tableau that is read at run time.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct CoupledRows {
    /// Positions, and the forces there.
    pub positions: HalfRows,
    /// Momenta, and the velocities there.
    pub momenta: HalfRows,
    /// How the linear systems of a Newton iteration decouple; `None` if they do not.
    pub decoupling: Option<RowDecoupling>,
}

/// One half of coupled stages: stage values, and the evaluations at them.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct HalfRows {
    /// The matrix, by rows: coefficients of the increments of the other half.
    pub matrix: Vec<Vec<f64>>,
    /// Its nonzero entries.
    pub rows: Vec<Row>,
    /// The matrix by columns, if sums are to be side by side; otherwise empty. The last stage is repeated to fill the lanes.
    pub columns: Vec<[f64; 8]>,
    /// For each stage value, the evaluation there.
    pub evaluations: Vec<Evaluation>,
    /// The indices of the evaluations that enter the result of the step.
    pub counting: Vec<usize>,
    /// The matrix, by rows, that extrapolates the increments to the next step of the same size; empty if there is none.
    pub extrapolation: Vec<Vec<f64>>,
}

/// The nonzero entries of a row: index of the increment, and its factor.
pub type Row = Vec<(usize, f64)>;

/// Maximum number of evaluations whose increments are extrapolated, as in emitted methods.
pub const MAX_EVALUATIONS: usize = 16;

/// A [`Decoupling`](crate::solver::Decoupling) in doubles. Its errors cost sweeps, but they never change the solution.
#[derive(Clone, Debug, PartialEq)]
pub struct RowDecoupling {
    /// The blocks in their order: `(α, ω)`, with `ω = 0` for a real eigenvalue.
    pub blocks: Vec<(f64, f64)>,
    /// `X` by rows.
    pub to_stages: Vec<Vec<f64>>,
    /// `X⁻¹` by rows.
    pub from_stages: Vec<Vec<f64>>,
}
