//! The result of a step of a second-order system.

use num_traits::Zero;

use super::rows::{WIDTH, forces, load, row_length, rows, rows_mut};
use super::{slopes, tableau, velocity};
use crate::method::{Outcome, StageTableau, Step};
use crate::number::array::array;
use crate::number::lanes::{in_groups, lane_of, lanes};
use crate::number::linear_combination::sum_of_products;
use crate::number::summation::add;
use crate::number::{F64x8, Lanes, Plain, Scalar, Summation, Vector};
use crate::solver::simd::stages::{Laned, SimdStages};
use crate::solver::simd::sums::{shortest, total};
use crate::system::SystemInLanes;

/// With unit masses, from forces stored in rows.
#[cfg_attr(not(debug_assertions), inline(always))]
pub(super) fn in_rows<P: StageTableau, R: Summation, V: Vector<Scalar = f64>>(
    step: &Step<'_, V>,
    stages: &SimdStages<V, P>,
    outcome: Outcome<'_, V>,
) {
    let length = row_length::<P>();
    let forces = forces(stages);
    let stages = |row: usize| {
        let row = &forces[row * length..(row + 1) * length];
        array(F64x8::zero(), |stage| match stage < P::POSITIONS.count {
            true => load(row, stage),
            false => F64x8::zero(),
        })
    };
    of_rows::<P, R, V>(step, forces.len() / length, stages, outcome);
}

/// With unit masses, from the forces of all stages in one group of lanes: eight components at a time, and the rest one by one.
#[cfg_attr(not(debug_assertions), inline(always))]
pub(super) fn by_eights<P: StageTableau, R: Summation, V: Vector<Scalar = f64>>(
    step: &Step<'_, V>,
    stages: &SimdStages<V, P>,
    Outcome { q, q_low, p, p_low }: Outcome<'_, V>,
) {
    let [forces, ..] = stages.force.as_ref() else {
        return;
    };
    let (rows, _) = forces.as_slice().as_chunks::<WIDTH>();
    let stages = |row: usize| {
        let components: &[P::Lanes; WIDTH] = &rows[row];
        let stage = |stage: usize| match stage < P::POSITIONS.count {
            true => F64x8::from_fn(|lane| lane_of(components[lane], stage)),
            false => F64x8::zero(),
        };
        // Unrolled, so that the compiler knows each lane; otherwise it reads each lane from memory.
        [
            stage(0),
            stage(1),
            stage(2),
            stage(3),
            stage(4),
            stage(5),
            stage(6),
            stage(7),
        ]
    };
    let outcome = Outcome {
        q: &mut *q,
        q_low: &mut *q_low,
        p: &mut *p,
        p_low: &mut *p_low,
    };
    of_rows::<P, R, V>(step, rows.len(), stages, outcome);
    for k in rows.len() * WIDTH..forces.dimension().min(step.q.dimension()) {
        let base = [step.q, step.q_low, step.p, step.p_low].map(|vector| vector.as_slice()[k]);
        let force = |stage: usize| lane_of(forces.as_slice()[k], stage);
        let result = of_unit_masses::<P, R, f64>(step.size, base, force);
        for (vector, component) in [&mut *q, q_low, p, p_low].into_iter().zip(result) {
            vector.as_mut_slice()[k] = component;
        }
    }
}

/// The result of the first rows; `stages` returns the forces at all stages of a row, zero for missing stages.
#[cfg_attr(not(debug_assertions), inline(always))]
fn of_rows<P: StageTableau, R: Summation, V: Vector<Scalar = f64>>(
    step: &Step<'_, V>,
    count: usize,
    stages: impl Fn(usize) -> [F64x8; WIDTH],
    Outcome { q, q_low, p, p_low }: Outcome<'_, V>,
) {
    let bases = [step.q, step.q_low, step.p, step.p_low].map(rows);
    let results = [q, q_low, p, p_low].map(rows_mut);
    let lengths =
        (results.each_ref().map(|rows| rows.len()).into_iter()).chain(bases.map(<[_]>::len));
    let n = lengths.fold(count, usize::min);
    let bases = bases.map(|rows| &rows[..n]);
    let [q, q_low, p, p_low] = results.map(|rows| &mut rows[..n]);
    for row in 0..n {
        let base = bases.map(|rows| F64x8::from_array(rows[row]));
        let forces = stages(row);
        let result = of_unit_masses::<P, R, F64x8>(step.size, base, |stage| forces[stage]);
        let [high, low, momentum, momentum_low] = result.map(F64x8::to_array);
        (q[row], p[row]) = (high, momentum);
        if R::COMPENSATED {
            (q_low[row], p_low[row]) = (low, momentum_low);
        }
    }
}

