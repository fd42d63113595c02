//! Output at given times.

use core::convert::Infallible;
use core::ops::ControlFlow;

use crate::error::Error;
use crate::integrator::clock::check_count;
use crate::integrator::{DenseSteps, Own, Pace, Reach, Run};

impl<S: DenseSteps> Run<S> {
    /// Steps past the last of `times` and calls `observe` with the state at each of them, in order.
    ///
    /// The step size does not depend on the output times. States inside a step are interpolated, or those of a shorter step. The first time
    /// may be the present time or lie in the last step. With a negative step size the times decrease.
    ///
    /// # Errors
    ///
    /// [`Error::OutputTime`] for the first time that is not finite, precedes its predecessor or precedes the last step;
    /// [`Error::StepCount`] for too many steps. Both are returned before any step is taken. Also the errors of
    /// [`step`](Self::step) and of its dense output; the state is then that of the last successful step.
    ///
    /// ```
    /// symplectic::tableau! { Gauss4 { basis: polynomial(4), nodes: gauss(4) } }
    /// # use symplectic::nalgebra::Vector1;
    /// # use symplectic::{Error, Integrator, State, acceleration};
    /// # fn main() -> Result<(), Error> {
    /// let oscillator = acceleration::<Vector1<f64>, _>(|_, q, acceleration| *acceleration = -q);
    /// let start = State::new(0.0, Vector1::new(1.0), Vector1::new(0.0));
    /// let mut integrator = Integrator::new(Gauss4, oscillator, start, 0.25)?;
    /// let mut found = Vec::new();
    /// integrator.integrate_at(&[0.0, 0.1, 0.2, 1.1], |state| found.push((state.time, state.q[0])))?;
    /// for (time, q) in found {
    ///     assert!((q - time.cos()).abs() < 1e-6);
    /// }
    /// assert_eq!((integrator.state().time, integrator.steps()), (1.25, 5));
    /// # Ok(())
    /// # }
    /// ```
    pub fn integrate_at<F: FnMut(&S::State)>(
        &mut self,
        times: &[f64],
        mut observe: F,
    ) -> Result<&S::State, S::Error> {
        self.check_times(times)?;
        let mut rest = times;
        let mut output = Output::new(&self.stepper, self.step_size());
        output.by_steps = self.output_by_steps;
        output.show(&mut self.stepper, &mut rest, &mut observe)?;
        while let Some(&time) = rest.first() {
            if !S::Pace::OWN {
                self.take_most_before(time)?;
            }
            self.step_shown_to(|stepper| output.show(stepper, &mut rest, &mut observe))?;
        }
        Ok(self.state())
    }

    /// The state at a time within the last step, exact to the bit at both ends.
    ///
    /// # Errors
    ///
    /// [`Error::NoStep`] before the first step and after every call that discards it, such as a new state or a failed step;
    /// [`Error::OutsideStep`]; those of the dense output of the stepper.
    pub fn state_at(&mut self, time: f64) -> Result<S::State, S::Error> {
        let mut output = Output::new(&self.stepper, self.step_size());
        output.look_at(&mut self.stepper, time)?;
        Ok(output.state)
    }

    /// Checks the times of [`integrate_at`](Self::integrate_at).
    #[doc(hidden)]
    pub fn check_times(&self, times: &[f64]) -> Result<(), Error> {
        let end = check_times(self.step_size(), times, self.start_of_last_step(), None)?;
        match S::Pace::OWN {
            // The number of steps is not known in advance.
            true => Ok(()),
            false => check_count(self.stepper.time(), end, self.step_size),
        }
    }

    /// Takes the steps to `end`, or all up to the one that reaches or passes it if the stepper has its own pace. Calls `observe` with the
    /// state after each.
    #[doc(hidden)]
    pub fn watch_to(
        &mut self,
        end: f64,
        mut observe: impl FnMut(&S::State),
    ) -> Result<(), S::Error> {
        if !S::Pace::OWN {
            let ended = self.steps_to(end, |run, size, time| {
                run.advance(size, time)?;
                observe(run.state());
                Ok(ControlFlow::<Infallible>::Continue(()))
            });
            return ended.map(|_| ());
        }
        let before = self.start_of_last_step();
        if !end.is_finite() || is_after(self.step_size(), before, end) {
            return Err(Error::OutputTime { time: end, before }.into());
        }
        while self.is_before(end) {
            observe(self.step()?);
        }
        Ok(())
    }

