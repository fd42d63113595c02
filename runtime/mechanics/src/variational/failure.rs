//! Failed steps.

use super::regular::Singular;
use crate::Error;
use symplectic_core::{Error as CoreError, Quantity};

/// Why a step failed.
pub(super) enum Failure {
    /// A value is not finite; stages are counted from 1.
    NonFinite {
        stage: Option<usize>,
    },
    /// An evaluation has a wrong dimension.
    Resized {
        what: Quantity,
        stage: Option<usize>,
        expected: usize,
        found: usize,
    },
    Singular(Singular),
    NotFound {
        residual: f64,
        iterations: u32,
    },
}

impl Failure {
    /// The error of step number `step`; `what` is the quantity that is not finite.
    pub(super) fn error(self, what: Quantity, time: f64, step_size: f64, step: u64) -> Error {
        match self {
            Self::NonFinite { stage } => CoreError::NonFinite {
                time,
                step_size,
                step,
                what,
                stage,
            }
            .into(),
            Self::Resized {
                what,
                stage,
                expected,
                found,
            } => CoreError::EvaluationDimension {
                time,
                step_size,
                step,
                what,
                stage,
                expected,
                found,
            }
            .into(),
            Self::Singular(Singular { component, pivot }) => Error::IrregularLagrangian {
                time,
                step_size,
                step,
                component,
                pivot,
            },
            Self::NotFound {
                residual,
                iterations,
            } => Error::NoEndOfStep {
                time,
                step_size,
                step,
                residual,
                iterations,
            },
        }
    }
}
