//! Coupled stages of a tableau that is known only at run time, by fixed-point iteration.

use core::marker::PhantomData;

use num_traits::Zero;

use crate::contract::relax::{LinearCombination, relax_by};
use crate::contract::storage::{first_non_finite, first_non_finite_of};
use crate::contract::{
    Class, EvaluationCounts, Failure, HalfChange, Outcome, StageChange, Step, StepStatistics,
    Stopping, System, WarmStart,
};
use crate::error::Quantity;
use crate::method::RunTimeStages;
use crate::method::run_time::{Coupled, Half, MAX_EVALUATIONS, Row, coupled};
use crate::number::linear_combination::{shortest, sum_of_products, totals_by};
use crate::number::summation::Overrelaxed;
use crate::number::{Coefficient, Scalar, Summation, Vector, copy, scale};
use crate::solver::convergence::{Sweeps, settle};

/// Takes a step whose stages depend on each other: the iteration of [`FixedPoint`](crate::solver::FixedPoint) over rows of
/// coefficients instead of straight-line code. Nothing is allocated.
#[inline]
pub fn by_rows<C: Class, R: Summation, V: Vector, S: System<V, Class = C>>(
    step: &Step<'_, V>,
    system: &S,
    memory: &mut RunTimeStages<V, C>,
    kept: WarmStart,
    stopping: Stopping,
    outcome: Outcome<'_, V>,
) -> Result<StepStatistics, Failure> {
    let RunTimeStages {
        tableau,
        q,
        p,
        velocity,
        force,
        ..
    } = memory;
    let coupled = coupled::<C>(tableau.as_ref());
    let common = &CoupledStep {
        step,
        system,
        coupled,
    };
    let mut sweeps = ByRows::<R, V, S> {
        common,
        q,
        p,
        velocity,
        force,
        sums: PhantomData,
    };
    let work = settle::<C, V::Scalar, _>(&mut sweeps, kept, stopping)?;
    common.totals::<R>(velocity, force, outcome);
    Ok(work)
}

/// A step whose stages depend on each other. Velocities and forces are stored as increments: multiplied by the step size and their weights.
pub(crate) struct CoupledStep<'a, V, S> {
    pub(crate) step: &'a Step<'a, V>,
    pub(crate) system: &'a S,
    pub(crate) coupled: &'a Coupled,
}

impl<V: Vector, S: System<V>> CoupledStep<'_, V, S> {
    /// The evaluations of a step.
    pub(crate) fn counts(&self) -> EvaluationCounts {
        let Coupled {
            positions, momenta, ..
        } = self.coupled;
        let always = momenta.extrapolation.is_empty();
        EvaluationCounts {
            begin: u32::from(always),
            start: u32::from(!always),
            sweep: (positions.evaluations.len() + momenta.evaluations.len()) as u32,
            finish: 0,
            carried: 0,
        }
    }

    /// Sets all velocities to that at the start of the step.
    #[cfg_attr(not(debug_assertions), inline(always))]
    pub(crate) fn start(&self, velocities: &mut [V]) {
        let (step, half) = (self.step, &self.coupled.momenta);
        if let [first, others @ ..] = velocities {
            let time = step.at(Coefficient::exact(half.evaluations[0].time));
            self.system.velocity(time, step.q, step.p, first);
            others.iter_mut().for_each(|other| copy(other, first));
            increments(half, step.size, velocities);
        }
    }

    /// The forces at the stages. In a separable system the momentum is not read, so any vector will do.
    #[cfg_attr(not(debug_assertions), inline(always))]
    pub(crate) fn forces(&self, q: &[V], p: &[V], forces: &mut [V]) {
        let (step, half) = (self.step, &self.coupled.positions);
        let at = |i: usize| {
            let time = step.at(Coefficient::exact(half.evaluations[i].time));
            (time, &q[i], p.get(i).unwrap_or(step.p))
        };
        self.system.forces(at, forces);
        increments(half, step.size, forces);
    }

    /// The velocities at the stages. In a separable system the position is not read.
    #[cfg_attr(not(debug_assertions), inline(always))]
    pub(crate) fn velocities(&self, q: &[V], p: &[V], velocities: &mut [V]) {
        let (step, half) = (self.step, &self.coupled.momenta);
        let at = |i: usize| {
            let time = step.at(Coefficient::exact(half.evaluations[i].time));
            (time, q.get(i).unwrap_or(step.q), &p[i])
        };
        self.system.velocities(at, velocities);
        increments(half, step.size, velocities);
    }

    /// The result of the step.
    #[cfg_attr(not(debug_assertions), inline(always))]
    pub(crate) fn totals<R: Summation>(
        &self,
        velocity: &[V],
        force: &[V],
        outcome: Outcome<'_, V>,
    ) {
        let (
            step,
            Coupled {
                positions, momenta, ..
            },
        ) = (self.step, self.coupled);
        let Outcome { q, q_low, p, p_low } = outcome;
        total::<R, V>((q, q_low), (step.q, step.q_low), momenta, velocity);
        total::<R, V>((p, p_low), (step.p, step.p_low), positions, force);
    }
}

/// The stages of a step.
struct ByRows<'a, R, V, S> {
    common: &'a CoupledStep<'a, V, S>,
    q: &'a mut [V],
    p: &'a mut [V],
    velocity: &'a mut [V],
    force: &'a mut [V],
    sums: PhantomData<R>,
}