    /// Whether `end` comes after the present time in the direction of the steps.
    pub(crate) fn is_before(&self, end: f64) -> bool {
        is_after(self.step_size(), end, self.stepper.time())
    }

    /// Start time of the last step; the present time if there is no last step or it went in the other direction.
    pub(crate) fn start_of_last_step(&self) -> f64 {
        let present = self.stepper.time();
        match self.stepper.last_span() {
            Some((start, _)) if is_after(self.step_size(), present, start) => start,
            _ => present,
        }
    }
}

impl<S: DenseSteps<Pace = Self>> Reach<S> for Own {
    type Reached<'a>
        = S::State
    where
        S: 'a;

    fn integrate_with(
        run: &mut Run<S>,
        end: f64,
        observe: impl FnMut(&S::State),
    ) -> Result<S::State, S::Error> {
        run.watch_to(end, observe)?;
        let mut state = run.state().clone();
        if end != state.time {
            let mut scratch = run.stepper.scratch();
            run.stepper.look_by_step(end, &mut scratch, &mut state)?;
        }
        Ok(state)
    }
}

/// Whether `time` comes after `other` in the direction whose sign `direction` has.
#[inline]
pub fn is_after(direction: f64, time: f64, other: f64) -> bool {
    if direction.is_sign_positive() {
        time > other
    } else {
        time < other
    }
}

/// Checks that the times are finite and ordered, from `before` to `end`, and returns the last of them.
pub(crate) fn check_times(
    direction: f64,
    times: &[f64],
    mut before: f64,
    end: Option<f64>,
) -> Result<f64, Error> {
    for &time in times {
        if !time.is_finite() || is_after(direction, before, time) {
            return Err(Error::OutputTime { time, before });
        }
        if let Some(end) = end
            && is_after(direction, time, end)
        {
            return Err(Error::OutputAfterEnd { time, end });
        }
        before = time;
    }
    Ok(before)
}

/// Storage for states inside a step.
pub struct Output<S: DenseSteps> {
    scratch: S::Scratch,
    /// Whether `scratch` is prepared for the last step.
    pub evaluated: bool,
    /// The state inside the last step.
    pub state: S::State,
    /// The sign of the step size.
    direction: f64,
    /// Whether output inside the last step is [by a step](Self::look_by_step).
    pub by_steps: bool,
}

impl<S: DenseSteps> Output<S> {
    /// Storage for states like the present one; `direction` has the sign of the step size.
    pub fn new(stepper: &S, direction: f64) -> Self {
        Self {
            scratch: stepper.scratch(),
            evaluated: false,
            state: stepper.state().clone(),
            direction,
            by_steps: false,
        }
    }

    /// Whether `time` comes after `other` in the direction of the steps.
    pub fn is_after(&self, time: f64, other: f64) -> bool {
        is_after(self.direction, time, other)
    }

    /// Sets `state` to the state at a time inside the last step.
    #[cfg_attr(not(debug_assertions), inline(always))]
    pub fn look_at(&mut self, stepper: &mut S, time: f64) -> Result<(), S::Error> {
        if !self.evaluated {
            stepper.prepare(&mut self.scratch)?;
            self.evaluated = true;
        }
        stepper.look(time, &mut self.scratch, &mut self.state)
    }

    /// [`look_at`](Self::look_at) by a step of the method.
    pub fn look_by_step(&mut self, stepper: &mut S, time: f64) -> Result<(), S::Error> {
        stepper.look_by_step(time, &mut self.scratch, &mut self.state)
    }

    /// [`look_at`](Self::look_at), or by a step of the method if output is by steps.
    pub fn look_for_output(&mut self, stepper: &mut S, time: f64) -> Result<(), S::Error> {
        match self.by_steps {
            true => self.look_by_step(stepper, time),
            false => self.look_at(stepper, time),
        }
    }

    /// Observes the states at the output times up to the present time and removes these times from the list.
    pub fn show(
        &mut self,
        stepper: &mut S,
        times: &mut &[f64],
        observe: &mut impl FnMut(&S::State),
    ) -> Result<(), S::Error> {
        self.evaluated = false;
        while let Some((&time, rest)) = times.split_first() {
            let present = stepper.time();
            if self.is_after(time, present) {
                break;
            }
            if time == present {
                observe(stepper.state());
            } else {
                self.look_for_output(stepper, time)?;
                observe(&self.state);
            }
            *times = rest;
        }
        Ok(())
    }
}
