//! Second-order systems whose force is local: positions of stages that need not be stored in memory.

use core::marker::PhantomData;
use core::mem;

use num_traits::Zero;

use super::rows::{AlongRows, are_in_rows, enter, leave};
use super::{Positions, Start, Terms, apart, eliminates, position, tableau};
use crate::error::Quantity;
use crate::method::{
    EvaluationCounts, Failure, StageChange, StageTableau, StepStatistics, Stopping, WarmStart,
};
use crate::number::lanes::{lane_of, lanes};
use crate::number::linear_combination::sum_of_products;
use crate::number::{Lanes, Scalar, Summation, Vector};
use crate::solver::convergence::{Begun, Sweeps};
use crate::solver::predictor::starts_at_once;
use crate::solver::simd::change::{LaneMovement, noted, part_change};
use crate::solver::simd::sums::{combination, increment_factor, is_about, times};
use crate::system::SystemInLanes;
use crate::system::SystemLanes;
use crate::system::{Class, Components, StageRows, System};

/// Whether stages are iterated along the components: for vectors on the heap, with all stages of a component in one group.
#[cfg_attr(not(debug_assertions), inline(always))]
pub(super) fn is_local<P: StageTableau, V: Vector, S: SystemInLanes<V>>() -> bool {
    <S as System<V>>::LOCAL_FORCE
        && P::Lanes::has_local_force::<V, S>()
        && <S as System<V>>::UNIT_MASSES
        && mem::needs_drop::<V>()
        && eliminates::<P>()
        && P::INCREMENTS
        && starts_at_once(&P::POSITIONS)
        && P::POSITIONS.count <= P::Lanes::WIDTH
}

/// The forces at the positions of the stages. Positions are computed from the forces of the previous sweep where they are needed.
/// The movement of a sweep bounds how far the next positions can differ from the positions of that sweep.
///
/// An iteration that does not settle in its early sweeps continues with [`Positions`], whose positions are in memory.
pub(super) struct Locally<'p, 'a, P: StageTableau, R, V: Vector, S> {
    positions: &'p mut Positions<'a, P, R, V, S>,
    /// The largest component of the positions at the start of the step and of the starting values of the stages. Sweeps do not
    /// update it.
    largest: P::Lanes,
    /// Number of sweeps of the previous step, without the sweep that `dither_last_sweep` may have added.
    sweeps_before: u32,
}