impl<R: Summation, V: Vector, S: System<V>> ByRows<'_, R, V, S> {
    fn sweep_by<T: Summation>(&mut self) -> StageChange {
        let mut change = StageChange::default();
        let CoupledStep { step, coupled, .. } = *self.common;
        let Coupled {
            positions, momenta, ..
        } = coupled;
        self.common.forces(self.q, self.p, self.force);
        for (row, p) in momenta.rows.iter().zip(&mut *self.p) {
            relax::<T, V>(p, (step.p, step.p_low), row, self.force, &mut change.p);
        }
        self.common.velocities(self.q, self.p, self.velocity);
        for (row, q) in positions.rows.iter().zip(&mut *self.q) {
            relax::<T, V>(q, (step.q, step.q_low), row, self.velocity, &mut change.q);
        }
        change
    }
}

impl<R: Summation, V: Vector, S: System<V>> Sweeps for ByRows<'_, R, V, S> {
    type Movement = StageChange;

    const STOPS_AT_ROUNDING: bool = !R::COMPENSATED;

    fn evaluations(&self) -> EvaluationCounts {
        self.common.counts()
    }

    fn time(&self) -> f64 {
        self.common.step.time
    }

    fn begin(&mut self, kept: WarmStart) {
        let CoupledStep { step, coupled, .. } = *self.common;
        let Coupled {
            positions, momenta, ..
        } = coupled;
        if kept.stages && !momenta.extrapolation.is_empty() {
            transform(self.velocity, &momenta.extrapolation);
        } else {
            self.common.start(self.velocity);
        }
        let mut ignored = HalfChange::default();
        for (row, q) in positions.rows.iter().zip(&mut *self.q) {
            relax::<R, V>(q, (step.q, step.q_low), row, self.velocity, &mut ignored);
        }
        if kept.stages && !positions.extrapolation.is_empty() {
            transform(self.force, &positions.extrapolation);
            for (row, p) in momenta.rows.iter().zip(&mut *self.p) {
                relax::<R, V>(p, (step.p, step.p_low), row, self.force, &mut ignored);
            }
        } else {
            self.p.iter_mut().for_each(|p| copy(p, step.p));
        }
    }

    fn non_finite(&self) -> Option<(Quantity, usize)> {
        first_non_finite((self.q, self.force), (self.p, self.velocity))
    }

    fn non_finite_force(&self) -> Option<usize> {
        first_non_finite_of(self.force)
    }

    fn sweep(&mut self) -> StageChange {
        self.sweep_by::<R>()
    }

    fn overrelaxed_sweep(&mut self) -> StageChange {
        self.sweep_by::<Overrelaxed<R>>()
    }

    fn scales(&self, movement: &StageChange) -> [f64; 2] {
        movement.scales()
    }
}

/// Scales the evaluations of a half to increments.
#[cfg_attr(not(debug_assertions), inline(always))]
fn increments<V: Vector>(half: &Half, size: f64, evaluations: &mut [V]) {
    for (vector, evaluation) in evaluations.iter_mut().zip(&half.evaluations) {
        scale(vector, size, Coefficient::exact(evaluation.factor));
    }
}

/// `out = base + low + Σ factor increment` over a row; records the change of `out` in `change`.
#[inline]
fn relax<R: Summation, V: Vector>(
    out: &mut V,
    (base, low): (&V, &V),
    row: &Row,
    increments: &[V],
    change: &mut HalfChange,
) {
    let increment = |index: usize| increments[index].as_slice();
    let lengths = row.iter().map(|&(index, _)| increment(index).len());
    let n = lengths.fold(shortest([&*out, base, low]), usize::min);
    let sum = LinearCombination {
        count: || row.len(),
        factor: |j: usize| V::Scalar::from_f64(row[j].1),
        vector: |j: usize| increment(row[j].0),
    };
    relax_by::<R, V>(out, (base, low), n, sum, change);
}

/// `out = base + low + Σ increments`, over the evaluations that enter the result, with the rounding error of the sum in `out_low`.
#[cfg_attr(not(debug_assertions), inline(always))]
fn total<R: Summation, V: Vector>(
    out: (&mut V, &mut V),
    base: (&V, &V),
    half: &Half,
    increments: &[V],
) {
    let n = shortest([&*out.0, &*out.1, base.0, base.1]).min(shortest(increments));
    let terms = &half.counting;
    totals_by::<R, V>(out, base, (n, terms.len()), |i: usize, j: usize| {
        increments[terms[j]].as_slice()[i]
    });
}

/// `vectors_i = Σ_j matrix_ij vectors_j`, for at most [`MAX_EVALUATIONS`] vectors.
fn transform<V: Vector>(vectors: &mut [V], matrix: &[alloc::vec::Vec<f64>]) {
    let count = vectors.len().min(MAX_EVALUATIONS);
    let lengths = vectors.iter().map(|vector| vector.as_slice().len());
    let n = lengths.min().unwrap_or(0);
    let mut old = [V::Scalar::zero(); MAX_EVALUATIONS];
    for i in 0..n {
        for (old, vector) in old.iter_mut().zip(&*vectors) {
            *old = vector.as_slice()[i];
        }
        for (vector, row) in vectors.iter_mut().zip(matrix) {
            let product = |j: usize| (V::Scalar::from_f64(row[j]), old[j]);
            vector.as_mut_slice()[i] = sum_of_products(None, count, product);
        }
    }
}
