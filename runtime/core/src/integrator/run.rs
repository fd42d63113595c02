//! The run of a stepper: step size, times of steps, and the reaction to a failed step.

use core::convert::Infallible;
use core::fmt;
use core::ops::ControlFlow;

use super::clock::{Clock, RemainingSteps, check_count};
use super::last_step::LastEvent;
use super::sight::Sight;
use super::stepper::advance_in_time;
use super::validation::check_step_size;
use super::{Equal, Pace, Retry, Statistics, Stepper};
use crate::error::Error;

/// A [`Stepper`] that steps from a state. All integrators of this library are runs.
///
/// A step allocates nothing. A step that fails leaves the state and the counts unchanged.
///
/// The run chooses equal steps unless the stepper has its [own](super::Own) pace. The time after `k` steps is computed as `start + k h`, not
/// as a sum. The count starts again when the step size or the state is set and when [`integrate_to`](crate::Integrator#method.integrate_to)
/// ends.
#[derive(Clone)]
pub struct Run<S> {
    pub(crate) stepper: S,
    pub(crate) clock: Clock,
    pub(crate) step_size: f64,
    pub(crate) retry: Retry,
    pub(crate) last_event: Option<LastEvent>,
    pub(crate) output_by_steps: bool,
}

impl<S: Stepper> Run<S> {
    /// A run of a stepper from its present state. A negative `step_size` steps backward; a stepper with its [own](super::Own) pace ignores it.
    ///
    /// # Errors
    ///
    /// [`Error::StepSize`].
    pub fn of(stepper: S, step_size: f64) -> Result<Self, Error> {
        check_step_size(step_size)?;
        Ok(Self {
            clock: Clock::new(stepper.time(), step_size),
            step_size,
            retry: Retry::Never,
            last_event: None,
            output_by_steps: false,
            stepper,
        })
    }

    /// Takes one step and returns the state after it.
    ///
    /// # Errors
    ///
    /// Those of the method, and [`Error::TimeResolution`]; the state is then unchanged.
    pub fn step(&mut self) -> Result<&S::State, S::Error> {
        self.advance(self.step_size, self.clock.next())?;
        self.clock.tick();
        Ok(self.stepper.state())
    }

    /// Takes `count` steps and returns the state after them. The result equals that of `count` calls of [`step`](Self::step) to the last
    /// bit, but it is faster for splittings and for short vectors.
    ///
    /// # Errors
    ///
    /// Those of [`step`](Self::step); the state is then that after the last successful step. [`Error::StepCount`] for 2⁵³ steps or more.
    ///
    /// ```
    /// symplectic::tableau! { StoermerVerlet { basis: polynomial(2), nodes: lobatto(2) } }
    /// # use symplectic::nalgebra::Vector1;
    /// # use symplectic::{Error, Integrator, State, acceleration};
    /// # fn main() -> Result<(), Error> {
    /// let oscillator = || acceleration::<Vector1<f64>, _>(|_, q, acceleration| *acceleration = -q);
    /// let start = State::new(0.0, Vector1::new(1.0), Vector1::new(0.0));
    /// let mut at_once = Integrator::new(StoermerVerlet, oscillator(), start.clone(), 0.125)?;
    /// let mut one_by_one = Integrator::new(StoermerVerlet, oscillator(), start, 0.125)?;
    /// for _ in 0..1000 {
    ///     one_by_one.step()?;
    /// }
    /// assert_eq!(at_once.take_steps(1000)?, one_by_one.state());
    /// # Ok(())
    /// # }
    /// ```
    pub fn take_steps(&mut self, count: u64) -> Result<&S::State, S::Error> {
        let (time, size) = (self.stepper.time(), self.step_size);
        check_count(time, time + size * count as f64, size)?;
        let mut remaining = self.steps_left(count);
        let outcome = self.take_remaining(&mut remaining);
        self.clock = remaining.clock;
        outcome.map(|()| self.stepper.state())
    }

    /// Calls `take` with the size and the end of each step of [`integrate_to`](Self::integrate_to), until it breaks.
    #[inline]
    pub(crate) fn steps_to<B>(
        &mut self,
        end: f64,
        mut take: impl FnMut(&mut Self, f64, f64) -> Result<ControlFlow<B>, S::Error>,
    ) -> Result<ControlFlow<B>, S::Error> {
        let mut remaining = self.steps_to_time(end)?;
        let mut outcome = Ok(ControlFlow::Continue(()));
        while let Some((size, time)) = remaining.next_step() {
            outcome = take(self, size, time);
            if !matches!(outcome, Ok(ControlFlow::Continue(()))) {
                break;
            }
        }
        self.restart_clock();
        outcome
    }

