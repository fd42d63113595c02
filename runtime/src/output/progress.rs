//! How far an integration has come.

use core::ops::ControlFlow;

use crate::error::Error;
use crate::integrator::{Integrator, Statistics};
use crate::method::{Method, Solver};
use crate::number::{Summation, Vector};
use crate::state::State;
use crate::system::System;

/// How far an integration has come, as [`Integrator::integrate_while`] reports after every step.
#[derive(Clone, Copy, Debug)]
pub struct Progress<'a, V> {
    /// The present state.
    pub state: &'a State<V>,
    /// Steps taken of this integration.
    pub step: u64,
    /// All steps of this integration.
    pub steps: u64,
    /// What the steps have taken since the integrator was made.
    pub statistics: &'a Statistics,
}

impl<V> Progress<'_, V> {
    /// The part of the integration that is done, from 0 to 1.
    pub fn fraction(&self) -> f64 {
        self.step as f64 / self.steps as f64
    }
}

impl<M: Method, S: System<V>, V: Vector, R: Summation, N: Solver<V, S>> Integrator<M, S, V, R, N> {
    /// [`integrate_to`](Self::integrate_to) that reports its progress after every step, and ends where the report breaks
    /// it: with the value that it breaks with, otherwise with `None`.
    ///
    /// # Errors
    ///
    /// As for [`integrate_to`](Self::integrate_to).
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
    pub fn integrate_while<B, F>(&mut self, end: f64, mut report: F) -> Result<Option<B>, Error>
    where
        F: FnMut(Progress<'_, V>) -> ControlFlow<B>,
    {
        let ended = self.steps_to(end, |integrator, next| {
            integrator.advance(next.size, next.time)?;
            Ok(report(Progress {
                state: integrator.state(),
                step: next.number,
                steps: next.steps,
                statistics: integrator.statistics(),
            }))
        })?;
        Ok(ended.break_value())
    }
}
