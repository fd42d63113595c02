//! Second-order systems (Nyström form): coupled stages with the momenta eliminated.

mod stages;

use core::marker::PhantomData;

pub use self::stages::NystromStages;
use crate::contract::tableau::{Columns, eliminates};
use crate::contract::{
    EvaluationCounts, Failure, Inside, Outcome, SecondOrderTableau, Solver, StageTableau, Step,
    StepStatistics, Stopping, System, SystemInLanes, SystemLanes, WarmStart,
};
use crate::error::Quantity;
use crate::number::lanes::{lane_of, lanes};
use crate::number::linear_combination::sum_of_products;
use crate::number::summation::add;
use crate::number::{Lanes, Plain, Scalar, Summation, Vector};
use crate::solver::SimdFixedPoint;
use crate::solver::convergence::{Sweeps, settle};
use crate::solver::predictor::{StartingColumns, starting_columns, starts_at_once, weighted};
use crate::solver::stages_in_lanes::change::LaneMovement;
use crate::solver::stages_in_lanes::stages::{Laned, SimdStages};
use crate::solver::stages_in_lanes::sums::{
    self, StageValue, Sums, entry, extrapolate, scale_of, shortest, total, values,
};
use crate::solver::stages_in_lanes::sweeps::{ByLanes, take};

/// Takes a step of a second-order system `q'' = M⁻¹ f(t, q)`, whose velocity `M⁻¹ p` is linear in the momentum. Only the positions are
/// iterated, with the coefficients of a [`SecondOrderTableau`]. Methods without such coefficients, and systems that are not
/// separable, are solved as by [`SimdFixedPoint`].
#[cfg_attr(not(debug_assertions), inline(always))]
pub(crate) fn nystrom<P, R, V, S>(
    step: &Step<'_, V>,
    system: &S,
    memory: &mut NystromStages<V, P>,
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
    let NystromStages {
        lanes,
        start,
        of_increments,
        eliminated,
    } = memory;
    if !eliminates::<P>() {
        return take::<P, R, V, S, false>(step, system, lanes, kept, stopping, outcome);
    }
    *eliminated = true;
    *of_increments = R::COMPENSATED;
    if !<S as System<V>>::MASSES.are_unit() {
        velocity::<P, V, S>(system, step, step.p, start, lanes);
    }
    let start = start_of::<V, S>(step.p, start);
    let mut sweeps = Positions::<P, R, V, S> {
        lanes: ByLanes {
            step,
            system,
            stages: &mut *lanes,
            sums: PhantomData,
        },
        start,
    };
    let mut work = settle::<P::Class, f64, _>(&mut sweeps, kept, stopping)?;
    // With unit masses, the velocity of the low part of the momentum is counted, like all velocities, but not computed.
    work.evaluations += sweeps.evaluations().finish;
    if R::COMPENSATED {
        compensated_result::<P, R, V, S>(step, system, start, lanes, outcome);
    } else {
        plain_result::<P, V, S>(step, start, lanes, outcome);
    }
    Ok(work)
}

/// With compensated sums, from increments.
#[cfg_attr(not(debug_assertions), inline(always))]
fn compensated_result<P, R, V, S>(
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
            (1.0 - tableau::<P>().nodes[stage], lane_of(slope, stage))
        });
        let parts = [sum, start[k]];
        (q[k], q_low[k]) = add::<R, f64>(base[k], low[k] + h * q[k], 2, |part| h * parts[part]);
    }
}

/// With plain sums, from forces that are not yet scaled to increments. All forces of a component are multiplied by their weights
/// before lanes are read one by one.
#[cfg_attr(not(debug_assertions), inline(always))]
fn plain_result<P, V, S>(
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
    let (mut weights, mut rests) = (P::groups(|_| h), P::groups(|_| h));
    let (weights, rests) = (weights.as_mut(), rests.as_mut());
    for group in 0..weights.len() {
        weights[group] = lanes::<P::Lanes>(P::POSITIONS.weights, group) * h;
        let rest = P::Lanes::from_f64(1.0) - lanes(tableau::<P>().nodes, group);
        rests[group] = rest * weights[group];
    }
    let (q, p) = (&mut q.as_mut_slice()[..n], &mut p.as_mut_slice()[..n]);
    let (q_base, p_base) = (&step.q.as_slice()[..n], &step.p.as_slice()[..n]);
    let start = &start.as_slice()[..n];
    for k in 0..n {
        p[k] = weighted_sum::<P, V>(p_base[k], forces, weights, k);
    }
    for k in 0..n {
        let mean = weighted_sum::<P, V>(start[k], slopes, rests, k);
        q[k] = step.size.fused(mean, q_base[k]);
    }
}

