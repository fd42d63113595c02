//! The last impulse of a step, which projects the velocity onto the constraints.

use alloc::vec;
use alloc::vec::Vec;

use super::increments::result;
use super::metric::{Metric, Point};
use super::momentum_terms::MomentumTerms;
use super::residuals::{NOISE, PATIENCE, ROUNDING, SETTLED};
use super::{Terms, WithConstraints};
use symplectic_core::inside::larger_or_nan;
use symplectic_core::solver::{Failure, Outcome, Step, StepStatistics, Stopping};
use symplectic_core::{Quantity, Scalar, Summation, System, Vector};

/// The impulse `−Gᵀy` at the end of a step with `G velocity(q1, p1) = 0`.
#[derive(Clone, Debug)]
pub(super) struct LastImpulse<T> {
    /// The multipliers y.
    pub(super) multipliers: Vec<T>,
    /// `G velocity` at the end.
    rates: Vec<T>,
    /// The sizes that each rate is compared with.
    terms: Vec<Terms>,
    /// `|G velocity|` before the impulse removes it.
    drive: Vec<f64>,
    /// The terms of the momentum at the end.
    momentum: MomentumTerms,
}

impl<T: Scalar> LastImpulse<T> {
    pub(super) fn new(constraints: usize, dimension: usize) -> Self {
        Self {
            multipliers: vec![T::zero(); constraints],
            rates: vec![T::zero(); constraints],
            terms: vec![Terms::default(); constraints],
            drive: vec![0.0; constraints],
            momentum: MomentumTerms::new(dimension),
        }
    }

    /// Adds the impulse to the last of the `increments` of the momentum. Writes the momentum after the step into `outcome`, which already
    /// holds the position. `end` is the point there, of this metric.
    ///
    /// # Errors
    ///
    /// [`Failure::NonFinite`] if a velocity is not finite; [`Failure::NoConvergence`].
    #[allow(clippy::too_many_arguments)]
    pub(super) fn find<R: Summation, V: Vector<Scalar = T>, S: System<V>>(
        &mut self,
        step: &Step<'_, V>,
        system: &WithConstraints<'_, V, S>,
        (metric, end): (&Metric<T>, &Point<V>),
        increments: &mut [V],
        scratch: &mut [V; 3],
        stopping: Stopping,
        outcome: &mut Outcome<'_, V>,
        work: &mut StepStatistics,
    ) -> Result<(), Failure> {
        let time = T::from_f64(step.time + step.size);
        self.multipliers.fill(T::zero());
        let (mut best, mut since) = (f64::INFINITY, 0);
        for sweep in 1..=stopping.max_iterations {
            let (p, start) = ((&mut *outcome.p, &mut *outcome.p_low), (step.p, step.p_low));
            result::<R, V>(p, start, increments);
            let velocity = if S::MASSES.are_unit() {
                &*outcome.p
            } else {
                system.velocity(time, outcome.q, outcome.p, &mut scratch[0]);
                work.evaluations += 1;
                &scratch[0]
            };
            let residual = self.residual(end, velocity, sweep == 1);
            if residual.is_nan() {
                return Err(Failure::NonFinite {
                    what: Quantity::Velocity,
                    stage: None,
                });
            }
            if residual <= SETTLED
                || residual <= ROUNDING && (sweep > 2 || sweep == stopping.max_iterations)
            {
                return Ok(());
            }
            if residual < 0.5 * best {
                (best, since) = (residual, 0);
            } else {
                since += 1;
                if best <= NOISE {
                    return Ok(());
                }
                // If the terms of momenta or velocities cancel, only their rounding errors are left.
                self.momentum.start(outcome.p.as_slice());
                for increment in &*increments {
                    self.momentum.add(increment.as_slice());
                }
                (self.momentum).add_impulses(&end.gradients, &self.multipliers);
                let at = (step.time + step.size, &*outcome.q, &*outcome.p);
                let (gradients, sizes) = (&end.gradients, (self.momentum.sizes(), 1.0));
                metric.raise(system, at, gradients, sizes, &mut self.terms, scratch);
                let limit = if sweep > 2 { NOISE } else { ROUNDING };
                if self.largest() <= limit {
                    return Ok(());
                }
                if since > PATIENCE {
                    return Err(Failure::NoConvergence {
                        residual: residual * T::EPSILON,
                        iterations: sweep,
                    });
                }
            }
            end.normal.solve(&mut self.rates);
            for (multiplier, &change) in self.multipliers.iter_mut().zip(&self.rates) {
                *multiplier += change;
            }
            if let Some(last) = increments.last_mut() {
                end.gradients
                    .subtract_transposed(&self.rates, last.as_mut_slice());
            }
        }
        Err(Failure::NoConvergence {
            residual: best * T::EPSILON,
            iterations: stopping.max_iterations,
        })
    }

    /// The largest `G velocity` at the end of the step, in units of its rounding errors.
    fn residual<V: Vector<Scalar = T>>(
        &mut self,
        end: &Point<V>,
        velocity: &V,
        first: bool,
    ) -> f64 {
        let velocity = velocity.as_slice();
        end.gradients.multiply(velocity, &mut self.rates);
        (end.gradients).sizes(|k| velocity[k].magnitude(), &mut self.terms);
        if first {
            let pairs = self.drive.iter_mut().zip(&self.rates);
            pairs.for_each(|(drive, rate)| *drive = rate.magnitude());
        }
        self.largest()
    }

    /// The largest of these rates, in units of rounding of its terms.
    fn largest(&self) -> f64 {
        let mut residual = 0.0;
        for (c, rate) in self.rates.iter().enumerate() {
            let rate = self.terms[c].relative(rate.magnitude(), self.drive[c]);
            residual = larger_or_nan(residual, rate);
        }
        residual / T::EPSILON
    }
}
