//! The cause of a failed step, with details for the user.

use crate::contract::storage::is_finite;
use crate::contract::{Class, EvaluationObserver, Failure, Solver, StageStorage, Step, System};
use crate::error::{Error, Quantity};
use crate::number::Vector;

/// A fault of an evaluation.
#[derive(Clone, Copy)]
enum Fault {
    NonFinite,
    /// Its dimension is wrong; the number is the dimension found.
    Dimension(usize),
}

/// Records the first evaluation that is not finite although its argument is, or that has a wrong dimension.
pub struct FirstFault {
    dimension: usize,
    found: Option<(Quantity, usize, Fault)>,
}

impl FirstFault {
    /// For a state of this dimension.
    pub const fn new(dimension: usize) -> Self {
        Self {
            dimension,
            found: None,
        }
    }

    /// The first evaluation that is not finite: its quantity and the number of its stage.
    fn non_finite(&self) -> Option<(Quantity, usize)> {
        match self.found {
            Some((what, stage, Fault::NonFinite)) => Some((what, stage)),
            _ => None,
        }
    }

    /// The first evaluation of a wrong dimension: its quantity, the number of its stage, and its dimension.
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

/// The cause of a result that is not finite and whose position is `q1`. It is an evaluation in `stages` or `observed`, with its stage, or
/// otherwise the position or momentum of the result.
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
pub struct Attempt {
    /// Time at its start.
    pub time: f64,
    /// Its size.
    pub step_size: f64,
    /// Its number, from 1.
    pub step: u64,
    /// Dimension of the state.
    pub dimension: usize,
    /// Whether Newton's iteration may find the stages.
    pub newton_may_help: bool,
}

impl Attempt {
    /// For a step with this number, from 1.
    pub fn of<V: Vector>(step: &Step<'_, V>, number: u64) -> Self {
        Self {
            time: step.time,
            step_size: step.size,
            step: number,
            dimension: step.q.dimension(),
            newton_may_help: false,
        }
    }

    /// The same step with this solver and class.
    pub fn with_solver<V: Vector, S: System<V>, N: Solver<V, S>>(self) -> Self {
        Self {
            // Without memory there is none.
            newton_may_help: cfg!(feature = "alloc") && !N::IS_NEWTON && !S::Class::CONSTRAINED,
            ..self
        }
    }

    /// The error for a `failure` to find the stages. Without a failure, the error for an invalid result whose position is `q1`. The invalid
    /// evaluation is in `stages`, or it was `observed`.
    pub fn error<V: Vector, T: StageStorage<V>>(
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
            newton_may_help,
        } = self;
        let mismatch = observed.mismatch().or_else(|| stages.mismatch(dimension));
        if let Some((what, stage, found)) = mismatch {
            // Checked first: any other fault may be a consequence.
            return Error::EvaluationDimension {
                time,
                step_size,
                step,
                what,
                stage: (stage > 0).then_some(stage),
                expected: dimension,
                found,
            };
        }
        let failure = failure.unwrap_or_else(|| {
            let (what, stage) = culprit(observed, stages, q1);
            Failure::NonFinite { what, stage }
        });
        match failure {
            Failure::NoConvergence {
                residual,
                iterations,
            } => Error::NoConvergence {
                time,
                step_size,
                step,
                residual,
                iterations,
                newton_may_help,
            },
            Failure::Stagnation {
                residual,
                iterations,
            } => Error::Stagnation {
                time,
                step_size,
                step,
                residual,
                iterations,
            },
            Failure::SingularMatrix => Error::SingularMatrix {
                time,
                step_size,
                step,
            },
            Failure::DependentConstraints { constraint, pivot } => Error::DependentConstraints {
                time,
                constraint,
                name: None,
                pivot,
            },
            Failure::MovingGradients => Error::MovingGradients { time },
            Failure::NonFinite { what, stage } => Error::NonFinite {
                time,
                step_size,
                step,
                what,
                stage,
            },
        }
    }
}
