//! Coupled stages of a tableau at run time: rows of coefficients instead of straight-line code.

use alloc::sync::Arc;
use alloc::vec::Vec;
use core::fmt::Debug;
use core::marker::PhantomData;

use num_traits::Zero;

use crate::contract::relax::{LinearCombination, relax_by};
use crate::contract::rows::{CoupledRows, HalfRows, MAX_EVALUATIONS, Row};
use crate::contract::storage::{
    first_mismatch, first_non_finite, first_non_finite_of, stored_words,
};
use crate::contract::{
    Class, EvaluationCounts, HalfChange, HalfTableau, Outcome, SecondOrderTableau, StageChange,
    StagePart, StagePlan, StageStorage, StageTableau, StageVisit, Step, StoredEvaluations, System,
    WarmStart,
};
use crate::error::Quantity;
use crate::number::linear_combination::{shortest, sum_of_products, totals_by};
use crate::number::{Coefficient, F64x2, Scalar, Summation, Vector, copy, scale};

/// The coupled stages of a tableau at run time, for systems of class `C`.
#[derive(Clone, Debug)]
pub struct RunTimeRows<C> {
    rows: Arc<CoupledRows>,
    class: PhantomData<C>,
}

impl<C> RunTimeRows<C> {
    pub(super) const fn new(rows: Arc<CoupledRows>) -> Self {
        Self {
            rows,
            class: PhantomData,
        }
    }
}

/// Coupled stages one by one: one vector for each stage value and evaluation. Evaluations are stored as increments.
#[derive(Clone, Debug)]
pub struct RunTimeStages<V> {
    rows: Arc<CoupledRows>,
    q: Vec<V>,
    p: Vec<V>,
    velocity: Vec<V>,
    force: Vec<V>,
}

impl<V: Vector> RunTimeStages<V> {
    fn new(rows: Arc<CoupledRows>, prototype: &V) -> Self {
        let zeros = |count: usize| (0..count).map(|_| prototype.zeros_like()).collect();
        let (positions, momenta) = (rows.positions.rows.len(), rows.momenta.rows.len());
        Self {
            q: zeros(positions),
            p: zeros(momenta),
            velocity: zeros(momenta),
            force: zeros(positions),
            rows,
        }
    }
}

impl<V: Vector> StageStorage<V> for RunTimeStages<V> {
    /// Without rows there are no stages.
    fn like(prototype: &V) -> Self {
        Self::new(Arc::default(), prototype)
    }

    fn anew(&self, prototype: &V) -> Self {
        Self::new(self.rows.clone(), prototype)
    }

    fn rows(&self) -> Option<&Arc<CoupledRows>> {
        Some(&self.rows)
    }

    stored_words! { q: vectors; p: vectors; velocity: vectors; force: vectors; }

    fn stages(&mut self, visit: &mut StageVisit<'_>) {
        let parts = [
            (StagePart::Positions, &mut self.q),
            (StagePart::Momenta, &mut self.p),
            (StagePart::Velocities, &mut self.velocity),
            (StagePart::Forces, &mut self.force),
        ];
        for (part, vectors) in parts {
            for (stage, vector) in vectors.iter_mut().enumerate() {
                let numbers = V::Scalar::doubles_mut(vector.as_mut_slice());
                for (component, number) in numbers.unwrap_or(&mut []).iter_mut().enumerate() {
                    visit(part, stage, component, number);
                }
            }
        }
    }

    fn non_finite(&self) -> Option<(Quantity, usize)> {
        first_non_finite((&self.q, &self.force), (&self.p, &self.velocity))
    }

    fn non_finite_force(&self) -> Option<usize> {
        first_non_finite_of(&self.force)
    }

    #[inline]
    fn mismatch(&self, dimension: usize) -> Option<(Quantity, usize, usize)> {
        first_mismatch(&self.force, &self.velocity, dimension)
    }
}

/// Nothing is allocated in a step.
impl<C: Class> StagePlan for RunTimeRows<C> {
    type Class = C;
    type Stages<V: Vector> = RunTimeStages<V>;

    /// See [`evaluations`](StagePlan::evaluations).
    const EVALUATIONS: EvaluationCounts = EvaluationCounts {
        begin: 0,
        start: 0,
        sweep: 0,
        finish: 0,
        carried: 0,
    };

    fn evaluations<V: Vector>(stages: &RunTimeStages<V>) -> EvaluationCounts {
        counts(&stages.rows)
    }

    fn stages<V: Vector>(&self, prototype: &V) -> RunTimeStages<V> {
        RunTimeStages::new(self.rows.clone(), prototype)
    }

    #[inline]
    fn begin<R: Summation, V: Vector, S: System<V, Class = C>>(
        step: &Step<'_, V>,
        system: &S,
        stages: &mut RunTimeStages<V>,
        kept: WarmStart,
    ) {
        let RunTimeStages {
            rows,
            q,
            p,
            velocity,
            force,
        } = stages;
        let rows: &CoupledRows = rows;
        let CoupledRows {
            positions, momenta, ..
        } = rows;
        if kept.stages && !momenta.extrapolation.is_empty() {
            transform(velocity, &momenta.extrapolation);
        } else {
            CoupledStep { step, system, rows }.start(velocity);
        }
        let mut ignored = HalfChange::default();
        for (row, q) in positions.rows.iter().zip(q) {
            relax::<R, V>(q, (step.q, step.q_low), row, velocity, &mut ignored);
        }
        if kept.stages && !positions.extrapolation.is_empty() {
            transform(force, &positions.extrapolation);
            for (row, p) in momenta.rows.iter().zip(p) {
                relax::<R, V>(p, (step.p, step.p_low), row, force, &mut ignored);
            }
        } else {
            p.iter_mut().for_each(|p| copy(p, step.p));
        }
    }

