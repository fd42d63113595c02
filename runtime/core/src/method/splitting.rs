//! Splittings: drifts and kicks, applied to the state in place.

use core::marker::PhantomData;

use crate::contract::{
    Class, EvaluationObserver, Evaluations, Failure, KickDrift, Outcome, Plan, Possible, Solver,
    Span, StageStorage, Step, StepStatistics, Stopping, System, WarmStart,
};
use crate::error::Quantity;
use crate::number::{Coefficient, Summation, Vector};

/// The error of a program that steps a system without a force gradient by a method with gradient kicks.
const NO_FORCE_GRADIENT: &str = "this method has gradient kicks: the system has to give `force_gradient`, with \
    `const FORCE_GRADIENT: bool = true`; a formula gives it if its kinetic energy is quadratic with constant masses";

/// How a splitting takes one step of a system of one [`Class`]. Every evaluation enters the later stages with its full weight, so it is
/// applied to the state at once, and no stage is stored.
pub trait SplittingPlan {
    /// The class of systems that it steps.
    type Class: Class;

    /// The number of evaluations of a step.
    const EVALUATIONS: u32;
    /// Number of first evaluations that are skipped if the previous step has [kept](WarmStart::evaluation) them.
    const CARRIED: u32;

    /// Takes the step: its kicks and drifts in their order.
    fn apply<R, V, S, K, W>(step: &mut SplittingStep<'_, R, V, S, K, W>)
    where
        R: Summation,
        V: Vector,
        S: System<V, Class = Self::Class>,
        K: KickDrift,
        W: EvaluationObserver;
}

/// A step of a splitting in progress: the state is advanced in place.
pub struct SplittingStep<'a, R, V, S, K, W> {
    span: Span,
    system: &'a S,
    /// The latest velocity and force.
    evaluations: &'a mut Evaluations<V>,
    /// Whether they are those at the end of the previous step.
    kept: bool,
    state: Outcome<'a, V>,
    /// How kicks and drifts are applied.
    kick_drift: &'a mut K,
    /// Receives every evaluation.
    observer: &'a mut W,
    sums: PhantomData<R>,
}

impl<R, V, S, K, W> SplittingStep<'_, R, V, S, K, W>
where
    R: Summation,
    V: Vector,
    S: System<V>,
    K: KickDrift,
    W: EvaluationObserver,
{
    /// Evaluates the force of a stage, from 1, at a time given as a fraction of the step.
    #[cfg_attr(not(debug_assertions), inline(always))]
    pub fn force(&mut self, stage: usize, time: Coefficient) {
        let (state, force) = (&mut self.state, &mut self.evaluations.force);
        (self.system).force(self.span.at(time), state.q, state.p, force);
        (self.observer).evaluation(Quantity::Force, stage, &*state.q, force);
    }

    /// [`force`](Self::force), unless the previous step has kept it.
    #[cfg_attr(not(debug_assertions), inline(always))]
    pub fn kept_force(&mut self, stage: usize, time: Coefficient) {
        if !self.kept {
            self.force(stage, time);
        }
    }

    /// Adds `(h weight) force` to the momentum.
    #[cfg_attr(not(debug_assertions), inline(always))]
    pub fn kick(&mut self, weight: Coefficient) {
        let state = &mut self.state;
        self.kick_drift.kick::<R, V>(
            self.span.size,
            weight,
            state.q,
            &self.evaluations.force,
            (state.p, state.p_low),
        );
    }

    /// Evaluates the [force gradient](System::force_gradient) of a stage, from 1, with the latest force.
    #[cfg_attr(not(debug_assertions), inline(always))]
    pub fn force_gradient(&mut self, stage: usize, time: Coefficient) {
        const { assert!(S::FORCE_GRADIENT, "{}", NO_FORCE_GRADIENT) }
        let Evaluations { velocity, force } = &mut *self.evaluations;
        (self.system).force_gradient(self.span.at(time), self.state.q, force, velocity);
        (self.observer).evaluation(Quantity::Force, stage, &*self.state.q, velocity);
    }

    /// [`force_gradient`](Self::force_gradient), unless the previous step has kept it.
    #[cfg_attr(not(debug_assertions), inline(always))]
    pub fn kept_force_gradient(&mut self, stage: usize, time: Coefficient) {
        if !self.kept {
            self.force_gradient(stage, time);
        }
    }

    /// Adds `(h³ weight) force_gradient` to the momentum.
    #[cfg_attr(not(debug_assertions), inline(always))]
    pub fn gradient_kick(&mut self, weight: Coefficient) {
        let (state, h) = (&mut self.state, self.span.size);
        // Until the next drift the slot of the velocity has the force gradient.
        self.kick_drift.kick::<R, V>(
            h * h * h,
            weight,
            state.q,
            &self.evaluations.velocity,
            (state.p, state.p_low),
        );
    }

    /// Evaluates the velocity of a stage, from 1, at a time given as a fraction of the step, and adds `(h weight) velocity` to the
    /// position.
    #[cfg_attr(not(debug_assertions), inline(always))]
    pub fn drift(&mut self, stage: usize, time: Coefficient, weight: Coefficient) {
        self.drift_by(stage, time, weight, false);
    }

    /// [`drift`](Self::drift), with the velocity kept by the previous step, if there is one.
    #[cfg_attr(not(debug_assertions), inline(always))]
    pub fn kept_drift(&mut self, stage: usize, time: Coefficient, weight: Coefficient) {
        self.drift_by(stage, time, weight, self.kept);
    }

    #[cfg_attr(not(debug_assertions), inline(always))]
    fn drift_by(&mut self, stage: usize, time: Coefficient, weight: Coefficient, known: bool) {
        let (state, place) = (&mut self.state, &mut self.evaluations.velocity);
        let velocity = match S::MASSES.are_unit() {
            true => &*state.p,
            false => {
                if !known {
                    (self.system).velocity(self.span.at(time), state.q, state.p, place);
                }
                &*place
            }
        };
        (self.observer).evaluation(Quantity::Velocity, stage, &*state.p, velocity);
        let position = (&mut *state.q, &mut *state.q_low);
        (self.kick_drift).drift::<R, V>(self.span.size, weight, velocity, position);
    }
}

