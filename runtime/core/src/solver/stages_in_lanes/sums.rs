//! The sums over stages in lanes: new stages, starting values, and the ends of a step.

use core::mem;

use num_traits::Zero;

use crate::contract::{HalfTableau, Inside, Outcome, StageTableau, Step};
use crate::number::lanes::{lane_of, lanes};
use crate::number::linear_combination::{Products, sum_of, totals_by};
use crate::number::summation::moved;
use crate::number::{Lanes, Scalar, Summation, Vector};
use crate::solver::stages_in_lanes::change::noted;
use crate::solver::stages_in_lanes::stages::{Laned, SimdStages};

/// The times of the evaluations of a group of lanes.
#[cfg_attr(not(debug_assertions), inline(always))]
pub(crate) fn times<P: StageTableau, V>(
    half: &HalfTableau,
    step: &Step<'_, V>,
    group: usize,
) -> P::Lanes {
    let fractions: P::Lanes = lanes(half.times, group);
    P::Lanes::from_f64(step.time) + fractions * P::Lanes::from_f64(step.size)
}

/// Scales evaluations to increments.
#[cfg_attr(not(debug_assertions), inline(always))]
pub(crate) fn scale<P: StageTableau, V: Vector>(
    half: &HalfTableau,
    h: f64,
    evaluations: &mut [Laned<V, P>],
) {
    if P::INCREMENTS {
        for (group, evaluation) in evaluations.iter_mut().enumerate() {
            let weights = lanes::<P::Lanes>(half.weights, group);
            let factor = weights * P::Lanes::from_f64(h);
            for component in evaluation.as_mut_slice() {
                *component *= factor;
            }
        }
    }
}

/// Copies a vector to all lanes.
#[cfg_attr(not(debug_assertions), inline(always))]
pub(crate) fn fill<P: StageTableau, V: Vector<Scalar = f64>>(groups: &mut [Laned<V, P>], from: &V) {
    let from = from.as_slice();
    for group in groups {
        let group = group.as_mut_slice();
        let n = group.len().min(from.len());
        let (group, from) = (&mut group[..n], &from[..n]);
        for k in 0..n {
            group[k] = P::Lanes::from_f64(from[k]);
        }
    }
}

// Functions that read from groups take slices instead of references to arrays. If LLVM knows the length of the referenced array, it
// widens loads of single lanes beyond the group. The processor then has to wait until both groups are in memory.

/// The entry of one stage in one component.
#[cfg_attr(not(debug_assertions), inline(always))]
pub(crate) fn entry<P: StageTableau, V: Vector>(
    groups: &[Laned<V, P>],
    stage: usize,
    component: usize,
) -> f64 {
    lane_of(groups[stage / P::Lanes::WIDTH].as_slice()[component], stage)
}

/// The linear combinations that give the stages: the columns of a matrix, with an entry for each lane, and an optional factor of each.
pub(crate) struct Sums<C, F> {
    pub(crate) count: usize,
    pub(crate) column: C,
    pub(crate) factor: F,
    /// Whether each sum starts with the low part of the base.
    pub(crate) with_low: bool,
    /// Whether the stages are over-relaxed, that is, moved twice as far.
    pub(crate) overrelaxed: bool,
}

/// The sums that give one half of the stages from the evaluations of the other half, which may be increments. `columns` are those of
/// the matrix of this half, `weights` those of the other half.
#[cfg_attr(not(debug_assertions), inline(always))]
pub(crate) fn sums<R: Summation, P: StageTableau>(
    columns: &'static [&'static [f64]],
    weights: &'static [f64],
    h: f64,
    of_increments: bool,
) -> Sums<impl Fn(usize) -> &'static [f64] + use<R, P>, impl Fn(usize) -> Option<f64> + use<R, P>> {
    Sums {
        count: columns.len(),
        column: move |j: usize| columns[j],
        factor: move |j: usize| match (P::INCREMENTS, of_increments) {
            (true, true) => None,
            (true, false) => Some(h * weights[j]),
            (false, _) => Some(h),
        },
        with_low: R::COMPENSATED,
        overrelaxed: R::OVERRELAXED,
    }
}

