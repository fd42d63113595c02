//! Steps with stages that depend on each other.

use core::marker::PhantomData;

use crate::contract::{
    Failure, Inside, Interpolation, Outcome, Plan, Possible, Solver, StageTableau, Step,
    StepStatistics, Stopping, System, TableauWork, WarmStart,
};
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

    #[cfg_attr(not(debug_assertions), inline(always))]
    fn with_tableau<W: TableauWork<P::Class>>(work: W) -> Option<W::Output> {
        Some(work.run::<P>())
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
