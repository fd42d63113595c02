//! The stages of a step in Lagrangian form.

use alloc::vec;
use alloc::vec::Vec;

use num_traits::Float;

use super::coefficients::StageCoefficients;
use super::derivatives::Derivatives;
use crate::variational::failure::Failure;
use crate::variational::regular::{Factors, Singular, largest};
use crate::variational::stages::StageOfStep;
use symplectic_core::inside::words;
use symplectic_core::solver::{Visit, Words};
use symplectic_core::system::Lagrangian;
use symplectic_core::{Error, Vector};

/// The unknown velocities of a step, and quantities computed from them. Each list consists of vectors one after the other.
#[derive(Clone)]
pub(super) struct Stages<L: Lagrangian> {
    coefficients: StageCoefficients,
    pub(super) kept: Kept,
    /// `P'_i`.
    rates: Vec<f64>,
    /// `L_i`.
    values: Vec<f64>,
    /// Position and velocity at a stage.
    q: Vec<f64>,
    v: Vec<f64>,
    residual: Vec<f64>,
    /// The sizes of the terms of the residual.
    terms: Vec<f64>,
    change: Vec<f64>,
    matrix: Vec<f64>,
    derivatives: Derivatives<L>,
}

/// What is kept from step to step.
#[derive(Clone)]
pub struct Kept {
    /// The unknowns `V_k`.
    unknowns: Vec<f64>,
    /// The unknowns of the last successful step.
    before: Vec<f64>,
    /// The unknowns of a new integrator.
    first: Vec<f64>,
    factors: Factors,
    /// The step size of the present factors; `None` if there are none.
    factored: Option<f64>,
}

impl Kept {
    /// Begins with the unknowns of the last step of a run.
    pub(super) fn begin_with_those_of(&mut self, run: &Self) {
        self.unknowns.copy_from_slice(&run.before);
        self.before.copy_from_slice(&run.before);
        self.factored = None;
    }
}

impl Words for Kept {
    fn words(&mut self, visit: &mut Visit<'_>) {
        words!(visit: self.unknowns[..], self.before[..], self.first[..], self.factors, self.factored);
    }
}

/// The start of a step.
#[derive(Clone, Copy)]
pub(super) struct Start<'a> {
    pub(super) time: f64,
    pub(super) size: f64,
    pub(super) q: &'a [f64],
    pub(super) p: &'a [f64],
}

/// Maximum number of Newton iterations.
const MAX_ITERATIONS: u32 = 60;
/// Maximum number of halvings of a change that leads to a point where L is not finite.
const MAX_HALVINGS: u32 = 60;
/// A matrix is kept while the changes decrease by at least this factor.
const CONTRACTION: f64 = 0.1;
/// Changes below this, relative to the velocities, are rounding errors.
const ROUNDING: f64 = 4.0 * f64::EPSILON;
/// Changes that no longer decrease are accepted below these bounds, for a kept matrix and for a new one. With a new matrix the
/// iteration otherwise converges quadratically.
const STATIONARY: [f64; 2] = [1e-13, 1e-9];

impl<L: Lagrangian> Stages<L> {
    /// Memory for vectors of `n` components.
    pub(super) fn new(coefficients: StageCoefficients, n: usize) -> Result<Self, Error> {
        let (stages, unknowns) = (coefficients.stages(), coefficients.unknowns());
        let size = unknowns * n;
        Ok(Self {
            kept: Kept {
                unknowns: vec![0.0; size],
                before: vec![0.0; size],
                first: vec![0.0; size],
                factors: Factors::new(size),
                factored: None,
            },
            rates: vec![0.0; stages * n],
            values: vec![0.0; stages],
            q: vec![0.0; n],
            v: vec![0.0; n],
            residual: vec![0.0; size],
            terms: vec![0.0; size],
            change: vec![0.0; size],
            matrix: vec![0.0; size * size],
            derivatives: Derivatives::new(n)?,
            coefficients,
        })
    }

