//! How coupled stages are found.

use core::fmt::Debug;

use crate::method::{
    Failure, Inside, Outcome, StageStorage, StageTableau, Step, StepStatistics, Stopping, WarmStart,
};
use crate::number::{Summation, Vector};
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

    /// Adds to `q` and `p` how far they are inside the last step from the straight line between its ends, by the
    /// [polynomials](crate::solver::HalfTableau::polynomial) through the evaluations in `memory`.
    fn extend<P: StageTableau>(memory: &Self::Memory<P>, at: Inside<'_, V>, q: &mut V, p: &mut V);
}
