//! Steps that fail because of what earlier steps left.

use crate::error::Error;

/// The result `taken` of a step. If it failed, and `forget` finds and discards anything that earlier steps left for its starting values, the
/// result of `take`: of the same step from those of a first step.
///
/// Extrapolated stages, multipliers or velocities of the last step, and decisions of a solver are usually better starting values than those
/// of a first step, but not always. With this rule no step fails that a new integrator can take from the same state.
pub fn or_as_first_step<I, T>(
    run: &mut I,
    taken: Result<T, Error>,
    forget: impl FnOnce(&mut I) -> bool,
    take: impl FnOnce(&mut I) -> Result<T, Error>,
) -> Result<T, Error> {
    // Whatever the starting values are, these faults of a system remain.
    let is_of_the_system = |error: &Error| {
        matches!(
            error,
            Error::EvaluationDimension { .. } | Error::MovingGradients { .. }
        )
    };
    match taken {
        Err(error) if !is_of_the_system(&error) && forget(run) => take(run).map_err(|second| {
            // No convergence is the reason, whatever the other attempt looks like.
            match error {
                Error::NoConvergence { .. } => error,
                _ => second,
            }
        }),
        taken => taken,
    }
}
