//! One step with holonomic constraints.

use super::HolonomicPart;
use super::start::CONSISTENT;
use crate::constraints::increments::{result, same_momentum, stage};
use crate::constraints::residuals::{NOISE, PATIENCE, ROUNDING, SETTLED};
use crate::constraints::{Gradients, Terms, WithConstraints, Workspace};
use symplectic_core::inside::{ConstrainedTableau, copy, larger_or_nan};
use symplectic_core::solver::{Coefficient, Failure, Outcome, Step, StepStatistics, Stopping};
use symplectic_core::system::Class;
use symplectic_core::{Quantity, Scalar, Summation, System, Vector};

/// A residual has stopped decreasing if the previous one is at most this size. With 128 the relative energy drift for a double pendulum on
/// rods would be 4·10⁻²² per step.
const STAGNANT: f64 = 48.0;
/// A sweep that leaves more than this fraction of the residual contracts badly.
const SLOW: f64 = 0.125;

impl<V: Vector> Workspace<V, HolonomicPart<V>> {
    /// Starting values of the stages and multipliers.
    pub(super) fn begin<S: System<V>>(
        &mut self,
        (number, tableau): (usize, &ConstrainedTableau),
        step: &Step<'_, V>,
        system: &WithConstraints<'_, V, S>,
        work: &mut StepStatistics,
    ) {
        let stages = tableau.weights.len();
        let velocity = &mut self.scratch[0];
        system.velocity(step.at(Coefficient::exact(0.0)), step.q, step.p, velocity);
        work.evaluations += 1;
        let history = &mut self.own.histories[number];
        let (velocity, gradients) = (&self.scratch[0], &self.start.gradients);
        // Another step of the composition may have more stages.
        let impulses = &mut self.own.impulses[..(stages - 1) * self.multipliers.len()];
        let weights = history.begin(step.time, step.size, impulses, |apart| {
            // Positions have rounding errors, and so have the impulses that correct them in a step.
            let [q, p, v] = [step.q, step.p, velocity].map(largest);
            let rounding = V::Scalar::EPSILON * p * (1.0 + q / (step.size.abs() * v));
            apart * largest_of(gradients.values()) <= NOISE * rounding
        });
        self.own.extrapolated = weights.is_some();
        if !self.own.extrapolated {
            let impulses = self.own.impulses.chunks_exact_mut(self.multipliers.len());
            for (impulses, &weight) in impulses.zip(tableau.weights) {
                let weight = V::Scalar::weight(step.size, weight);
                for (impulse, &multiplier) in impulses.iter_mut().zip(&self.multipliers) {
                    *impulse = weight * multiplier;
                }
            }
        }
        copy(&mut self.q[0], step.q);
        for i in 1..stages {
            let factor = V::Scalar::weight(step.size, tableau.nodes[i]);
            let pairs = step.q.as_slice().iter().zip(velocity.as_slice());
            for (out, (&q, &velocity)) in self.q[i].as_mut_slice().iter_mut().zip(pairs) {
                *out = velocity.fused(factor, q);
            }
            history.correct(weights, i - 1, &mut self.q[i]);
        }
        for (i, p) in self.p[..stages].iter_mut().enumerate() {
            copy(p, step.p);
            if !S::Class::SEPARABLE {
                history.correct(weights, stages - 1 + i, p);
            }
        }
        let size = step.size.abs();
        let (q, velocity) = (step.q.as_slice(), velocity.as_slice());
        (self.start.gradients).sizes(
            |k| q[k].magnitude() + size * velocity[k].magnitude(),
            &mut self.terms,
        );
    }

