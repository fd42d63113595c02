//! The sweeps of a Newton iteration.

use core::marker::PhantomData;

use num_traits::Zero;

use super::coefficients::{HalfCoefficients, StageCoefficients};
use super::convergence::{Attempt, MAX_SWEEPS, size};
use super::every_stage::{EveryStage, NOT_FINITE};
use super::linear_solver::{Coupling, LinearSolver};
use super::memory::{NewtonMemory, Workspace, rows};
use symplectic_core::inside::{first_non_finite_of, totals_by};
use symplectic_core::solver::{Failure, HalfChange, Outcome, StageChange, StageTableau, Step};
use symplectic_core::system::Class;
use symplectic_core::{Quantity, Scalar, Summation, System, Vector};

/// A contraction rate above this makes the derivatives stale for the next step.
const GOOD: f64 = 1.0 / 32.0;

/// Changes of this many units of EPSILON count as rounding errors in the prediction of the number of sweeps.
const ROUNDING: f64 = 16.0;

/// Changes below this many units of EPSILON may be noise; their ratio says nothing about the contraction rate.
const NOISE: f64 = 16384.0;

/// Steps without extrapolated starting values after a step in which they were worse than the start of the step.
const PATIENCE: u32 = 16;

/// The increments of a method; each sweep corrects all of them simultaneously.
pub(super) struct ByIncrements<'a, P, R, V: Vector, S: System<V>, L: LinearSolver<V, S>> {
    step: &'a Step<'a, V>,
    system: &'a S,
    coefficients: &'a StageCoefficients<P>,
    memory: &'a mut Workspace<V, S, L>,
    /// The change in the previous sweep.
    last: f64,
    /// Sweeps made.
    sweeps: u32,
    /// Sweeps since the matrices were factored, or since the start of the step.
    since: u32,
    /// Whether the derivatives are evaluated at every stage, again in every sweep.
    in_full: bool,
    /// Whether the derivatives were recomputed within the step.
    renewed: bool,
    /// Whether the iteration contracts too slowly even with recomputed derivatives.
    slow: bool,
    /// The largest contraction rate of this attempt.
    contraction: f64,
    /// The first change of this attempt, if it began with extrapolated starting values.
    first_change: Option<f64>,
    /// Number of factorisations of the linear systems in this step.
    factorisations: u32,
    sums: PhantomData<R>,
}

