//! Steps of several methods, one after another.

use core::marker::PhantomData;

use crate::contract::storage::{is_finite, stored_words};
use crate::contract::{
    Class, EvaluationObserver, Failure, Outcome, Plan, Possible, Solver, StageStorage, Step,
    StepStatistics, Stopping, System, WarmStart,
};
use crate::error::Quantity;
use crate::method::diagnosis::{FirstFault, culprit};
use crate::number::{Coefficient, Summation, Vector};

/// A substep `Φ_{γh}` of a composition.
#[derive(Clone, Copy, Debug)]
pub struct Substep {
    /// Where it starts, as a fraction of the whole step: the sum of the fractions before it.
    pub start: Coefficient,
    /// The fraction γ of the whole step.
    pub fraction: Coefficient,
    /// The data in the memory of its plan from the previous substep, or from the last substep of the previous step.
    pub kept: WarmStart,
    /// The number of stages of the substeps before it, for error messages.
    pub stages: usize,
}

/// The steps `Φ_{γ_m h} ∘ … ∘ Φ_{γ_1 h}` of a composition, as the macro emits them.
pub trait Substeps {
    /// The class of systems that they step.
    type Class: Class;
    /// The memory of the plans of the substeps.
    type Memory<V: Vector, S: System<V>, N: Solver<V, S>>: StageStorage<V>;

    /// The steps in their order.
    const SUBSTEPS: &'static [Substep];

    /// [`Plan::take`] of the substep with this number, from 0.
    ///
    /// # Errors
    ///
    /// [`Failure`]
    fn take<R: Summation, V: Vector, S: System<V, Class = Self::Class>, N: Solver<V, S>>(
        number: usize,
        step: &Step<'_, V>,
        system: &S,
        memory: &mut Self::Memory<V, S, N>,
        kept: WarmStart,
        stopping: Stopping,
        outcome: Outcome<'_, V>,
    ) -> Result<StepStatistics, Failure>;
    /// [`Plan::observe`] of the substep with this number, from 0.
    fn observe<R, V, S, N, W>(
        number: usize,
        step: &Step<'_, V>,
        system: &S,
        memory: &mut Self::Memory<V, S, N>,
        outcome: Outcome<'_, V>,
        observer: &mut W,
    ) where
        R: Summation,
        V: Vector,
        S: System<V, Class = Self::Class>,
        N: Solver<V, S>,
        W: EvaluationObserver;
}

/// A composition at the level of steps: each substep finds its own stages, from the result of the previous one.
///
/// So an iteration costs as much as one substep, and it converges like that of the base method with step size `γh`. The sums between
/// substeps are like those between steps: compensated sums lose nothing there either. A composition of explicit splittings is not a
/// `Composition` but one splitting, in which neighbouring drifts and kicks are merged.
#[derive(Clone, Copy, Debug)]
pub struct Composition<L>(PhantomData<L>);

/// The memory of a [`Composition`].
#[derive(Clone, Debug)]
pub struct CompositionMemory<V, T> {
    /// The memory of the plans of the substeps.
    plans: T,
    /// A state between two substeps: position, its compensation, momentum, its compensation.
    between: [V; 4],
}

impl<V: Vector, T: StageStorage<V>> StageStorage<V> for CompositionMemory<V, T> {
    fn like(prototype: &V) -> Self {
        Self {
            plans: T::like(prototype),
            between: core::array::from_fn(|_| prototype.zeros_like()),
        }
    }

    stored_words! { plans: memory; between: vectors; }

    fn non_finite(&self) -> Option<(Quantity, usize)> {
        self.plans.non_finite()
    }

    #[inline]
    fn mismatch(&self, dimension: usize) -> Option<(Quantity, usize, usize)> {
        self.plans.mismatch(dimension)
    }
}

impl<L: Substeps> Possible for Composition<L> {}

impl<L: Substeps> Plan for Composition<L> {
    type Class = L::Class;
    type Memory<V: Vector, S: System<V>, N: Solver<V, S>> =
        CompositionMemory<V, L::Memory<V, S, N>>;

    #[inline]
    fn take<R: Summation, V: Vector, S: System<V, Class = Self::Class>, N: Solver<V, S>>(
        step: &Step<'_, V>,
        system: &S,
        memory: &mut Self::Memory<V, S, N>,
        kept: WarmStart,
        stopping: Stopping,
        outcome: Outcome<'_, V>,
    ) -> Result<StepStatistics, Failure> {
        let CompositionMemory {
            plans,
            between: [q, q_low, p, p_low],
        } = memory;
        let between = Outcome { q, q_low, p, p_low };
        let take = |(number, substep): (usize, &Substep),
                    part: &Step<'_, V>,
                    kept: WarmStart,
                    here: &mut Outcome<'_, V>| {
            let kept = WarmStart {
                evaluation: substep.kept.evaluation && kept.evaluation,
                stages: substep.kept.stages && kept.stages,
                ..kept
            };
            let result = here.reborrow();
            let taken = L::take::<R, V, S, N>(number, part, system, plans, kept, stopping, result);
            let taken = taken.and_then(|taken| {
                if is_finite(here.q) && is_finite(here.p) {
                    return Ok(taken);
                }
                let mut fault = FirstFault::new(step.q.dimension());
                let result = here.reborrow();
                L::observe::<R, V, S, N, _>(number, part, system, plans, result, &mut fault);
                let (what, stage) = culprit(&fault, plans, here.q);
                Err(Failure::NonFinite { what, stage })
            });
            taken.map_err(|failure| failure.after(substep.stages))
        };
        let place = |substep: &Substep| (substep.start, substep.fraction);
        in_turn(L::SUBSTEPS, place, step, kept, between, outcome, take)
    }
}

/// Takes substeps one after another. `place` gives the start and the size of a substep, as fractions of the whole step. `take` takes the
/// substep with a number, from 0; its [`WarmStart`] states which data of the previous substep or step are kept.
#[cfg_attr(not(debug_assertions), inline(always))]
pub fn in_turn<'a, V: Vector, P>(
    substeps: &[P],
    place: impl Fn(&P) -> (Coefficient, Coefficient),
    step: &Step<'_, V>,
    mut kept: WarmStart,
    mut between: Outcome<'a, V>,
    mut outcome: Outcome<'a, V>,
    mut take: impl FnMut(
        (usize, &P),
        &Step<'_, V>,
        WarmStart,
        &mut Outcome<'_, V>,
    ) -> Result<StepStatistics, Failure>,
) -> Result<StepStatistics, Failure> {
    let mut work = StepStatistics::default();
    for (number, substep) in substeps.iter().enumerate() {
        // Results alternate between two places, so that the last one is written to `outcome`.
        let (here, there) = if (substeps.len() - number) % 2 == 1 {
            (&mut outcome, &between)
        } else {
            (&mut between, &outcome)
        };
        let (q, q_low, p, p_low) = if number == 0 {
            (step.q, step.q_low, step.p, step.p_low)
        } else {
            (&*there.q, &*there.q_low, &*there.p, &*there.p_low)
        };
        let (start, fraction) = place(substep);
        let part = Step {
            time: step.time + start.double() * step.size,
            size: fraction.double() * step.size,
            q,
            q_low,
            p,
            p_low,
            linear_velocity: step.linear_velocity,
        };
        work += take((number, substep), &part, kept, here)?;
        kept = WarmStart {
            evaluation: true,
            stages: true,
            scales: work.scales,
        };
    }
    Ok(work)
}
