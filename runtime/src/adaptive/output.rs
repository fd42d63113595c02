//! Output of a run with steps of variable size.

use core::ops::ControlFlow;

use super::integrator::Adaptive;
use super::monitor::Monitor;
use crate::error::Error;
use crate::integrator::last_step::LastEvent;
use crate::integrator::partial_step::PartialSteps;
use crate::integrator::sight::Sight;
use crate::integrator::{Integrator, Partitioned};
use crate::method::{Method, Solver};
use crate::number::{Summation, Vector};
use crate::output::at_times::integrate_at;
use crate::output::event::run::integrate_through;
use crate::output::steps::Steps;
use crate::output::{Event, Events, Moment};
use crate::state::State;
use crate::system::System;

impl<M, S, W, V, R, N> Adaptive<M, S, W, V, R, N>
where
    M: Method,
    S: System<V>,
    W: Monitor,
    V: Vector<Scalar = f64>,
    R: Summation,
    N: Solver<V, S>,
{
    /// Takes steps until `end` is reached or passed, and returns the state at `end`. If `end` is inside the last step, a shorter step from
    /// its start gives that state. The present state is that after the last step, so the step sizes do not depend on `end`.
    ///
    /// If `end` is already inside the last step, no step is taken.
    ///
    /// # Errors
    ///
    /// [`Error::OutputTime`] if `end` is not finite, or before the start of the last step in the direction of the run. Those of
    /// [`step`](Self::step); the state is then that after the last successful step.
    pub fn integrate_to(&mut self, end: f64) -> Result<State<V>, Error> {
        self.integrate_with(end, |_| ())
    }

    /// Like [`integrate_to`](Self::integrate_to), and calls `observe` with the state after every step.
    ///
    /// # Errors
    ///
    /// As for [`integrate_to`](Self::integrate_to).
    pub fn integrate_with<F: FnMut(&State<V>)>(
        &mut self,
        end: f64,
        mut observe: F,
    ) -> Result<State<V>, Error> {
        let before = self.start_of_last_step();
        if !end.is_finite() || self.is_after(before, end) {
            return Err(Error::OutputTime { time: end, before });
        }
        while self.is_after(end, self.state().time) {
            self.advance()?;
            observe(self.state());
        }
        let mut state = self.state().clone();
        if end != state.time {
            PartialSteps::of(&self.integrator).take(&self.integrator, end, &mut state)?;
        }
        Ok(state)
    }

    /// Takes steps until all `times` are reached or passed, and calls `observe` with the state at each of them: see
    /// [`Integrator::integrate_at`].
    ///
    /// # Errors
    ///
    /// Those of [`Integrator::integrate_at`] and of [`step`](Self::step).
    ///
    /// ```
    /// use symplectic::adaptive::DistancePower;
    /// use symplectic::nalgebra::Vector2;
    /// use symplectic::{Error, Integrator, State, acceleration};
    ///
    /// symplectic::tableau! { VelocityVerlet { base: velocity-verlet } }
    ///
    /// # fn main() -> Result<(), Error> {
    /// let kepler = acceleration(|_time, q: &Vector2<f64>, acceleration| *acceleration = -q / q.norm().powi(3));
    /// let start = State::from_arrays(0.0, [0.1, 0.0], [0.0, 19_f64.sqrt()]);
    /// let mut run = Integrator::adaptive(VelocityVerlet, kepler, DistancePower(1.5), start, 0.01)?;
    /// let mut distances = Vec::new();
    /// run.integrate_at(&[0.0, 1.0, 2.0, 3.0], |state| distances.push(state.q.norm()))?;
    /// // On the way to the apocentre at 1.9.
    /// assert!(distances.is_sorted() && (distances[3] - 1.9).abs() < 0.02);
    /// # Ok(())
    /// # }
    /// ```
    pub fn integrate_at<F: FnMut(&State<V>)>(
        &mut self,
        times: &[f64],
        mut observe: F,
    ) -> Result<&State<V>, Error> {
        integrate_at(self, times, &mut observe)?;
        Ok(self.state())
    }

    /// Takes steps until `end` is reached or passed, and calls `observe` with the state at every event: see
    /// [`Integrator::integrate_with_events`]. Events of the last step are reported even after `end`, so that a continued run misses none.
    /// The search starts from the present state. After [`integrate_to`](Self::integrate_to) and [`integrate_at`](Self::integrate_at) that
    /// state may be later than the end or the last output time.
    ///
    /// # Errors
    ///
    /// Those of [`Integrator::integrate_with_events`] and of [`step`](Self::step); [`Error::OutputTime`] if `end` is before the start of
    /// the last step in the direction of the run.
    pub fn integrate_with_events<G, B, F>(
        &mut self,
        end: f64,
        event: &Event<G>,
        mut observe: F,
    ) -> Result<Option<B>, Error>
    where
        G: Fn(&State<V>) -> f64,
        F: FnMut(&State<V>) -> ControlFlow<B>,
    {
        self.integrate_through(end, &[], event, |moment| match moment {
            Moment::Event { state, .. } => observe(state),
            Moment::Output(_) => ControlFlow::Continue(()),
        })
    }

    /// The state at the first event, if there is one up to the end of the step that reaches or passes `end`: see
    /// [`Integrator::find_event`].
    ///
    /// # Errors
    ///
    /// As for [`integrate_with_events`](Self::integrate_with_events).
    ///
    /// ```
    /// use symplectic::adaptive::DistancePower;
    /// use symplectic::nalgebra::Vector2;
    /// use symplectic::{Error, Event, Integrator, State, acceleration};
    ///
    /// symplectic::tableau! { VelocityVerlet { base: velocity-verlet } }
    ///
    /// # fn main() -> Result<(), Error> {
    /// let kepler = acceleration(|_time, q: &Vector2<f64>, acceleration| *acceleration = -q / q.norm().powi(3));
    /// let start = State::from_arrays(0.0, [0.1, 0.0], [0.0, 19_f64.sqrt()]);
    /// let mut run = Integrator::adaptive(VelocityVerlet, kepler, DistancePower(1.5), start, 0.01)?;
    /// let apocentre = Event::falling(|state: &State<Vector2<f64>>| state.q.dot(&state.p)).by_steps();
    /// let state = run.find_event(10.0, &apocentre)?.expect("an apocentre");
    /// assert!((state.q.norm() - 1.9).abs() < 1e-3);
    /// # Ok(())
    /// # }
    /// ```
    pub fn find_event<G: Fn(&State<V>) -> f64>(
        &mut self,
        end: f64,
        event: &Event<G>,
    ) -> Result<Option<State<V>>, Error> {
        self.integrate_with_events(end, event, |state| ControlFlow::Break(state.clone()))
    }

    /// Takes steps until `end` is reached or passed, and calls `handle` with the states at output times and at the events of a list: see
    /// [`Integrator::integrate_through`]. The first output times may lie inside the last step. When the run continues from a changed state,
    /// or from a wall, the step density becomes 1/σ there.
    ///
    /// # Errors
    ///
    /// Those of [`Integrator::integrate_through`] and of [`step`](Self::step); [`Error::OutputTime`] if `end` is before the start of the
    /// last step in the direction of the run.
    pub fn integrate_through<E, B, F>(
        &mut self,
        end: f64,
        times: &[f64],
        events: &E,
        mut handle: F,
    ) -> Result<Option<B>, Error>
    where
        E: Events<V> + ?Sized,
        F: FnMut(Moment<'_, V>) -> ControlFlow<B>,
    {
        if !end.is_finite() {
            return Err(Error::EndTime { value: end });
        }
        integrate_through(self, end, times, events, &mut handle)
    }
}

impl<M, S, W, V, R, N> Steps<M, S, V, R, N> for Adaptive<M, S, W, V, R, N>
where
    M: Method,
    S: System<V>,
    W: Monitor,
    V: Vector<Scalar = f64>,
    R: Summation,
    N: Solver<V, S>,
{
    fn integrator(&self) -> &Integrator<M, S, V, R, N> {
        &self.integrator
    }

    /// The controller alone sets the step size, whatever the end time.
    fn size_to(&self, _end: f64) -> f64 {
        self.step_size()
    }

    fn direction(&self) -> f64 {
        self.epsilon()
    }

    fn first_output(&self) -> f64 {
        self.start_of_last_step()
    }

    /// The number of steps is not known in advance.
    fn check_count(&self, _end: f64) -> Result<(), Error> {
        Ok(())
    }

    /// Every step has its own size.
    fn steps_before(&mut self, _time: f64) -> Result<(), Error> {
        Ok(())
    }

    fn step_in_sight(
        &mut self,
        mut see: impl FnMut(&Integrator<M, S, V, R, N>) -> Result<(), Error>,
    ) -> Result<(), Error> {
        self.advance()?;
        see(&self.integrator)
    }

    fn steps_in_sight<B>(
        &mut self,
        end: f64,
        sight: &mut impl Sight<Partitioned<M, S, V, R, N>, B>,
    ) -> Result<ControlFlow<B>, Error> {
        while self.is_after(end, self.state().time) {
            self.advance()?;
            let seen = sight.see_or_pass(&self.integrator)?;
            if seen.is_break() {
                return Ok(seen);
            }
        }
        Ok(ControlFlow::Continue(()))
    }

    fn replace_state(&mut self, state: &State<V>) -> Result<(), Error> {
        self.copy_state(state)
    }

    fn keep_last_event(&mut self, event: Option<LastEvent>) {
        self.integrator.last_event = event;
    }
}
