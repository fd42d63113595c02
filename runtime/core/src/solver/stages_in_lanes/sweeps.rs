//! Sweeps over coupled stages in SIMD lanes.

use core::marker::PhantomData;

use crate::contract::storage::aside;
use crate::contract::tableau::Columns;
use crate::contract::{
    Class, EvaluationCounts, Failure, HalfTableau, Outcome, StageStorage, StageTableau, Step,
    StepStatistics, Stopping, SystemInLanes, SystemLanes, WarmStart,
};
use crate::error::Quantity;
use crate::number::summation::Overrelaxed;
use crate::number::{Summation, Vector};
use crate::solver::convergence::{Sweeps, settle};
use crate::solver::predictor::{Starting, StartingColumns, starts_at_once};
use crate::solver::stages_in_lanes::change::LaneMovement;
use crate::solver::stages_in_lanes::stages::SimdStages;
use crate::solver::stages_in_lanes::sums::{
    BasePlusSum, Sums, extrapolate, fill, scale, scale_of, sums, times, totals, values,
};

/// [`Solver::take`](crate::contract::Solver::take) with Gauss–Seidel sweeps, or with `JACOBI` sweeps.
#[cfg_attr(not(debug_assertions), inline(always))]
pub(crate) fn take<P, R, V, S, const JACOBI: bool>(
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
    let mut sweeps = ByLanes::<P, R, V, S, JACOBI> {
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
/// A Gauss–Seidel sweep evaluates the velocities at the new momenta. A `JACOBI` sweep evaluates both halves at the stages of the previous
/// sweep.
///
/// With plain sums, velocities and forces are not scaled to increments during the iteration; the matrices contain the scale
/// factors instead.
pub(crate) struct ByLanes<'a, P: StageTableau, R, V: Vector, S, const JACOBI: bool> {
    pub(crate) step: &'a Step<'a, V>,
    pub(crate) system: &'a S,
    pub(crate) stages: &'a mut SimdStages<V, P>,
    pub(crate) sums: PhantomData<R>,
}

impl<P, R, V, S, const JACOBI: bool> Sweeps for ByLanes<'_, P, R, V, S, JACOBI>
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
        let sweep = (P::POSITIONS.count + P::MOMENTA.count) as u32;
        let first = if JACOBI {
            sweep
        } else {
            P::MOMENTA.count as u32
        };
        let (begin, start) = match extrapolates::<P>() {
            true => (0, first),
            false => (first, 0),
        };
        EvaluationCounts {
            begin,
            start,
            sweep,
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
        if JACOBI && kept.stages && starts_at_once(&P::POSITIONS) && starts_at_once(&P::MOMENTA) {
            return self.start();
        }
        if kept.stages && extrapolates::<P>() {
            extrapolate::<P, V>(&P::MOMENTA, self.stages.velocity.as_mut());
            if !P::Class::SEPARABLE {
                extrapolate::<P, V>(&P::POSITIONS, self.stages.force.as_mut());
                self.momenta(true);
            }
        } else {
            fill::<P, V>(self.stages.q.as_mut(), self.step.q);
            fill::<P, V>(self.stages.p.as_mut(), self.step.p);
            if JACOBI {
                self.sweep();
                return;
            }
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
        if JACOBI {
            self.slopes();
            if R::COMPENSATED {
                self.increments();
            }
            return LaneMovement {
                p: self.momenta(R::COMPENSATED),
                q: self.positions(R::COMPENSATED),
            };
        }
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
        self.overrelaxed().sweep()
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
pub const fn extrapolates<P: StageTableau>() -> bool {
    !P::MOMENTA.extrapolation.is_empty()
        && (P::Class::SEPARABLE || !P::POSITIONS.extrapolation.is_empty())
}

impl<P, R, V, S, const JACOBI: bool> ByLanes<'_, P, R, V, S, JACOBI>
where
    P: StageTableau,
    R: Summation,
    V: Vector<Scalar = f64>,
    S: SystemInLanes<V>,
{
    /// Predicts the stages from the increments of the previous step.
    #[cfg_attr(not(debug_assertions), inline(always))]
    fn start(&mut self) {
        let (step, stages) = (self.step, &mut *self.stages);
        let factor = (!P::INCREMENTS).then_some(step.size);
        let sums = |half: &HalfTableau, columns: &'static StartingColumns| Sums {
            count: half.columns.len(),
            column: move |j: usize| &columns[j][..],
            factor: move |_| factor,
            with_low: R::COMPENSATED,
            overrelaxed: false,
        };
        let momenta = sums(&P::MOMENTA, Starting::<P>::MOMENTA);
        let (base, forces) = ((step.p, step.p_low), stages.force.as_ref());
        values::<P, V>(&momenta, stages.p.as_mut(), base, forces, BasePlusSum);
        let positions = sums(&P::POSITIONS, Starting::<P>::POSITIONS);
        let (base, velocities) = ((step.q, step.q_low), stages.velocity.as_ref());
        values::<P, V>(&positions, stages.q.as_mut(), base, velocities, BasePlusSum);
    }

    /// The same stages with over-relaxed sweeps, which move them twice as far.
    #[cfg_attr(not(debug_assertions), inline(always))]
    fn overrelaxed(&mut self) -> ByLanes<'_, P, Overrelaxed<R>, V, S, JACOBI> {
        ByLanes {
            step: self.step,
            system: self.system,
            stages: &mut *self.stages,
            sums: PhantomData,
        }
    }

    /// Computes new positions from velocities, which may be `of_increments`; returns their change.
    #[cfg_attr(not(debug_assertions), inline(always))]
    fn positions(&mut self, of_increments: bool) -> P::Lanes {
        let (step, stages) = (self.step, &mut *self.stages);
        let base = (step.q, step.q_low);
        let (columns, weights) = (Columns::<P>::POSITIONS, P::MOMENTA.weights);
        let sums = sums::<R, P>(columns, weights, step.size, of_increments);
        let terms = stages.velocity.as_ref();
        values::<P, V>(&sums, stages.q.as_mut(), base, terms, BasePlusSum)
    }

    /// Computes new momenta from forces, which may be `of_increments`; returns their change.
    #[cfg_attr(not(debug_assertions), inline(always))]
    fn momenta(&mut self, of_increments: bool) -> P::Lanes {
        let (step, stages) = (self.step, &mut *self.stages);
        let base = (step.p, step.p_low);
        let (columns, weights) = (Columns::<P>::MOMENTA, P::POSITIONS.weights);
        let sums = sums::<R, P>(columns, weights, step.size, of_increments);
        let terms = stages.force.as_ref();
        values::<P, V>(&sums, stages.p.as_mut(), base, terms, BasePlusSum)
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
    fn velocities(&mut self) {
        let SimdStages { q, p, velocity, .. } = &mut *self.stages;
        let (q, p) = (q.as_ref(), p.as_ref());
        for (group, velocity) in velocity.as_mut().iter_mut().enumerate() {
            let time = times::<P, V>(&P::MOMENTA, self.step, group);
            P::Lanes::velocity::<V, S>(self.system, time, &q[group], &p[group], velocity);
        }
    }

    /// Evaluates all velocities and forces, not yet scaled to increments.
    #[cfg_attr(not(debug_assertions), inline(always))]
    fn slopes(&mut self) {
        if !are_at_one_time::<P>() {
            self.forces();
            return self.velocities();
        }
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
    fn scale_velocities(&mut self) {
        scale::<P, V>(&P::MOMENTA, self.step.size, self.stages.velocity.as_mut());
    }

    /// Scales velocities and forces to increments.
    #[cfg_attr(not(debug_assertions), inline(always))]
    fn increments(&mut self) {
        self.scale_forces();
        self.scale_velocities();
    }
}

/// Whether force and velocity of each stage are evaluated at the same time.
pub const fn are_at_one_time<P: StageTableau>() -> bool {
    same(P::POSITIONS.times, P::MOMENTA.times)
}

/// Whether two lists are equal.
const fn same(left: &[f64], right: &[f64]) -> bool {
    let mut i = 0;
    while i < left.len() && i < right.len() && left[i] == right[i] {
        i += 1;
    }
    i == left.len() && i == right.len()
}
