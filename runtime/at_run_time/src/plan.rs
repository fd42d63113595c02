//! One step of a tableau at run time.

use alloc::sync::Arc;
use core::marker::PhantomData;

use symplectic_core::inside::rows::{CoupledRows, Kind};
use symplectic_core::inside::{
    EvaluationObserver, Evaluations, Plan, Possible, StageVisit, TableauWork, advance, copy,
};
use symplectic_core::output::{Inside, Interpolation};
use symplectic_core::solver::{
    Coefficient, Failure, Outcome, Solver, StageStorage, Step, StepStatistics, Stopping, Visit,
    WarmStart,
};
use symplectic_core::system::Class;
use symplectic_core::{Quantity, Scalar, Summation, System, Vector};

use crate::rows::RunTimeRows;
use crate::schedule::{Schedule, Splitting};

/// The plan of a [`RunTimeTableau`](crate::RunTimeTableau) for systems of one class.
#[derive(Clone, Copy, Debug)]
pub struct RunTimePlan<C>(PhantomData<C>);

/// The memory of a [`RunTimePlan`].
#[derive(Clone, Debug)]
pub enum RunTimeMemory<V, M> {
    /// The drifts and kicks of a splitting, and the latest evaluations.
    Splitting(Arc<Splitting>, Evaluations<V>),
    /// The memory of the solver for coupled stages.
    Coupled(M),
}

impl<V: Vector, M: StageStorage<V>> RunTimeMemory<V, M> {
    /// Memory for steps in this order.
    pub(crate) fn new<C: Class, S: System<V>, N: Solver<V, S, Memory<RunTimeRows<C>> = M>>(
        schedule: &Schedule,
        prototype: &V,
    ) -> Self {
        match schedule {
            Schedule::Splitting(splitting) => {
                Self::Splitting(splitting.clone(), Evaluations::like(prototype))
            }
            Schedule::Coupled(rows) => {
                Self::Coupled(N::memory(&RunTimeRows::new(rows.clone()), prototype))
            }
        }
    }
}

impl<V: Vector, M: StageStorage<V>> StageStorage<V> for RunTimeMemory<V, M> {
    const AT_RUN_TIME: bool = true;

    /// Without a tableau there are no stages.
    fn like(prototype: &V) -> Self {
        Self::Coupled(M::like(prototype))
    }

    fn anew(&self, prototype: &V) -> Self {
        match self {
            Self::Splitting(splitting, _) => {
                Self::Splitting(splitting.clone(), Evaluations::like(prototype))
            }
            Self::Coupled(memory) => Self::Coupled(memory.anew(prototype)),
        }
    }

    fn rows(&self) -> Option<&Arc<CoupledRows>> {
        match self {
            Self::Splitting(..) => None,
            Self::Coupled(memory) => memory.rows(),
        }
    }

    fn words(&mut self, visit: &mut Visit<'_>) {
        match self {
            Self::Splitting(_, evaluations) => evaluations.words(visit),
            Self::Coupled(memory) => memory.words(visit),
        }
    }

    fn show_words(&self, visit: &mut Visit<'_>) {
        match self {
            Self::Splitting(_, evaluations) => evaluations.show_words(visit),
            Self::Coupled(memory) => memory.show_words(visit),
        }
    }

    fn stages(&mut self, visit: &mut StageVisit<'_>) {
        if let Self::Coupled(memory) = self {
            memory.stages(visit);
        }
    }

    /// `None` for a splitting, whose evaluations an observer receives.
    fn non_finite(&self) -> Option<(Quantity, usize)> {
        match self {
            Self::Splitting(..) => None,
            Self::Coupled(memory) => memory.non_finite(),
        }
    }

    #[inline]
    fn mismatch(&self, dimension: usize) -> Option<(Quantity, usize, usize)> {
        match self {
            Self::Splitting(_, evaluations) => evaluations.mismatch(dimension),
            Self::Coupled(memory) => memory.mismatch(dimension),
        }
    }
}

impl<C: Class> Possible for RunTimePlan<C> {}

impl<C: Class> Plan for RunTimePlan<C> {
    type Class = C;
    type Memory<V: Vector, S: System<V>, N: Solver<V, S>> =
        RunTimeMemory<V, N::Memory<RunTimeRows<C>>>;

    /// Valid only if the tableau [is explicit](crate::RunTimeTableau::is_explicit).
    const LANEWISE: bool = C::SEPARABLE;