impl<'a, P, R, V, S, L> ByIncrements<'a, P, R, V, S, L>
where
    P: StageTableau,
    R: Summation,
    V: Vector,
    S: System<V, Class = P::Class>,
    L: LinearSolver<V, S>,
{
    pub(super) fn new(
        step: &'a Step<'a, V>,
        system: &'a S,
        memory: &'a mut NewtonMemory<V, P, S, L>,
    ) -> Self {
        Self {
            step,
            system,
            coefficients: &memory.coefficients,
            memory: &mut memory.work,
            last: f64::NAN,
            sweeps: 0,
            since: 0,
            in_full: false,
            renewed: false,
            slow: false,
            contraction: 0.0,
            first_change: None,
            factorisations: 0,
            sums: PhantomData,
        }
    }

    /// Evaluations in one sweep.
    pub(super) fn evaluations(&self) -> u32 {
        (self.coefficients.positions().count() + self.coefficients.momenta().count()) as u32
    }

    /// Time at the start of the step.
    pub(super) const fn time(&self) -> f64 {
        self.step.time
    }

    /// Number of further steps that use the derivatives at every stage.
    pub(super) const fn steps_in_full(&mut self) -> &mut u32 {
        &mut self.memory.steps_in_full
    }

    /// Whether the iteration contracts too slowly even with recomputed derivatives at one point.
    pub(super) const fn is_slow(&self) -> bool {
        self.slow
    }

    /// Computes the starting values, and the derivatives there if they are missing, stale or factored for another step size.
    pub(super) fn begin(&mut self, attempt: Attempt) -> Result<(), Failure> {
        let memory = &mut *self.memory;
        (self.last, self.sweeps, self.since) = (f64::NAN, 0, 0);
        (self.in_full, self.renewed, self.slow) = (attempt.in_full, false, false);
        self.contraction = 0.0;
        if !attempt.kept {
            memory.stale = true;
            let evaluations = memory.velocity.iter_mut().chain(&mut memory.force);
            evaluations.for_each(clear);
        }
        let (positions, momenta) = (self.coefficients.positions(), self.coefficients.momenta());
        let extrapolates =
            attempt.kept && memory.pause == 0 && momenta.extrapolates() && positions.extrapolates();
        self.first_change = extrapolates.then_some(f64::NAN);
        if extrapolates {
            extrapolate(momenta, &mut memory.u, &mut memory.component);
            extrapolate(positions, &mut memory.w, &mut memory.component);
        } else {
            memory.u.iter_mut().chain(&mut memory.w).for_each(clear);
        }
        self.values();
        if self.in_full {
            // The derivatives at one point are out of date for the following steps.
            self.memory.stale = true;
            self.scale();
            Ok(())
        } else if self.memory.stale || self.memory.factored != Some(self.step.size) {
            self.factor()
        } else {
            Ok(())
        }
    }

    /// The first evaluation that is NaN or infinite although its argument is finite.
    pub(super) fn non_finite(&self) -> Option<(Quantity, usize)> {
        self.memory.non_finite()
    }

    /// The first stage, from 1, whose force is NaN or infinite.
    pub(super) fn non_finite_force(&self) -> Option<usize> {
        first_non_finite_of(&self.memory.force)
    }

    /// Corrects all increments; returns the change of the stages.
    pub(super) fn sweep(&mut self) -> Result<StageChange, Failure> {
        self.evaluate();
        self.residuals();
        self.correct()?;
        self.update();
        let change = self.values();
        self.judge(&change)?;
        Ok(change)
    }

    /// How far rounding alone moves the positions and the momenta of the stages in a sweep. It is the response of the sweep to
    /// components that are off by one unit of EPSILON, up or down.
    pub(super) fn noise(&mut self) -> Result<[f64; 2], Failure> {
        self.evaluate();
        self.residuals();
        let Workspace {
            q,
            p,
            x,
            y,
            residuals,
            ..
        } = &mut *self.memory;
        residuals[0].copy_from_slice(x);
        residuals[1].copy_from_slice(y);
        q.iter_mut().enumerate().for_each(|(i, q)| jog(q, i));
        p.iter_mut().enumerate().for_each(|(j, p)| jog(p, j));
        self.evaluate();
        self.residuals();
        let Workspace {
            x, y, residuals, ..
        } = &mut *self.memory;
        for (new, old) in [(x, &residuals[0]), (y, &residuals[1])] {
            new.iter_mut().zip(old).for_each(|(new, &old)| *new -= old);
        }
        self.correct()?;
        let noise = self.extent();
        self.values();
        Ok(noise)
    }

    /// Writes the result of the step, and decides what is kept for the next one; returns the number of factorisations of the linear
    /// systems.
    pub(super) fn finish(self, outcome: Outcome<'_, V>) -> u32 {
        let Self {
            step,
            coefficients,
            memory,
            ..
        } = self;
        let Outcome { q, q_low, p, p_low } = outcome;
        let factor = (!coefficients.increments()).then_some(step.size);
        let base = (step.q, step.q_low);
        let (momenta, positions) = (coefficients.momenta(), coefficients.positions());
        total::<R, V>(factor, momenta, &memory.u, base, (q, q_low));
        let base = (step.p, step.p_low);
        total::<R, V>(factor, positions, &memory.w, base, (p, p_low));
        if self.contraction > GOOD {
            memory.stale = true;
        }
        memory.pause = memory.pause.saturating_sub(1);
        if let Some(first) = self.first_change {
            let change = StageChange {
                q: moved(&memory.q, step.q),
                p: moved(&memory.p, step.p),
            };
            if first > size::<P::Class>(&change) {
                memory.pause = PATIENCE;
            }
        }
        self.factorisations
    }

    /// Evaluates velocities and forces at the stages.
    fn evaluate(&mut self) {
        let (positions, momenta) = (self.coefficients.positions(), self.coefficients.momenta());
        let Workspace {
            q,
            p,
            velocity,
            force,
            ..
        } = &mut *self.memory;
        // In a separable system the numbers of positions and momenta may differ. The argument that is not read is the start of the step.
        for (i, (q, force)) in q.iter().zip(force).enumerate() {
            let p = if P::Class::SEPARABLE {
                self.step.p
            } else {
                &p[i]
            };
            let time = self.step.time + positions.time(i) * self.step.size;
            self.system.force(V::Scalar::from_f64(time), q, p, force);
        }
        for (i, (p, velocity)) in p.iter().zip(velocity).enumerate() {
            let q = if P::Class::SEPARABLE {
                self.step.q
            } else {
                &q[i]
            };
            let time = self.step.time + momenta.time(i) * self.step.size;
            self.system
                .velocity(V::Scalar::from_f64(time), q, p, velocity);
        }
    }

    /// Computes the residuals: `h velocity` and `h force` minus the current increments.
    fn residuals(&mut self) {
        let (h, n) = (self.step.size, self.step.q.dimension());
        let (positions, momenta) = (self.coefficients.positions(), self.coefficients.momenta());
        let increments = self.coefficients.increments();
        let Workspace {
            velocity,
            force,
            u,
            w,
            x,
            y,
            ..
        } = &mut *self.memory;
        let rows = rows::<P::Class>(n);
        for (j, (velocity, u)) in velocity.iter().zip(&*u).enumerate() {
            let (factor, unit) = factors::<V>(increments, momenta, j, h);
            let pairs = velocity.as_slice().iter().zip(u.as_slice());
            for (k, (&velocity, &u)) in pairs.enumerate() {
                let place = if P::Class::SEPARABLE { k } else { 2 * k };
                x[j * rows + place] = (factor * velocity - u) * unit;
            }
        }
        for (i, (force, w)) in force.iter().zip(&*w).enumerate() {
            let (factor, unit) = factors::<V>(increments, positions, i, h);
            let pairs = force.as_slice().iter().zip(w.as_slice());
            for (k, (&force, &w)) in pairs.enumerate() {
                let residual = (factor * force - w) * unit;
                if P::Class::SEPARABLE {
                    y[i * n + k] = residual;
                } else {
                    x[i * rows + 2 * k + 1] = residual;
                }
            }
        }
    }

    /// Turns the residuals into corrections.
    fn correct(&mut self) -> Result<(), Failure> {
        if self.in_full {
            let corrected = self.correct_in_full();
            return corrected.map_err(|failure| self.failure(failure));
        }
        if P::Class::SEPARABLE {
            self.correct_separable();
        } else {
            self.solve();
        }
        Ok(())
    }

    /// Corrects with the derivatives at every stage.
    fn correct_in_full(&mut self) -> Result<(), Failure> {
        let Workspace {
            q,
            p,
            x,
            y,
            times,
            scaled,
            linear,
            ..
        } = &mut *self.memory;
        let stages = EveryStage {
            q,
            p,
            start: (self.step.q, self.step.p),
            times,
            positions: &scaled[0],
            momenta: &scaled[1],
        };
        L::correct(linear, self.system, stages, x, y)?;
        self.factorisations += 1;
        Ok(())
    }

    /// Computes the coefficients for [`correct_in_full`](Self::correct_in_full).
    fn scale(&mut self) {
        let Step { time, size: h, .. } = *self.step;
        let Workspace {
            times,
            scaled: [positions, momenta],
            ..
        } = &mut *self.memory;
        let coefficients = self.coefficients;
        let (forces, velocities) = (coefficients.positions(), coefficients.momenta());
        let (of_q, of_p) = (forces.count(), velocities.count());
        let last = |stage: usize, count: usize| (count > 0).then(|| stage.min(count - 1));
        for (i, stage) in times.iter_mut().enumerate() {
            // In a system that depends on time, force and velocity of a stage may have different times: derivatives are evaluated halfway.
            let force = last(i, of_q).map_or(0.5, |i| forces.time(i));
            let velocity = last(i, of_p).map_or(0.5, |i| velocities.time(i));
            let sum = force + velocity;
            *stage = time + 0.5 * sum * h;
        }
        for i in 0..of_q {
            for j in 0..of_p {
                positions[i * of_p + j] = h * position(coefficients, i, j);
                momenta[j * of_q + i] = h * momentum(coefficients, j, i);
            }
        }
    }

    /// The largest changes that the corrections cause in the positions and in the momenta of the stages.
    fn extent(&self) -> [f64; 2] {
        let n = self.step.q.dimension();
        let rows = rows::<P::Class>(n);
        let Workspace { x, y, .. } = &*self.memory;
        let (stride, turn) = if P::Class::SEPARABLE { (1, 0) } else { (2, 1) };
        let of_velocities = |j: usize, k: usize| x[j * rows + stride * k];
        let of_forces = |i: usize, k: usize| match P::Class::SEPARABLE {
            true => y[i * n + k],
            false => x[i * rows + stride * k + turn],
        };
        let coefficients = self.coefficients;
        let (positions, momenta) = (
            coefficients.positions().count(),
            coefficients.momenta().count(),
        );
        let a = |i, j| position(coefficients, i, j);
        let a_tilde = |i, j| momentum(coefficients, i, j);
        let q = largest_sum(n, (positions, momenta), a, of_velocities);
        let p = largest_sum(n, (momenta, positions), a_tilde, of_forces);
        [q, p]
    }

    /// Turns the residuals into corrections, for a separable system.
    fn correct_separable(&mut self) {
        let (h, n) = (self.step.size, self.step.q.dimension());
        let coefficients = self.coefficients;
        for j in 0..coefficients.momenta().count() {
            let Workspace {
                x,
                y,
                vectors,
                linear,
                ..
            } = &mut *self.memory;
            let [sum, product] = vectors;
            combine::<V>(sum, y, |i| h * momentum(coefficients, j, i));
            L::velocity_by_momentum(linear, self.system, sum, product);
            let row = x[j * n..(j + 1) * n].iter_mut().zip(&*product);
            row.for_each(|(x, &product)| *x += product);
        }
        self.solve();
        for i in 0..coefficients.positions().count() {
            let Workspace {
                x,
                y,
                vectors,
                linear,
                ..
            } = &mut *self.memory;
            let [sum, product] = vectors;
            combine::<V>(sum, x, |j| h * position(coefficients, i, j));
            L::force_by_position(linear, self.system, sum, product);
            let row = y[i * n..(i + 1) * n].iter_mut().zip(&*product);
            row.for_each(|(y, &product)| *y += product);
        }
    }

    /// Solves the linear systems for `x`.
    fn solve(&mut self) {
        let rows = rows::<P::Class>(self.step.q.dimension());
        let coefficients = self.coefficients;
        let count = coefficients.momenta().count();
        let Workspace {
            x,
            transformed,
            unknown,
            linear,
            ..
        } = &mut *self.memory;
        let Some(blocks) = coefficients.blocks() else {
            for (place, entry) in unknown.iter_mut().enumerate() {
                *entry = x[place % count * rows + place / count];
            }
            L::solve(linear, self.system, 0, unknown);
            for (place, &entry) in unknown.iter().enumerate() {
                x[place % count * rows + place / count] = entry;
            }
            return;
        };
        let mut first = 0;
        for (number, &(_, imaginary)) in blocks.iter().enumerate() {
            let parts = if imaginary == 0.0 { 1 } else { 2 };
            let unknown = &mut unknown[..parts * rows];
            for (place, entry) in unknown.iter_mut().enumerate() {
                let row = coefficients.block_row(first + place % parts);
                *entry = dot(row, x, rows, place / parts);
            }
            L::solve(linear, self.system, number, unknown);
            for (place, &entry) in unknown.iter().enumerate() {
                transformed[(first + place % parts) * rows + place / parts] = entry;
            }
            first += parts;
        }
        for (place, entry) in x.iter_mut().enumerate() {
            let row = coefficients.stage_row(place / rows);
            *entry = dot(row, transformed, rows, place % rows);
        }
    }

    /// Adds the corrections to the increments.
    fn update(&mut self) {
        let (h, n) = (self.step.size, self.step.q.dimension());
        let rows = rows::<P::Class>(n);
        let (positions, momenta) = (self.coefficients.positions(), self.coefficients.momenta());
        let increments = self.coefficients.increments();
        let Workspace { u, w, x, y, .. } = &mut *self.memory;
        for (j, u) in u.iter_mut().enumerate() {
            let unit = V::Scalar::from_f64(increment(increments, momenta, j, h));
            for (k, u) in u.as_mut_slice().iter_mut().enumerate() {
                let place = if P::Class::SEPARABLE { k } else { 2 * k };
                *u += x[j * rows + place] * unit;
            }
        }
        for (i, w) in w.iter_mut().enumerate() {
            let unit = V::Scalar::from_f64(increment(increments, positions, i, h));
            for (k, w) in w.as_mut_slice().iter_mut().enumerate() {
                *w += unit
                    * if P::Class::SEPARABLE {
                        y[i * n + k]
                    } else {
                        x[i * rows + 2 * k + 1]
                    };
            }
        }
    }

    /// Computes stage values from the increments; returns their change.
    fn values(&mut self) -> StageChange {
        let (step, coefficients) = (self.step, self.coefficients);
        let (positions, momenta) = (coefficients.positions(), coefficients.momenta());
        let Workspace { q, p, u, w, .. } = &mut *self.memory;
        let factor = if coefficients.increments() {
            1.0
        } else {
            step.size
        };
        StageChange {
            q: values::<R, V>(positions, factor, q, (step.q, step.q_low), u),
            p: values::<R, V>(momenta, factor, p, (step.p, step.p_low), w),
        }
    }

    /// Decides from a change whether the derivatives at one point are still accurate enough.
    fn judge(&mut self, change: &StageChange) -> Result<(), Failure> {
        if self.sweeps == 0 && self.first_change.is_some() {
            self.first_change = Some(size::<P::Class>(change));
        }
        self.sweeps += 1;
        self.since += 1;
        let size = size::<P::Class>(change);
        let contraction = size / self.last;
        self.last = size;
        if self.in_full
            || size.is_nan()
            || size <= NOISE * V::Scalar::EPSILON
            || contraction.is_nan()
        {
            return Ok(());
        }
        self.contraction = self.contraction.max(contraction);
        let forecast = num_traits::Float::ln(ROUNDING * V::Scalar::EPSILON / size)
            / num_traits::Float::ln(contraction);
        let is_bad =
            contraction >= 1.0 || f64::from(self.sweeps) + forecast > f64::from(MAX_SWEEPS);
        if is_bad && self.since > 1 {
            self.slow = self.renewed;
            self.renewed = true;
            self.memory.stale = true;
            self.factor()?;
        }
        Ok(())
    }

    /// The error that ends the iteration. After the first sweep the stages may have diverged, so the error is a lack of convergence.
    const fn failure(&self, failure: Failure) -> Failure {
        if self.sweeps == 0 {
            failure
        } else {
            Failure::NoConvergence {
                residual: self.last,
                iterations: self.sweeps,
            }
        }
    }

    /// Recomputes the derivatives, if they are stale, and factors the linear systems.
    fn factor(&mut self) -> Result<(), Failure> {
        let (step, system) = (self.step, self.system);
        let h = step.size;
        let memory = &mut *self.memory;
        memory.factored = None;
        self.since = 0;
        if memory.stale {
            let (q, p) = &mut memory.middle;
            mean(q, &memory.q);
            mean(p, &memory.p);
            let time = V::Scalar::from_f64(step.time + 0.5 * h);
            if !L::linearize(&mut memory.linear, system, time, q, p) {
                return Err(self.failure(NOT_FINITE));
            }
            memory.stale = false;
        }
        let factor = if P::Class::SEPARABLE { h * h } else { h };
        let coefficients = self.coefficients;
        let count = coefficients.momenta().count();
        let regular = match coefficients.blocks() {
            Some(blocks) => {
                let mut blocks = blocks.iter().enumerate();
                blocks.all(|(number, &(real, imaginary))| {
                    let coupling = if imaginary == 0.0 {
                        Coupling::Real(factor * real)
                    } else {
                        Coupling::Complex(factor * real, factor * imaginary)
                    };
                    L::factor(&mut memory.linear, system, number, coupling)
                })
            }
            None => {
                let [positions, momenta] = &mut memory.couplings;
                for i in 0..count {
                    for j in 0..count {
                        (positions[i * count + j], momenta[i * count + j]) = if P::Class::SEPARABLE
                        {
                            let products = (0..coefficients.positions().count()).map(|k| {
                                momentum(coefficients, i, k) * position(coefficients, k, j)
                            });
                            let product: f64 = products.sum();
                            (factor * product, factor * product)
                        } else {
                            (
                                factor * position(coefficients, i, j),
                                factor * momentum(coefficients, i, j),
                            )
                        };
                    }
                }
                let coupling = Coupling::Stages {
                    count,
                    positions,
                    momenta,
                };
                L::factor(&mut memory.linear, system, 0, coupling)
            }
        };
        if regular {
            memory.factored = Some(h);
            self.factorisations += 1;
            Ok(())
        } else {
            Err(self.failure(Failure::SingularMatrix))
        }
    }
}

