//! Coupled stages side by side in SIMD lanes, with Gauss–Seidel sweeps.

use crate::error::Quantity;
use crate::method::storage::aside;
use crate::method::tableau::Columns;
use crate::method::{
    EvaluationCounts, Failure, Inside, Outcome, Solver, StageStorage, StageTableau, Step,
    StepStatistics, Stopping, WarmStart,
};
use crate::number::summation::Overrelaxed;
use crate::number::{Summation, Vector};
use crate::solver::convergence::{Sweeps, settle};
use crate::solver::simd::change::LaneMovement;
use crate::solver::simd::stages::SimdStages;
use crate::solver::simd::sums::{
    entry, extend, extrapolate, fill, scale, scale_of, sum, sums, times, totals, values,
};
use crate::system::SystemInLanes;
use crate::system::SystemLanes;
use crate::system::{Class, System};
use core::marker::PhantomData;

/// The iteration of [`FixedPoint`](crate::solver::FixedPoint) with the stages side by side in lanes: one evaluation of the
/// system computes two, four or eight stages.
///
/// The system must be generic over the scalar. Long vectors are allowed. [`FixedPoint`](crate::solver::FixedPoint) vectorises along
/// the components instead. Its sums over the stages are slower than sums with all stages of a component at hand
/// (`--example ratios` of the contest times both for a chain of 1024 particles).
#[derive(Clone, Copy, Debug, Default)]
pub struct SimdFixedPoint;

impl<V, S> Solver<V, S> for SimdFixedPoint
where
    V: Vector<Scalar = f64>,
    S: SystemInLanes<V>,
{
    type Memory<P: StageTableau> = SimdStages<V, P>;

    #[cfg_attr(not(debug_assertions), inline(always))]
    fn take<P, R>(
        step: &Step<'_, V>,
        system: &S,
        stages: &mut SimdStages<V, P>,
        kept: WarmStart,
        stopping: Stopping,
        outcome: Outcome<'_, V>,
    ) -> Result<StepStatistics, Failure>
    where
        P: StageTableau,
        R: Summation,
        S: System<V, Class = P::Class>,
    {
        gauss_seidel::<P, R, V, S>(step, system, stages, kept, stopping, outcome)
    }

    fn extend<P: StageTableau>(stages: &SimdStages<V, P>, at: Inside<'_, V>, q: &mut V, p: &mut V) {
        let velocity = |stage, k| entry::<P, V>(stages.velocity.as_ref(), stage, k);
        let force = |stage, k| entry::<P, V>(stages.force.as_ref(), stage, k);
        extend::<P, V>(&P::MOMENTA, at, velocity, q);
        extend::<P, V>(&P::POSITIONS, at, force, p);
    }
}

/// [`SimdFixedPoint::take`](Solver::take)
#[cfg_attr(not(debug_assertions), inline(always))]
pub(crate) fn gauss_seidel<P, R, V, S>(
    step: &Step<'_, V>,
    system: &S,
    stages: &mut SimdStages<V, P>,
    kept: WarmStart,
    stopping: Stopping,
    outcome: Outcome<'_, V>,
) -> Result<StepStatistics, Failure>
where
    P: StageTableau,
    R: Summation,
    V: Vector<Scalar = f64>,
    S: SystemInLanes<V>,
{
    let mut sweeps = ByLanes::<P, R, V, S> {
        step,
        system,
        stages: &mut *stages,
        sums: PhantomData,
    };
    let work = settle::<P::Class, f64, _>(&mut sweeps, kept, stopping)?;
    if !R::COMPENSATED {
        sweeps.increments();
    }
    totals::<R, P, V>(step, stages, outcome);
    Ok(work)
}

