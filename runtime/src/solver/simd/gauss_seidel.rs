//! Coupled stages side by side in SIMD lanes, with Gauss–Seidel sweeps.

use core::marker::PhantomData;
use core::mem;

use num_traits::Zero;

use crate::error::Quantity;
use crate::method::tableau::Columns;
use crate::method::{
    EvaluationCounts, Failure, HalfTableau, Inside, Outcome, Solver, StageChange, StageStorage,
    StageTableau, Step, StepStatistics, Stopping, WarmStart,
};
use crate::number::lanes::{lane_of, lanes};
use crate::number::linear_combination::sum_of_products;
use crate::number::summation::{Overrelaxed, add, moved};
use crate::number::vector::{LIGHT, is_in_place};
use crate::number::{Lanes, Scalar, Summation, Vector};
use crate::solver::convergence::{Begun, Sweeps, settle, settle_from_cold_start};
use crate::solver::simd::change::{LaneMovement, noted, part_change};
use crate::solver::simd::stages::{Laned, SimdStages};
use crate::system::SystemInLanes;
use crate::system::SystemLanes;
use crate::system::{Class, System};

/// The iteration of [`FixedPoint`](crate::solver::FixedPoint) with the stages side by side in [`Lanes`]: one evaluation of the
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
    let work = settle::<P::Class, f64>(&mut sweeps, kept, stopping)?;
    if !R::COMPENSATED {
        sweeps.increments();
    }
    totals::<R, P, V>(step, stages, outcome);
    Ok(work)
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
        self.stages.non_finite()
    }

    #[cfg_attr(not(debug_assertions), inline(always))]
    fn non_finite_force(&self) -> Option<usize> {
        self.stages.non_finite_force()
    }

    #[cfg_attr(not(debug_assertions), inline(always))]
    fn go_on<C: Class, T: Scalar>(
        &mut self,
        kept: WarmStart,
        stopping: Stopping,
        begun: Begun<Self::Movement>,
    ) -> Result<StepStatistics, Failure> {
        self.elsewhere(begun.is_nothing(), |mut lanes| {
            settle_from_cold_start::<C, T, _>(&mut lanes, kept, stopping, begun)
        })
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
    fn change(&self, movement: &LaneMovement<P::Lanes>) -> StageChange {
        let (step, stages) = (self.step, &*self.stages);
        StageChange {
            q: part_change(movement.q, scale_of::<P, V>(step.q, stages.q.as_ref())),
            p: part_change(movement.p, scale_of::<P, V>(step.p, stages.p.as_ref())),
        }
    }

    #[cfg_attr(not(debug_assertions), inline(always))]
    fn are_about(&self, _movement: &Self::Movement, [q, p]: [f64; 2], both: bool) -> bool {
        let (step, stages) = (self.step, &*self.stages);
        is_about(scale_of::<P, V>(step.q, stages.q.as_ref()), q)
            && (!both || is_about(scale_of::<P, V>(step.p, stages.p.as_ref()), p))
    }
}

/// Whether there are predictor coefficients: for the velocities, and for the forces if the system is not separable.
pub(crate) const fn extrapolates<P: StageTableau>() -> bool {
    !P::MOMENTA.extrapolation.is_empty()
        && (P::Class::SEPARABLE || !P::POSITIONS.extrapolation.is_empty())
}

/// The largest component of the stages and of the base, distributed over the lanes.
#[cfg_attr(not(debug_assertions), inline(always))]
pub(crate) fn scale_of<P: StageTableau, V: Vector<Scalar = f64>>(
    base: &V,
    groups: &[Laned<V, P>],
) -> P::Lanes {
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
    scale
}