    /// Sweeps until the stages are on the constraints and no longer move. The position after the step is in `outcome`.
    pub(super) fn iterate<R: Summation, S: System<V>>(
        &mut self,
        tableau: &ConstrainedTableau,
        step: &Step<'_, V>,
        system: &WithConstraints<'_, V, S>,
        stopping: Stopping,
        outcome: &mut Outcome<'_, V>,
        work: &mut StepStatistics,
    ) -> Result<(), Failure> {
        let (mut best, mut since) = (f64::INFINITY, 0);
        let (mut before, mut moved) = (f64::INFINITY, f64::INFINITY);
        let (unit, mut cancelled) = (V::Scalar::EPSILON, false);
        let stages = tableau.weights.len();
        // The first sweep with Newton's matrix, which needs good stages.
        let first = if self.own.extrapolated { 1 } else { 2 };
        // Forces inside the step depend on the multipliers if there are stages between start and end.
        let between = stages > 2 && !self.jacobian_is_costly();
        for sweep in 1..=stopping.max_iterations {
            work.iterations += 1;
            self.kicks(tableau, step, system, work)?;
            self.drifts::<S>(tableau, step, system, work);
            let [moved_by, size] = self.positions::<R, S>(tableau, step, system, outcome);
            let movement = moved_by / size / unit;
            // Where stages do not follow the multipliers at once, the next movement is smaller by the same factor at least.
            let rate = if !between && sweep > 1 && movement < moved {
                movement / moved
            } else {
                1.0
            };
            let mut residual = larger_or_nan(self.defect(stages), movement * rate);
            moved = movement;
            // Impulses change from sweep to sweep, and the terms with them.
            cancelled |= residual > NOISE && residual > SLOW * before || residual == f64::INFINITY;
            if cancelled {
                let reach = self.raise(tableau, step, system)?;
                let movement = moved_by / size.max(reach) / unit;
                residual = larger_or_nan(self.defect(stages), movement * rate);
            }
            let last = before <= STAGNANT || sweep == stopping.max_iterations;
            if residual <= SETTLED || residual <= ROUNDING && last {
                return Ok(());
            }
            if residual.is_nan() {
                return Err(self.not_finite());
            }
            if residual < best {
                (best, since) = (residual, 0);
            } else {
                since += 1;
                if since >= PATIENCE
                    && (best <= NOISE || self.noise(stages, movement, size) <= NOISE)
                {
                    return Ok(());
                }
                if since >= PATIENCE * PATIENCE {
                    return Err(Failure::NoConvergence {
                        residual: residual * V::Scalar::EPSILON,
                        iterations: sweep,
                    });
                }
            }
            // The matrix at the start of the step costs nothing extra; that at the first stages contracts much faster.
            let slow = residual > SLOW * before;
            before = residual;
            if sweep < first || self.jacobian_is_costly() && !slow {
                self.correct(tableau, step);
            } else {
                let renew = sweep == first || slow;
                self.correct_by_newton(tableau, step, system, renew)?;
                work.factorisations += u32::from(renew);
            }
            for (impulse, &change) in self.own.impulses.iter_mut().zip(&self.own.changes) {
                *impulse += change;
            }
            if between {
                self.follow::<S>(tableau, step, system, work);
            }
        }
        Err(Failure::NoConvergence {
            residual: best * V::Scalar::EPSILON,
            iterations: stopping.max_iterations,
        })
    }

    /// `h b_j force_j` of all stages except the last, with the impulses of the constraints.
    fn kicks<S: System<V>>(
        &mut self,
        tableau: &ConstrainedTableau,
        step: &Step<'_, V>,
        system: &WithConstraints<'_, V, S>,
        work: &mut StepStatistics,
    ) -> Result<(), Failure> {
        let constraints = self.multipliers.len();
        for j in 0..tableau.weights.len() - 1 {
            let force = &mut self.scratch[1];
            let gradients = if j == 0 {
                &self.start.gradients
            } else {
                let gradients = &mut self.own.gradients[j - 1];
                let q = &self.q[j];
                if !gradients.evaluate(|gradients| system.constraint_gradients(q, gradients)) {
                    return Err(Failure::MovingGradients);
                }
                gradients
            };
            let force = if j == 0 && S::Class::SEPARABLE {
                &self.start.force
            } else {
                let at = step.at(tableau.nodes[j]);
                system.force(at, &self.q[j], &self.p[j], force);
                work.evaluations += 1;
                force
            };
            let weight = V::Scalar::weight(step.size, tableau.weights[j]);
            let kick = self.kick[j].as_mut_slice();
            for (kick, &force) in kick.iter_mut().zip(force.as_slice()) {
                *kick = weight * force;
            }
            let impulses = &self.own.impulses[j * constraints..(j + 1) * constraints];
            gradients.subtract_transposed(impulses, kick);
        }
        Ok(())
    }