/// The factor that scales a velocity or a force to an increment, and the factor that scales an increment to `h velocity` or `h force`.
fn factors<V: Vector>(
    increments: bool,
    half: HalfCoefficients<'_>,
    stage: usize,
    h: f64,
) -> (V::Scalar, V::Scalar) {
    let (factor, unit) = if increments {
        (h * half.weight(stage), half.weight(stage).recip())
    } else {
        (1.0, h)
    };
    (V::Scalar::from_f64(factor), V::Scalar::from_f64(unit))
}

/// The factor that scales `h velocity` or `h force` to an increment.
fn increment(increments: bool, half: HalfCoefficients<'_>, stage: usize, h: f64) -> f64 {
    if increments {
        half.weight(stage)
    } else {
        h.recip()
    }
}

/// `a_ij`
fn position<P: StageTableau>(coefficients: &StageCoefficients<P>, i: usize, j: usize) -> f64 {
    let weight = if coefficients.increments() {
        coefficients.momenta().weight(j)
    } else {
        1.0
    };
    coefficients.positions().entry(i, j) * weight
}

/// `ã_ij`
fn momentum<P: StageTableau>(coefficients: &StageCoefficients<P>, i: usize, j: usize) -> f64 {
    let weight = if coefficients.increments() {
        coefficients.positions().weight(j)
    } else {
        1.0
    };
    coefficients.momenta().entry(i, j) * weight
}