    /// Takes one step as [`step`](Self::step) does, and calls `see` after each of its parts.
    pub(crate) fn step_shown_to(
        &mut self,
        mut see: impl FnMut(&mut S) -> Result<(), S::Error>,
    ) -> Result<(), S::Error> {
        let (size, time) = (self.step_size, self.clock.next());
        let outcome = self.advance_in_sight(size, time, &mut |stepper| {
            see(stepper)?;
            Ok(ControlFlow::<Infallible>::Continue(()))
        });
        match outcome {
            Ok(_) => self.clock.tick(),
            Err(_) => self.restart_clock(),
        }
        outcome.map(|_| ())
    }

    /// Takes steps in blocks, all or all but a few of those that end before `time`.
    pub(crate) fn take_most_before(&mut self, time: f64) -> Result<(), S::Error> {
        // The quotient is wrong by rounding.
        let whole = (time - self.stepper.time()) / self.step_size - 2.0;
        if whole < 2.0 {
            return Ok(());
        }
        let outcome = self.take_steps(whole as u64).map(|_| ());
        if outcome.is_err() {
            self.restart_clock();
        }
        outcome
    }

    /// Takes one step of size `size` to the time `time`, split if it has to be. The caller advances the clock.
    #[doc(hidden)]
    #[inline]
    pub fn advance(&mut self, size: f64, time: f64) -> Result<(), S::Error> {
        match advance_in_time(&mut self.stepper, size, time) {
            Ok(()) => Ok(()),
            Err(error) => self.take_again(size, time, error).map(|_| ()),
        }
    }

    /// [`advance`](Self::advance) that calls `see` after the step until it breaks; after each part if the step has to be split.
    #[doc(hidden)]
    #[inline]
    pub fn advance_in_sight<B>(
        &mut self,
        size: f64,
        time: f64,
        see: &mut impl FnMut(&mut S) -> Result<ControlFlow<B>, S::Error>,
    ) -> Result<ControlFlow<B>, S::Error> {
        match advance_in_time(&mut self.stepper, size, time) {
            Ok(()) => see(&mut self.stepper),
            Err(error) => self.take_again_in_sight(size, time, error, see),
        }
    }

    /// Repeats the next step, which failed with `error`, in parts.
    #[cold]
    pub(crate) fn take_next_again(
        &mut self,
        remaining: &mut RemainingSteps,
        error: S::Error,
    ) -> Result<(), S::Error> {
        self.take_again(remaining.size, remaining.next_time(), error)?;
        remaining.tick();
        Ok(())
    }

    /// Takes one step, never split.
    #[doc(hidden)]
    pub fn step_at_once(&mut self) -> Result<(), S::Error> {
        advance_in_time(&mut self.stepper, self.step_size, self.clock.next())?;
        self.clock.tick();
        Ok(())
    }

    /// The steps of [`take_steps`](Self::take_steps).
    #[doc(hidden)]
    pub const fn steps_left(&self, count: u64) -> RemainingSteps {
        RemainingSteps {
            left: count,
            size: self.step_size,
            clock: self.clock,
            end: None,
            alone: 0,
        }
    }

    /// The steps of [`integrate_to`](Self::integrate_to).
    #[doc(hidden)]
    pub fn steps_to_time(&self, end: f64) -> Result<RemainingSteps, Error> {
        RemainingSteps::between(self.stepper.time(), end, self.step_size)
    }

    /// Takes all remaining steps.
    #[doc(hidden)]
    #[inline]
    pub fn take_remaining(&mut self, remaining: &mut RemainingSteps) -> Result<(), S::Error> {
        while let Err(error) = self.stepper.take(remaining) {
            self.take_next_again(remaining, error)?;
        }
        Ok(())
    }

    /// [`integrate_to`](Self::integrate_to) in sight of `sight`, until it breaks.
    pub(crate) fn integrate_in_sight<B>(
        &mut self,
        end: f64,
        sight: &mut impl Sight<S, B>,
    ) -> Result<ControlFlow<B>, S::Error> {
        let mut remaining = self.steps_to_time(end)?;
        let outcome = self.take_in_sight(&mut remaining, sight);
        self.restart_clock();
        outcome
    }

    /// Takes the remaining steps in sight of `sight`, until it breaks.
    fn take_in_sight<B>(
        &mut self,
        remaining: &mut RemainingSteps,
        sight: &mut impl Sight<S, B>,
    ) -> Result<ControlFlow<B>, S::Error> {
        let mut seen = ControlFlow::Continue(());
        while remaining.left > 0 && seen.is_continue() {
            let passes = |state: &_, statistics: &_| sight.passes(state, statistics);
            match self.stepper.take_while(remaining, passes) {
                Ok(true) => return Ok(ControlFlow::Continue(())),
                Ok(false) => seen = sight.see(&mut self.stepper)?,
                Err(error) => {
                    let (size, time) = (remaining.size, remaining.next_time());
                    let mut see = |stepper: &mut _| sight.see_or_pass(stepper);
                    seen = self.take_again_in_sight(size, time, error, &mut see)?;
                    remaining.tick();
                }
            }
        }
        Ok(seen)
    }