    /// The momenta of the stages, and `h b_i velocity_i` there.
    fn drifts<S: System<V>>(
        &mut self,
        tableau: &ConstrainedTableau,
        step: &Step<'_, V>,
        system: &WithConstraints<'_, V, S>,
        work: &mut StepStatistics,
    ) {
        for i in 0..tableau.weights.len() {
            if !same_momentum::<V, S>(tableau, i) {
                let (row, time) = (tableau.momenta[i], tableau.momentum_nodes[i]);
                stage(&mut self.p[i], (step.p, step.p_low), row, &self.kick);
                let velocity = &mut self.scratch[0];
                system.velocity(step.at(time), &self.q[i], &self.p[i], velocity);
                work.evaluations += 1;
            }
            let weight = V::Scalar::weight(step.size, tableau.weights[i]);
            let velocities = self.scratch[0].as_slice().iter();
            for (drift, &velocity) in self.drift[i].as_mut_slice().iter_mut().zip(velocities) {
                *drift = weight * velocity;
            }
        }
    }

    /// The positions of the stages, and their distance from the constraints. Returns the movement of the positions that forces depend on,
    /// and the size of these positions.
    fn positions<R: Summation, S: System<V>>(
        &mut self,
        tableau: &ConstrainedTableau,
        step: &Step<'_, V>,
        system: &WithConstraints<'_, V, S>,
        outcome: &mut Outcome<'_, V>,
    ) -> [f64; 2] {
        let (stages, constraints) = (tableau.weights.len(), self.multipliers.len());
        // No force inside the step of a separable system depends on the last position.
        let moving = if S::Class::SEPARABLE {
            stages - 1
        } else {
            stages
        };
        let (mut movement, mut size) = (0.0_f64, f64::MIN_POSITIVE);
        for i in 1..stages {
            let old = &mut self.scratch[2];
            core::mem::swap(old, &mut self.q[i]);
            if i + 1 < stages {
                stage(
                    &mut self.q[i],
                    (step.q, step.q_low),
                    tableau.positions[i],
                    &self.drift,
                );
            } else {
                let (q, start) = ((&mut *outcome.q, &mut *outcome.q_low), (step.q, step.q_low));
                result::<R, V>(q, start, &self.drift[..stages]);
                copy(&mut self.q[i], outcome.q);
            }
            if i < moving {
                let pairs = self.q[i].as_slice().iter().zip(old.as_slice());
                for (&new, &old) in pairs {
                    movement = larger_or_nan(movement, (new - old).magnitude());
                    // A position that is NaN has moved by NaN.
                    size = size.max(new.magnitude());
                }
            }
            let defects = &mut self.own.defects[(i - 1) * constraints..i * constraints];
            system.constraint_values(&self.q[i], defects);
        }
        [movement, size]
    }

    /// The distance of the stages from the constraints, in units of rounding.
    fn defect(&self, stages: usize) -> f64 {
        let constraints = self.multipliers.len();
        let defects = self.own.defects.chunks_exact(constraints).take(stages - 1);
        let mut residual = 0.0;
        for defects in defects {
            for (defect, terms) in defects.iter().zip(&self.terms) {
                residual = larger_or_nan(residual, terms.relative(defect.magnitude(), 0.0));
            }
        }
        residual / V::Scalar::EPSILON
    }

