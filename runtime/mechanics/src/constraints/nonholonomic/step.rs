//! One step with non-holonomic constraints.

use super::NonholonomicPart;
use crate::constraints::increments::{result, same_momentum, stage};
use crate::constraints::residuals::{NOISE, PATIENCE, ROUNDING};
use crate::constraints::{WithConstraints, Workspace};
use symplectic_core::inside::{ConstrainedTableau, copy, larger_or_nan};
use symplectic_core::solver::{Coefficient, Failure, Outcome, Step, StepStatistics, Stopping};
use symplectic_core::system::Class;
use symplectic_core::{Scalar, Summation, System, Vector};

impl<V: Vector> Workspace<V, NonholonomicPart<V>> {
    /// Starting values of the stages; the multipliers start from zero.
    pub(super) fn begin<S: System<V>>(
        &mut self,
        tableau: &ConstrainedTableau,
        step: &Step<'_, V>,
        system: &WithConstraints<'_, V, S>,
        work: &mut StepStatistics,
    ) {
        let velocity = &mut self.scratch[0];
        system.velocity(step.at(Coefficient::exact(0.0)), step.q, step.p, velocity);
        work.evaluations += 1;
        for (i, &node) in tableau.nodes.iter().enumerate() {
            self.own.moved[i] = true;
            copy(&mut self.p[i], step.p);
            let factor = V::Scalar::weight(step.size, node);
            let pairs = step.q.as_slice().iter().zip(velocity.as_slice());
            for (out, (&q, &velocity)) in self.q[i].as_mut_slice().iter_mut().zip(pairs) {
                *out = velocity.fused(factor, q);
            }
        }
        let zero = V::Scalar::from_f64(0.0);
        for impulse in &mut self.kick[tableau.weights.len()..] {
            impulse.as_mut_slice().fill(zero);
        }
        self.multipliers.fill(zero);
        let size = V::Scalar::from_f64(step.size);
        let pairs = self.own.reach.as_mut_slice().iter_mut();
        for (reach, &velocity) in pairs.zip(velocity.as_slice()) {
            *reach = size * velocity;
        }
    }

