//! Second-order systems whose force is computed in rows: eight neighbouring components side by side, for all stages at once.
//!
//! From step to step the forces are stored in the place of the velocities, which unit masses leave unused. They are stored row by
//! row, and within a row stage by stage. During a step without a warm start they are in their own place, component by component with
//! the stages in lanes. The same holds for a step that does not settle in its early sweeps.

use core::marker::PhantomData;

use num_traits::Zero;

use super::local::is_local;
use super::{Terms, position, tableau};
use crate::method::{StageTableau, Step};
use crate::number::lanes::lane_of;
use crate::number::linear_combination::sum_of_products;
use crate::number::{F64x8, Lanes, Scalar, Summation, Vector};
use crate::solver::simd::stages::SimdStages;
use crate::solver::simd::sums::{entry, shortest, times};
use crate::system::SystemInLanes;
use crate::system::{MOST_ROW_STAGES, StageRows, System};

/// Components in a row.
pub(super) const WIDTH: usize = F64x8::WIDTH;

/// Whether the forces of stages are stored in rows.
#[cfg_attr(not(debug_assertions), inline(always))]
pub(super) fn are_in_rows<P, V, S>(dimension: usize) -> bool
where
    P: StageTableau,
    V: Vector,
    S: SystemInLanes<V>,
{
    is_local::<P, V, S>()
        && <S as System<V>>::ROW_FORCES
        && P::POSITIONS.count <= MOST_ROW_STAGES
        && dimension >= WIDTH
        && dimension.is_multiple_of(WIDTH)
}

/// The forces stored in rows.
#[cfg_attr(not(debug_assertions), inline(always))]
pub(super) fn forces<P: StageTableau, V: Vector>(stages: &SimdStages<V, P>) -> &[P::Lanes] {
    (stages.velocity.as_ref().first()).map_or(&[], Vector::as_slice)
}

/// [`forces`], mutable.
#[cfg_attr(not(debug_assertions), inline(always))]
fn forces_mut<P: StageTableau, V: Vector>(stages: &mut SimdStages<V, P>) -> &mut [P::Lanes] {
    (stages.velocity.as_mut().first_mut()).map_or(&mut [], Vector::as_mut_slice)
}

/// Number of lane vectors that hold a row of one stage.
const fn parts<L: Lanes>() -> usize {
    WIDTH / L::WIDTH
}

/// Loads the forces of one stage from a row.
#[cfg_attr(not(debug_assertions), inline(always))]
pub(super) fn load<L: Lanes>(row: &[L], stage: usize) -> F64x8 {
    let parts = &row[stage * parts::<L>()..(stage + 1) * parts::<L>()];
    F64x8::from_fn(|lane| lane_of(parts[lane / L::WIDTH], lane))
}

/// Stores the forces of one stage in a row.
#[cfg_attr(not(debug_assertions), inline(always))]
fn store<L: Lanes>(row: &mut [L], stage: usize, numbers: F64x8) {
    let numbers = numbers.to_array();
    let places = &mut row[stage * parts::<L>()..(stage + 1) * parts::<L>()];
    for (part, place) in places.iter_mut().enumerate() {
        *place = L::from_fn(|lane| numbers[part * L::WIDTH + lane]);
    }
}

/// Number of lane vectors that hold a row of all stages.
pub(super) const fn row_length<P: StageTableau>() -> usize {
    P::POSITIONS.count * parts::<P::Lanes>()
}

/// The first stage, from 1, whose force is NaN or infinite.
pub(super) fn non_finite_force<P: StageTableau, V: Vector>(
    stages: &SimdStages<V, P>,
) -> Option<usize> {
    let components = || 0..forces(stages).len() / row_length::<P>() * WIDTH;
    let first = (0..P::POSITIONS.count)
        .find(|&stage| components().any(|k| !force(stages, stage, k).is_finite()));
    first.map(|stage| stage + 1)
}

/// The force on a component at a stage.
#[cfg_attr(not(debug_assertions), inline(always))]
pub(super) fn force<P: StageTableau, V: Vector>(
    stages: &SimdStages<V, P>,
    stage: usize,
    component: usize,
) -> f64 {
    let (row, lane) = (component / WIDTH, component % WIDTH);
    let part = row * row_length::<P>() + stage * parts::<P::Lanes>() + lane / P::Lanes::WIDTH;
    lane_of(forces(stages)[part], lane)
}

/// Moves the forces from the rows to their own place. The rows become zero, so that after a failed iteration they are not read as
/// velocities.
pub(super) fn leave<P: StageTableau, V: Vector>(stages: &mut SimdStages<V, P>) {
    let n = shortest(stages.force.as_ref()).min(shortest(stages.velocity.as_ref()));
    for k in 0..n / WIDTH * WIDTH {
        let numbers = P::Lanes::from_fn(|lane| force(stages, lane.min(P::POSITIONS.count - 1), k));
        for group in stages.force.as_mut() {
            group.as_mut_slice()[k] = numbers;
        }
    }
    forces_mut(stages).fill(P::Lanes::from_f64(0.0));
}

/// Copies the forces back to the rows.
pub(super) fn enter<P: StageTableau, V: Vector>(stages: &mut SimdStages<V, P>) {
    let SimdStages {
        velocity, force, ..
    } = stages;
    let (Some(rows), force) = (velocity.as_mut().first_mut(), force.as_ref()) else {
        return;
    };
    let rows = rows.as_mut_slice().chunks_exact_mut(row_length::<P>());
    for (row, places) in rows.take(shortest(force) / WIDTH).enumerate() {
        for stage in 0..P::POSITIONS.count {
            let component = |lane: usize| entry::<P, V>(force, stage, row * WIDTH + lane);
            store(places, stage, F64x8::from_fn(component));
        }
    }
}

