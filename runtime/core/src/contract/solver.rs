//! How coupled stages are found.

#[cfg(feature = "alloc")]
use alloc::string::String;
use core::fmt::Debug;

use crate::contract::{
    Failure, Inside, Outcome, StageStorage, StageTableau, Step, StepStatistics, Stopping, System,
    WarmStart,
};
use crate::number::{Summation, Vector};

/// Finds the stages of a [`Coupled`](crate::emitted::Coupled) plan, for a system `S` over the vectors `V`.
///
/// [`FixedPoint`](crate::solver::FixedPoint) is available for every system.
pub trait Solver<V: Vector, S: System<V>>: Copy + Debug + 'static {
    /// Whether it takes steps by Newton's iteration, always or if another one fails.
    const IS_NEWTON: bool = false;

    /// Whether it is [`Automatic`](crate::solver::Automatic).
    #[doc(hidden)]
    const IS_AUTOMATIC: bool = false;

    /// Whether a new integrator tests if the velocity is [linear](Step::linear_velocity) in the momentum.
    const TRIES_LINEARITY: bool = false;

    /// Its name in [checkpoints](crate::Checkpoint): by default that of the type without paths, such as `Newton<Dense<Differences>>`.
    #[cfg(feature = "alloc")]
    #[must_use]
    fn name() -> String {
        without_paths(core::any::type_name::<Self>())
    }

    /// Its memory for one plan, allocated once and used for every step.
    type Memory<P: StageTableau>: StageStorage<V>;

    /// Its memory for a plan that is a value: a tableau at run time, whose stages [`StagePlan::stages`](crate::emitted::StagePlan::stages)
    /// allocates. By default it does not compile for such a plan. A solver that provides it must not read the constants of the plan if the
    /// plan is [`AT_RUN_TIME`](StageTableau::AT_RUN_TIME).
    #[must_use]
    fn memory<P: StageTableau>(_plan: &P, prototype: &V) -> Self::Memory<P> {
        const {
            assert!(
                !P::AT_RUN_TIME,
                "this solver does not take tableaux at run time: take the default solver, `FixedPoint`, `Newton` or `FixedPointThenNewton`"
            );
        }
        <Self::Memory<P> as StageStorage<V>>::like(prototype)
    }

    /// Takes `step` and writes its result into `outcome`; returns the statistics of the step.
    ///
    /// # Errors
    ///
    /// [`Failure`] if the stages cannot be found. The caller checks that the result is finite.
    fn take<P, R>(
        step: &Step<'_, V>,
        system: &S,
        memory: &mut Self::Memory<P>,
        kept: WarmStart,
        stopping: Stopping,
        outcome: Outcome<'_, V>,
    ) -> Result<StepStatistics, Failure>
    where
        P: StageTableau,
        R: Summation,
        S: System<V, Class = P::Class>;

    /// Adds to `q` and `p` their deviations from the straight line between the ends of the last step. These come from the
    /// [polynomials](crate::solver::HalfTableau::polynomial) through the evaluations in `memory`.
    fn extend<P: StageTableau>(memory: &Self::Memory<P>, at: Inside<'_, V>, q: &mut V, p: &mut V);
}

/// A type without the modules before its names: a checkpoint does not depend on where a type is defined.
#[cfg(feature = "alloc")]
fn without_paths(name: &str) -> String {
    let words = name.split_inclusive([' ', ',', '<', '>', '(', ')', '[', ']', ';', '&']);
    words
        .map(|word| word.rsplit("::").next().unwrap_or(word))
        .collect()
}

#[cfg(all(test, feature = "alloc"))]
mod tests {
    use super::without_paths;

    #[test]
    fn names_of_solvers_have_no_paths() {
        let name = "a::b::Newton<a::c::Banded<3, a::d::Differences>, (u8, x::Y)>";
        assert_eq!(
            without_paths(name),
            "Newton<Banded<3, Differences>, (u8, Y)>"
        );
    }
}
