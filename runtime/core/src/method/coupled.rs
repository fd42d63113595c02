//! Steps with stages that depend on each other.

use core::marker::PhantomData;

#[cfg(feature = "alloc")]
use crate::contract::LaneStep;
#[cfg(feature = "alloc")]
use crate::contract::tableau::eliminates;
use crate::contract::{
    Failure, Inside, Interpolation, Outcome, Plan, Possible, Solver, StageTableau, Step,
    StepStatistics, Stopping, System, WarmStart,
};
#[cfg(feature = "alloc")]
use crate::number::Lanes;
use crate::number::{Summation, Vector};

/// The plan of a step with stages that depend on each other: a [`Solver`] finds them.
#[derive(Clone, Copy, Debug)]
pub struct Coupled<P>(PhantomData<P>);

impl<P: StageTableau> Possible for Coupled<P> {}

impl<P: StageTableau> Plan for Coupled<P> {
    type Class = P::Class;
    type Memory<V: Vector, S: System<V>, N: Solver<V, S>> = N::Memory<P>;

    #[cfg_attr(not(debug_assertions), inline(always))]
    fn take<R: Summation, V: Vector, S: System<V, Class = P::Class>, N: Solver<V, S>>(
        step: &Step<'_, V>,
        system: &S,
        memory: &mut N::Memory<P>,
        kept: WarmStart,
        stopping: Stopping,
        outcome: Outcome<'_, V>,
    ) -> Result<StepStatistics, Failure> {
        N::take::<P, R>(step, system, memory, kept, stopping, outcome)
    }

    #[cfg(feature = "alloc")]
    #[inline]
    fn goes_in_lanes<V, S, N>() -> bool
    where
        V: Vector,
        S: System<V, Class = P::Class>,
        N: Solver<V, S>,
    {
        // If momenta are eliminated, the velocities' memory holds the slopes of the positions, one for each force.
        let slopes_fit = !eliminates::<P>() || P::POSITIONS.count == P::MOMENTA.count;
        slopes_fit && N::goes_in_lanes()
    }

    #[cfg(feature = "alloc")]
    #[inline]
    fn lane_step<R, V, S, N, W, J>() -> Option<LaneStep<W, J>>
    where
        R: Summation,
        V: Vector,
        S: System<V, Class = P::Class>,
        N: Solver<V, S>,
        W: Vector<Scalar: Lanes>,
        J: System<W, Class = P::Class>,
    {
        N::lane_step::<P, R, W, J>()
    }

    const INTERPOLATION: Interpolation =
        Interpolation::of_stages(P::MOMENTA.polynomial, P::POSITIONS.polynomial);

    fn extend<V, S, N>(memory: &N::Memory<P>, at: Inside<'_, V>, q: &mut V, p: &mut V)
    where
        V: Vector,
        S: System<V, Class = P::Class>,
        N: Solver<V, S>,
    {
        N::extend::<P>(memory, at, q, p);
    }
}
