//! Failed steps.

use crate::{Error, variational};
use symplectic_core::{Error as CoreError, Quantity};

/// Maximum number of Newton iterations; 2 to 6 are typical.
pub(super) const MAX_ITERATIONS: u32 = 40;

/// Why a step failed.
pub(super) enum Failure {
    /// A failed evaluation of the Lagrangian.
    Evaluation(variational::failure::Failure),
    NonFinite,
    MovingRows,
    Dependent {
        constraint: usize,
    },
    Undetermined {
        component: usize,
    },
    Contradiction {
        what: Quantity,
        index: usize,
        value: f64,
    },
    NotFound {
        residual: f64,
    },
}

impl Failure {
    pub(super) fn error(self, time: f64, step_size: f64, step: u64) -> Error {
        match self {
            Self::NonFinite => CoreError::NonFinite {
                time,
                step_size,
                step,
                what: Quantity::Lagrangian,
                stage: None,
            }
            .into(),
            Self::Evaluation(failure) => failure.error(Quantity::Lagrangian, time, step_size, step),
            Self::MovingRows => CoreError::MovingGradients { time }.into(),
            Self::Dependent { constraint } => CoreError::DependentConstraints {
                time,
                constraint,
                name: None,
                pivot: 0.0,
            }
            .into(),
            Self::Undetermined { component } => Error::UndeterminedPosition {
                time,
                step_size,
                step,
                component,
            },
            Self::Contradiction { what, index, value } => Error::ContradictoryStep {
                time,
                step_size,
                step,
                what,
                index,
                value,
            },
            Self::NotFound { residual } => Error::NoEndOfStep {
                time,
                step_size,
                step,
                residual,
                iterations: MAX_ITERATIONS,
            },
        }
    }
}