/// `base + Σ_j factor_j term_j` in component k.
#[cfg_attr(not(debug_assertions), inline(always))]
fn weighted_sum<P: StageTableau, V: Vector>(
    base: f64,
    terms: &[Laned<V, P>],
    factors: &[P::Lanes],
    k: usize,
) -> f64 {
    let mut products = P::groups(|group| factors[group]);
    for (group, product) in products.as_mut().iter_mut().enumerate() {
        *product *= terms[group].as_slice()[k];
    }
    let products = products.as_ref();
    let term = |stage: usize| lane_of(products[stage / P::Lanes::WIDTH], stage);
    add::<Plain, f64>(base, 0.0, P::POSITIONS.count, term).0
}

/// [`Solver::extend`] for the stages that [`nystrom`], or another solver in its place, has left.
pub(crate) fn extend<P, V, S>(memory: &NystromStages<V, P>, at: Inside<'_, V>, q: &mut V, p: &mut V)
where
    P: StageTableau,
    V: Vector<Scalar = f64>,
    S: SystemInLanes<V>,
{
    let stages = &memory.lanes;
    if !memory.eliminated {
        return <SimdFixedPoint as Solver<V, S>>::extend::<P>(stages, at, q, p);
    }
    // The factor that scales a stored force or slope to an increment.
    let factor = |stage: usize| match memory.of_increments {
        true => 1.0,
        false => P::POSITIONS.weights[stage] * at.size,
    };
    let force =
        |stage: usize, k: usize| entry::<P, V>(stages.force.as_ref(), stage, k) * factor(stage);
    sums::extend::<P, V>(&P::POSITIONS, at, force, p);
    let Some(polynomial) = P::MOMENTA.polynomial else {
        return;
    };
    let slope = |stage: usize, k: usize| match <S as System<V>>::MASSES.are_unit() {
        true => force(stage, k),
        false => entry::<P, V>(stages.velocity.as_ref(), stage, k) * factor(stage),
    };
    let start = start_of::<V, S>(at.momentum, &memory.start).as_slice();
    // The velocities at the stages: M⁻¹(p0 + Σ_j μ̃_ij w_j).
    for stage in 0..P::MOMENTA.count {
        let factor = at.size * P::MOMENTA.weights[stage] * at.factor(polynomial, stage);
        for (k, out) in q.as_mut_slice().iter_mut().enumerate() {
            let part = |j: usize| P::MOMENTA.columns[j][stage] * slope(j, k);
            let sum: f64 = (0..P::POSITIONS.count).map(part).sum();
            *out += factor * (start[k] + sum);
        }
    }
}

/// The velocity of a momentum. If its dimension is wrong, it is stored where the validation of the step finds it.
#[cfg_attr(not(debug_assertions), inline(always))]
fn velocity<P, V, S>(
    system: &S,
    step: &Step<'_, V>,
    momentum: &V,
    out: &mut V,
    stages: &mut SimdStages<V, P>,
) where
    P: StageTableau,
    V: Vector<Scalar = f64>,
    S: System<V>,
{
    system.velocity(step.time, step.q, momentum, out);
    if out.dimension() != step.q.dimension() {
        stages.velocity.as_mut()[0] = out.zeros_with::<P::Lanes>();
        *out = step.q.zeros_like();
    }
}

/// The stages, reduced to their positions. The places of the velocities hold `M⁻¹` times the increments of the momentum.
///
/// With plain sums, forces are not scaled to increments during the iteration; the matrix contains the weights
/// instead. This saves one product per sweep.
struct Positions<'a, P: StageTableau, R, V: Vector, S> {
    lanes: ByLanes<'a, P, R, V, S, false>,
    /// The velocity at the start of the step.
    start: &'a V,
}

/// `M⁻¹` times the increments of the momentum; with unit masses, the increments themselves.
#[cfg_attr(not(debug_assertions), inline(always))]
const fn slopes<'a, V: Vector, S: System<V>, G>(velocity: &'a G, force: &'a G) -> &'a G {
    if S::MASSES.are_unit() {
        force
    } else {
        velocity
    }
}