impl<'p, 'a, P, R, V, S> Locally<'p, 'a, P, R, V, S>
where
    P: StageTableau,
    R: Summation,
    V: Vector<Scalar = f64>,
    S: SystemInLanes<V>,
{
    /// Number of sweeps that are examined if a step takes as many as the previous one. In them the changes come down to rounding, shrink
    /// further, and stop. With plain sums the last one is predicted from the two before it. If fewer sweeps suffice, one or two fewer
    /// are made.
    const SEEN: u32 = 3;

    pub(super) fn new(positions: &'p mut Positions<'a, P, R, V, S>, sweeps_before: u32) -> Self {
        Self {
            positions,
            largest: P::Lanes::zero(),
            sweeps_before,
        }
    }

    /// Whether the forces are in rows.
    #[cfg_attr(not(debug_assertions), inline(always))]
    fn are_in_rows(&self) -> bool {
        are_in_rows::<P, V, S>(self.positions.lanes.step.q.dimension())
    }

    /// Computes the forces at the positions with these terms; returns the change of the forces.
    #[cfg_attr(not(debug_assertions), inline(always))]
    fn walk<const MEASURED: bool>(&mut self, terms: &Terms<impl AsRef<[f64]>>) -> P::Lanes {
        let in_rows = self.are_in_rows();
        let lanes = &mut self.positions.lanes;
        let (step, stages) = (lanes.step, &mut *lanes.stages);
        if in_rows {
            let mut along = AlongRows::<P, R, _, MEASURED>::new(terms, step, stages);
            if along.count() == 0 {
                // A wrong dimension, which the validation of the step finds.
                return P::Lanes::zero();
            }
            System::<V>::row_forces(lanes.system, &mut along);
            let (largest, changes) = along.changes();
            if MEASURED {
                self.largest = largest;
            }
            return changes;
        }
        let [force, ..] = stages.force.as_mut() else {
            return P::Lanes::zero();
        };
        let force = force.as_mut_slice();
        let n = (force.len().min(step.q.dimension()))
            .min(step.q_low.dimension())
            .min(step.p.dimension());
        let mut along = Along::<P, R, _, MEASURED> {
            terms,
            size: step.size,
            q: &step.q.as_slice()[..n],
            q_low: &step.q_low.as_slice()[..n],
            p: &step.p.as_slice()[..n],
            force: &mut force[..n],
            largest: P::Lanes::from_f64(0.0),
            changes: None,
            summation: PhantomData,
        };
        let time = times::<P, V>(&P::POSITIONS, step, 0);
        P::Lanes::local_force::<V, S>(lanes.system, time, &mut along);
        if MEASURED {
            self.largest = along.largest;
        }
        along.changes.unwrap_or_else(P::Lanes::zero)
    }

    /// Like [`walk`](Self::walk), but returns how far the next positions can differ from those of the forces, up to rounding.
    #[cfg_attr(not(debug_assertions), inline(always))]
    fn movement(&mut self, terms: &Terms<impl AsRef<[f64]>>) -> P::Lanes {
        let changes = self.walk::<false>(terms);
        let factor = P::Lanes::from_f64(terms.factor);
        sum_of_products(None, terms.columns.len(), |j| {
            let column: P::Lanes = lanes(terms.columns[j].as_ref(), 0);
            (
                (column * factor).abs(),
                P::Lanes::from_f64(lane_of(changes, j)),
            )
        })
    }
}

/// The stages of a step along its components. `MEASURED`: whether the largest position is recorded.
struct Along<'a, P: StageTableau, R, C: 'static, const MEASURED: bool> {
    terms: &'a Terms<C>,
    size: f64,
    q: &'a [f64],
    q_low: &'a [f64],
    p: &'a [f64],
    /// The forces of the previous sweep, replaced one by one by the new ones; or the increments computed from them.
    force: &'a mut [P::Lanes],
    largest: P::Lanes,
    /// The largest change of a force.
    changes: Option<P::Lanes>,
    summation: PhantomData<R>,
}

impl<P, R, C, const MEASURED: bool> Components<P::Lanes> for Along<'_, P, R, C, MEASURED>
where
    P: StageTableau,
    R: Summation,
    C: AsRef<[f64]>,
{
    #[cfg_attr(not(debug_assertions), inline(always))]
    fn dimension(&self) -> usize {
        self.force.len()
    }

    #[cfg_attr(not(debug_assertions), inline(always))]
    fn position(&mut self, k: usize) -> P::Lanes {
        let (Some(force), Some(&q), Some(&q_low), Some(&p)) = (
            self.force.get(k),
            self.q.get(k),
            self.q_low.get(k),
            self.p.get(k),
        ) else {
            return P::Lanes::from_f64(f64::NAN);
        };
        let sum = combination(&self.terms.sums(None), 0, None, |j| lane_of(*force, j));
        let base = (P::Lanes::from_f64(q), P::Lanes::from_f64(q_low));
        let node = lanes(tableau::<P>().nodes, 0);
        let velocity = P::Lanes::from_f64(p);
        let terms = (self.terms.factor, sum);
        let position = position::<R, P::Lanes>(base, (self.size, node), velocity, terms);
        if MEASURED {
            self.largest = (self.largest.larger(base.0.abs())).larger(position.abs());
        }
        position
    }

    #[cfg_attr(not(debug_assertions), inline(always))]
    fn set_force(&mut self, k: usize, force: P::Lanes) {
        let Some(place) = self.force.get_mut(k) else {
            return;
        };
        let new = match R::COMPENSATED {
            true => force * increment_factor::<P>(&P::POSITIONS, self.size, 0),
            false => force,
        };
        let change = (new - *place).abs();
        *place = new;
        self.changes = Some(noted(self.changes, change));
    }
}

