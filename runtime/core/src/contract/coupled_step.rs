//! A step whose stages are coupled by rows of coefficients.

use num_traits::Zero;

use crate::contract::relax::{LinearCombination, relax_by, relax_side_by_side};
use crate::contract::rows::{CoupledRows, HalfRows, MAX_EVALUATIONS};
use crate::contract::{EvaluationCounts, HalfChange, Outcome, Step, System};
use crate::number::linear_combination::{shortest, sum_of_products, totals_by};
use crate::number::{Coefficient, Scalar, Summation, Vector, copy, scale};

/// A step whose stages depend on each other. Velocities and forces are stored as increments: multiplied by the step size and their weights.
pub struct CoupledStep<'a, V, S> {
    /// The step.
    pub step: &'a Step<'a, V>,
    /// The system.
    pub system: &'a S,
    /// The coefficients.
    pub rows: &'a CoupledRows,
}

impl<V: Vector, S: System<V>> CoupledStep<'_, V, S> {
    /// Sets all velocities to that at the start of the step.
    #[cfg_attr(not(debug_assertions), inline(always))]
    pub fn start(&self, velocities: &mut [V]) {
        let (step, half) = (self.step, &self.rows.momenta);
        if let [first, others @ ..] = velocities {
            let time = step.at(Coefficient::exact(half.evaluations[0].time));
            self.system.velocity(time, step.q, step.p, first);
            others.iter_mut().for_each(|other| copy(other, first));
            increments(half, step.size, velocities);
        }
    }

    /// The forces at the stages. In a separable system the momentum is not read, so any vector will do.
    #[cfg_attr(not(debug_assertions), inline(always))]
    pub fn forces(&self, q: &[V], p: &[V], forces: &mut [V]) {
        let (step, half) = (self.step, &self.rows.positions);
        let at = |i: usize| {
            let time = step.at(Coefficient::exact(half.evaluations[i].time));
            (time, &q[i], p.get(i).unwrap_or(step.p))
        };
        self.system.forces(at, forces);
        increments(half, step.size, forces);
    }

    /// The velocities at the stages. In a separable system the position is not read.
    #[cfg_attr(not(debug_assertions), inline(always))]
    pub fn velocities(&self, q: &[V], p: &[V], velocities: &mut [V]) {
        let (step, half) = (self.step, &self.rows.momenta);
        let at = |i: usize| {
            let time = step.at(Coefficient::exact(half.evaluations[i].time));
            (time, q.get(i).unwrap_or(step.q), &p[i])
        };
        self.system.velocities(at, velocities);
        increments(half, step.size, velocities);
    }

    /// The result of the step.
    #[cfg_attr(not(debug_assertions), inline(always))]
    pub fn totals<R: Summation>(&self, velocity: &[V], force: &[V], outcome: Outcome<'_, V>) {
        let step = self.step;
        let CoupledRows {
            positions, momenta, ..
        } = self.rows;
        let Outcome { q, q_low, p, p_low } = outcome;
        total::<R, V>((q, q_low), (step.q, step.q_low), momenta, velocity);
        total::<R, V>((p, p_low), (step.p, step.p_low), positions, force);
    }
}

impl CoupledRows {
    /// The evaluations of a step.
    pub fn counts(&self) -> EvaluationCounts {
        let Self {
            positions, momenta, ..
        } = self;
        let always = momenta.extrapolation.is_empty();
        EvaluationCounts {
            begin: u32::from(always),
            start: u32::from(!always),
            sweep: (positions.evaluations.len() + momenta.evaluations.len()) as u32,
            finish: 0,
            carried: 0,
        }
    }
}

impl HalfRows {
    /// `out_i = base + low + Σ_j factor_ij increment_j` over each row; records the change of `out` in `change`.
    #[inline]
    pub fn relax<R: Summation, V: Vector>(
        &self,
        out: &mut [V],
        (base, low): (&V, &V),
        increments: &[V],
        change: &mut HalfChange,
    ) {
        if relax_side_by_side::<R, V>(&self.columns, out, (base, low), increments, change) {
            return;
        }
        let increment = |index: usize| increments[index].as_slice();
        for (row, out) in self.rows.iter().zip(out) {
            let lengths = row.iter().map(|&(index, _)| increment(index).len());
            let n = lengths.fold(shortest([&*out, base, low]), usize::min);
            let sum = LinearCombination {
                count: || row.len(),
                factor: |j: usize| V::Scalar::from_f64(row[j].1),
                vector: |j: usize| increment(row[j].0),
            };
            relax_by::<R, V>(out, (base, low), n, sum, change);
        }
    }

    /// Replaces the increments of the previous step, at most [`MAX_EVALUATIONS`], by extrapolated ones.
    pub fn extrapolate<V: Vector>(&self, increments: &mut [V]) {
        let count = increments.len().min(MAX_EVALUATIONS);
        let lengths = increments.iter().map(|vector| vector.as_slice().len());
        let n = lengths.min().unwrap_or(0);
        let mut old = [V::Scalar::zero(); MAX_EVALUATIONS];
        for i in 0..n {
            for (old, vector) in old.iter_mut().zip(&*increments) {
                *old = vector.as_slice()[i];
            }
            for (vector, row) in increments.iter_mut().zip(&self.extrapolation) {
                let product = |j: usize| (V::Scalar::from_f64(row[j]), old[j]);
                vector.as_mut_slice()[i] = sum_of_products(None, count, product);
            }
        }
    }
}

/// Scales the evaluations of a half to increments.
#[cfg_attr(not(debug_assertions), inline(always))]
fn increments<V: Vector>(half: &HalfRows, size: f64, evaluations: &mut [V]) {
    for (vector, evaluation) in evaluations.iter_mut().zip(&half.evaluations) {
        scale(vector, size, Coefficient::exact(evaluation.factor));
    }
}

/// `out = base + low + Σ increments`, over the evaluations that enter the result, with the rounding error of the sum in `out_low`.
#[cfg_attr(not(debug_assertions), inline(always))]
fn total<R: Summation, V: Vector>(
    out: (&mut V, &mut V),
    base: (&V, &V),
    half: &HalfRows,
    increments: &[V],
) {
    let n = shortest([&*out.0, &*out.1, base.0, base.1]).min(shortest(increments));
    let terms = &half.counting;
    totals_by::<R, V>(out, base, (n, terms.len()), |i: usize, j: usize| {
        increments[terms[j]].as_slice()[i]
    });
}