/// The plan of a splitting. Its code contains no solver.
#[derive(Clone, Copy, Debug)]
pub struct Splitting<P>(PhantomData<P>);

impl<P: SplittingPlan> Possible for Splitting<P> {}

impl<P: SplittingPlan> Plan for Splitting<P> {
    type Class = P::Class;
    type Memory<V: Vector, S: System<V>, N: Solver<V, S>> = Evaluations<V>;

    const EVALUATIONS_IN_PLACE: Option<u32> = Some(P::EVALUATIONS - P::CARRIED);

    const LANEWISE: bool = true;

    #[cfg_attr(not(debug_assertions), inline(always))]
    fn take<R: Summation, V: Vector, S: System<V, Class = P::Class>, N: Solver<V, S>>(
        step: &Step<'_, V>,
        system: &S,
        memory: &mut Evaluations<V>,
        kept: WarmStart,
        _stopping: Stopping,
        outcome: Outcome<'_, V>,
    ) -> Result<StepStatistics, Failure> {
        let (kick_drift, observer) = (&mut (), &mut ());
        Ok(Self::take_by::<R, V, S, _, _>(
            step, system, memory, kept, outcome, kick_drift, observer,
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
        observer: &mut W,
    ) -> StepStatistics
    where
        R: Summation,
        V: Vector,
        S: System<V, Class = P::Class>,
        K: KickDrift,
        W: EvaluationObserver,
    {
        outcome.copy_from::<R>(step);
        P::apply(&mut SplittingStep::<R, V, S, K, W> {
            span: step.span(),
            system,
            evaluations,
            kept: kept.evaluation,
            state: outcome,
            kick_drift,
            observer,
            sums: PhantomData,
        });
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
        observer: &mut W,
    ) where
        R: Summation,
        V: Vector,
        S: System<V, Class = P::Class>,
        N: Solver<V, S>,
        W: EvaluationObserver,
    {
        *memory = Evaluations::like(step.q);
        let kept = WarmStart::default();
        Self::take_by::<R, V, S, _, _>(step, system, memory, kept, outcome, &mut (), observer);
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
        P::apply(&mut SplittingStep::<R, V, S, K, ()> {
            span,
            system,
            evaluations: memory,
            kept: true,
            state,
            kick_drift,
            observer: &mut (),
            sums: PhantomData,
        });
    }
}
