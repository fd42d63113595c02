//! Steps with stages that depend on each other.

use core::marker::PhantomData;

use crate::method::{
    EvaluationObserver, Failure, Inside, Interpolation, Outcome, Plan, Solver, StageTableau, Step,
    StepStatistics, Stopping, WarmStart,
};
use crate::number::{Summation, Vector};
use crate::system::System;

/// The plan of a step with stages that depend on each other: a [`Solver`] finds them.
#[derive(Clone, Copy, Debug)]
pub struct Coupled<P>(PhantomData<P>);

impl<P: StageTableau> Plan for Coupled<P> {
    type Class = P::Class;
    type Memory<V: Vector, S: System<V>, N: Solver<V, S>> = N::Memory<P>;

    #[inline(always)]
    fn take<R, V, S, N>(
        step: &Step<'_, V>,
        system: &S,
        memory: &mut N::Memory<P>,
        kept: WarmStart,
        stopping: Stopping,
        outcome: Outcome<'_, V>,
    ) -> Result<StepStatistics, Failure>
    where
        R: Summation,
        V: Vector,
        S: System<V, Class = P::Class>,
        N: Solver<V, S>,
    {
        N::take::<P, R>(step, system, memory, kept, stopping, outcome)
    }

    /// Does nothing: the evaluations are in the memory.
    fn observe<R, V, S, N, W>(
        _step: &Step<'_, V>,
        _system: &S,
        _memory: &mut N::Memory<P>,
        _outcome: Outcome<'_, V>,
        _witness: &mut W,
    ) where
        R: Summation,
        V: Vector,
        S: System<V, Class = P::Class>,
        N: Solver<V, S>,
        W: EvaluationObserver,
    {
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
