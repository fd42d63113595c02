//! Steps of one size, for integrators that manage their state themselves.

use super::clock::{Clock, RemainingSteps};
use super::validation::check_step_size;
use crate::error::Error;
use crate::number::words::{Visit, Words, words};

/// The step size, the times of the steps, and their number.
#[derive(Clone, Copy, Debug)]
pub(crate) struct StepClock {
    step_size: f64,
    clock: Clock,
    taken: u64,
}

impl Words for StepClock {
    fn words(&mut self, visit: &mut Visit<'_>) {
        words!(visit: self.step_size, self.clock, self.taken);
    }
}

impl StepClock {
    /// Steps of this size from `time` on.
    pub(crate) fn new(time: f64, step_size: f64) -> Result<Self, Error> {
        check_step_size(step_size)?;
        Ok(Self {
            step_size,
            clock: Clock::new(time, step_size),
            taken: 0,
        })
    }

    pub(crate) const fn step_size(&self) -> f64 {
        self.step_size
    }

    /// Steps taken.
    pub(crate) const fn taken(&self) -> u64 {
        self.taken
    }

    /// Changes the step size for steps from `time` on.
    pub(crate) fn set_step_size(&mut self, time: f64, step_size: f64) -> Result<(), Error> {
        let taken = self.taken;
        *self = Self {
            taken,
            ..Self::new(time, step_size)?
        };
        Ok(())
    }

    /// Steps of the same size from `time` on.
    pub(crate) const fn restart(&mut self, time: f64) {
        self.clock = Clock::new(time, self.step_size);
    }
}

/// An integrator that takes steps.
pub(crate) trait Stepper {
    fn step_clock(&mut self) -> &mut StepClock;

    fn time(&self) -> f64;

    /// Takes a step of size `size` to the time `end`; its number is `number`. If it fails, nothing changes.
    fn advance(&mut self, size: f64, end: f64, number: u64) -> Result<(), Error>;

    /// Takes one step: after `k` steps the time is `start + k h`.
    fn one_step(&mut self) -> Result<(), Error> {
        let step_clock = *self.step_clock();
        self.counted(step_clock.step_size, step_clock.clock.next())?;
        self.step_clock().clock.tick();
        Ok(())
    }

    /// Takes the smallest number of equal steps to `end` that are no longer than the step size.
    fn steps_to(&mut self, end: f64) -> Result<(), Error> {
        self.steps_in_sight(end, |_| {})
    }

    /// [`steps_to`](Self::steps_to) that calls `see` after every step.
    fn steps_in_sight(&mut self, end: f64, mut see: impl FnMut(&Self)) -> Result<(), Error> {
        let start = self.time();
        let step_size = self.step_clock().step_size;
        let mut remaining = RemainingSteps::between(start, end, step_size)?;
        let mut outcome = Ok(());
        while outcome.is_ok()
            && let Some((size, time)) = remaining.next_step()
        {
            outcome = self.counted(size, time).map(|()| see(self));
        }
        let time = self.time();
        self.step_clock().restart(time);
        outcome
    }

    /// Takes and counts a step, after a check that it changes the time.
    fn counted(&mut self, size: f64, end: f64) -> Result<(), Error> {
        if end == self.time() {
            return Err(Error::TimeResolution {
                time: end,
                step_size: size,
            });
        }
        let number = self.step_clock().taken + 1;
        self.advance(size, end, number)?;
        self.step_clock().taken = number;
        Ok(())
    }
}
