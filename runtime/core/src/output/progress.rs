//! Progress of an integration.

use core::ops::ControlFlow;

use crate::integrator::{Equal, Run, Statistics, Stepper};

/// Progress of an integration, reported by [`Run::integrate_while`] after every step; `T` is the type of the state.
#[derive(Clone, Copy, Debug)]
pub struct Progress<'a, T> {
    /// The present state.
    pub state: &'a T,
    /// Number of steps taken in this integration.
    pub step: u64,
    /// Number of steps of the whole integration.
    pub steps: u64,
    /// Statistics since the integrator was created.
    pub statistics: &'a Statistics,
}

impl<T> Progress<'_, T> {
    /// Fraction of the integration that is done, from 0 to 1.
    pub fn fraction(&self) -> f64 {
        self.step as f64 / self.steps as f64
    }
}

impl<S: Stepper<Pace = Equal>> Run<S> {
    /// [`integrate_to`](crate::Integrator#method.integrate_to) that calls `report` after every step. If `report` breaks with a value, the
    /// integration stops and returns that value; otherwise it returns `None` at `end`.
    ///
    /// # Errors
    ///
    /// Those of [`integrate_to`](crate::Integrator#method.integrate_to).
    ///
    /// ```
    /// symplectic::tableau! { StoermerVerlet { basis: polynomial(2), nodes: lobatto(2) } }
    /// # use core::ops::ControlFlow;
    /// # use symplectic::nalgebra::Vector1;
    /// # use symplectic::{Error, Integrator, State, acceleration};
    /// # fn main() -> Result<(), Error> {
    /// let oscillator = acceleration::<Vector1<f64>, _>(|_, q, acceleration| *acceleration = -q);
    /// let start = State::new(0.0, Vector1::new(1.0), Vector1::new(0.0));
    /// let mut integrator = Integrator::new(StoermerVerlet, oscillator, start, 0.125)?;
    /// let stopped = integrator.integrate_while(100.0, |progress| {
    ///     if progress.step % 100 == 0 {
    ///         println!("{:3.0} %", 100.0 * progress.fraction());
    ///     }
    ///     match progress.state.q[0] < 0.0 {
    ///         true => ControlFlow::Break(progress.step),
    ///         false => ControlFlow::Continue(()),
    ///     }
    /// })?;
    /// // The first step beyond π/2.
    /// assert_eq!(stopped, Some(13));
    /// # Ok(())
    /// # }
    /// ```
    pub fn integrate_while<B, F: FnMut(Progress<'_, S::State>) -> ControlFlow<B>>(
        &mut self,
        end: f64,
        mut report: F,
    ) -> Result<Option<B>, S::Error> {
        let (mut step, steps) = (0, self.steps_to_time(end)?.left);
        let ended = self.steps_to(end, |run, size, time| {
            run.advance(size, time)?;
            step += 1;
            Ok(report(Progress {
                state: run.state(),
                step,
                steps,
                statistics: run.statistics(),
            }))
        })?;
        Ok(ended.break_value())
    }
}