/// Returns whether the largest lane equals `other` up to a factor of two.
#[cfg_attr(not(debug_assertions), inline(always))]
pub(crate) fn is_about<L: Lanes>(scale: L, other: f64) -> bool {
    scale.any_above(0.5 * other) && !scale.any_above(2.0 * other)
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

    /// Applies `go_on` to a copy of these stages, unless they are large or on the heap. Stages to which no pointer exists can stay in
    /// registers from step to step. If the iteration begins `anew`, the old positions and momenta are not copied.
    #[cfg_attr(not(debug_assertions), inline(always))]
    pub(crate) fn elsewhere<T>(
        &mut self,
        anew: bool,
        go_on: impl FnOnce(ByLanes<'_, P, R, V, S>) -> T,
    ) -> T {
        let (system, sums) = (self.system, PhantomData);
        if !is_in_place(self.step.q) || size_of::<SimdStages<V, P>>() > LIGHT {
            let (step, stages) = (self.step, &mut *self.stages);
            return go_on(ByLanes {
                step,
                system,
                stages,
                sums,
            });
        }
        let mut stages = self.stages.take(!anew);
        let made = self.step.copied(|step| {
            go_on(ByLanes {
                step,
                system,
                stages: &mut stages,
                sums,
            })
        });
        *self.stages = stages;
        made
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

/// The factors that scale the evaluations of a group to increments.
#[cfg_attr(not(debug_assertions), inline(always))]
pub(crate) fn increment_factor<P: StageTableau>(
    half: &HalfTableau,
    h: f64,
    group: usize,
) -> P::Lanes {
    lanes::<P::Lanes>(half.weights, group) * P::Lanes::from_f64(h)
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
            let factor = increment_factor::<P>(half, h, group);
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
    pub(crate) beyond: bool,
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
        beyond: R::BEYOND,
    }
}

/// Computes new stage values from evaluations; returns their change. `value` gets the indices of group and component, the base with
/// its low part, and the sum.
#[cfg_attr(not(debug_assertions), inline(always))]
pub(crate) fn values<P: StageTableau, V: Vector<Scalar = f64>>(
    sums: &Sums<impl Fn(usize) -> &'static [f64], impl Fn(usize) -> Option<f64>>,
    out: &mut [Laned<V, P>],
    (base, low): (&V, &V),
    terms: &[Laned<V, P>],
    value: impl Fn((usize, usize), (P::Lanes, P::Lanes), P::Lanes) -> P::Lanes,
) -> P::Lanes {
    let n = shortest(out)
        .min(shortest(terms))
        .min(base.dimension())
        .min(low.dimension());
    let (base, low) = (&base.as_slice()[..n], &low.as_slice()[..n]);
    if mem::needs_drop::<V>() {
        return long_values::<P, V>(sums, out, (base, low), terms, value);
    }
    let mut largest = None;
    for k in 0..n {
        let start = P::Lanes::from_f64(base[k]);
        for (group, out) in out.iter_mut().enumerate() {
            let low = P::Lanes::from_f64(low[k]);
            let with = sums.with_low.then_some(low);
            let sum_of_terms = combination(sums, group, with, |j| entry::<P, V>(terms, j, k));
            let new = value((group, k), (start, low), sum_of_terms);
            let component = &mut out.as_mut_slice()[k];
            let new = moved(sums.beyond, *component, new);
            let change = (new - *component).abs();
            *component = new;
            largest = Some(noted(largest, change));
        }
    }
    largest.unwrap_or_else(P::Lanes::zero)
}

/// [`values`] for vectors on the heap. It looks up the location of their components once; otherwise the compiler would repeat that
/// after every write.
#[cfg_attr(not(debug_assertions), inline(always))]
fn long_values<P: StageTableau, V: Vector<Scalar = f64>>(
    sums: &Sums<impl Fn(usize) -> &'static [f64], impl Fn(usize) -> Option<f64>>,
    out: &mut [Laned<V, P>],
    (base, low): (&[f64], &[f64]),
    terms: &[Laned<V, P>],
    value: impl Fn((usize, usize), (P::Lanes, P::Lanes), P::Lanes) -> P::Lanes,
) -> P::Lanes {
    let n = base.len();
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
        for (group, out) in out.iter_mut().enumerate() {
            let with = sums.with_low.then_some(low);
            let term = |j: usize| lane_of(terms[j / P::Lanes::WIDTH][k], j);
            let sum_of_terms = combination(sums, group, with, term);
            let new = value((group, k), (start, low), sum_of_terms);
            let new = moved(sums.beyond, out[k], new);
            let change = (new - out[k]).abs();
            out[k] = new;
            largest = Some(noted(largest, change));
        }
    }
    largest.unwrap_or_else(P::Lanes::zero)
}

/// `base + sum`, for a sum that includes the low part of the base.
#[cfg_attr(not(debug_assertions), inline(always))]
pub(crate) fn sum<P: StageTableau>(
    _place: (usize, usize),
    (base, _low): (P::Lanes, P::Lanes),
    sum: P::Lanes,
) -> P::Lanes {
    base + sum
}

/// `start + Σ_j factor_j columns_j terms_j` in one component, for the stages of one group; a factor is multiplied into the column.
#[cfg_attr(not(debug_assertions), inline(always))]
pub(crate) fn combination<L: Lanes>(
    sums: &Sums<impl Fn(usize) -> &'static [f64], impl Fn(usize) -> Option<f64>>,
    group: usize,
    start: Option<L>,
    term: impl Fn(usize) -> f64,
) -> L {
    sum_of_products(start, sums.count, |j| {
        let column: L = lanes((sums.column)(j), group);
        let column = match (sums.factor)(j) {
            Some(factor) => column * L::from_f64(factor),
            None => column,
        };
        (column, L::from_f64(term(j)))
    })
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
        beyond: false,
    };
    let mut new = P::groups(|_| P::Lanes::from_f64(0.0));
    for k in 0..n {
        for (group, new) in new.as_mut().iter_mut().enumerate() {
            *new = combination(&sums, group, None, |j| entry::<P, V>(increments, j, k));
        }
        for (group, new) in new.as_ref().iter().enumerate() {
            increments[group].as_mut_slice()[k] = *new;
        }
    }
}

/// Computes one half of the result of a step from the evaluations `terms`.
#[cfg_attr(not(debug_assertions), inline(always))]
pub(crate) fn total<R: Summation, P: StageTableau, V: Vector<Scalar = f64>>(
    (out, out_low): (&mut V, &mut V),
    (base, low): (&V, &V),
    terms: &[Laned<V, P>],
    half: &HalfTableau,
    h: f64,
) {
    let n = shortest(terms).min(base.dimension());
    for k in 0..n {
        let term = |stage: usize| {
            let entry = entry::<P, V>(terms, stage, k);
            if P::INCREMENTS {
                entry
            } else {
                h * half.weights[stage] * entry
            }
        };
        let (base, low) = (base.as_slice()[k], low.as_slice()[k]);
        let (high, rest) = add::<R, f64>(base, low, half.count, term);
        out.as_mut_slice()[k] = high;
        if R::COMPENSATED {
            out_low.as_mut_slice()[k] = rest;
        }
    }
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
