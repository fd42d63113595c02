//! Steps of constant or variable size, as dense output and events use them.

use core::ops::ControlFlow;

use crate::error::Error;
use crate::integrator::clock::check_count;
use crate::integrator::last_step::LastEvent;
use crate::integrator::sight::Sight;
use crate::integrator::{Integrator, Partitioned};
use crate::method::{Method, Solver};
use crate::number::{Summation, Vector};
use crate::state::State;
use crate::system::System;

/// An integrator with constant or variable step size.
pub(crate) trait Steps<M, S, V, R, N>
where
    M: Method,
    S: System<V>,
    V: Vector,
    R: Summation,
    N: Solver<V, S>,
{
    /// The underlying integrator, which holds the state and the last step.
    fn integrator(&self) -> &Integrator<M, S, V, R, N>;

    /// Approximate size of the next step towards `end`.
    fn size_to(&self, end: f64) -> f64;

    /// The sign of the step size.
    fn direction(&self) -> f64;

    /// Whether `time` comes after `other` in the direction of the steps.
    fn is_after(&self, time: f64, other: f64) -> bool {
        is_after(self.direction(), time, other)
    }

    /// Start time of the last step; the present time if there is no last step or it went in the other direction.
    fn start_of_last_step(&self) -> f64 {
        let present = self.integrator().state().time;
        match self.integrator().last_step() {
            Some(last) if self.is_after(present, last.start) => last.start,
            _ => present,
        }
    }

    /// Earliest output time of a run to an end time. If a run may step beyond its end time, it is the start of the last step; otherwise it
    /// is the present time.
    fn first_output(&self) -> f64;

    /// Checks that the number of steps to `end` is small enough to count.
    fn check_count(&self, end: f64) -> Result<(), Error>;

    /// Takes most of the steps that end before `time`.
    fn steps_before(&mut self, time: f64) -> Result<(), Error>;

    /// Takes one step and calls `see` after each part of it.
    fn step_in_sight(
        &mut self,
        see: impl FnMut(&Integrator<M, S, V, R, N>) -> Result<(), Error>,
    ) -> Result<(), Error>;

    /// Steps to `end` in sight of `sight`, until it breaks.
    fn steps_in_sight<B>(
        &mut self,
        end: f64,
        sight: &mut impl Sight<Partitioned<M, S, V, R, N>, B>,
    ) -> Result<ControlFlow<B>, Error>;

    /// Replaces the present state, without an allocation.
    fn replace_state(&mut self, state: &State<V>) -> Result<(), Error>;

    /// Stores the last event found.
    fn keep_last_event(&mut self, event: Option<LastEvent>);
}

impl<M: Method, S: System<V>, V: Vector, R: Summation, N: Solver<V, S>> Steps<M, S, V, R, N>
    for Integrator<M, S, V, R, N>
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

    fn steps_before(&mut self, time: f64) -> Result<(), Error> {
        self.take_most_before(time)
    }

    fn step_in_sight(&mut self, see: impl FnMut(&Self) -> Result<(), Error>) -> Result<(), Error> {
        self.step_shown_to(see)
    }

    fn steps_in_sight<B>(
        &mut self,
        end: f64,
        sight: &mut impl Sight<Partitioned<M, S, V, R, N>, B>,
    ) -> Result<ControlFlow<B>, Error> {
        self.integrate_in_sight(end, sight)
    }

    fn replace_state(&mut self, state: &State<V>) -> Result<(), Error> {
        self.copy_state(state)
    }

    fn keep_last_event(&mut self, event: Option<LastEvent>) {
        self.last_event = event;
    }
}

/// Whether `time` comes after `other` in the direction whose sign `direction` has.
pub(crate) fn is_after(direction: f64, time: f64, other: f64) -> bool {
    if direction > 0.0 {
        time > other
    } else {
        time < other
    }
}
