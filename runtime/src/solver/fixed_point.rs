//! Coupled stages by fixed-point iteration.

use core::marker::PhantomData;
use core::mem;

use crate::error::Quantity;
#[cfg(feature = "alloc")]
use crate::method::RunTimeStages;
use crate::method::{
    EvaluationCounts, Failure, Inside, Outcome, Solver, StageChange, StagePlan, StageStorage,
    StageTableau, Step, StepStatistics, Stopping, WarmStart,
};
use crate::number::summation::Overrelaxed;
use crate::number::vector::{LIGHT, is_in_place};
use crate::number::{Scalar, Summation, Vector};
use crate::solver::convergence::{Begun, Sweeps, patiently, settle};
#[cfg(feature = "alloc")]
use crate::solver::run_time::by_rows;
use crate::system::{Class, System};

/// Fixed-point iteration: sweep after sweep from the latest evaluations to new stages. It converges where the step size
/// times the Lipschitz constant of the system is small.
///
/// The iteration runs until it stagnates, for a tolerance above the rounding errors would let the energy drift
/// (Hairer, McLachlan & Razakarivony, 2008). It has settled when a sweep changes nothing, or when the change has
/// stopped shrinking and is down to rounding errors, at most 64 units of [`Scalar::EPSILON`](crate::Scalar::EPSILON) relative to the
/// largest position and the largest momentum: in either half for a separable system, in both for a general one
/// . It has stopped when it has not shrunk further for one sweep and a sixteenth of
/// all: where sweeps take little and turn the stages as they do, changes grow now and then before that. In the last sweep that
/// is allowed one will do.
/// Where evaluations are noisier than that, or sweeps amplify what rounding does, it is enough that the change has shrunk a
/// thousandfold, has stopped for ten sweeps too, that the smallest one was down to rounding errors in one half, and that it is at
/// most four times as much; sweeps are counted from the tenth on while the change is above 4096 units of the first stages or, in a
/// step that goes on from another one, while none has been within 64 units.
///
/// Where it has settled with a change that is not zero, rounding makes stages jump to and fro between two values, and the side
/// that the starting values come from says at which of them it ends. The energy would drift by that too, though by 1e-21 of it
/// a step (measured; Hénon–Heiles, Gauss 8). At half of these steps, by a bit of their time that is as good as random, there
/// is one sweep more. Where it stands still, at one of several roundings that solve the rounded equations,
/// that side says at which: a drift of 1e-20 of the energy a step of a system that is not separable (measured;
/// `(q² + 1)(p² + 1)/2`, Gauss 6 and 8). Of such a system half of the steps that go on from another one, by another such bit, therefore
/// come from the other side: their second sweep moves the stages twice as far, where sweeps converge fast to about the mirror image of
/// where the first one had left them. Both count; where less than ten sweeps are allowed there is none of it.
///
/// With [`Plain`](crate::Plain) sums the energy drifts anyway, and the iteration does not wait for the stagnation: it
/// ends with a change that is at most 64 units of [`Scalar::EPSILON`](crate::Scalar::EPSILON) if the next one, should it shrink by the same factor,
/// would be at most one. With a [tolerance](crate::Integrator::set_tolerance) the first change within it is the last; one of less
/// than eight units is not waited for.
///
/// In a step that goes on from another one the largest position and momentum are those there as long as they are right but for a
/// factor of two, and nothing is looked at in the first nine sweeps before a change is within 64 units of them.
#[derive(Clone, Copy, Debug, Default)]
pub struct FixedPoint;

impl<V: Vector, S: System<V>> Solver<V, S> for FixedPoint {
    type Memory<P: StageTableau> = P::Stages<V>;

    #[inline(always)]
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

    #[cfg(feature = "alloc")]
    fn take_at_run_time<C, R>(
        step: &Step<'_, V>,
        system: &S,
        memory: &mut RunTimeStages<V, C>,
        kept: WarmStart,
        stopping: Stopping,
        outcome: Outcome<'_, V>,
    ) -> Result<StepStatistics, Failure>
    where
        C: Class,
        R: Summation,
        S: System<V, Class = C>,
    {
        by_rows::<C, R, V, S>(step, system, memory, kept, stopping, outcome)
    }

    fn extend<P: StageTableau>(stages: &P::Stages<V>, at: Inside<'_, V>, q: &mut V, p: &mut V) {
        let [velocities, forces] = P::stored(stages);
        at.add(&P::MOMENTA, P::INCREMENTS, velocities, q);
        at.add(&P::POSITIONS, P::INCREMENTS, forces, p);
    }
}

/// Takes a step stage by stage; returns what it took.
#[inline]
pub(crate) fn by_stages<P, R, V, S>(
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
    let mut work = settle::<P::Class, V::Scalar>(&mut sweeps, kept, stopping)?;
    if !R::COMPENSATED {
        P::increments(step, stages);
    }
    P::finish::<R, V, S, ()>(step, system, stages, kept, outcome, &mut ());
    work.evaluations += P::EVALUATIONS.finish;
    Ok(work)
}

/// The stages of a plan, one after another.
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

    #[inline(always)]
    fn evaluations(&self) -> EvaluationCounts {
        P::EVALUATIONS
    }

    #[inline(always)]
    fn time(&self) -> f64 {
        self.step.time
    }

    #[inline(always)]
    fn begin(&mut self, kept: WarmStart) {
        P::begin::<R, V, S>(self.step, self.system, self.stages, kept);
    }

    fn non_finite(&self) -> Option<(Quantity, usize)> {
        self.stages.non_finite()
    }

    fn non_finite_force(&self) -> Option<usize> {
        self.stages.non_finite_force()
    }

    #[inline(always)]
    fn go_on<C: Class, T: Scalar>(
        &mut self,
        kept: WarmStart,
        stopping: Stopping,
        begun: Begun<StageChange>,
    ) -> Result<StepStatistics, Failure> {
        if !is_in_place(self.step.q) || size_of::<P::Stages<V>>() > LIGHT {
            return patiently::<C, T, _>(self, kept, stopping, begun);
        }
        let mut stages = mem::replace(self.stages, StageStorage::like(&V::blank()));
        let (system, sums) = (self.system, PhantomData);
        let made = self.step.copied(|step| {
            let mut there = ByStages::<P, R, V, S> {
                step,
                system,
                stages: &mut stages,
                sums,
            };
            patiently::<C, T, _>(&mut there, kept, stopping, begun)
        });
        *self.stages = stages;
        made
    }

    #[inline(always)]
    fn sweep(&mut self) -> StageChange {
        P::sweep::<R, V, S>(self.step, self.system, self.stages)
    }

    #[inline(always)]
    fn overrelaxed_sweep(&mut self) -> StageChange {
        P::sweep::<Overrelaxed<R>, V, S>(self.step, self.system, self.stages)
    }

    #[inline(always)]
    fn change(&self, movement: &StageChange) -> StageChange {
        *movement
    }
}