/// The velocity at the start of the step; with unit masses, the momentum.
#[cfg_attr(not(debug_assertions), inline(always))]
const fn start_of<'a, V: Vector, S: System<V>>(momentum: &'a V, velocity: &'a V) -> &'a V {
    if S::MASSES.are_unit() {
        momentum
    } else {
        velocity
    }
}

/// The position of stages: `base + low + size node velocity + factor sum`. `low` is the low part of the base, `velocity` that at the
/// start of the step, and `node` the stage's fraction of the step.
#[cfg_attr(not(debug_assertions), inline(always))]
pub fn position<R: Summation, L: Lanes>(
    (base, low): (L, L),
    (size, node): (f64, L),
    velocity: L,
    (factor, sum): (f64, L),
) -> L {
    let (h, factor) = (L::from_f64(size), L::from_f64(factor));
    // Everything except the sum is the same in every sweep.
    if R::COMPENSATED {
        // Rounding `h * node` would cause the same relative error in every step, and the energy would drift.
        return base + factor.fused(sum, h.fused(node * velocity, low));
    }
    factor.fused(sum, (h * node).fused(velocity, base))
}

/// [`position`] as a [`StageValue`].
struct Position<'a, P, R> {
    size: f64,
    factor: f64,
    velocity: &'a [f64],
    method: PhantomData<(P, R)>,
}

impl<P: StageTableau, R: Summation> StageValue<P::Lanes> for Position<'_, P, R> {
    #[cfg_attr(not(debug_assertions), inline(always))]
    fn of(
        &self,
        (group, k): (usize, usize),
        base: (P::Lanes, P::Lanes),
        sum: P::Lanes,
    ) -> P::Lanes {
        let velocity = P::Lanes::from_f64(self.velocity[k]);
        let node = lanes(tableau::<P>().nodes, group);
        position::<R, P::Lanes>(base, (self.size, node), velocity, (self.factor, sum))
    }
}

/// The coefficients of a method that [`eliminates`] the momenta. They are constants, so that the compiler unrolls sums over stages.
#[cfg_attr(not(debug_assertions), inline(always))]
pub const fn tableau<P: StageTableau>() -> SecondOrderTableau {
    match P::SECOND_ORDER {
        Some(tableau) => tableau,
        None => SecondOrderTableau {
            nodes: &[],
            columns: &[],
            of_forces: &[],
        },
    }
}

/// The matrix `ν E`, which gives starting values from the previous step.
pub struct Start<P>(PhantomData<P>);

impl<P: StageTableau> Start<P> {
    /// As factors of increments.
    pub const OF_INCREMENTS: &'static StartingColumns =
        &starting_columns(tableau::<P>().columns, &P::POSITIONS);
    /// As factors of forces.
    pub const OF_FORCES: &'static StartingColumns =
        &weighted(Self::OF_INCREMENTS, P::POSITIONS.weights);
}

