//! Steps that fail because of what earlier steps left.

use crate::error::Error;

/// An error that may be one of the core.
pub trait OfTheCore {
    /// The error of the core, if it is one.
    fn of_the_core(&self) -> Option<&Error>;
}

impl OfTheCore for Error {
    fn of_the_core(&self) -> Option<&Error> {
        Some(self)
    }
}

/// The result `taken` of a step. If it failed, and `forget` finds and discards anything that earlier steps left for its starting values, the
/// result of `take`: of the same step from those of a first step.
///
/// Extrapolated stages, multipliers or velocities of the last step, and decisions of a solver are usually better starting values than those
/// of a first step, but not always. With this rule no step fails that a new integrator can take from the same state.
pub fn or_as_first_step<I, T, E: OfTheCore>(
    run: &mut I,
    taken: Result<T, E>,
    forget: impl FnOnce(&mut I) -> bool,
    take: impl FnOnce(&mut I) -> Result<T, E>,
) -> Result<T, E> {
    match taken {
        Err(error) if may_depend_on_start(&error) && forget(run) => {
            take(run).map_err(|second| reason_of(error, second))
        }
        taken => taken,
    }
}

/// Whether other starting values may help: some faults of a system do not depend on them.
pub(super) fn may_depend_on_start(error: &impl OfTheCore) -> bool {
    !matches!(
        error.of_the_core(),
        Some(Error::EvaluationDimension { .. } | Error::MovingGradients { .. })
    )
}

/// The error to report of two attempts: no convergence is the reason, whatever the other attempt looks like.
pub(super) fn reason_of<E: OfTheCore>(first: E, second: E) -> E {
    match first.of_the_core() {
        Some(Error::NoConvergence { .. }) => first,
        _ => second,
    }
}