/// Moves every component by one unit of EPSILON, up or down in a pseudo-random pattern.
fn jog<V: Vector>(values: &mut V, stage: usize) {
    for (k, value) in values.as_mut_slice().iter_mut().enumerate() {
        let up = ((stage * 7 + k * 5 + stage * k) % 3).is_multiple_of(2);
        let unit = V::Scalar::from_f64(if up {
            V::Scalar::EPSILON
        } else {
            -V::Scalar::EPSILON
        });
        *value += *value * unit;
    }
}

/// The largest component of `Σ_j factor(i, j) value(j)` over all `i`; `sums` counts the `i`, `terms` the `j`.
fn largest_sum<T: Scalar>(
    dimension: usize,
    (sums, terms): (usize, usize),
    factor: impl Fn(usize, usize) -> f64,
    value: impl Fn(usize, usize) -> T,
) -> f64 {
    let mut largest = 0.0_f64;
    for i in 0..sums {
        for k in 0..dimension {
            let mut sum = T::zero();
            for j in 0..terms {
                sum += T::from_f64(factor(i, j)) * value(j, k);
            }
            largest = largest.max(sum.magnitude());
        }
    }
    largest
}

/// One component of a linear combination of the stages.
#[cfg_attr(not(debug_assertions), inline(always))]
fn dot<T: Scalar>(row: &[f64], stages: &[T], rows: usize, component: usize) -> T {
    let mut sum = T::zero();
    for (j, &factor) in row.iter().enumerate() {
        sum += T::from_f64(factor) * stages[j * rows + component];
    }
    sum
}

