//! One step of a tableau at run time.

use alloc::vec::Vec;
use core::marker::PhantomData;

use super::{Coupled, Kind, RunTimeTableau, Schedule, Splitting, coupled};
use crate::contract::storage::{first_mismatch, first_non_finite, stored_words};
use crate::contract::{
    Class, EvaluationObserver, Evaluations, Failure, Inside, Interpolation, LaneStep, Outcome,
    Plan, Possible, Solver, StagePart, StageStorage, StageVisit, Step, StepStatistics, Stopping,
    System, WarmStart,
};
use crate::error::Quantity;
use crate::number::{Coefficient, Lanes, Scalar, Summation, Vector, advance, copy};

/// The plan of [`AtRunTime`](super::AtRunTime) for systems of one class.
#[derive(Clone, Copy, Debug)]
pub struct RunTimePlan<C>(PhantomData<C>);

/// The memory of a [`RunTimePlan`]: the tableau, the latest evaluations of a splitting, and the solver's memory `M` for coupled stages.
#[derive(Clone, Debug)]
pub struct RunTimeMemory<V, M, C> {
    tableau: Option<RunTimeTableau>,
    splitting: Option<Evaluations<V>>,
    coupled: Option<M>,
    class: PhantomData<C>,
}

impl<V: Vector, M: StageStorage<V>, C: Class> StageStorage<V> for RunTimeMemory<V, M, C> {
    const AT_RUN_TIME: bool = true;

    /// Without a tableau there is nothing to store.
    fn like(_prototype: &V) -> Self {
        Self {
            tableau: None,
            splitting: None,
            coupled: None,
            class: PhantomData,
        }
    }

    fn tableau(&self) -> Option<&RunTimeTableau> {
        self.tableau.as_ref()
    }

    fn set_tableau(&mut self, tableau: &RunTimeTableau, prototype: &V) {
        (self.splitting, self.coupled) = match tableau.schedule::<C>() {
            Schedule::Splitting(_) => (Some(Evaluations::like(prototype)), None),
            Schedule::Coupled(_) => {
                let mut coupled = M::like(prototype);
                coupled.set_tableau(tableau, prototype);
                (None, Some(coupled))
            }
        };
        self.tableau = Some(tableau.clone());
    }

    stored_words! { splitting: optional memory; coupled: optional memory; }

    fn stages(&mut self, visit: &mut StageVisit<'_>) {
        if let Some(stages) = &mut self.coupled {
            stages.stages(visit);
        }
    }

    /// `None` for a splitting, whose evaluations an observer receives.
    fn non_finite(&self) -> Option<(Quantity, usize)> {
        self.coupled.as_ref().and_then(M::non_finite)
    }

    #[inline]
    fn mismatch(&self, dimension: usize) -> Option<(Quantity, usize, usize)> {
        let evaluations = self.splitting.as_ref();
        let mismatch = evaluations.and_then(|evaluations| evaluations.mismatch(dimension));
        let stages = self.coupled.as_ref();
        mismatch.or_else(|| stages.and_then(|stages| stages.mismatch(dimension)))
    }
}

/// Coupled stages one by one: one vector for each stage value and evaluation.
#[derive(Clone, Debug)]
pub struct RunTimeStages<V, C> {
    pub(crate) tableau: Option<RunTimeTableau>,
    pub(crate) q: Vec<V>,
    pub(crate) p: Vec<V>,
    pub(crate) velocity: Vec<V>,
    pub(crate) force: Vec<V>,
    class: PhantomData<C>,
}

impl<V: Vector, C: Class> StageStorage<V> for RunTimeStages<V, C> {
    /// Without a tableau there is nothing to store.
    fn like(_prototype: &V) -> Self {
        Self {
            tableau: None,
            q: Vec::new(),
            p: Vec::new(),
            velocity: Vec::new(),
            force: Vec::new(),
            class: PhantomData,
        }
    }

