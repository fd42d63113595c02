//! How coupled stages are found.

use core::fmt::Debug;

#[cfg(feature = "alloc")]
use crate::method::RunTimeStages;
use crate::method::{
    Failure, Inside, Outcome, StageStorage, StageTableau, Step, StepStatistics, Stopping, WarmStart,
};
use crate::number::{Summation, Vector};
#[cfg(feature = "alloc")]
use crate::system::Class;
use crate::system::System;

/// Finds the stages of a [`Coupled`](crate::emitted::Coupled) plan, for a system `S` over the vectors `V`.
///
/// [`FixedPoint`](crate::solver::FixedPoint) is the one that every system has.
pub trait Solver<V: Vector, S: System<V>>: Copy + Debug + 'static {
    /// Whether it is tried, when an integrator is made, if the velocity is [linear](Step::linear_velocity) in the momentum.
    const TRIES_LINEARITY: bool = false;

    /// Its name in [checkpoints](crate::Checkpoint).
    fn name() -> &'static str {
        core::any::type_name::<Self>()
    }

    /// What it needs for one plan, made once and used for every step.
    type Memory<P: StageTableau>: StageStorage<V>;

    /// Takes `step` and writes its result into `outcome`; returns what that took.
    ///
    /// # Errors
    ///
    /// [`Failure`], where the stages cannot be found. That the result is finite is left to the caller to check.
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

    /// Takes a step of a tableau that is known only when the program runs, and whose stages depend on each other. Code that asks a
    /// solver for it that cannot do it does not compile.
    ///
    /// # Errors
    ///
    /// As for [`take`](Self::take).
    #[cfg(feature = "alloc")]
    fn take_at_run_time<C, R>(
        _step: &Step<'_, V>,
        _system: &S,
        _memory: &mut RunTimeStages<V, C>,
        _kept: WarmStart,
        _stopping: Stopping,
        _outcome: Outcome<'_, V>,
    ) -> Result<StepStatistics, Failure>
    where
        C: Class,
        R: Summation,
        S: System<V, Class = C>,
    {
        const {
            assert!(
                size_of::<V>() == usize::MAX,
                "a tableau at run time is for `FixedPoint` and the solver that an integrator has from the start: leave out `with_solver`"
            );
        }
        Ok(StepStatistics::default())
    }

    /// Adds to `q` and `p` how far they are inside the last step from the straight line between its ends, by the
    /// [polynomials](crate::solver::HalfTableau::polynomial) through the evaluations in `memory`.
    fn extend<P: StageTableau>(memory: &Self::Memory<P>, at: Inside<'_, V>, q: &mut V, p: &mut V);
}