    /// Begins with this velocity at every stage.
    pub(super) fn begin_with(&mut self, velocity: &[f64]) {
        self.set_unknowns(velocity);
        self.kept.first.copy_from_slice(&self.kept.unknowns);
        self.forget();
    }

    /// The same velocity at every stage.
    fn set_unknowns(&mut self, velocity: &[f64]) {
        let unknowns = self.kept.unknowns.chunks_exact_mut(velocity.len().max(1));
        for (unknowns, factor) in unknowns.zip(&self.coefficients.constant) {
            for (unknown, component) in unknowns.iter_mut().zip(velocity) {
                *unknown = factor * component;
            }
        }
    }

    /// Starts like a new integrator, without the stages and factors of earlier steps.
    pub(super) fn forget(&mut self) {
        self.kept.before.copy_from_slice(&self.kept.first);
        self.kept.unknowns.copy_from_slice(&self.kept.first);
        self.kept.factored = None;
    }

    /// Whether the next step starts like that of a new integrator.
    pub(super) fn are_new(&self) -> bool {
        self.kept.factored.is_none() && self.kept.unknowns == self.kept.first
    }

    /// Lets the next step start like that of a new integrator: with this velocity at every stage, unless a new one begins at rest.
    pub(super) fn begin_as_first(&mut self, velocity: impl FnOnce() -> Option<L::Vector<f64>>) {
        self.kept.factored = None;
        self.kept.unknowns.copy_from_slice(&self.kept.first);
        if self.kept.first.iter().any(|&component| component != 0.0)
            && let Some(velocity) = velocity()
        {
            self.set_unknowns(velocity.as_slice());
        }
    }

    /// Adds `(q1 − q0)/h` of the last step to `out`.
    pub(super) fn add_mean_velocity(&self, out: &mut [f64]) {
        add_combination(out, &self.coefficients.end, &self.kept.before);
    }

    /// Whether there are fewer unknowns than stages.
    pub(super) fn is_rectangular(&self) -> bool {
        self.coefficients.unknowns() < self.coefficients.stages()
    }

    /// Identifies a Lagrangian, at a position with the mean velocity of the last step.
    pub(super) fn fingerprint(
        &mut self,
        lagrangian: &L,
        time: f64,
        q: &L::Vector<f64>,
    ) -> Vec<f64> {
        let mut mean = q.zeros_like();
        self.add_mean_velocity(mean.as_mut_slice());
        self.derivatives.fingerprint(lagrangian, time, q, &mean)
    }

    /// Takes a step, and writes its end. A step that fails leaves the unknowns unchanged.
    pub(super) fn take(
        &mut self,
        lagrangian: &L,
        start: Start<'_>,
        q1: &mut [f64],
        p1: &mut [f64],
    ) -> Result<(), Failure> {
        let outcome = self.try_to_take(lagrangian, start, q1, p1);
        match outcome {
            Ok(()) => self.kept.before.copy_from_slice(&self.kept.unknowns),
            Err(_) => self.kept.unknowns.copy_from_slice(&self.kept.before),
        }
        outcome
    }

    fn try_to_take(
        &mut self,
        lagrangian: &L,
        start: Start<'_>,
        q1: &mut [f64],
        p1: &mut [f64],
    ) -> Result<(), Failure> {
        self.find(lagrangian, start)?;
        self.end(start, q1, p1);
        let mut numbers = q1.iter().chain(p1.iter());
        if numbers.all(|number| number.is_finite()) {
            Ok(())
        } else {
            Err(Failure::NonFinite { stage: None })
        }
    }

