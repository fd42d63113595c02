//! How a method takes one step.

use crate::contract::{
    Class, EvaluationObserver, Evaluations, Failure, Inside, Interpolation, KickDrift, Outcome,
    Solver, Span, StageStorage, StageView, Step, StepStatistics, Stopping, System, TableauWork,
    WarmStart,
};
use crate::error::Error;
use crate::number::{Scalar, Summation, Vector};

/// How a [`Method`](crate::Method) takes one step of a system of one [`Class`]:
///
/// * by drifts and kicks ([`Splitting`]),
/// * by other explicit stages ([`Explicit`]),
/// * by coupled stages, which a [`Solver`] computes ([`Coupled`]),
/// * by steps of other methods ([`Composition`]).
///
/// [`Splitting`]: crate::emitted::Splitting
/// [`Explicit`]: crate::emitted::Explicit
/// [`Coupled`]: crate::emitted::Coupled
/// [`Composition`]: crate::emitted::Composition
pub trait Plan {
    /// The class of systems that it steps.
    type Class: Class;
    /// Its memory besides the state, allocated once and used for every step.
    type Memory<V: Vector, S: System<V>, N: Solver<V, S>>: StageStorage<V>;

    /// Number of evaluations in a step [in place](Self::take_in_place); `None` if the plan takes no steps in place.
    const EVALUATIONS_IN_PLACE: Option<u32> = None;

    /// Whether a step has no branch on a value. Then a step of a vector of lanes has in every lane the bits of a step of doubles.
    const LANEWISE: bool = false;

    /// Allocates in `memory` what depends on the system.
    #[cfg_attr(not(debug_assertions), inline(always))]
    fn prepare<V, S, N>(
        _memory: &mut Self::Memory<V, S, N>,
        _system: &S,
        _time: f64,
        _q: &V,
        _p: &V,
    ) where
        V: Vector,
        S: System<V, Class = Self::Class>,
        N: Solver<V, S>,
    {
    }

    /// Checks that steps can begin at a state.
    ///
    /// # Errors
    ///
    /// [`Error::NoExtra`] if the class has constraints or friction that the system does not give; [`Error::InconsistentStart`] and others if
    /// there are constraints.
    #[cfg_attr(not(debug_assertions), inline(always))]
    fn check<V, S>(_system: &S, _time: f64, _q: &V, _p: &V) -> Result<(), Error>
    where
        V: Vector,
        S: System<V, Class = Self::Class>,
    {
        Ok(())
    }

    /// Takes `step` and writes its result into `outcome`; returns the statistics of the step.
    ///
    /// # Errors
    ///
    /// [`Failure`] if the stages cannot be found. The caller checks that the result is finite.
    fn take<R: Summation, V: Vector, S: System<V, Class = Self::Class>, N: Solver<V, S>>(
        step: &Step<'_, V>,
        system: &S,
        memory: &mut Self::Memory<V, S, N>,
        kept: WarmStart,
        stopping: Stopping,
        outcome: Outcome<'_, V>,
    ) -> Result<StepStatistics, Failure>;

    /// Runs work with the tableau whose stages a [`Solver`] finds; `None` if it has none.
    #[doc(hidden)]
    #[cfg_attr(not(debug_assertions), inline(always))]
    fn with_tableau<W: TableauWork<Self::Class>>(_work: W) -> Option<W::Output> {
        None
    }

    /// Takes a step from `state`, in place, with the evaluations [kept](WarmStart::evaluation) by the previous step. Does nothing if
    /// [`EVALUATIONS_IN_PLACE`](Self::EVALUATIONS_IN_PLACE) is `None`.
    #[cfg_attr(not(debug_assertions), inline(always))]
    fn take_in_place<R, V, S, N, K>(
        _span: Span,
        _system: &S,
        _memory: &mut Self::Memory<V, S, N>,
        _state: Outcome<'_, V>,
        _kick_drift: &mut K,
    ) where
        R: Summation,
        V: Vector,
        S: System<V, Class = Self::Class>,
        N: Solver<V, S>,
        K: KickDrift,
    {
    }

    /// Takes `step` of a splitting with the kicks and drifts of `kick_drift`, and shows its evaluations to `observer`. Only for a plan that
    /// [splits](crate::proved::Splits).
    #[cfg_attr(not(debug_assertions), inline(always))]
    fn take_by<R, V, S, K, W>(
        _step: &Step<'_, V>,
        _system: &S,
        _evaluations: &mut Evaluations<V>,
        _kept: WarmStart,
        _outcome: Outcome<'_, V>,
        _kick_drift: &mut K,
        _witness: &mut W,
    ) -> StepStatistics
    where
        R: Summation,
        V: Vector,
        S: System<V, Class = Self::Class>,
        K: KickDrift,
        W: EvaluationObserver,
    {
        unreachable!("a plan that splits has this function, and no other is asked")
    }

    /// Repeats a step that failed, and shows its evaluations to `observer`; does nothing if they are in `memory` or have been shown.
    fn observe<R, V, S, N, W>(
        _step: &Step<'_, V>,
        _system: &S,
        _memory: &mut Self::Memory<V, S, N>,
        _outcome: Outcome<'_, V>,
        _witness: &mut W,
    ) where
        R: Summation,
        V: Vector,
        S: System<V, Class = Self::Class>,
        N: Solver<V, S>,
        W: EvaluationObserver,
    {
    }

    /// Repeats a step with new memory, and shows its stages. `None` if the stages follow from the position at its start and the momentum at
    /// its end.
    #[inline]
    fn show_stages<R, V, S>(
        _step: &Step<'_, V>,
        _system: &S,
        _stopping: Stopping,
        _show: &mut dyn FnMut(StageView<'_, V>),
    ) -> Option<Result<(), Failure>>
    where
        R: Summation,
        V: Vector,
        S: System<V, Class = Self::Class>,
    {
        None
    }

    /// Writes p' at a state into `rate`: the force, including that of constraints.
    #[cfg_attr(not(debug_assertions), inline(always))]
    fn momentum_rate<V, S>(system: &S, time: f64, q: &V, p: &V, rate: &mut V)
    where
        V: Vector,
        S: System<V, Class = Self::Class>,
    {
        system.force(V::Scalar::from_f64(time), q, p, rate);
    }

    /// How values inside a step are computed.
    const INTERPOLATION: Interpolation = Interpolation::Hermite;

    /// Adds to `q` and `p` their deviations from the straight line between the ends of the last step, if the
    /// [stages](Interpolation::Stages) in `memory` determine them.
    fn extend<V, S, N>(_memory: &Self::Memory<V, S, N>, _at: Inside<'_, V>, _q: &mut V, _p: &mut V)
    where
        V: Vector,
        S: System<V, Class = Self::Class>,
        N: Solver<V, S>,
    {
    }
}