    /// Sweeps until the displacement obeys the constraints and the stages no longer move. The position after the step is in `outcome`.
    pub(super) fn iterate<R: Summation, S: System<V>>(
        &mut self,
        tableau: &ConstrainedTableau,
        step: &Step<'_, V>,
        system: &WithConstraints<'_, V, S>,
        stopping: Stopping,
        outcome: &mut Outcome<'_, V>,
        work: &mut StepStatistics,
    ) -> Result<(), Failure> {
        let (mut best, mut since, mut moved) = (f64::INFINITY, 0, f64::INFINITY);
        for sweep in 1..=stopping.max_iterations {
            work.iterations += 1;
            self.kicks(tableau, step, system, work);
            self.drifts(tableau, step, system, work);
            let (movement, size) = self.positions::<R>(tableau, step, outcome);
            let defect = self.defects(tableau, system)?;
            // The remaining movement shrinks at least as fast as the movements did.
            let rate = if sweep > 1 && movement.own < moved {
                movement.own / moved
            } else {
                1.0
            };
            let residual = larger_or_nan(defect, movement.own * rate);
            moved = movement.own;
            if residual <= ROUNDING {
                return Ok(());
            }
            if residual.is_nan() {
                return Err(self.non_finite_increment());
            }
            if residual < best {
                (best, since) = (residual, 0);
            } else {
                since += 1;
                if since >= PATIENCE
                    && (best <= NOISE
                        || self.noise(tableau, step, system, movement.largest, size) <= NOISE)
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
            self.correct(tableau, step);
        }
        Err(Failure::NoConvergence {
            residual: best * V::Scalar::EPSILON,
            iterations: stopping.max_iterations,
        })
    }

    /// `h b_j force_j` of all stages.
    fn kicks<S: System<V>>(
        &mut self,
        tableau: &ConstrainedTableau,
        step: &Step<'_, V>,
        system: &WithConstraints<'_, V, S>,
        work: &mut StepStatistics,
    ) {
        for (j, &weight) in tableau.weights.iter().enumerate() {
            // The force of a separable system is known if the position has not moved.
            if S::Class::SEPARABLE && !self.own.moved[j] {
                continue;
            }
            let force = &mut self.scratch[1];
            let at = step.at(tableau.nodes[j]);
            system.force(at, &self.q[j], &self.p[j], force);
            work.evaluations += 1;
            let weight = V::Scalar::weight(step.size, weight);
            let kick = self.kick[j].as_mut_slice();
            for (kick, &force) in kick.iter_mut().zip(force.as_slice()) {
                *kick = weight * force;
            }
        }
    }

    /// The momenta of the stages, and `h b_i velocity_i` there.
    fn drifts<S: System<V>>(
        &mut self,
        tableau: &ConstrainedTableau,
        step: &Step<'_, V>,
        system: &WithConstraints<'_, V, S>,
        work: &mut StepStatistics,
    ) {
        let stages = tableau.weights.len();
        let [velocity, _, low] = &mut self.scratch;
        // All momenta begin with the impulse of the constraints.
        copy(low, step.p_low);
        let pairs = low.as_mut_slice().iter_mut();
        for (low, &impulse) in pairs.zip(self.kick[stages].as_slice()) {
            *low += impulse;
        }
        for i in 0..stages {
            if !same_momentum::<V, S>(tableau, i) {
                let (row, time) = (tableau.momenta[i], tableau.momentum_nodes[i]);
                stage(&mut self.p[i], (step.p, low), row, &self.kick);
                system.velocity(step.at(time), &self.q[i], &self.p[i], velocity);
                work.evaluations += 1;
            }
            let weight = V::Scalar::weight(step.size, tableau.weights[i]);
            let velocities = velocity.as_slice().iter();
            for (drift, &velocity) in self.drift[i].as_mut_slice().iter_mut().zip(velocities) {
                *drift = weight * velocity;
            }
        }
    }

    /// The positions of the stages and after the step, and the displacement `q1 − q0`. Returns how far the stages have moved, and their size.
    fn positions<R: Summation>(
        &mut self,
        tableau: &ConstrainedTableau,
        step: &Step<'_, V>,
        outcome: &mut Outcome<'_, V>,
    ) -> (Residual, f64) {
        let stages = tableau.weights.len();
        for (k, displacement) in self.own.displacement.as_mut_slice().iter_mut().enumerate() {
            let drifts = self.drift[..stages].iter().map(|drift| drift.as_slice()[k]);
            *displacement = drifts.fold(V::Scalar::from_f64(0.0), |sum, drift| sum + drift);
            let reach = &mut self.own.reach.as_mut_slice()[k];
            if displacement.magnitude() > reach.magnitude() {
                *reach = *displacement;
            }
        }
        let q = ((&mut *outcome.q, &mut *outcome.q_low), (step.q, step.q_low));
        result::<R, V>(q.0, q.1, &self.drift[..stages]);
        let (mut own, mut difference, mut size) = (0.0_f64, 0.0_f64, f64::MIN_POSITIVE);
        for i in 0..stages {
            let old = &mut self.scratch[2];
            core::mem::swap(old, &mut self.q[i]);
            let start = (step.q, step.q_low);
            stage(&mut self.q[i], start, tableau.positions[i], &self.drift);
            self.own.moved[i] = self.q[i].as_slice() != old.as_slice();
            let reach = self.own.reach.as_slice().iter();
            let pairs = self.q[i].as_slice().iter().zip(old.as_slice()).zip(reach);
            for ((&new, &old), &reach) in pairs {
                let change = (new - old).magnitude();
                let scale = larger_or_nan(new.magnitude(), old.magnitude()) + reach.magnitude();
                if change != 0.0 {
                    own = larger_or_nan(own, change / scale);
                }
                difference = larger_or_nan(difference, change);
                size = larger_or_nan(size, scale);
            }
        }
        (Residual::new::<V>(own, difference / size), size)
    }

    /// `Σ_i b_i w(Q_i)·(q1 − q0)`. Returns its size relative to the displacement, in units of rounding.
    fn defects<S: System<V>>(
        &mut self,
        tableau: &ConstrainedTableau,
        system: &WithConstraints<'_, V, S>,
    ) -> Result<f64, Failure> {
        self.own.defects.fill(V::Scalar::from_f64(0.0));
        for (q, &weight) in self.q.iter().zip(tableau.weights) {
            let rows = &mut self.own.rows;
            if !rows.evaluate(|rows| system.constraint_gradients(q, rows)) {
                return Err(Failure::MovingGradients);
            }
            rows.multiply(self.own.displacement.as_slice(), &mut self.own.part);
            let weight = V::Scalar::from_coefficient(weight);
            for (defect, &part) in self.own.defects.iter_mut().zip(&self.own.part) {
                *defect += weight * part;
            }
        }
        let (reach, q) = (self.own.reach.as_slice(), self.q[0].as_slice());
        let rows = &self.own.rows;
        rows.sizes(|k| reach[k].magnitude(), &mut self.terms);
        let own = self.largest_defect();
        rows.sizes(|k| q[k].magnitude() + reach[k].magnitude(), &mut self.terms);
        Ok(own)
    }

    /// The largest defect, in units of rounding of its terms.
    fn largest_defect(&self) -> f64 {
        let mut largest = 0.0;
        for (defect, terms) in self.own.defects.iter().zip(&self.terms) {
            largest = larger_or_nan(largest, terms.relative(defect.magnitude(), 0.0));
        }
        largest / V::Scalar::EPSILON
    }

    /// The larger of defect and movement in units of rounding of all terms, also of those of the momenta, which may cancel.
    fn noise<S: System<V>>(
        &mut self,
        tableau: &ConstrainedTableau,
        step: &Step<'_, V>,
        system: &WithConstraints<'_, V, S>,
        movement: f64,
        size: f64,
    ) -> f64 {
        let stages = tableau.weights.len();
        self.momentum.start(step.p.as_slice());
        for kick in &self.kick[..stages] {
            self.momentum.add(kick.as_slice());
        }
        (self.momentum).add_impulses(&self.start.gradients, &self.multipliers);
        let (q, p) = (&self.q[stages - 1], &self.p[stages - 1]);
        let at = (step.time + step.size, q, p);
        let sizes = (self.momentum.sizes(), step.size.abs());
        let rows = &self.own.rows;
        (self.metric).raise(system, at, rows, sizes, &mut self.terms, &mut self.scratch);
        let reaches = self.terms.iter().map(|terms| terms.raised());
        let reach = reaches.fold(size, f64::max);
        larger_or_nan(self.largest_defect(), movement * size / reach)
    }

    /// Changes the multipliers by the defects, and with them their impulse.
    fn correct(&mut self, tableau: &ConstrainedTableau, step: &Step<'_, V>) {
        self.start.normal.solve(&mut self.own.defects);
        let factor = V::Scalar::from_f64(step.size.recip());
        for (multiplier, &change) in self.multipliers.iter_mut().zip(&self.own.defects) {
            *multiplier += change * factor;
        }
        let impulse = self.kick[tableau.weights.len()].as_mut_slice();
        impulse.fill(V::Scalar::from_f64(0.0));
        (self.start.gradients).subtract_transposed(&self.multipliers, impulse);
    }

    /// The momentum after the step, with a velocity that obeys the constraints.
    pub(super) fn finish<R: Summation, S: System<V>>(
        &mut self,
        tableau: &ConstrainedTableau,
        step: &Step<'_, V>,
        system: &WithConstraints<'_, V, S>,
        stopping: Stopping,
        outcome: &mut Outcome<'_, V>,
        work: &mut StepStatistics,
    ) -> Result<(), Failure> {
        let Workspace {
            metric,
            end,
            scratch,
            p,
            kick,
            last_impulse,
            ..
        } = self;
        let stages = tableau.weights.len();
        let time = step.time + step.size;
        metric.evaluate(system, time, (outcome.q, &p[stages - 1]), end, scratch)?;
        let (kick, end) = (&mut kick[..stages + 2], (&*metric, &*end));
        let found =
            last_impulse.find::<R, V, S>(step, system, end, kick, scratch, stopping, outcome, work);
        match found {
            Err(Failure::NonFinite { .. }) => Err(self.non_finite_increment()),
            found => found,
        }
    }
}

/// A residual in units of rounding.
struct Residual {
    /// Relative to the size of each component.
    own: f64,
    /// Relative to the size of all components, because rounding errors of large components perturb the small ones.
    largest: f64,
}

impl Residual {
    fn new<V: Vector>(own: f64, largest: f64) -> Self {
        let [own, largest] = [own, largest].map(|residual| residual / V::Scalar::EPSILON);
        Self { own, largest }
    }
}