/// A stage value from the indices of group and component, the base with its low part, and the sum.
pub trait StageValue<L> {
    /// The value in this place.
    fn of(&self, place: (usize, usize), base: (L, L), sum: L) -> L;
}

/// `base + sum`, for a sum that includes the low part of the base.
pub struct BasePlusSum;

impl<L: Lanes> StageValue<L> for BasePlusSum {
    #[cfg_attr(not(debug_assertions), inline(always))]
    fn of(&self, _place: (usize, usize), (base, _low): (L, L), sum: L) -> L {
        base + sum
    }
}

/// Computes new stage values from evaluations; returns their change.
#[cfg_attr(not(debug_assertions), inline(always))]
pub(crate) fn values<P: StageTableau, V: Vector<Scalar = f64>>(
    sums: &Sums<impl Fn(usize) -> &'static [f64], impl Fn(usize) -> Option<f64>>,
    out: &mut [Laned<V, P>],
    (base, low): (&V, &V),
    terms: &[Laned<V, P>],
    value: impl StageValue<P::Lanes>,
) -> P::Lanes {
    let n = shortest(out)
        .min(shortest(terms))
        .min(base.dimension())
        .min(low.dimension());
    let (base, low) = (&base.as_slice()[..n], &low.as_slice()[..n]);
    // The addresses of the components are loaded once: the compiler would load them again after every write.
    let mut places = out.iter_mut();
    let mut out = P::groups(|_| match places.next() {
        Some(group) => &mut group.as_mut_slice()[..n],
        None => &mut [],
    });
    let terms = P::groups(|group| &terms[group].as_slice()[..n]);
    let (out, terms) = (out.as_mut(), terms.as_ref());
    let mut largest = None;
    for k in 0..n {
        let [start, low] = [base[k], low[k]].map(P::Lanes::from_f64);
        let terms = P::groups(|group| terms[group][k]);
        for (group, out) in out.iter_mut().enumerate() {
            let with = sums.with_low.then_some(low);
            let term =
                |j: usize| terms.as_ref()[j / P::Lanes::WIDTH].broadcast(j % P::Lanes::WIDTH);
            let sum_of_terms = combination(sums, group, with, term);
            let new = value.of((group, k), (start, low), sum_of_terms);
            let new = moved(sums.overrelaxed, out[k], new);
            let change = (new - out[k]).abs();
            out[k] = new;
            largest = Some(noted(largest, change));
        }
    }
    largest.unwrap_or_else(P::Lanes::zero)
}

/// `start + Σ_j factor_j columns_j terms_j` in one component, for the stages of one group; a factor is multiplied into the column.
#[cfg_attr(not(debug_assertions), inline(always))]
fn combination<L: Lanes>(
    sums: &Sums<impl Fn(usize) -> &'static [f64], impl Fn(usize) -> Option<f64>>,
    group: usize,
    start: Option<L>,
    term: impl Fn(usize) -> L,
) -> L {
    let count = sums.count;
    sum_of(start, count, Terms { sums, group, term })
}

/// The products of a [`combination`].
struct Terms<'a, C, F, T> {
    sums: &'a Sums<C, F>,
    group: usize,
    term: T,
}

impl<L, C, F, T> Products<L> for Terms<'_, C, F, T>
where
    L: Lanes,
    C: Fn(usize) -> &'static [f64],
    F: Fn(usize) -> Option<f64>,
    T: Fn(usize) -> L,
{
    #[cfg_attr(not(debug_assertions), inline(always))]
    fn product(&self, j: usize) -> (L, L) {
        let column: L = lanes((self.sums.column)(j), self.group);
        let column = match (self.sums.factor)(j) {
            Some(factor) => column * L::from_f64(factor),
            None => column,
        };
        (column, (self.term)(j))
    }
}