    fn tableau(&self) -> Option<&RunTimeTableau> {
        self.tableau.as_ref()
    }

    fn set_tableau(&mut self, tableau: &RunTimeTableau, prototype: &V) {
        let zeros = |count: usize| (0..count).map(|_| prototype.zeros_like()).collect();
        let Coupled {
            positions, momenta, ..
        } = coupled::<C>(Some(tableau));
        let (positions, momenta) = (positions.rows.len(), momenta.rows.len());
        *self = Self {
            q: zeros(positions),
            p: zeros(momenta),
            velocity: zeros(momenta),
            force: zeros(positions),
            tableau: Some(tableau.clone()),
            class: PhantomData,
        };
    }

    stored_words! { q: vectors; p: vectors; velocity: vectors; force: vectors; }

    fn stages(&mut self, visit: &mut StageVisit<'_>) {
        let parts = [
            (StagePart::Positions, &mut self.q),
            (StagePart::Momenta, &mut self.p),
            (StagePart::Velocities, &mut self.velocity),
            (StagePart::Forces, &mut self.force),
        ];
        for (part, vectors) in parts {
            for (stage, vector) in vectors.iter_mut().enumerate() {
                let numbers = V::Scalar::doubles_mut(vector.as_mut_slice());
                for (component, number) in numbers.unwrap_or(&mut []).iter_mut().enumerate() {
                    visit(part, stage, component, number);
                }
            }
        }
    }

    fn non_finite(&self) -> Option<(Quantity, usize)> {
        first_non_finite((&self.q, &self.force), (&self.p, &self.velocity))
    }

    #[inline]
    fn mismatch(&self, dimension: usize) -> Option<(Quantity, usize, usize)> {
        first_mismatch(&self.force, &self.velocity, dimension)
    }
}

/// Set by [`Integrator::at_run_time`](crate::Integrator::at_run_time), which is the only way to make such an integrator.
const TABLEAU: &str = "the memory of a step at run time has its tableau";

impl<C: Class> Possible for RunTimePlan<C> {}

impl<C: Class> Plan for RunTimePlan<C> {
    type Class = C;
    type Memory<V: Vector, S: System<V>, N: Solver<V, S>> = RunTimeMemory<V, N::AtRunTime<C>, C>;

    /// Valid only if the tableau [is explicit](RunTimeTableau::is_explicit).
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
        let tableau = memory.tableau.as_ref().expect(TABLEAU);
        match tableau.schedule::<C>() {
            Schedule::Splitting(splitting) => {
                let evaluations = memory.splitting.as_mut().expect(TABLEAU);
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
            Schedule::Coupled(_) if V::Scalar::FOUND => {
                unreachable!("coupled stages of several trajectories are in `LaneStages`")
            }
            Schedule::Coupled(_) => {
                let memory = memory.coupled.as_mut().expect(TABLEAU);
                N::take_at_run_time::<C, R>(step, system, memory, kept, stopping, outcome)
            }
        }
    }

    fn goes_in_lanes<V, S, N>() -> bool
    where
        V: Vector,
        S: System<V, Class = C>,
        N: Solver<V, S>,
    {
        N::goes_in_lanes()
    }

    #[inline]
    fn lane_step<R, V, S, N, W, J>() -> Option<LaneStep<W, J>>
    where
        R: Summation,
        V: Vector,
        S: System<V, Class = C>,
        N: Solver<V, S>,
        W: Vector<Scalar: Lanes>,
        J: System<W, Class = C>,
    {
        N::lane_step_at_run_time::<C, R, W, J>()
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
        let tableau = memory.tableau.clone().expect(TABLEAU);
        // The evaluations of coupled stages are in the memory.
        if let Schedule::Splitting(splitting) = tableau.schedule::<C>() {
            memory.set_tableau(&tableau, step.q);
            let evaluations = memory.splitting.as_mut().expect(TABLEAU);
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