/// Neither the size of the stages nor NaN or infinite values are tested here. An iteration that does not settle in its early sweeps
/// [continues](Sweeps::go_on) with [`Positions`].
impl<P, R, V, S> Sweeps for Locally<'_, '_, P, R, V, S>
where
    P: StageTableau,
    R: Summation,
    V: Vector<Scalar = f64>,
    S: SystemInLanes<V>,
{
    type Movement = LaneMovement<P::Lanes>;

    const STOPS_AT_ROUNDING: bool = !R::COMPENSATED;

    const MEASURED: bool = false;

    #[cfg_attr(not(debug_assertions), inline(always))]
    fn evaluations(&self) -> EvaluationCounts {
        let counts = self.positions.evaluations();
        // The evaluations at the starting values come before the first sweep.
        EvaluationCounts {
            begin: counts.begin + counts.sweep,
            ..counts
        }
    }

    #[cfg_attr(not(debug_assertions), inline(always))]
    fn time(&self) -> f64 {
        self.positions.time()
    }

    #[cfg_attr(not(debug_assertions), inline(always))]
    fn begin(&mut self, _kept: WarmStart) {
        // The sweeps that follow measure their own changes.
        apart(|| {
            let h = self.positions.lanes.step.size;
            self.walk::<true>(&Start::<P>::terms(R::COMPENSATED, h));
        });
    }

    #[cfg_attr(not(debug_assertions), inline(always))]
    fn non_finite(&self) -> Option<(Quantity, usize)> {
        self.positions.non_finite()
    }

    #[cfg_attr(not(debug_assertions), inline(always))]
    fn non_finite_force(&self) -> Option<usize> {
        self.positions.non_finite_force()
    }

    /// Continues with positions in memory, where the error diagnosis reads them.
    #[cfg_attr(not(debug_assertions), inline(always))]
    fn go_on<C: Class, T: Scalar>(
        &mut self,
        kept: WarmStart,
        stopping: Stopping,
        begun: Begun<Self::Movement>,
    ) -> Result<StepStatistics, Failure> {
        let in_rows = self.are_in_rows();
        if in_rows {
            leave::<P, V>(self.positions.lanes.stages);
        }
        let begun_here = !begun.is_nothing();
        if begun_here {
            self.positions.positions();
        }
        let mut work = self.positions.go_on::<C, T>(kept, stopping, begun)?;
        if begun_here {
            work.evaluations += self.positions.evaluations().sweep;
        }
        if in_rows {
            enter::<P, V>(self.positions.lanes.stages);
        }
        Ok(work)
    }

    #[cfg_attr(not(debug_assertions), inline(always))]
    fn sweep(&mut self) -> LaneMovement<P::Lanes> {
        let h = self.positions.lanes.step.size;
        let q = apart(|| self.movement(&Terms::new::<P>(R::COMPENSATED, h)));
        // Positions stand for both halves.
        LaneMovement { q, p: q }
    }

    #[cfg_attr(not(debug_assertions), inline(always))]
    fn unexamined(&self) -> u32 {
        self.sweeps_before.saturating_sub(Self::SEEN)
    }

    #[cfg_attr(not(debug_assertions), inline(always))]
    fn sweep_unexamined(&mut self) {
        let h = self.positions.lanes.step.size;
        apart(|| {
            self.walk::<false>(&Terms::new::<P>(R::COMPENSATED, h));
        });
    }

    #[cfg_attr(not(debug_assertions), inline(always))]
    fn change(&self, movement: &LaneMovement<P::Lanes>) -> StageChange {
        let q = part_change(movement.q, self.largest);
        StageChange { q, p: q }
    }

    #[cfg_attr(not(debug_assertions), inline(always))]
    fn are_about(&self, _movement: &Self::Movement, [q, _]: [f64; 2], _both: bool) -> bool {
        is_about(self.largest, q)
    }
}