/// Extrapolates the increments from those of the previous step.
#[cfg_attr(not(debug_assertions), inline(always))]
pub(crate) fn extrapolate<P: StageTableau, V: Vector>(
    half: &HalfTableau,
    increments: &mut [Laned<V, P>],
) {
    let n = shortest(increments);
    let columns = half.extrapolation;
    let sums = Sums {
        count: columns.len(),
        column: |j: usize| columns[j],
        factor: |_| None,
        with_low: false,
        overrelaxed: false,
    };
    let mut new = P::groups(|_| P::Lanes::from_f64(0.0));
    for k in 0..n {
        for (group, new) in new.as_mut().iter_mut().enumerate() {
            *new = combination(&sums, group, None, |j| {
                P::Lanes::from_f64(entry::<P, V>(increments, j, k))
            });
        }
        for (group, new) in new.as_ref().iter().enumerate() {
            increments[group].as_mut_slice()[k] = *new;
        }
    }
}

/// Computes one half of the result of a step from the evaluations `terms`.
#[cfg_attr(not(debug_assertions), inline(always))]
pub(crate) fn total<R: Summation, P: StageTableau, V: Vector<Scalar = f64>>(
    out: (&mut V, &mut V),
    base: (&V, &V),
    terms: &[Laned<V, P>],
    half: &HalfTableau,
    h: f64,
) {
    let n = shortest(terms).min(base.0.dimension());
    totals_by::<R, V>(out, base, (n, half.count), |k, stage| {
        let entry = entry::<P, V>(terms, stage, k);
        match P::INCREMENTS {
            true => entry,
            false => h * half.weights[stage] * entry,
        }
    });
}

/// The smallest dimension of these vectors.
#[cfg_attr(not(debug_assertions), inline(always))]
pub(crate) fn shortest<V: Vector>(groups: &[V]) -> usize {
    let mut shortest = usize::MAX;
    for group in groups {
        shortest = shortest.min(group.as_slice().len());
    }
    shortest
}

/// Computes the new positions and momenta of the step.
#[cfg_attr(not(debug_assertions), inline(always))]
pub(crate) fn totals<R: Summation, P: StageTableau, V: Vector<Scalar = f64>>(
    step: &Step<'_, V>,
    stages: &SimdStages<V, P>,
    outcome: Outcome<'_, V>,
) {
    let Outcome { q, q_low, p, p_low } = outcome;
    total::<R, P, V>(
        (q, q_low),
        (step.q, step.q_low),
        stages.velocity.as_ref(),
        &P::MOMENTA,
        step.size,
    );
    total::<R, P, V>(
        (p, p_low),
        (step.p, step.p_low),
        stages.force.as_ref(),
        &P::POSITIONS,
        step.size,
    );
}

/// Adds to `out` the part of the interpolation that vanishes at both ends of the step. `evaluation` gives those of one half by stage
/// and component.
pub(crate) fn extend<P: StageTableau, V: Vector<Scalar = f64>>(
    half: &HalfTableau,
    at: Inside<'_, V>,
    evaluation: impl Fn(usize, usize) -> f64,
    out: &mut V,
) {
    let Some(polynomial) = half.polynomial else {
        return;
    };
    for stage in 0..half.count {
        let factor = at.factor(polynomial, stage);
        let factor = if P::INCREMENTS {
            factor
        } else {
            at.size * factor
        };
        for (k, out) in out.as_mut_slice().iter_mut().enumerate() {
            *out += factor * evaluation(stage, k);
        }
    }
}

/// The largest component of the stages and of the base.
#[cfg_attr(not(debug_assertions), inline(always))]
pub(crate) fn scale_of<P: StageTableau, V: Vector<Scalar = f64>>(
    base: &V,
    groups: &[Laned<V, P>],
) -> f64 {
    let components = base.as_slice();
    // Vectors on the heap may be long, so all lanes are used.
    let rows = match mem::needs_drop::<V>() {
        true => components.len() / P::Lanes::WIDTH,
        false => 0,
    };
    let (in_rows, rest) = components.split_at(rows * P::Lanes::WIDTH);
    let mut scale = P::Lanes::from_f64(0.0);
    for row in in_rows.chunks_exact(P::Lanes::WIDTH) {
        scale = scale.larger(P::Lanes::from_fn(|lane| row[lane]).abs());
    }
    for &component in rest {
        scale = scale.larger(P::Lanes::from_f64(component).abs());
    }
    for group in groups {
        for component in group.as_slice() {
            scale = scale.larger(component.abs());
        }
    }
    scale.largest()
}
