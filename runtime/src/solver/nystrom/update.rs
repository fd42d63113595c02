//! The result of a step of a second-order system.

use super::{slopes, tableau, velocity};
use crate::method::{Outcome, StageTableau, Step};
use crate::number::lanes::{lane_of, lanes};
use crate::number::linear_combination::sum_of_products;
use crate::number::summation::add;
use crate::number::{Lanes, Plain, Scalar, Summation, Vector};
use crate::solver::simd::stages::{Laned, SimdStages};
use crate::solver::simd::sums::{shortest, total};
use crate::system::SystemInLanes;

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
        let term = |stage: usize| lane_of(terms.as_ref()[stage / P::Lanes::WIDTH], stage);
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