    #[cfg_attr(not(debug_assertions), inline(always))]
    fn take<R: Summation, V: Vector, S: System<V, Class = C>, N: Solver<V, S>>(
        step: &Step<'_, V>,
        system: &S,
        memory: &mut Self::Memory<V, S, N>,
        kept: WarmStart,
        stopping: Stopping,
        outcome: Outcome<'_, V>,
    ) -> Result<StepStatistics, Failure> {
        match memory {
            RunTimeMemory::Splitting(splitting, evaluations) => {
                let count = apply::<R, V, S, ()>(
                    splitting,
                    step,
                    system,
                    evaluations,
                    kept,
                    outcome,
                    &mut (),
                );
                Ok(StepStatistics {
                    evaluations: count,
                    ..StepStatistics::default()
                })
            }
            // A constant condition: registers detected at run time compile without the other branch.
            RunTimeMemory::Coupled(_) if V::Scalar::FOUND => {
                unreachable!("coupled stages of several trajectories are in `LaneStages`")
            }
            RunTimeMemory::Coupled(memory) => {
                N::take::<RunTimeRows<C>, R>(step, system, memory, kept, stopping, outcome)
            }
        }
    }

    #[cfg_attr(not(debug_assertions), inline(always))]
    fn with_tableau<W: TableauWork<C>>(work: W) -> Option<W::Output> {
        Some(work.run::<RunTimeRows<C>>())
    }

    fn observe<R, V, S, N, W>(
        step: &Step<'_, V>,
        system: &S,
        memory: &mut Self::Memory<V, S, N>,
        outcome: Outcome<'_, V>,
        observer: &mut W,
    ) where
        R: Summation,
        V: Vector,
        S: System<V, Class = C>,
        N: Solver<V, S>,
        W: EvaluationObserver,
    {
        // The evaluations of coupled stages are in the memory.
        if let RunTimeMemory::Splitting(splitting, evaluations) = memory {
            *evaluations = Evaluations::like(step.q);
            let kept = WarmStart::default();
            apply::<R, V, S, W>(
                splitting,
                step,
                system,
                evaluations,
                kept,
                outcome,
                observer,
            );
        }
    }

    const INTERPOLATION: Interpolation = Interpolation::Hermite;

    /// Does nothing: values inside a step come from the cubic polynomial of its ends.
    fn extend<V, S, N>(_memory: &Self::Memory<V, S, N>, _at: Inside<'_, V>, _q: &mut V, _p: &mut V)
    where
        V: Vector,
        S: System<V, Class = C>,
        N: Solver<V, S>,
    {
    }
}

/// Applies drifts and kicks to the state at the start of a step; returns the number of evaluations.
#[cfg_attr(not(debug_assertions), inline(always))]
fn apply<R: Summation, V: Vector, S: System<V>, W: EvaluationObserver>(
    splitting: &Splitting,
    step: &Step<'_, V>,
    system: &S,
    Evaluations { velocity, force }: &mut Evaluations<V>,
    kept: WarmStart,
    state: Outcome<'_, V>,
    observer: &mut W,
) -> u32 {
    let Outcome { q, q_low, p, p_low } = state;
    copy(q, step.q);
    copy(p, step.p);
    if R::COMPENSATED {
        copy(q_low, step.q_low);
        copy(p_low, step.p_low);
    }
    let mut counts = [0; 2];
    let mut made = 0;
    for (index, evaluation) in splitting.evaluations.iter().enumerate() {
        let is_carried = index == 0 && splitting.carries && kept.evaluation;
        let time = step.at(Coefficient::exact(evaluation.time));
        let factor = Coefficient::exact(evaluation.factor);
        counts[evaluation.kind as usize] += 1;
        let stage = counts[evaluation.kind as usize];
        made += u32::from(!is_carried);
        match evaluation.kind {
            Kind::Velocity => {
                if !is_carried {
                    system.velocity(time, q, p, velocity);
                    observer.evaluation(Quantity::Velocity, stage, &*p, velocity);
                }
                advance::<R, V>(q, q_low, step.size, factor, velocity);
            }
            Kind::Force => {
                if !is_carried {
                    system.force(time, q, p, force);
                    observer.evaluation(Quantity::Force, stage, &*q, force);
                }
                advance::<R, V>(p, p_low, step.size, factor, force);
            }
        }
    }
    made
}