impl<P, R, V, S> Positions<'_, P, R, V, S>
where
    P: StageTableau,
    R: Summation,
    V: Vector<Scalar = f64>,
    S: SystemInLanes<V>,
{
    /// Computes new positions; returns their change.
    #[cfg_attr(not(debug_assertions), inline(always))]
    fn positions(&mut self) -> P::Lanes {
        let h = self.lanes.step.size;
        match R::COMPENSATED {
            true => self.with(Columns::<P>::SECOND_ORDER, h, false),
            // Multiplied into the columns, the factor is computed once for all sweeps.
            false => self.with(Columns::<P>::OF_FORCES, h * h, true),
        }
    }

    /// Predicts the positions from the increments or forces of the previous step.
    #[cfg_attr(not(debug_assertions), inline(always))]
    fn predict(&mut self) {
        let count = P::POSITIONS.extrapolation.len();
        let h = self.lanes.step.size;
        match R::COMPENSATED {
            true => self.with(&Start::<P>::OF_INCREMENTS[..count], h, false),
            false => self.with(&Start::<P>::OF_FORCES[..count], h * h, false),
        };
    }

    /// Computes the positions with the terms `factor Σ_j columns_j slope_j`; the factor may be multiplied into the columns. Returns their
    /// change.
    #[cfg_attr(not(debug_assertions), inline(always))]
    fn with(
        &mut self,
        columns: &'static [impl AsRef<[f64]>],
        factor: f64,
        in_columns: bool,
    ) -> P::Lanes {
        let (in_columns, before) = match in_columns {
            true => (Some(factor), 1.0),
            false => (None, factor),
        };
        let sums = Sums {
            count: columns.len(),
            column: |j: usize| columns[j].as_ref(),
            factor: |_| in_columns,
            with_low: false,
            overrelaxed: false,
        };
        let (step, stages) = (self.lanes.step, &mut *self.lanes.stages);
        let start = self.start.as_slice();
        let value = Position::<P, R> {
            size: step.size,
            factor: before,
            velocity: start,
            method: PhantomData,
        };
        let base = (step.q, step.q_low);
        let slopes = slopes::<V, S, _>(&stages.velocity, &stages.force);
        values::<P, V>(&sums, stages.q.as_mut(), base, slopes.as_ref(), value)
    }

    /// Computes `M⁻¹` times the increments of the momentum, except with unit masses.
    #[cfg_attr(not(debug_assertions), inline(always))]
    fn velocities(&mut self) {
        if <S as System<V>>::MASSES.are_unit() {
            return;
        }
        let SimdStages {
            q, velocity, force, ..
        } = &mut *self.lanes.stages;
        let (q, force) = (q.as_ref(), force.as_ref());
        for (group, velocity) in velocity.as_mut().iter_mut().enumerate() {
            let time = P::Lanes::from_f64(self.lanes.step.time);
            let (q, force) = (&q[group], &force[group]);
            // A force of a wrong dimension is not passed to the system; the validation of the step finds it.
            if force.dimension() == velocity.dimension() {
                P::Lanes::velocity::<V, S>(self.lanes.system, time, q, force, velocity);
            }
        }
    }
}

impl<P, R, V, S> Sweeps for Positions<'_, P, R, V, S>
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
        let stages = P::POSITIONS.count as u32;
        // The velocities of the predicted increments, unless the predictor gives positions directly.
        let (begin, start) = if starts_at_once(&P::POSITIONS) {
            (0, stages)
        } else {
            (stages, 0)
        };
        EvaluationCounts {
            begin: begin + 1,
            start,
            sweep: 2 * stages,
            finish: u32::from(R::COMPENSATED),
            carried: 0,
        }
    }

    #[cfg_attr(not(debug_assertions), inline(always))]
    fn time(&self) -> f64 {
        self.lanes.time()
    }

    #[cfg_attr(not(debug_assertions), inline(always))]
    fn begin(&mut self, kept: WarmStart) {
        if kept.stages && starts_at_once(&P::POSITIONS) {
            return self.predict();
        }
        if kept.stages && !P::POSITIONS.extrapolation.is_empty() {
            if !R::COMPENSATED {
                self.lanes.scale_forces();
            }
            extrapolate::<P, V>(&P::POSITIONS, self.lanes.stages.force.as_mut());
        } else {
            for group in self.lanes.stages.force.as_mut() {
                for component in group.as_mut_slice() {
                    *component = P::Lanes::from_f64(0.0);
                }
            }
        }
        self.velocities();
        self.with(Columns::<P>::SECOND_ORDER, self.lanes.step.size, false);
    }

    #[cfg_attr(not(debug_assertions), inline(always))]
    fn non_finite(&self) -> Option<(Quantity, usize)> {
        self.lanes.non_finite()
    }

    #[cfg_attr(not(debug_assertions), inline(always))]
    fn non_finite_force(&self) -> Option<usize> {
        self.lanes.non_finite_force()
    }

    #[cfg_attr(not(debug_assertions), inline(always))]
    fn sweep(&mut self) -> LaneMovement<P::Lanes> {
        self.lanes.forces();
        if R::COMPENSATED {
            self.lanes.scale_forces();
        }
        self.velocities();
        let q = self.positions();
        // The change of the positions is used for the momenta, too.
        LaneMovement { q, p: q }
    }

    #[cfg_attr(not(debug_assertions), inline(always))]
    fn scales(&self, _movement: &Self::Movement) -> [f64; 2] {
        let q = scale_of::<P, V>(self.lanes.step.q, self.lanes.stages.q.as_ref());
        [q, q]
    }
}
