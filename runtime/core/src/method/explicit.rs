//! Steps with explicit stages, computed one after another.

use core::marker::PhantomData;

use crate::contract::{
    EvaluationObserver, Failure, Outcome, Plan, Possible, Solver, StagePlan, StageStorage, Step,
    StepStatistics, Stopping, System, WarmStart,
};
use crate::number::{Summation, Vector};

/// The plan of a step in which every stage is computed from the previous ones. Its code contains no solver.
#[derive(Clone, Copy, Debug)]
pub struct Explicit<P>(PhantomData<P>);

impl<P: StagePlan> Possible for Explicit<P> {}

impl<P: StagePlan> Plan for Explicit<P> {
    type Class = P::Class;
    type Memory<V: Vector, S: System<V>, N: Solver<V, S>> = P::Stages<V>;

    const LANEWISE: bool = true;

    #[cfg_attr(not(debug_assertions), inline(always))]
    fn take<R: Summation, V: Vector, S: System<V, Class = P::Class>, N: Solver<V, S>>(
        step: &Step<'_, V>,
        system: &S,
        memory: &mut P::Stages<V>,
        kept: WarmStart,
        _stopping: Stopping,
        outcome: Outcome<'_, V>,
    ) -> Result<StepStatistics, Failure> {
        P::begin::<R, V, S>(step, system, memory, kept);
        P::finish::<R, V, S>(step, system, memory, kept, outcome);
        Ok(StepStatistics {
            evaluations: P::EVALUATIONS.at_begin(kept) + P::EVALUATIONS.finish,
            ..StepStatistics::default()
        })
    }

    /// Leaves the evaluations in the memory.
    fn observe<R, V, S, N, W>(
        step: &Step<'_, V>,
        system: &S,
        memory: &mut P::Stages<V>,
        outcome: Outcome<'_, V>,
        _witness: &mut W,
    ) where
        R: Summation,
        V: Vector,
        S: System<V, Class = P::Class>,
        N: Solver<V, S>,
        W: EvaluationObserver,
    {
        *memory = P::Stages::like(step.q);
        P::begin::<R, V, S>(step, system, memory, WarmStart::default());
        P::finish::<R, V, S>(step, system, memory, WarmStart::default(), outcome);
    }
}