    /// Raises the terms of the constraints to those of the forces and impulses of the step, which may cancel. Returns the size of a position
    /// with the same rounding error. The gradients are those after the step: at another place they could be too large.
    fn raise<S: System<V>>(
        &mut self,
        tableau: &ConstrainedTableau,
        step: &Step<'_, V>,
        system: &WithConstraints<'_, V, S>,
    ) -> Result<f64, Failure> {
        let last = tableau.weights.len() - 1;
        let (q, p) = (&self.q[last], &self.p[last]);
        let end = &mut self.end.gradients;
        if !end.evaluate(|gradients| system.constraint_gradients(q, gradients)) {
            return Err(Failure::MovingGradients);
        }
        let (at, size) = ((step.time + step.size, q, p), step.size.abs());
        let [_, evaluated, _] = &self.scratch;
        let force = match S::Class::SEPARABLE {
            true => &self.start.force,
            false => evaluated,
        };
        self.momentum.start(force.as_slice());
        let (terms, scratch) = (&mut self.terms, &mut self.scratch);
        let sizes = (self.momentum.sizes(), size * size);
        (self.metric).raise(system, at, end, sizes, terms, scratch);
        let pushed = reach(terms);
        self.momentum.start(step.p.as_slice());
        let impulses = self.own.impulses.chunks_exact(self.multipliers.len());
        for (j, impulses) in impulses.take(last).enumerate() {
            let gradients = match j {
                0 => &self.start.gradients,
                _ => &self.own.gradients[j - 1],
            };
            self.momentum.add(self.kick[j].as_slice());
            self.momentum.add_impulses(gradients, impulses);
        }
        let sizes = (self.momentum.sizes(), size);
        (self.metric).raise(system, at, end, sizes, terms, scratch);
        // Rounding errors above those of a start would decide the motion.
        let motion = largest(step.q).max(largest(q)) + pushed;
        if NOISE * V::Scalar::EPSILON * reach(terms) > CONSISTENT * motion {
            terms.iter_mut().for_each(|terms| terms.raise(0.0));
            return Ok(0.0);
        }
        // Below these the terms of every step are enough.
        terms.iter_mut().for_each(|terms| terms.keep_above(NOISE));
        Ok(reach(terms))
    }

    /// The larger of distance and movement in units of what the values of the constraints resolve.
    fn noise(&self, stages: usize, movement: f64, size: f64) -> f64 {
        let resolution = &self.own.resolution;
        let mut noise = movement * size / (size + resolution.position);
        let defects = self.own.defects.chunks_exact(self.multipliers.len());
        for defects in defects.take(stages - 1) {
            let defects = defects.iter().zip(&self.terms).zip(&resolution.values);
            for ((defect, terms), &resolved) in defects {
                let defect = terms.relative(defect.magnitude(), resolved);
                noise = larger_or_nan(noise, defect / V::Scalar::EPSILON);
            }
        }
        noise
    }

    /// Moves the stages between start and end by the changes of the impulses.
    fn follow<S: System<V>>(
        &mut self,
        tableau: &ConstrainedTableau,
        step: &Step<'_, V>,
        system: &WithConstraints<'_, V, S>,
        work: &mut StepStatistics,
    ) {
        let (stages, constraints) = (tableau.weights.len(), self.multipliers.len());
        let changes = self.own.changes.chunks_exact(constraints);
        for (j, changes) in changes.take(stages - 1).enumerate() {
            let gradients = match j {
                0 => &self.start.gradients,
                _ => &self.own.gradients[j - 1],
            };
            gradients.subtract_transposed(changes, self.kick[j].as_mut_slice());
        }
        self.drifts::<S>(tableau, step, system, work);
        for i in 1..stages - 1 {
            let start = (step.q, step.q_low);
            stage(&mut self.q[i], start, tableau.positions[i], &self.drift);
        }
    }

    /// Changes of the impulses of the constraints from the defects.
    fn correct(&mut self, tableau: &ConstrainedTableau, step: &Step<'_, V>) {
        let (stages, constraints) = (tableau.weights.len(), self.multipliers.len());
        let defects = self.own.defects.chunks_exact_mut(constraints);
        for defects in defects.take(stages - 1) {
            self.start.normal.solve(defects);
        }
        self.own.changes.fill(V::Scalar::from_f64(0.0));
        for (k, row) in tableau.multipliers.iter().enumerate() {
            let weight = match tableau.weights[k].double() {
                0.0 => 1.0,
                weight => weight,
            };
            for (i, &entry) in row.iter().enumerate() {
                let factor = V::Scalar::from_f64(weight / step.size * entry);
                for c in 0..constraints {
                    self.own.changes[k * constraints + c] +=
                        factor * self.own.defects[i * constraints + c];
                }
            }
        }
    }

