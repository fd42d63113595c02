//! Iterator over the states of an integration.

use core::fmt;
use core::iter::FusedIterator;

use crate::error::Error;
use crate::integrator::Integrator;
use crate::method::{Method, Solver};
use crate::number::{Compensated, Summation, Vector};
use crate::solver::FixedPoint;
use crate::state::State;
use crate::system::System;

impl<M: Method, S: System<V>, V: Vector, R: Summation, N: Solver<V, S>> Integrator<M, S, V, R, N> {
    /// An endless iterator over the states after each step; limit it by [`Iterator::take`].
    pub const fn states(&mut self) -> States<'_, M, S, V, R, N> {
        States {
            integrator: self,
            stride: 1,
            failed: false,
        }
    }
}

/// The endless iterator that [`Integrator::states`] returns.
///
/// Each item is a clone of the state after one more step, or after [several](Self::every). It ends after an error.
pub struct States<
    'a,
    M: Method,
    S: System<V>,
    V: Vector,
    R: Summation = Compensated,
    N: Solver<V, S> = FixedPoint,
> {
    integrator: &'a mut Integrator<M, S, V, R, N>,
    /// Number of steps between items.
    stride: u64,
    failed: bool,
}

impl<M: Method, S: System<V>, V: Vector, R: Summation, N: Solver<V, S>> States<'_, M, S, V, R, N> {
    /// Yields the states after every `steps` steps only, without a copy of the states in between; 0 counts as 1.
    ///
    /// ```
    /// symplectic::tableau! { StoermerVerlet { basis: polynomial(2), nodes: lobatto(2) } }
    /// # use symplectic::nalgebra::Vector1;
    /// # use symplectic::{Error, Integrator, State, acceleration};
    /// # fn main() -> Result<(), Error> {
    /// let oscillator = acceleration::<Vector1<f64>, _>(|_, q, acceleration| *acceleration = -q);
    /// let start = State::new(0.0, Vector1::new(1.0), Vector1::new(0.0));
    /// let mut integrator = Integrator::new(StoermerVerlet, oscillator, start, 0.125)?;
    /// let states: Result<Vec<_>, _> = integrator.states().every(8).take(3).collect();
    /// let times: Vec<f64> = states?.iter().map(|state| state.time).collect();
    /// assert_eq!(times, [1.0, 2.0, 3.0]);
    /// # Ok(())
    /// # }
    /// ```
    #[must_use]
    pub const fn every(mut self, steps: u64) -> Self {
        self.stride = if steps == 0 { 1 } else { steps };
        self
    }
}

impl<M: Method, S: System<V>, V: Vector, R: Summation, N: Solver<V, S>> Iterator
    for States<'_, M, S, V, R, N>
{
    type Item = Result<State<V>, Error>;

    fn next(&mut self) -> Option<Self::Item> {
        if self.failed {
            return None;
        }
        let state = self.integrator.take_steps(self.stride).cloned();
        self.failed = state.is_err();
        Some(state)
    }
}

impl<M: Method, S: System<V>, V: Vector, R: Summation, N: Solver<V, S>> FusedIterator
    for States<'_, M, S, V, R, N>
{
}

impl<M: Method, S: System<V>, V: Vector, R: Summation, N: Solver<V, S>> fmt::Debug
    for States<'_, M, S, V, R, N>
{
    fn fmt(&self, formatter: &mut fmt::Formatter<'_>) -> fmt::Result {
        formatter
            .debug_struct("States")
            .field("integrator", self.integrator)
            .field("stride", &self.stride)
            .field("failed", &self.failed)
            .finish()
    }
}