/// `sum = Σ_j factor(j) vectors_j`, for vectors stored one after another.
fn combine<V: Vector>(sum: &mut [V::Scalar], vectors: &[V::Scalar], factor: impl Fn(usize) -> f64) {
    sum.fill(V::Scalar::zero());
    // `chunks_exact` does not allow chunks of length zero.
    for (j, vector) in vectors.chunks_exact(sum.len().max(1)).enumerate() {
        let factor = V::Scalar::from_f64(factor(j));
        let components = sum.iter_mut().zip(vector);
        components.for_each(|(sum, &component)| *sum += factor * component);
    }
}

/// Computes the stage values `base + low + factor Σ_j columns_j increments_j`; returns their change.
fn values<R: Summation, V: Vector>(
    half: HalfCoefficients<'_>,
    factor: f64,
    values: &mut [V],
    (base, low): (&V, &V),
    increments: &[V],
) -> HalfChange {
    let mut change = HalfChange::default();
    for (i, value) in values.iter_mut().enumerate() {
        let components = value.as_mut_slice().iter_mut();
        let components = components.zip(base.as_slice().iter().zip(low.as_slice()));
        for (k, (value, (&base, &low))) in components.enumerate() {
            let mut sum = V::Scalar::zero();
            for (j, increment) in increments.iter().enumerate() {
                sum += V::Scalar::from_f64(factor * half.entry(i, j)) * increment.as_slice()[k];
            }
            if R::COMPENSATED {
                sum += low;
            }
            let new = base + sum;
            change.record(base, *value, new);
            *value = new;
        }
    }
    change
}