    /// Finds the stages by Newton's iteration from the unknowns of the previous step, extrapolated if that step had the same size. If
    /// something is not finite there, starts from fractions of these. The factors are kept from step to step while they contract well.
    fn find(&mut self, lagrangian: &L, start: Start<'_>) -> Result<(), Failure> {
        let (mut fresh, mut last) = (self.kept.factored.take() != Some(start.size), f64::INFINITY);
        if !fresh {
            let unknowns = self.kept.unknowns.chunks_exact_mut(start.q.len().max(1));
            for (unknowns, row) in unknowns.zip(&self.coefficients.next) {
                unknowns.fill(0.0);
                add_combination(unknowns, row, &self.kept.before);
            }
        }
        self.change.copy_from_slice(&self.kept.unknowns);
        fresh |= !self.evaluate_on_the_way(lagrangian, start, fresh)?;
        for _ in 0..MAX_ITERATIONS {
            if fresh {
                self.factor(start.q.len())?;
            }
            let change = self
                .kept
                .factors
                .solve(self.residual.iter().map(|entry| -entry));
            self.change.copy_from_slice(change);
            for (unknown, change) in self.kept.unknowns.iter_mut().zip(&self.change) {
                *unknown += change;
            }
            let (changed, size) = (largest(&self.change), largest(&self.kept.unknowns));
            let slow = changed > CONTRACTION * last;
            let stationary = STATIONARY[usize::from(fresh)];
            let done = changed <= ROUNDING * size || (slow && changed <= stationary * size);
            let whole = self.evaluate_on_the_way(lagrangian, start, slow && !done)?;
            if whole && (done || (slow && self.is_solved())) {
                self.kept.factored = Some(start.size);
                return Ok(());
            }
            fresh = slow || !whole;
            last = if whole { changed } else { f64::INFINITY };
        }
        Err(Failure::NotFound {
            residual: last / largest(&self.kept.unknowns),
            iterations: MAX_ITERATIONS,
        })
    }

    /// Whether the residual consists of rounding errors. Needed near rest, where the velocities give no scale for the changes.
    fn is_solved(&self) -> bool {
        let mut rows = self.residual.iter().zip(&self.terms);
        rows.all(|(residual, terms)| Float::abs(*residual) <= ROUNDING * terms)
    }

    fn factor(&mut self, n: usize) -> Result<(), Failure> {
        self.kept.factors.factor(&self.matrix).map_err(|singular| {
            Failure::Singular(Singular {
                component: singular.component % n,
                ..singular
            })
        })
    }

    /// Evaluates at the present unknowns. If something is not finite there, halves the last change, at most `MAX_HALVINGS` times.
    /// Returns whether the whole change was made.
    fn evaluate_on_the_way(
        &mut self,
        lagrangian: &L,
        start: Start<'_>,
        with_matrix: bool,
    ) -> Result<bool, Failure> {
        let mut outcome = self.evaluate(lagrangian, start, with_matrix);
        if outcome.is_ok() {
            return Ok(true);
        }
        for _ in 0..MAX_HALVINGS {
            for (unknown, change) in self.kept.unknowns.iter_mut().zip(&mut self.change) {
                *change *= 0.5;
                *unknown -= *change;
            }
            outcome = self.evaluate(lagrangian, start, true);
            if outcome.is_ok() {
                break;
            }
        }
        outcome.map(|()| false)
    }

    /// Evaluates the stages, the residual of the equations, and with `with_matrix` its derivative with respect to the unknowns.
    fn evaluate(
        &mut self,
        lagrangian: &L,
        start: Start<'_>,
        with_matrix: bool,
    ) -> Result<(), Failure> {
        let n = start.q.len();
        for (row, &factor) in self
            .residual
            .chunks_exact_mut(n.max(1))
            .zip(&self.coefficients.start)
        {
            for (residual, p) in row.iter_mut().zip(start.p) {
                *residual = -factor * p;
            }
        }
        for (terms, residual) in self.terms.iter_mut().zip(&self.residual) {
            *terms = Float::abs(*residual);
        }
        if with_matrix {
            self.matrix.fill(0.0);
        }
        for stage in 0..self.coefficients.stages() {
            self.place(start, stage);
            let time = start.time + self.coefficients.nodes[stage] * start.size;
            if with_matrix {
                self.derivatives.second(lagrangian, time, &self.q, &self.v);
            } else {
                self.derivatives.first(lagrangian, time, &self.q, &self.v);
            }
            if !self.derivatives.is_finite() {
                return Err(self.derivatives.failure(Some(stage + 1)));
            }
            self.values[stage] = self.derivatives.value;
            self.rates[stage * n..][..n].copy_from_slice(&self.derivatives.rate);
            self.add(stage, start.size, with_matrix);
        }
        Ok(())
    }