/// The stages of a method in lanes.
///
/// With plain sums, velocities and forces are not scaled to increments during the iteration; the matrices contain the scale
/// factors instead.
pub(crate) struct ByLanes<'a, P: StageTableau, R, V: Vector, S> {
    pub(crate) step: &'a Step<'a, V>,
    pub(crate) system: &'a S,
    pub(crate) stages: &'a mut SimdStages<V, P>,
    pub(crate) sums: PhantomData<R>,
}

impl<P, R, V, S> Sweeps for ByLanes<'_, P, R, V, S>
where
    P: StageTableau,
    R: Summation,
    V: Vector<Scalar = f64>,
    S: SystemInLanes<V>,
{
    type Movement = LaneMovement<P::Lanes>;

    const STOPS_AT_ROUNDING: bool = !R::COMPENSATED;

    #[cfg_attr(not(debug_assertions), inline(always))]
    fn evaluations(&self) -> EvaluationCounts {
        let start = P::MOMENTA.count as u32;
        let (begin, start) = if extrapolates::<P>() {
            (0, start)
        } else {
            (start, 0)
        };
        EvaluationCounts {
            begin,
            start,
            sweep: (P::POSITIONS.count + P::MOMENTA.count) as u32,
            finish: 0,
            carried: 0,
        }
    }

    #[cfg_attr(not(debug_assertions), inline(always))]
    fn time(&self) -> f64 {
        self.step.time
    }

    #[cfg_attr(not(debug_assertions), inline(always))]
    fn begin(&mut self, kept: WarmStart) {
        if kept.stages && extrapolates::<P>() {
            extrapolate::<P, V>(&P::MOMENTA, self.stages.velocity.as_mut());
            if !P::Class::SEPARABLE {
                extrapolate::<P, V>(&P::POSITIONS, self.stages.force.as_mut());
                self.momenta(true);
            }
        } else {
            fill::<P, V>(self.stages.q.as_mut(), self.step.q);
            fill::<P, V>(self.stages.p.as_mut(), self.step.p);
            self.velocities();
            self.scale_velocities();
        }
        self.positions(true);
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
    fn sweep(&mut self) -> LaneMovement<P::Lanes> {
        self.forces();
        if R::COMPENSATED {
            self.scale_forces();
        }
        let p = self.momenta(R::COMPENSATED);
        self.velocities();
        if R::COMPENSATED {
            self.scale_velocities();
        }
        let q = self.positions(R::COMPENSATED);
        LaneMovement { q, p }
    }

    #[cfg_attr(not(debug_assertions), inline(always))]
    fn overrelaxed_sweep(&mut self) -> LaneMovement<P::Lanes> {
        self.beyond().sweep()
    }

    #[cfg_attr(not(debug_assertions), inline(always))]
    fn scales(&self, _movement: &Self::Movement) -> [f64; 2] {
        let (step, stages) = (self.step, &*self.stages);
        [
            scale_of::<P, V>(step.q, stages.q.as_ref()),
            scale_of::<P, V>(step.p, stages.p.as_ref()),
        ]
    }
}

/// Whether there are predictor coefficients: for the velocities, and for the forces if the system is not separable.
pub(crate) const fn extrapolates<P: StageTableau>() -> bool {
    !P::MOMENTA.extrapolation.is_empty()
        && (P::Class::SEPARABLE || !P::POSITIONS.extrapolation.is_empty())
}

impl<P, R, V, S> ByLanes<'_, P, R, V, S>
where
    P: StageTableau,
    R: Summation,
    V: Vector<Scalar = f64>,
    S: SystemInLanes<V>,
{
    /// The same stages with over-relaxed sweeps, which move them twice as far.
    #[cfg_attr(not(debug_assertions), inline(always))]
    pub(crate) fn beyond(&mut self) -> ByLanes<'_, P, Overrelaxed<R>, V, S> {
        ByLanes {
            step: self.step,
            system: self.system,
            stages: &mut *self.stages,
            sums: PhantomData,
        }
    }

    /// Computes new positions from velocities, which may be `of_increments`; returns their change.
    #[cfg_attr(not(debug_assertions), inline(always))]
    pub(crate) fn positions(&mut self, of_increments: bool) -> P::Lanes {
        let (step, stages) = (self.step, &mut *self.stages);
        let base = (step.q, step.q_low);
        let (columns, weights) = (Columns::<P>::POSITIONS, P::MOMENTA.weights);
        let sums = sums::<R, P>(columns, weights, step.size, of_increments);
        let terms = stages.velocity.as_ref();
        values::<P, V>(&sums, stages.q.as_mut(), base, terms, sum::<P>)
    }

    /// Computes new momenta from forces, which may be `of_increments`; returns their change.
    #[cfg_attr(not(debug_assertions), inline(always))]
    pub(crate) fn momenta(&mut self, of_increments: bool) -> P::Lanes {
        let (step, stages) = (self.step, &mut *self.stages);
        let base = (step.p, step.p_low);
        let (columns, weights) = (Columns::<P>::MOMENTA, P::POSITIONS.weights);
        let sums = sums::<R, P>(columns, weights, step.size, of_increments);
        let terms = stages.force.as_ref();
        values::<P, V>(&sums, stages.p.as_mut(), base, terms, sum::<P>)
    }

    /// Evaluates all forces, not yet scaled to increments.
    #[cfg_attr(not(debug_assertions), inline(always))]
    pub(crate) fn forces(&mut self) {
        let SimdStages { q, p, force, .. } = &mut *self.stages;
        let (q, p) = (q.as_ref(), p.as_ref());
        for (group, force) in force.as_mut().iter_mut().enumerate() {
            let time = times::<P, V>(&P::POSITIONS, self.step, group);
            P::Lanes::force::<V, S>(self.system, time, &q[group], &p[group], force);
        }
    }

    /// Evaluates all velocities, not yet scaled to increments.
    #[cfg_attr(not(debug_assertions), inline(always))]
    pub(crate) fn velocities(&mut self) {
        let SimdStages { q, p, velocity, .. } = &mut *self.stages;
        let (q, p) = (q.as_ref(), p.as_ref());
        for (group, velocity) in velocity.as_mut().iter_mut().enumerate() {
            let time = times::<P, V>(&P::MOMENTA, self.step, group);
            P::Lanes::velocity::<V, S>(self.system, time, &q[group], &p[group], velocity);
        }
    }

    /// Evaluates all velocities and forces, not yet scaled to increments; both are evaluated at the same times.
    #[cfg_attr(not(debug_assertions), inline(always))]
    pub(crate) fn slopes(&mut self) {
        let SimdStages {
            q,
            p,
            velocity,
            force,
        } = &mut *self.stages;
        let (q, p, velocity, force) = (q.as_ref(), p.as_ref(), velocity.as_mut(), force.as_mut());
        let n = velocity.len().min(force.len());
        let (velocity, force) = (&mut velocity[..n], &mut force[..n]);
        for group in 0..n {
            let time = times::<P, V>(&P::POSITIONS, self.step, group);
            let slopes = (&mut velocity[group], &mut force[group]);
            P::Lanes::slopes::<V, S>(self.system, time, &q[group], &p[group], slopes);
        }
    }

    /// Scales the forces to increments.
    #[cfg_attr(not(debug_assertions), inline(always))]
    pub(crate) fn scale_forces(&mut self) {
        scale::<P, V>(&P::POSITIONS, self.step.size, self.stages.force.as_mut());
    }

    /// Scales the velocities to increments.
    #[cfg_attr(not(debug_assertions), inline(always))]
    pub(crate) fn scale_velocities(&mut self) {
        scale::<P, V>(&P::MOMENTA, self.step.size, self.stages.velocity.as_mut());
    }

    /// Scales velocities and forces to increments.
    #[cfg_attr(not(debug_assertions), inline(always))]
    pub(crate) fn increments(&mut self) {
        self.scale_forces();
        self.scale_velocities();
    }
}
