//! What a step took, or why it could not be taken.

use crate::Quantity;

/// What a step took.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub struct Work {
    /// Fixed-point sweeps.
    pub iterations: u32,
    /// Evaluations of a velocity or a force.
    pub evaluations: u32,
}

/// Why the stages of a step could not be found.
#[derive(Clone, Copy, Debug, PartialEq)]
pub enum Failure {
    /// The iteration did not settle: [`Error::NoConvergence`](crate::Error::NoConvergence).
    NoConvergence {
        /// Relative change in the last sweep in which it was finite.
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
}

impl Failure {
    /// The same in a longer step, in which there are this many stages before.
    pub(crate) fn after(self, stages: usize) -> Self {
        match self {
            Self::NonFinite { what, stage } => Self::NonFinite {
                what,
                stage: stage.map(|stage| stages + stage),
            },
            Self::NoConvergence { .. } => self,
        }
    }
}