    #[inline]
    fn sweep<R: Summation, V: Vector, S: System<V, Class = C>>(
        step: &Step<'_, V>,
        system: &S,
        stages: &mut RunTimeStages<V>,
    ) -> StageChange {
        let mut change = StageChange::default();
        let RunTimeStages {
            rows,
            q,
            p,
            velocity,
            force,
        } = stages;
        let rows: &CoupledRows = rows;
        let common = CoupledStep { step, system, rows };
        common.forces(q, p, force);
        for (row, p) in rows.momenta.rows.iter().zip(&mut *p) {
            relax::<R, V>(p, (step.p, step.p_low), row, force, &mut change.p);
        }
        common.velocities(q, p, velocity);
        for (row, q) in rows.positions.rows.iter().zip(q) {
            relax::<R, V>(q, (step.q, step.q_low), row, velocity, &mut change.q);
        }
        change
    }

    #[inline]
    fn finish<R: Summation, V: Vector, S: System<V, Class = C>>(
        step: &Step<'_, V>,
        system: &S,
        stages: &mut RunTimeStages<V>,
        _kept: WarmStart,
        outcome: Outcome<'_, V>,
    ) {
        let rows = &stages.rows;
        CoupledStep { step, system, rows }.totals::<R>(&stages.velocity, &stages.force, outcome);
    }
}

/// The constants are empty: see [`StageTableau::AT_RUN_TIME`].
impl<C: Class> StageTableau for RunTimeRows<C> {
    type Lanes = F64x2;
    type Groups<T: Debug> = [T; 0];

    const AT_RUN_TIME: bool = true;
    const INCREMENTS: bool = true;
    const POSITIONS: HalfTableau = HalfTableau::NONE;
    const MOMENTA: HalfTableau = HalfTableau::NONE;
    const SECOND_ORDER: Option<SecondOrderTableau> = None;

    fn rows(&self) -> Option<&Arc<CoupledRows>> {
        Some(&self.rows)
    }

    fn groups<T: Debug>(_make: impl FnMut(usize) -> T) -> [T; 0] {
        []
    }

    fn stored<V: Vector>(stages: &RunTimeStages<V>) -> [StoredEvaluations<'_, V>; 2] {
        [&stages.velocity, &stages.force].map(|values| StoredEvaluations {
            values,
            carried: &[],
        })
    }
}

/// A step whose stages depend on each other. Velocities and forces are stored as increments: multiplied by the step size and their weights.
pub(crate) struct CoupledStep<'a, V, S> {
    pub(crate) step: &'a Step<'a, V>,
    pub(crate) system: &'a S,
    pub(crate) rows: &'a CoupledRows,
}

impl<V: Vector, S: System<V>> CoupledStep<'_, V, S> {
    /// Sets all velocities to that at the start of the step.
    #[cfg_attr(not(debug_assertions), inline(always))]
    pub(crate) fn start(&self, velocities: &mut [V]) {
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
    pub(crate) fn forces(&self, q: &[V], p: &[V], forces: &mut [V]) {
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
    pub(crate) fn velocities(&self, q: &[V], p: &[V], velocities: &mut [V]) {
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
    pub(crate) fn totals<R: Summation>(
        &self,
        velocity: &[V],
        force: &[V],
        outcome: Outcome<'_, V>,
    ) {
        let step = self.step;
        let CoupledRows {
            positions, momenta, ..
        } = self.rows;
        let Outcome { q, q_low, p, p_low } = outcome;
        total::<R, V>((q, q_low), (step.q, step.q_low), momenta, velocity);
        total::<R, V>((p, p_low), (step.p, step.p_low), positions, force);
    }
}

/// The evaluations of a step.
pub(crate) fn counts(rows: &CoupledRows) -> EvaluationCounts {
    let CoupledRows {
        positions, momenta, ..
    } = rows;
    let always = momenta.extrapolation.is_empty();
    EvaluationCounts {
        begin: u32::from(always),
        start: u32::from(!always),
        sweep: (positions.evaluations.len() + momenta.evaluations.len()) as u32,
        finish: 0,
        carried: 0,
    }
}

/// Scales the evaluations of a half to increments.
#[cfg_attr(not(debug_assertions), inline(always))]
fn increments<V: Vector>(half: &HalfRows, size: f64, evaluations: &mut [V]) {
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
    half: &HalfRows,
    increments: &[V],
) {
    let n = shortest([&*out.0, &*out.1, base.0, base.1]).min(shortest(increments));
    let terms = &half.counting;
    totals_by::<R, V>(out, base, (n, terms.len()), |i: usize, j: usize| {
        increments[terms[j]].as_slice()[i]
    });
}

/// `vectors_i = Σ_j matrix_ij vectors_j`, for at most [`MAX_EVALUATIONS`] vectors.
fn transform<V: Vector>(vectors: &mut [V], matrix: &[Vec<f64>]) {
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
