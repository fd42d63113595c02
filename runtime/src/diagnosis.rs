//! Why a step failed, with what a person needs to know about it.

use crate::stage::is_finite;
use crate::{Error, Failure, Quantity, StageStorage, Vector};

/// The step that failed.
pub(crate) struct Attempt {
    /// Time at its start.
    pub time: f64,
    /// Its size.
    pub step_size: f64,
    /// Its number, from 1.
    pub step: u64,
}

impl Attempt {
    /// The error for a failure to find the stages or, without one, for a result that is not sound, of which `q1` is
    /// the position.
    pub(crate) fn error<V: Vector, T: StageStorage<V>>(
        self,
        failure: Option<Failure>,
        stages: &T,
        q1: &V,
        dimension: usize,
    ) -> Error {
        let Self {
            time,
            step_size,
            step,
        } = self;
        if let Some((what, stage, found)) = stages.mismatch(dimension) {
            // First of all: whatever else went wrong may be a consequence.
            return Error::EvaluationDimension {
                time,
                step_size,
                step,
                what,
                stage,
                expected: dimension,
                found,
            };
        }
        match failure {
            Some(Failure::NoConvergence {
                residual,
                iterations,
            }) => Error::NoConvergence {
                time,
                step_size,
                step,
                residual,
                iterations,
            },
            Some(Failure::NonFinite { what, stage }) => Error::NonFinite {
                time,
                step_size,
                step,
                what,
                stage,
            },
            None => {
                let part = if is_finite(q1) {
                    Quantity::Momentum
                } else {
                    Quantity::Position
                };
                let culprit = stages.non_finite();
                Error::NonFinite {
                    time,
                    step_size,
                    step,
                    what: culprit.map_or(part, |(what, _)| what),
                    stage: culprit.map(|(_, stage)| stage),
                }
            }
        }
    }
}
