//! Splittings: drifts and kicks, applied to the state in place.

use core::marker::PhantomData;

use crate::method::{
    EvaluationObserver, Evaluations, Failure, Inside, Interpolation, KickDrift, Outcome, Plan,
    Solver, Span, StageStorage, Step, StepStatistics, Stopping, WarmStart,
};
use crate::number::{Summation, Vector, copy};
use crate::system::{Class, System};

/// How a splitting takes one step of a system of one [`Class`]. Every evaluation enters the later stages with its full weight, so it is
/// applied to the state at once, and no stage is stored.
pub trait SplittingPlan {
    /// The class of systems that it steps.
    type Class: Class;

    /// The number of evaluations of a step.
    const EVALUATIONS: u32;
    /// Number of first evaluations that are skipped if the previous step has [kept](WarmStart::evaluation) them.
    const CARRIED: u32;

    /// Takes the step `span` from `state`, in place, with the kicks and drifts of `kick_drift`, and shows its evaluations to `witness`.
    fn apply<
        R: Summation,
        V: Vector,
        S: System<V, Class = Self::Class>,
        K: KickDrift,
        W: EvaluationObserver,
    >(
        span: Span,
        system: &S,
        evaluations: &mut Evaluations<V>,
        kept: WarmStart,
        state: Outcome<'_, V>,
        kick_drift: &mut K,
        witness: &mut W,
    );
}

/// The plan of a splitting. Its code contains no solver.
#[derive(Clone, Copy, Debug)]
pub struct Splitting<P>(PhantomData<P>);

impl<P: SplittingPlan> Splitting<P> {
    /// Copies the state before `step` to `state`, where the step is applied.
    #[cfg_attr(not(debug_assertions), inline(always))]
    fn start<R: Summation, V: Vector>(step: &Step<'_, V>, state: &mut Outcome<'_, V>) {
        copy(state.q, step.q);
        copy(state.p, step.p);
        if R::COMPENSATED {
            copy(state.q_low, step.q_low);
            copy(state.p_low, step.p_low);
        }
    }
}

impl<P: SplittingPlan> Plan for Splitting<P> {
    type Class = P::Class;
    type Memory<V: Vector, S: System<V>, N: Solver<V, S>> = Evaluations<V>;

    const EVALUATIONS_IN_PLACE: Option<u32> = Some(P::EVALUATIONS - P::CARRIED);

    const LANEWISE: bool = true;

    #[cfg_attr(not(debug_assertions), inline(always))]
    fn take<R, V, S, N>(
        step: &Step<'_, V>,
        system: &S,
        memory: &mut Evaluations<V>,
        kept: WarmStart,
        _stopping: Stopping,
        outcome: Outcome<'_, V>,
    ) -> Result<StepStatistics, Failure>
    where
        R: Summation,
        V: Vector,
        S: System<V, Class = P::Class>,
        N: Solver<V, S>,
    {
        let (kick_drift, witness) = (&mut (), &mut ());
        Ok(Self::take_by::<R, V, S, _, _>(
            step, system, memory, kept, outcome, kick_drift, witness,
        ))
    }

    #[cfg_attr(not(debug_assertions), inline(always))]
    fn take_by<R, V, S, K, W>(
        step: &Step<'_, V>,
        system: &S,
        evaluations: &mut Evaluations<V>,
        kept: WarmStart,
        mut outcome: Outcome<'_, V>,
        kick_drift: &mut K,
        witness: &mut W,
    ) -> StepStatistics
    where
        R: Summation,
        V: Vector,
        S: System<V, Class = P::Class>,
        K: KickDrift,
        W: EvaluationObserver,
    {
        Self::start::<R, V>(step, &mut outcome);
        P::apply::<R, V, S, K, W>(
            step.span(),
            system,
            evaluations,
            kept,
            outcome,
            kick_drift,
            witness,
        );
        let carried = if kept.evaluation { P::CARRIED } else { 0 };
        StepStatistics {
            evaluations: P::EVALUATIONS - carried,
            ..StepStatistics::default()
        }
    }

    fn observe<R, V, S, N, W>(
        step: &Step<'_, V>,
        system: &S,
        memory: &mut Evaluations<V>,
        outcome: Outcome<'_, V>,
        witness: &mut W,
    ) where
        R: Summation,
        V: Vector,
        S: System<V, Class = P::Class>,
        N: Solver<V, S>,
        W: EvaluationObserver,
    {
        *memory = Evaluations::like(step.q);
        let kept = WarmStart::default();
        Self::take_by::<R, V, S, _, _>(step, system, memory, kept, outcome, &mut (), witness);
    }

    const INTERPOLATION: Interpolation = Interpolation::Hermite;

    /// Does nothing: a splitting has no stages for a polynomial.
    fn extend<V, S, N>(_memory: &Evaluations<V>, _at: Inside<'_, V>, _q: &mut V, _p: &mut V)
    where
        V: Vector,
        S: System<V, Class = P::Class>,
        N: Solver<V, S>,
    {
    }

    #[cfg_attr(not(debug_assertions), inline(always))]
    fn take_in_place<R, V, S, N, K>(
        span: Span,
        system: &S,
        memory: &mut Evaluations<V>,
        state: Outcome<'_, V>,
        kick_drift: &mut K,
    ) where
        R: Summation,
        V: Vector,
        S: System<V, Class = P::Class>,
        N: Solver<V, S>,
        K: KickDrift,
    {
        let kept = WarmStart::new(true, false);
        P::apply::<R, V, S, K, ()>(span, system, memory, kept, state, kick_drift, &mut ());
    }

    #[cfg_attr(not(debug_assertions), inline(always))]
    fn settle_in_place<R, V, S, N, K>(
        system: &S,
        memory: &mut Evaluations<V>,
        state: Outcome<'_, V>,
        kick_drift: &mut K,
    ) where
        R: Summation,
        V: Vector,
        S: System<V, Class = P::Class>,
        N: Solver<V, S>,
        K: KickDrift,
    {
        let momentum = (state.p, state.p_low);
        kick_drift.settle::<R, V, S>(system, &mut memory.force, state.q, momentum);
    }
}
