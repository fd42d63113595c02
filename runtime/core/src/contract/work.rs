//! Statistics of a step, and why a step failed.

use core::ops::AddAssign;

use crate::error::Quantity;

/// Statistics of a step.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct StepStatistics {
    /// Sweeps of the fixed-point iteration or of another iteration.
    pub iterations: u32,
    /// Evaluations of a velocity or a force. Evaluations made to form derivatives are not counted.
    pub evaluations: u32,
    /// How often the linear systems of a Newton iteration were assembled and factored.
    pub factorisations: u32,
    /// Failed attempts to find the stages, after which another solver or the starting values of a first step succeeded.
    pub rejected: u32,
    /// The largest absolute values of the positions and of the momenta of the coupled stages, as last measured. A fixed-point iteration
    /// measures them no later than the first change that can be rounding errors. If the momenta are eliminated, both values are that of the
    /// positions. Zero if unknown. For several steps, those of the last step.
    pub scales: [f64; 2],
    /// Relative change of the stages in the last sweep of a Newton iteration; for several steps, the largest one. Zero for other solvers.
    pub residual: f64,
}

impl Default for StepStatistics {
    /// All zero. Written out because the default of an array would be a function call: see `array.rs`.
    #[cfg_attr(not(debug_assertions), inline(always))]
    fn default() -> Self {
        Self {
            iterations: 0,
            evaluations: 0,
            factorisations: 0,
            rejected: 0,
            scales: [0.0; 2],
            residual: 0.0,
        }
    }
}

impl AddAssign for StepStatistics {
    #[inline]
    fn add_assign(&mut self, other: Self) {
        self.iterations += other.iterations;
        self.evaluations += other.evaluations;
        self.factorisations += other.factorisations;
        self.rejected += other.rejected;
        self.scales = other.scales;
        self.residual = self.residual.max(other.residual);
    }
}

/// Why the stages of a step could not be found.
#[derive(Clone, Copy, Debug, PartialEq)]
pub enum Failure {
    /// The iteration did not converge: [`Error::NoConvergence`](crate::Error::NoConvergence).
    NoConvergence {
        /// Relative change in the last sweep in which it was finite; infinite if it was not measured.
        residual: f64,
        /// Number of sweeps.
        iterations: u32,
    },
    /// The iteration stagnates far above round-off: [`Error::Stagnation`](crate::Error::Stagnation).
    Stagnation {
        /// Relative change in the last sweep.
        residual: f64,
        /// Number of sweeps.
        iterations: u32,
    },
    /// An evaluation at the start of the iteration is not finite: [`Error::NonFinite`](crate::Error::NonFinite).
    NonFinite {
        /// The quantity that is not finite.
        what: Quantity,
        /// The stage of the evaluation, from 1.
        stage: Option<usize>,
    },
    /// A linear system of a Newton iteration has no solution: [`Error::SingularMatrix`](crate::Error::SingularMatrix).
    SingularMatrix,
    /// The gradient of a constraint depends linearly on those of the previous constraints:
    /// [`Error::DependentConstraints`](crate::Error::DependentConstraints).
    DependentConstraints {
        /// The constraint, from 0.
        constraint: usize,
        /// The pivot of its row of `G M⁻¹ Gᵀ`, relative to its diagonal entry.
        pivot: f64,
    },
    /// The sparsity pattern of the gradients of the constraints changed: [`Error::MovingGradients`](crate::Error::MovingGradients).
    MovingGradients,
}

impl Failure {
    /// The same failure as part of a longer step, in which `stages` stages come before it.
    pub(crate) fn after(self, stages: usize) -> Self {
        match self {
            Self::NonFinite { what, stage } => Self::NonFinite {
                what,
                stage: stage.map(|stage| stages + stage),
            },
            _ => self,
        }
    }
}