    /// Position and velocity at a stage.
    fn place(&mut self, start: Start<'_>, stage: usize) {
        self.q.fill(0.0);
        self.v.fill(0.0);
        let rows = [
            (&mut self.q, &self.coefficients.positions[stage]),
            (&mut self.v, &self.coefficients.velocities[stage]),
        ];
        for (out, row) in rows {
            add_combination(out, row, &self.kept.unknowns);
        }
        for (q, q0) in self.q.iter_mut().zip(start.q) {
            *q = q0 + start.size * *q;
        }
    }

    /// Adds the contribution of a stage to the equations.
    fn add(&mut self, stage: usize, h: f64, with_matrix: bool) {
        let (n, size) = (self.q.len(), self.residual.len());
        let (coefficients, at) = (&self.coefficients, &self.derivatives);
        let rows = coefficients.forces.iter().zip(&coefficients.momenta);
        for (k, (of_forces, of_momenta)) in rows.enumerate() {
            let (of_force, of_momentum) = (h * of_forces[stage], of_momenta[stage]);
            for i in 0..n {
                let (force, momentum) = (of_force * at.rate[i], of_momentum * at.momentum[i]);
                self.residual[k * n + i] += force + momentum;
                self.terms[k * n + i] += Float::abs(force) + Float::abs(momentum);
            }
            if !with_matrix || (of_force == 0.0 && of_momentum == 0.0) {
                continue;
            }
            let columns = coefficients.positions[stage]
                .iter()
                .zip(&coefficients.velocities[stage]);
            for (l, (position, &velocity)) in columns.enumerate() {
                let position = h * position;
                for (i, j) in (0..n).flat_map(|i| (0..n).map(move |j| (i, j))) {
                    let entry = i * n + j;
                    let rate = position * at.rate_by_position[entry]
                        + velocity * at.rate_by_velocity[entry];
                    let momentum = position * at.momentum_by_position[entry]
                        + velocity * at.momentum_by_velocity[entry];
                    self.matrix[(k * n + i) * size + l * n + j] +=
                        of_force * rate + of_momentum * momentum;
                }
            }
        }
    }

    /// Writes the end of the step from its stages.
    fn end(&self, start: Start<'_>, q1: &mut [f64], p1: &mut [f64]) {
        let StageCoefficients { end, weights, .. } = &self.coefficients;
        for (out, from, row, vectors) in [
            (q1, start.q, end, &self.kept.unknowns),
            (p1, start.p, weights, &self.rates),
        ] {
            out.fill(0.0);
            add_combination(out, row, vectors);
            for (out, from) in out.iter_mut().zip(from) {
                *out = from + start.size * *out;
            }
        }
    }

    /// The stages of the last step, which had this start.
    pub(super) fn of_step(
        &mut self,
        lagrangian: &L,
        start: Start<'_>,
    ) -> Vec<StageOfStep<L::Vector<f64>>> {
        let stages = (0..self.coefficients.stages()).map(|stage| {
            self.place(start, stage);
            let weight = start.size * self.coefficients.weights[stage];
            let time = start.time + self.coefficients.nodes[stage] * start.size;
            (self.derivatives).stage(lagrangian, (weight, time), &self.q, &self.v)
        });
        stages.collect()
    }

    /// `h Σ_i b_i L_i`, the value of the discrete Lagrangian.
    pub(super) fn action(&self, size: f64) -> f64 {
        let terms = self.coefficients.weights.iter().zip(&self.values);
        size * terms.map(|(weight, value)| weight * value).sum::<f64>()
    }
}

/// Adds `Σ_k row_k vector_k` to `out`.
fn add_combination(out: &mut [f64], row: &[f64], vectors: &[f64]) {
    for (factor, vector) in row.iter().zip(vectors.chunks_exact(out.len().max(1))) {
        for (out, component) in out.iter_mut().zip(vector) {
            *out += factor * component;
        }
    }
}