/// Distance of the stages from the start of the step.
fn moved<V: Vector>(values: &[V], base: &V) -> HalfChange {
    let mut change = HalfChange::default();
    for value in values {
        let components = value.as_slice().iter().zip(base.as_slice());
        components.for_each(|(&value, &base)| change.record(base, base, value));
    }
    change
}

/// The mean of these vectors.
fn mean<V: Vector>(out: &mut V, vectors: &[V]) {
    clear(out);
    let factor = V::Scalar::from_f64((vectors.len() as f64).recip());
    for vector in vectors {
        let components = out.as_mut_slice().iter_mut().zip(vector.as_slice());
        components.for_each(|(out, &component)| *out += factor * component);
    }
}

fn clear<V: Vector>(vector: &mut V) {
    vector.as_mut_slice().fill(V::Scalar::zero());
}

/// Extrapolates the increments from those of the previous step; `scratch` has at least one entry for each stage.
fn extrapolate<V: Vector>(
    half: HalfCoefficients<'_>,
    increments: &mut [V],
    scratch: &mut [V::Scalar],
) {
    let n = increments.first().map_or(0, V::dimension);
    for k in 0..n {
        for (i, new) in scratch.iter_mut().enumerate().take(increments.len()) {
            *new = V::Scalar::zero();
            for (j, increment) in increments.iter().enumerate() {
                *new += V::Scalar::from_f64(half.extrapolation(i, j)) * increment.as_slice()[k];
            }
        }
        for (increment, &new) in increments.iter_mut().zip(&*scratch) {
            increment.as_mut_slice()[k] = new;
        }
    }
}

/// Computes one half of the result of a step from its increments; with a `factor`, increments are evaluations without their weights.
fn total<R: Summation, V: Vector>(
    factor: Option<f64>,
    half: HalfCoefficients<'_>,
    increments: &[V],
    base: (&V, &V),
    out: (&mut V, &mut V),
) {
    let (n, count) = (base.0.dimension(), increments.len());
    totals_by::<R, V>(out, base, (n, count), |k: usize, j: usize| {
        let increment = increments[j].as_slice()[k];
        match factor {
            None if half.counts(j) => increment,
            None => V::Scalar::zero(),
            Some(h) => V::Scalar::from_f64(h * half.weight(j)) * increment,
        }
    });
}
