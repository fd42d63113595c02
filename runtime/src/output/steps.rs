//! What takes the steps that are seen.

use core::ops::ControlFlow;

use crate::error::Error;
use crate::integrator::Integrator;
use crate::integrator::clock::check_count;
use crate::integrator::last_event::LastEvent;
use crate::method::{Method, Solver};
use crate::number::{Summation, Vector};
use crate::state::State;
use crate::system::System;

/// An integrator with steps of one size, or one that chooses their sizes.
pub(crate) trait Steps<M, S, V, R, N>
where
    M: Method,
    S: System<V>,
    V: Vector,
    R: Summation,
    N: Solver<V, S>,
{
    /// The integrator, for its state and its last step.
    fn integrator(&self) -> &Integrator<M, S, V, R, N>;

    /// About the size of the next step on the way to `end`.
    fn size_to(&self, end: f64) -> f64;

    /// The sign of the step size.
    fn direction(&self) -> f64;

    /// Whether `time` comes after `other` in the direction of the steps.
    fn is_after(&self, time: f64, other: f64) -> bool {
        is_after(self.direction(), time, other)
    }

    /// The start of the last step, or the present time where there is none, or where the last step went the other way.
    fn start_of_last_step(&self) -> f64 {
        let present = self.integrator().state().time;
        match self.integrator().last_step() {
            Some(last) if self.is_after(present, last.start) => last.start,
            _ => present,
        }
    }

    /// The earliest output time of a run to an end: the present time, or the start of the last step where that may go beyond the end.
    fn first_output(&self) -> f64;

    /// Checks that steps to `end` can be counted.
    fn check_count(&self, end: f64) -> Result<(), Error>;

    /// One step, the parts of which are shown to `see`.
    fn step_in_sight(
        &mut self,
        see: impl FnMut(&Integrator<M, S, V, R, N>) -> Result<(), Error>,
    ) -> Result<(), Error>;

    /// The steps to `end`, the parts of which are shown to `see` until it breaks.
    fn steps_in_sight<B>(
        &mut self,
        end: f64,
        see: impl FnMut(&Integrator<M, S, V, R, N>) -> Result<ControlFlow<B>, Error>,
    ) -> Result<ControlFlow<B>, Error>;

    /// Puts another state in place of the present one, without an allocation.
    fn replace_state(&mut self, state: &State<V>) -> Result<(), Error>;

    /// Keeps the event that was found last.
    fn keep_last_event(&mut self, event: Option<LastEvent>);
}

impl<M, S, V, R, N> Steps<M, S, V, R, N> for Integrator<M, S, V, R, N>
where
    M: Method,
    S: System<V>,
    V: Vector,
    R: Summation,
    N: Solver<V, S>,
{
    fn integrator(&self) -> &Self {
        self
    }

    fn size_to(&self, end: f64) -> f64 {
        self.step_size().abs().copysign(end - self.state().time)
    }

    fn direction(&self) -> f64 {
        self.step_size()
    }

    fn first_output(&self) -> f64 {
        self.state().time
    }

    fn check_count(&self, end: f64) -> Result<(), Error> {
        check_count(self.state().time, end, self.step_size())
    }

    fn step_in_sight(&mut self, see: impl FnMut(&Self) -> Result<(), Error>) -> Result<(), Error> {
        self.step_shown_to(see)
    }

    fn steps_in_sight<B>(
        &mut self,
        end: f64,
        mut see: impl FnMut(&Self) -> Result<ControlFlow<B>, Error>,
    ) -> Result<ControlFlow<B>, Error> {
        self.steps_to(end, |integrator, next| {
            integrator.advance_in_sight(next.size, next.time, &mut see)
        })
    }

    fn replace_state(&mut self, state: &State<V>) -> Result<(), Error> {
        self.copy_state(state)
    }

    fn keep_last_event(&mut self, event: Option<LastEvent>) {
        self.set_last_event(event);
    }
}

/// Whether `time` comes after `other` in a direction.
pub(crate) fn is_after(direction: f64, time: f64, other: f64) -> bool {
    if direction > 0.0 {
        time > other
    } else {
        time < other
    }
}
