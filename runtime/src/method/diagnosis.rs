//! Why a step failed, with what a person needs to know about it.

use crate::error::{Error, Quantity};
use crate::method::storage::is_finite;
use crate::method::{EvaluationObserver, Failure, StageStorage};
use crate::number::Vector;

/// What is wrong with an evaluation.
#[derive(Clone, Copy)]
enum Fault {
    NonFinite,
    /// It has another dimension, this one.
    Dimension(usize),
}

/// Looks for the first evaluation that is wrong although its argument is not.
pub(crate) struct FirstFault {
    dimension: usize,
    found: Option<(Quantity, usize, Fault)>,
}

impl FirstFault {
    /// For a state of this dimension.
    pub(crate) const fn new(dimension: usize) -> Self {
        Self {
            dimension,
            found: None,
        }
    }

    /// The first that is not finite: what, and the number of its stage.
    fn non_finite(&self) -> Option<(Quantity, usize)> {
        match self.found {
            Some((what, stage, Fault::NonFinite)) => Some((what, stage)),
            _ => None,
        }
    }

    /// The first that has another dimension: what, the number of its stage, and its dimension.
    fn mismatch(&self) -> Option<(Quantity, usize, usize)> {
        match self.found {
            Some((what, stage, Fault::Dimension(found))) => Some((what, stage, found)),
            _ => None,
        }
    }
}

impl EvaluationObserver for FirstFault {
    fn evaluation<V: Vector>(&mut self, what: Quantity, stage: usize, argument: &V, value: &V) {
        let dimension = value.dimension();
        let fault = if dimension != self.dimension {
            Fault::Dimension(dimension)
        } else if is_finite(argument) && !is_finite(value) {
            Fault::NonFinite
        } else {
            return;
        };
        self.found.get_or_insert((what, stage, fault));
    }
}

/// What is to blame for a result that is not finite, of which `q1` is the position: an evaluation with its stage, in
/// the stages or `observed`, or else the part of the result.
pub(crate) fn culprit<V: Vector, T: StageStorage<V>>(
    observed: &FirstFault,
    stages: &T,
    q1: &V,
) -> (Quantity, Option<usize>) {
    match observed.non_finite().or_else(|| stages.non_finite()) {
        Some((what, stage)) => (what, Some(stage)),
        None if is_finite(q1) => (Quantity::Momentum, None),
        None => (Quantity::Position, None),
    }
}

/// The step that failed.
pub(crate) struct Attempt {
    /// Time at its start.
    pub time: f64,
    /// Its size.
    pub step_size: f64,
    /// Its number, from 1.
    pub step: u64,
    /// Dimension of the state.
    pub dimension: usize,
}

impl Attempt {
    /// The error for a failure to find the stages or, without one, for a result that is not sound, of which `q1` is
    /// the position. What is wrong is in the stages, or it was `observed`.
    pub(crate) fn error<V: Vector, T: StageStorage<V>>(
        self,
        failure: Option<Failure>,
        observed: &FirstFault,
        stages: &T,
        q1: &V,
    ) -> Error {
        let Self {
            time,
            step_size,
            step,
            dimension,
        } = self;
        let mismatch = observed.mismatch().or_else(|| stages.mismatch(dimension));
        if let Some((what, stage, found)) = mismatch {
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
            Some(Failure::Stagnation {
                residual,
                iterations,
            }) => Error::Stagnation {
                time,
                step_size,
                step,
                residual,
                iterations,
            },
            Some(Failure::SingularMatrix) => Error::SingularMatrix {
                time,
                step_size,
                step,
            },
            Some(Failure::DependentConstraints { constraint, pivot }) => {
                Error::DependentConstraints {
                    time,
                    constraint,
                    name: None,
                    pivot,
                }
            }
            Some(Failure::MovingGradients) => Error::MovingGradients { time },
            Some(Failure::NonFinite { what, stage }) => Error::NonFinite {
                time,
                step_size,
                step,
                what,
                stage,
            },
            None => {
                let (what, stage) = culprit(observed, stages, q1);
                Error::NonFinite {
                    time,
                    step_size,
                    step,
                    what,
                    stage,
                }
            }
        }
    }
}