    /// The present state, rounded.
    pub fn state(&self) -> &S::State {
        self.stepper.state()
    }

    /// Whether a state at an output time inside a step is that of a step of the method from the start of the step, which has the order of the
    /// method, and not that of the dense output. Such an output costs about as much as a step. The default is `false`.
    pub const fn set_output_by_steps(&mut self, by_steps: bool) {
        self.output_by_steps = by_steps;
    }

    /// Replaces the present state by another one of the same dimension. The next step is that of a new run from there.
    ///
    /// # Errors
    ///
    /// Those of a new run, for example [`Error::Dimension`] and [`Error::NonFiniteState`]; the state is then unchanged.
    pub fn set_state(&mut self, state: S::State) -> Result<(), S::Error> {
        self.copy_state(&state)
    }

    /// [`set_state`](Self::set_state) by a copy.
    #[doc(hidden)]
    pub fn copy_state(&mut self, state: &S::State) -> Result<(), S::Error> {
        self.stepper.set_state(state)?;
        self.restart_clock();
        Ok(())
    }

    /// Returns the present state and drops the run.
    pub fn into_state(self) -> S::State {
        self.stepper.into_state()
    }

    /// The statistics of all steps so far.
    pub fn statistics(&self) -> &Statistics {
        self.stepper.statistics()
    }

    /// The step size. If the stepper has its [own](super::Own) pace: about the size of the next step, negative in a run backward.
    pub fn step_size(&self) -> f64 {
        let own = S::Pace::OWN.then(|| self.stepper.own_step_size());
        own.flatten().unwrap_or(self.step_size)
    }

    /// Number of steps taken.
    pub fn steps(&self) -> u64 {
        self.stepper.statistics().steps
    }

    /// The stepper.
    pub const fn stepper(&self) -> &S {
        &self.stepper
    }

    /// The stepper, to change it. The time of its state must stay: the run counts equal steps from there, and [`set_state`](Self::set_state)
    /// begins anew.
    pub const fn stepper_mut(&mut self) -> &mut S {
        &mut self.stepper
    }

    pub(crate) fn restart_clock(&mut self) {
        self.clock = Clock::new(self.stepper.time(), self.step_size);
    }
}

impl<S: Stepper<Pace = Equal>> Run<S> {
    /// Changes the step size; negative to go backward.
    ///
    /// # Errors
    ///
    /// [`Error::StepSize`]; the step size is then unchanged.
    pub fn set_step_size(&mut self, step_size: f64) -> Result<(), Error> {
        check_step_size(step_size)?;
        self.step_size = step_size;
        self.restart_clock();
        Ok(())
    }

    /// Sets the reaction to a failed step; the default is [`Retry::Never`]. It has no effect if the stepper refuses to be
    /// [split](Stepper::may_split), as a flow does.
    ///
    /// ```
    /// symplectic::tableau! { Midpoint { basis: polynomial(1), nodes: gauss(1) } }
    /// # use symplectic::nalgebra::Vector2;
    /// # use symplectic::{Error, Integrator, Retry, State, separable};
    /// # fn main() -> Result<(), Error> {
    /// let kepler = separable(
    ///     |_time, p: &Vector2<f64>, velocity| *velocity = *p,
    ///     |_time, q, force| *force = -q / q.norm().powi(3),
    /// );
    /// // From the apocentre of an orbit with eccentricity 0.99; at the pericentre steps of 1/16 do not converge.
    /// let start = State::new(0.0, Vector2::new(1.99, 0.0), Vector2::new(0.0, (0.01_f64 / 1.99).sqrt()));
    /// let mut integrator = Integrator::new(Midpoint, kepler, start, 0.0625)?;
    /// integrator.set_retry(Retry::Split { halvings: 8 });
    /// integrator.integrate_to(6.0)?;
    /// assert!(integrator.statistics().rejected > 0);
    /// # Ok(())
    /// # }
    /// ```
    pub const fn set_retry(&mut self, retry: Retry) {
        self.retry = retry;
    }
}

impl<S: fmt::Debug> fmt::Debug for Run<S> {
    fn fmt(&self, formatter: &mut fmt::Formatter<'_>) -> fmt::Result {
        formatter
            .debug_struct("Run")
            .field("stepper", &self.stepper)
            .field("step_size", &self.step_size)
            .finish_non_exhaustive()
    }
}
