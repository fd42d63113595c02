//! Coupled stages by fixed-point iteration.

use core::marker::PhantomData;

use crate::contract::storage::aside;
use crate::contract::{
    EvaluationCounts, Failure, Inside, Outcome, Solver, StageChange, StagePlan, StageStorage,
    StageTableau, Step, StepStatistics, Stopping, System, WarmStart,
};
use crate::error::Quantity;
use crate::number::summation::Overrelaxed;
use crate::number::{Summation, Vector};
use crate::solver::convergence::{Sweeps, settle};

/// Fixed-point iteration: each sweep computes new stages from the latest evaluations. It converges if the step size
/// times the Lipschitz constant of the system is small.
///
/// The iteration runs until it stagnates, because with a tolerance above the rounding errors the energy would drift
/// (Hairer, McLachlan & Razakarivony, 2008). It has settled when a sweep changes nothing (in a separable system: no position), or when the
/// change can be rounding errors and has stopped shrinking.
///
/// - *Can be rounding errors:* at most 64 units of [`Scalar::EPSILON`](crate::Scalar::EPSILON), relative to the largest position and the
///   largest momentum. In a separable system the positions or the momenta suffice; in a general one both must be.
/// - *Shrinks:* the relative change of the stages becomes smaller; in a separable system, that of the positions.
/// - *Has stopped shrinking:* at least one sweep, and more than a sixteenth of all sweeps, made no progress. A slow iteration with
///   oscillations has changes that grow now and then before that. In the last allowed sweep, one sweep without progress suffices.
/// - The first nine sweeps count only from the first change on that can be rounding errors.
///
/// If evaluations are noisier than that, or sweeps amplify rounding errors, the iteration has also settled if all of these conditions hold:
///
/// - no sweep of the last ten made progress;
/// - the smallest change was 1024 times smaller than the first one, or than the largest one after nine sweeps;
/// - the smallest change was at most 64 units in the positions or in the momenta, and the present one is at most 256 units in either.
///
/// If the iteration settles with a nonzero change, rounding makes the stages alternate between two values. The side
/// from which the starting values come decides at which of them it ends. This would cause an energy drift, though only of a relative
/// 1e-21 per step (measured; Hénon–Heiles, Gauss 8). In half of the steps, by a pseudo-random bit of their time, one more sweep is
/// made.
///
/// If the stages no longer change, they are one of several solutions of the rounded equations. The same side decides which. For a system
/// that is not separable the relative energy drift is 1e-20 per step (measured; `(q² + 1)(p² + 1)/2`, Gauss 6 and 8). In such a system,
/// half of the steps with a warm start, by another such bit, therefore approach from the other side. Their second sweep moves the stages
/// twice as far. If sweeps converge fast, this leads to about the mirror image of the stages after the first sweep. Both sweeps are
/// counted. If fewer than ten sweeps are allowed, this is omitted.
///
/// With [`Plain`](crate::Plain) sums the energy drifts anyway, and the iteration does not wait for stagnation. It also ends with a change
/// of at most one unit. A change of at most 64 units suffices if the next one would be at most one unit, predicted by the same contraction
/// rate. With a [tolerance](crate::Integrator::set_tolerance) it also ends with the first change within it.
#[derive(Clone, Copy, Debug, Default)]
pub struct FixedPoint;

impl<V: Vector, S: System<V>> Solver<V, S> for FixedPoint {
    type Memory<P: StageTableau> = P::Stages<V>;

    fn memory<P: StageTableau>(plan: &P, prototype: &V) -> P::Stages<V> {
        plan.stages(prototype)
    }

    #[cfg_attr(not(debug_assertions), inline(always))]
    fn take<P, R>(
        step: &Step<'_, V>,
        system: &S,
        stages: &mut P::Stages<V>,
        kept: WarmStart,
        stopping: Stopping,
        outcome: Outcome<'_, V>,
    ) -> Result<StepStatistics, Failure>
    where
        P: StageTableau,
        R: Summation,
        S: System<V, Class = P::Class>,
    {
        by_stages::<P, R, V, S>(step, system, stages, kept, stopping, outcome)
    }

    fn extend<P: StageTableau>(stages: &P::Stages<V>, at: Inside<'_, V>, q: &mut V, p: &mut V) {
        let [velocities, forces] = P::stored(stages);
        at.add(&P::MOMENTA, P::INCREMENTS, velocities, q);
        at.add(&P::POSITIONS, P::INCREMENTS, forces, p);
    }
}

/// Takes a step stage by stage; returns its statistics.
#[inline]
pub fn by_stages<P, R, V, S>(
    step: &Step<'_, V>,
    system: &S,
    stages: &mut P::Stages<V>,
    kept: WarmStart,
    stopping: Stopping,
    outcome: Outcome<'_, V>,
) -> Result<StepStatistics, Failure>
where
    P: StagePlan,
    R: Summation,
    V: Vector,
    S: System<V, Class = P::Class>,
{
    let mut sweeps = ByStages::<P, R, V, S> {
        step,
        system,
        stages: &mut *stages,
        sums: PhantomData,
    };
    let mut work = settle::<P::Class, V::Scalar, _>(&mut sweeps, kept, stopping)?;
    let finish = P::evaluations(stages).finish;
    if !R::COMPENSATED {
        P::increments(step, stages);
    }
    P::finish::<R, V, S>(step, system, stages, kept, outcome);
    work.evaluations += finish;
    Ok(work)
}

/// The stages of a method, computed one after another.
struct ByStages<'a, P: StagePlan, R, V: Vector, S> {
    step: &'a Step<'a, V>,
    system: &'a S,
    stages: &'a mut P::Stages<V>,
    sums: PhantomData<R>,
}

impl<P, R, V, S> Sweeps for ByStages<'_, P, R, V, S>
where
    P: StagePlan,
    R: Summation,
    V: Vector,
    S: System<V, Class = P::Class>,
{
    type Movement = StageChange;

    const STOPS_AT_ROUNDING: bool = !R::COMPENSATED;

    #[cfg_attr(not(debug_assertions), inline(always))]
    fn evaluations(&self) -> EvaluationCounts {
        P::evaluations(self.stages)
    }

    #[cfg_attr(not(debug_assertions), inline(always))]
    fn time(&self) -> f64 {
        self.step.time
    }

    #[cfg_attr(not(debug_assertions), inline(always))]
    fn begin(&mut self, kept: WarmStart) {
        P::begin::<R, V, S>(self.step, self.system, self.stages, kept);
    }

    #[cfg_attr(not(debug_assertions), inline(always))]
    fn non_finite(&self) -> Option<(Quantity, usize)> {
        aside(self.stages, StageStorage::non_finite)
    }

    #[cfg_attr(not(debug_assertions), inline(always))]
    fn non_finite_force(&self) -> Option<usize> {
        aside(self.stages, StageStorage::non_finite_force)
    }

    #[cfg_attr(not(debug_assertions), inline(always))]
    fn sweep(&mut self) -> StageChange {
        P::sweep::<R, V, S>(self.step, self.system, self.stages)
    }

    #[cfg_attr(not(debug_assertions), inline(always))]
    fn overrelaxed_sweep(&mut self) -> StageChange {
        P::sweep::<Overrelaxed<R>, V, S>(self.step, self.system, self.stages)
    }

    #[cfg_attr(not(debug_assertions), inline(always))]
    fn scales(&self, movement: &StageChange) -> [f64; 2] {
        movement.scales()
    }
}