    /// The momentum after the step, on the hidden constraint.
    pub(super) fn finish<R: Summation, S: System<V>>(
        &mut self,
        tableau: &ConstrainedTableau,
        step: &Step<'_, V>,
        system: &WithConstraints<'_, V, S>,
        stopping: Stopping,
        outcome: &mut Outcome<'_, V>,
        work: &mut StepStatistics,
    ) -> Result<(), Failure> {
        let last = tableau.weights.len() - 1;
        let weight = V::Scalar::weight(step.size, tableau.weights[last]);
        let force = &mut self.scratch[1];
        system.force(
            step.at(tableau.nodes[last]),
            outcome.q,
            &self.p[last],
            force,
        );
        work.evaluations += 1;
        let pairs = self.kick[last].as_mut_slice().iter_mut();
        for (kick, &force) in pairs.zip(force.as_slice()) {
            *kick = weight * force;
        }
        if S::Class::SEPARABLE {
            copy(&mut self.end.force, force);
        }
        let end = step.time + step.size;
        let (point, scratch) = (&mut self.end, &mut self.scratch);
        (self.metric).evaluate(system, end, (outcome.q, &self.p[last]), point, scratch)?;
        let found = self.last_impulse.find::<R, V, S>(
            step,
            system,
            (&self.metric, &self.end),
            &mut self.kick[..=last],
            &mut self.scratch,
            stopping,
            outcome,
            work,
        );
        match found {
            Err(Failure::NonFinite { .. }) => return Err(self.not_finite()),
            found => found?,
        }
        // The impulse −Gᵀy of the last stage, in place of its multiplier; that of the previous stage if the weight is zero.
        let constraints = self.multipliers.len();
        let (impulses, weight) = if weight == V::Scalar::from_f64(0.0) {
            let weight = V::Scalar::weight(step.size, tableau.weights[last - 1]);
            (&self.own.impulses[(last - 1) * constraints..], weight)
        } else {
            (&self.last_impulse.multipliers[..], weight)
        };
        let inverse = weight.recip();
        for (multiplier, &impulse) in self.multipliers.iter_mut().zip(impulses) {
            *multiplier = impulse * inverse;
        }
        Ok(())
    }

    /// The failure for stages that are not finite.
    fn not_finite(&self) -> Failure {
        let finite = |gradients: &Gradients<V::Scalar>| {
            let mut values = gradients.values().iter();
            values.all(|value| value.is_finite())
        };
        let mut gradients = self.own.gradients.iter();
        match gradients.position(|gradients| !finite(gradients)) {
            Some(stage) => Failure::NonFinite {
                what: Quantity::Constraint,
                stage: Some(stage + 2),
            },
            None => self.non_finite_increment(),
        }
    }
}

/// Whether an iteration that fails like this may succeed from other starting values.
pub(super) const fn depends_on_the_start(failure: &Failure) -> bool {
    matches!(
        failure,
        Failure::NoConvergence { .. } | Failure::NonFinite { .. } | Failure::SingularMatrix
    )
}

/// The largest size of a position for which raised terms have their size.
fn reach(terms: &[Terms]) -> f64 {
    let reaches = terms.iter().map(|terms| terms.raised());
    reaches.fold(0.0, f64::max)
}

/// The largest magnitude of the components.
fn largest<V: Vector>(vector: &V) -> f64 {
    largest_of(vector.as_slice())
}

fn largest_of<T: Scalar>(numbers: &[T]) -> f64 {
    let sizes = numbers.iter().map(|number| number.magnitude());
    sizes.fold(0.0, larger_or_nan)
}