/// New positions and momenta with their low parts: from increments if sums are compensated, otherwise from forces.
#[allow(
    clippy::redundant_closure,
    reason = "a reference to one would be called"
)]
#[cfg_attr(not(debug_assertions), inline(always))]
fn of_unit_masses<P: StageTableau, R: Summation, T: Scalar>(
    size: f64,
    [q, q_low, p, p_low]: [T; 4],
    force: impl Fn(usize) -> T,
) -> [T; 4] {
    let (h, count) = (T::from_f64(size), P::POSITIONS.count);
    let rest = |stage: usize| tableau::<P>().rest[stage];
    if R::COMPENSATED {
        let (momentum, momentum_low) = add::<R, T>(p, p_low, count, |stage| force(stage));
        let sum = sum_of_products(None, count, |stage| {
            (T::from_f64(rest(stage)), force(stage))
        });
        let parts = [sum, p];
        let (high, low) = add::<R, T>(q, q_low + h * p_low, 2, |part| h * parts[part]);
        return [high, low, momentum, momentum_low];
    }
    let weight = |stage: usize| P::POSITIONS.weights[stage] * size;
    let mean = plus_forces::<P, T>(p, &force, |stage| rest(stage) * weight(stage));
    [
        h.fused(mean, q),
        q_low,
        plus_forces::<P, T>(p, &force, weight),
        p_low,
    ]
}

/// `base + Σ_j factor_j force_j`
#[cfg_attr(not(debug_assertions), inline(always))]
fn plus_forces<P: StageTableau, T: Scalar>(
    base: T,
    force: &impl Fn(usize) -> T,
    factor: impl Fn(usize) -> f64,
) -> T {
    let term = |stage: usize| T::from_f64(factor(stage)) * force(stage);
    add::<Plain, T>(base, T::zero(), P::POSITIONS.count, term).0
}

/// With compensated sums, from increments.
#[cfg_attr(not(debug_assertions), inline(always))]
pub(super) fn compensated<P, R, V, S>(
    step: &Step<'_, V>,
    system: &S,
    start: &V,
    stages: &mut SimdStages<V, P>,
    Outcome { q, q_low, p, p_low }: Outcome<'_, V>,
) where
    P: StageTableau,
    R: Summation,
    V: Vector<Scalar = f64>,
    S: SystemInLanes<V>,
{
    let h = step.size;
    total::<R, P, V>(
        (p, p_low),
        (step.p, step.p_low),
        stages.force.as_ref(),
        &P::POSITIONS,
        h,
    );
    // The velocity of the low part of the momentum, stored in the place of the result.
    velocity::<P, V, S>(system, step, step.p_low, q, stages);
    let slopes = slopes::<V, S, _>(&stages.velocity, &stages.force).as_ref();
    let n = shortest(slopes)
        .min(step.q.dimension())
        .min(start.dimension());
    let slopes = P::groups(|group| &slopes[group].as_slice()[..n]);
    let start = &start.as_slice()[..n];
    let (base, low) = (&step.q.as_slice()[..n], &step.q_low.as_slice()[..n]);
    let (q, q_low) = (&mut q.as_mut_slice()[..n], &mut q_low.as_mut_slice()[..n]);
    for k in 0..n {
        // Usually smaller than the velocity by a factor of the step size, so its rounding errors are like those of the increments.
        let sum = sum_of_products(None, P::POSITIONS.count, |stage| {
            let slope = slopes.as_ref()[stage / P::Lanes::WIDTH][k];
            (tableau::<P>().rest[stage], lane_of(slope, stage))
        });
        let parts = [sum, start[k]];
        (q[k], q_low[k]) = add::<R, f64>(base[k], low[k] + h * q[k], 2, |part| h * parts[part]);
    }
}

/// With plain sums, from forces that are not yet scaled to increments. All forces of a component are multiplied by their weights
/// before lanes are read one by one.
#[cfg_attr(not(debug_assertions), inline(always))]
pub(super) fn plain<P, V, S>(
    step: &Step<'_, V>,
    start: &V,
    stages: &SimdStages<V, P>,
    Outcome { q, p, .. }: Outcome<'_, V>,
) where
    P: StageTableau,
    V: Vector<Scalar = f64>,
    S: SystemInLanes<V>,
{
    let slopes = slopes::<V, S, _>(&stages.velocity, &stages.force).as_ref();
    let forces = stages.force.as_ref();
    let n = (shortest(slopes).min(shortest(forces)))
        .min(step.q.dimension())
        .min(step.p.dimension())
        .min(start.dimension());
    let h = P::Lanes::from_f64(step.size);
    let weights = P::groups(|group| lanes::<P::Lanes>(P::POSITIONS.weights, group) * h);
    let weights = weights.as_ref();
    let rest = P::groups(|group| lanes::<P::Lanes>(tableau::<P>().rest, group));
    // `base + Σ_j factor_j term_j` in component k.
    let total = |base: f64, terms: &[Laned<V, P>], factor: &[P::Lanes], k: usize| {
        let terms = P::groups(|group| factor[group] * terms[group].as_slice()[k]);
        let term = |stage: usize| in_groups(terms.as_ref(), stage);
        add::<Plain, f64>(base, 0.0, P::POSITIONS.count, term).0
    };
    let factors = P::groups(|group| rest.as_ref()[group] * weights[group]);
    let (q, p) = (&mut q.as_mut_slice()[..n], &mut p.as_mut_slice()[..n]);
    let (q_base, p_base) = (&step.q.as_slice()[..n], &step.p.as_slice()[..n]);
    let start = &start.as_slice()[..n];
    for k in 0..n {
        p[k] = total(p_base[k], forces, weights, k);
    }
    for k in 0..n {
        let mean = total(start[k], slopes, factors.as_ref(), k);
        q[k] = step.size.fused(mean, q_base[k]);
    }
}