/// The stages of a step along its rows. `MEASURED`: whether the largest position is recorded.
pub(super) struct AlongRows<'a, P: StageTableau, R, C: 'static, const MEASURED: bool> {
    terms: &'a Terms<C>,
    times: P::Lanes,
    size: f64,
    q: &'a [[f64; WIDTH]],
    q_low: &'a [[f64; WIDTH]],
    p: &'a [[f64; WIDTH]],
    forces: &'a mut [P::Lanes],
    /// The largest position, including the start of the step; zero if not `MEASURED`.
    largest: F64x8,
    /// The largest change of a force at each stage.
    changes: [F64x8; MOST_ROW_STAGES],
    summation: PhantomData<R>,
}

/// The rows of a vector.
#[cfg_attr(not(debug_assertions), inline(always))]
pub(super) fn rows<V: Vector<Scalar = f64>>(vector: &V) -> &[[f64; WIDTH]] {
    vector.as_slice().as_chunks().0
}

/// [`rows`], mutable.
#[cfg_attr(not(debug_assertions), inline(always))]
pub(super) fn rows_mut<V: Vector<Scalar = f64>>(vector: &mut V) -> &mut [[f64; WIDTH]] {
    vector.as_mut_slice().as_chunks_mut().0
}

impl<'a, P, R, C, const MEASURED: bool> AlongRows<'a, P, R, C, MEASURED>
where
    P: StageTableau,
    R: Summation,
    C: AsRef<[f64]>,
{
    /// The stages whose positions have these terms.
    #[cfg_attr(not(debug_assertions), inline(always))]
    pub(super) fn new<V: Vector<Scalar = f64>>(
        terms: &'a Terms<C>,
        step: &'a Step<'_, V>,
        stages: &'a mut SimdStages<V, P>,
    ) -> Self {
        let (q, q_low, p) = (rows(step.q), rows(step.q_low), rows(step.p));
        let forces = forces_mut(stages);
        let n = (q.len().min(q_low.len()).min(p.len())).min(forces.len() / row_length::<P>());
        Self {
            terms,
            times: times::<P, V>(&P::POSITIONS, step, 0),
            size: step.size,
            q: &q[..n],
            q_low: &q_low[..n],
            p: &p[..n],
            forces: &mut forces[..n * row_length::<P>()],
            largest: F64x8::zero(),
            changes: [F64x8::zero(); MOST_ROW_STAGES],
            summation: PhantomData,
        }
    }

    /// The largest position, including the start of the step, and the changes of the forces of each stage.
    #[cfg_attr(not(debug_assertions), inline(always))]
    pub(super) fn changes(self) -> (P::Lanes, P::Lanes) {
        let changes = P::Lanes::from_fn(|lane| match self.changes.get(lane) {
            Some(change) if change.any_nan() => f64::NAN,
            Some(change) => change.largest(),
            None => 0.0,
        });
        let positions = P::Lanes::from_f64(self.largest.largest());
        (positions, changes)
    }
}

impl<P, R, C, const MEASURED: bool> StageRows for AlongRows<'_, P, R, C, MEASURED>
where
    P: StageTableau,
    R: Summation,
    C: AsRef<[f64]>,
{
    #[cfg_attr(not(debug_assertions), inline(always))]
    fn count(&self) -> usize {
        self.q.len()
    }

    #[cfg_attr(not(debug_assertions), inline(always))]
    fn stages(&self) -> usize {
        P::POSITIONS.count
    }

    #[cfg_attr(not(debug_assertions), inline(always))]
    fn time(&self, stage: usize) -> F64x8 {
        F64x8::from_f64(lane_of(self.times, stage))
    }

    // Loops over indices without an early exit: otherwise all arrays are in memory, which takes four times as long. Substituting a row
    // for a missing one would take a fifth longer.
    #[allow(clippy::needless_range_loop, reason = "all in registers")]
    #[cfg_attr(not(debug_assertions), inline(always))]
    fn positions(&mut self, row: usize) -> [F64x8; MOST_ROW_STAGES] {
        let [q, q_low, p] = [self.q, self.q_low, self.p].map(|rows| F64x8::from_array(rows[row]));
        let forces = &self.forces[row * row_length::<P>()..(row + 1) * row_length::<P>()];
        let mut positions = [F64x8::zero(); MOST_ROW_STAGES];
        if MEASURED {
            self.largest = self.largest.larger(q.abs());
        }
        for stage in 0..P::POSITIONS.count {
            let sum = sum_of_products(None, self.terms.columns.len(), |j| {
                let entry = self.terms.columns[j].as_ref()[stage];
                (F64x8::from_f64(entry), load(forces, j))
            });
            let terms = (self.terms.factor, sum);
            let node = F64x8::from_f64(tableau::<P>().nodes[stage]);
            let position = position::<R, F64x8>((q, q_low), (self.size, node), p, terms);
            if MEASURED {
                self.largest = self.largest.larger(position.abs());
            }
            positions[stage] = position;
        }
        positions
    }

    #[allow(clippy::needless_range_loop, reason = "all in registers")]
    #[cfg_attr(not(debug_assertions), inline(always))]
    fn set_forces(&mut self, row: usize, forces: [F64x8; MOST_ROW_STAGES]) {
        let places = &mut self.forces[row * row_length::<P>()..(row + 1) * row_length::<P>()];
        for stage in 0..P::POSITIONS.count {
            let new = match R::COMPENSATED {
                true => forces[stage] * F64x8::from_f64(P::POSITIONS.weights[stage] * self.size),
                false => forces[stage],
            };
            let change = (new - load(places, stage)).abs();
            store(places, stage, new);
            self.changes[stage] = self.changes[stage].larger_or_nan(change);
        }
    }
}
