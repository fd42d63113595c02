//! What a step took, or why it could not be taken.

use core::ops::AddAssign;

use crate::error::Quantity;

/// What a step took.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct StepStatistics {
    /// Sweeps of the fixed-point iteration, or of another one.
    pub iterations: u32,
    /// Evaluations of a velocity or a force; those that derivatives are made of are not counted.
    pub evaluations: u32,
    /// Times the linear systems of a Newton iteration were made and factored.
    pub factorisations: u32,
    /// Attempts to find the stages that failed and were made good by another solver.
    pub rejected: u32,
    /// How large the positions and the momenta of coupled stages were when that was last looked for, of several steps in the last; zero
    /// where that is not known. Without a tolerance it is right but for a factor of two; of momenta where they show that an iteration
    /// goes on, which in plain sums those of a separable system do not.
    pub scales: [f64; 2],
    /// The relative change of the stages in the last sweep of a Newton iteration; of several steps, the largest one. Zero elsewhere.
    pub residual: f64,
}

impl Default for StepStatistics {
    /// Nothing. Written out, for that of an array would be a call: see `array.rs`.
    #[inline(always)]
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
    /// The iteration did not settle: [`Error::NoConvergence`](crate::Error::NoConvergence).
    NoConvergence {
        /// Relative change in the last sweep in which it was finite; infinite where that was not looked at.
        residual: f64,
        /// Sweeps made.
        iterations: u32,
    },
    /// The iteration stands still, far above rounding errors: [`Error::Stagnation`](crate::Error::Stagnation).
    Stagnation {
        /// Relative change in the last sweep.
        residual: f64,
        /// Sweeps made.
        iterations: u32,
    },
    /// An evaluation at the start of the iteration is not finite: [`Error::NonFinite`](crate::Error::NonFinite).
    NonFinite {
        /// What is not finite.
        what: Quantity,
        /// The stage of the evaluation, from 1.
        stage: Option<usize>,
    },
    /// A linear system of a Newton iteration has no solution: [`Error::SingularMatrix`](crate::Error::SingularMatrix).
    SingularMatrix,
    /// The gradient of a constraint depends on those before it: [`Error::DependentConstraints`](crate::Error::DependentConstraints).
    DependentConstraints {
        /// The constraint, from 0.
        constraint: usize,
        /// What is left of its row of `G M⁻¹ Gᵀ`, relative to its diagonal entry.
        pivot: f64,
    },
    /// The gradients of the constraints were set in other places than before: [`Error::MovingGradients`](crate::Error::MovingGradients).
    MovingGradients,
}

impl Failure {
    /// The same in a longer step, in which there are this many stages before.
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
