//! Statistics of an integration.

use crate::method::StepStatistics;
use crate::number::words::{Visit, Words, words};

/// Counts over all steps taken; a failed step changes none of them. A stepper without an [`Integrator`](crate::Integrator) counts only steps,
/// and attempts that were [split](crate::Retry).
///
/// ```
/// symplectic::tableau! { Midpoint { basis: polynomial(1), nodes: gauss(1) } }
/// # use symplectic::nalgebra::Vector1;
/// # use symplectic::{Error, Integrator, State, separable};
/// # fn main() -> Result<(), Error> {
/// let pendulum = separable::<Vector1<f64>, _, _>(|_, p, velocity| *velocity = *p, |_, q, force| force[0] = -q[0].sin());
/// let start = State::new(0.0, Vector1::new(1.0), Vector1::new(0.0));
/// let mut integrator = Integrator::new(Midpoint, pendulum, start, 0.1)?;
/// integrator.integrate_to(10.0)?;
/// let statistics = integrator.statistics();
/// assert_eq!(statistics.steps, 100);
/// // A velocity and a force in each sweep, and the velocity that the first step begins with.
/// assert_eq!(statistics.evaluations, 2 * statistics.iterations + 1);
/// assert!(statistics.mean_iterations() < f64::from(statistics.most_iterations));
/// # Ok(())
/// # }
/// ```
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub struct Statistics {
    /// Steps taken; for a [split](crate::Retry::Split) step, its parts.
    pub steps: u64,
    /// Failed attempts that were repeated with shorter steps. With the steps of an [`Integrator`](crate::Integrator) also those that were
    /// repeated with another solver or the starting values of a first step.
    pub rejected: u64,
    /// Fixed-point sweeps; 0 for an explicit method.
    pub iterations: u64,
    /// The largest number of sweeps of one step.
    pub most_iterations: u32,
    /// Evaluations of the velocity or the force.
    pub evaluations: u64,
    /// Factorisations of the linear systems of Newton's iteration: one for each pair of stages.
    pub factorisations: u64,
    /// The largest residual of a step by Newton's iteration: the relative change of the positions or momenta of the stages in its last
    /// sweep. In a stiff system it is the rounding error of the force, divided by the step size. It may be far above
    /// [`Scalar::EPSILON`](crate::Scalar::EPSILON). Zero for other iterations.
    pub largest_residual: f64,
}

impl Statistics {
    /// Mean number of sweeps per step; 0 before the first step.
    pub fn mean_iterations(&self) -> f64 {
        if self.steps == 0 {
            0.0
        } else {
            self.iterations as f64 / self.steps as f64
        }
    }

    /// Counts `steps` explicit steps with `evaluations` evaluations each.
    #[inline]
    pub(crate) fn count_explicit(&mut self, steps: u64, evaluations: u32) {
        self.steps += steps;
        self.evaluations += steps * u64::from(evaluations);
    }

    /// Counts a step that was accepted.
    #[inline]
    pub(crate) fn count(&mut self, work: StepStatistics) {
        self.steps += 1;
        self.iterations += u64::from(work.iterations);
        self.most_iterations = self.most_iterations.max(work.iterations);
        self.evaluations += u64::from(work.evaluations);
        self.factorisations += u64::from(work.factorisations);
        self.rejected += u64::from(work.rejected);
        self.largest_residual = self.largest_residual.max(work.residual);
    }
}

impl Words for Statistics {
    fn words(&mut self, visit: &mut Visit<'_>) {
        let Self {
            steps,
            rejected,
            iterations,
            most_iterations,
            evaluations,
            factorisations,
            largest_residual,
        } = self;
        words!(visit: *steps, *rejected, *iterations, *most_iterations, *evaluations, *factorisations, *largest_residual);
    }
}
