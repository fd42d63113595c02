//! Times without drift, and step sizes that end at a given time.

use num_traits::Float;

use crate::error::Error;
use crate::number::words::{Visit, Words, words};

/// The times `start + k size`.
#[derive(Clone, Copy, Debug)]
pub struct Clock {
    start: f64,
    size: f64,
    count: u64,
}

impl Words for Clock {
    fn words(&mut self, visit: &mut Visit<'_>) {
        words!(visit: self.start, self.size, self.count);
    }
}

impl Clock {
    /// The times of steps of one size.
    pub const fn new(start: f64, size: f64) -> Self {
        Self {
            start,
            size,
            count: 0,
        }
    }

    /// The time after the next step.
    pub fn next(&self) -> f64 {
        self.later(1)
    }

    /// The time after `steps` more steps.
    pub(crate) fn later(&self, steps: u64) -> f64 {
        self.start + (self.count + steps) as f64 * self.size
    }

    /// Counts a step as taken.
    pub const fn tick(&mut self) {
        self.skip(1);
    }

    pub(crate) const fn skip(&mut self, steps: u64) {
        self.count += steps;
    }
}

/// The remaining steps of a run, all of one size.
#[derive(Clone, Copy, Debug)]
pub struct RemainingSteps {
    /// Number of steps.
    pub(crate) left: u64,
    pub(crate) size: f64,
    pub(crate) clock: Clock,
    /// The time after the last step, if it is given.
    pub(crate) end: Option<f64>,
    /// Number of the next steps that are taken one by one, because not all of them succeed.
    pub(crate) alone: u64,
}

impl RemainingSteps {
    /// The smallest number of equal steps from `start` to `end` that are no longer than `|step_size|`.
    ///
    /// # Errors
    ///
    /// [`Error::StepCount`] and [`Error::EndTime`].
    pub fn between(start: f64, end: f64, step_size: f64) -> Result<Self, Error> {
        let (left, size) = uniform(start, end, step_size)?;
        Ok(Self::of_size(left, size, start, end))
    }

    /// Steps of a size from `start` to `end`.
    pub(crate) const fn of_size(left: u64, size: f64, start: f64, end: f64) -> Self {
        Self {
            left,
            size,
            clock: Clock::new(start, size),
            end: Some(end),
            alone: 0,
        }
    }

    /// The time after the next step.
    #[inline]
    pub(crate) fn next_time(&self) -> f64 {
        let end = self.end.filter(|_| self.left == 1);
        end.unwrap_or_else(|| self.clock.next())
    }

    /// Number of steps.
    pub const fn left(&self) -> u64 {
        self.left
    }

    /// The size of the next step and the time after it, if a step is left.
    #[inline]
    pub fn next(&self) -> Option<(f64, f64)> {
        (self.left > 0).then(|| (self.size, self.next_time()))
    }

    /// Counts the next step as taken.
    pub const fn tick(&mut self) {
        self.skip(1);
    }

    /// Counts the next steps as taken.
    pub const fn skip(&mut self, steps: u64) {
        self.left = self.left.saturating_sub(steps);
        self.alone = self.alone.saturating_sub(steps);
        self.clock.skip(steps);
    }

    /// The size of the next step and the time after it, if a step is left; the step counts as taken.
    #[inline]
    pub(crate) fn next_step(&mut self) -> Option<(f64, f64)> {
        let next = self.next()?;
        self.tick();
        Some(next)
    }
}

/// Checks that the number of steps from `start` to `end` can be counted.
pub(crate) fn check_count(start: f64, end: f64, step_size: f64) -> Result<(), Error> {
    if ((end - start) / step_size).abs() < MAX_STEPS {
        Ok(())
    } else {
        Err(Error::StepCount {
            time: start,
            end,
            step_size,
        })
    }
}

/// Numbers of steps below this bound are exact as doubles.
const MAX_STEPS: f64 = (1_u64 << 53) as f64;

/// The smallest number of equal steps from `start` to `end` that are no longer than `|step_size|`, and their size.
fn uniform(start: f64, end: f64, step_size: f64) -> Result<(u64, f64), Error> {
    let span = end - start;
    if !span.is_finite() {
        return Err(Error::EndTime { value: end });
    }
    if span == 0.0 {
        return Ok((0, 0.0));
    }
    let ratio = (span / step_size).abs();
    // In f64, 1.2 is not three times 0.4, and 1000.4 − 1000.1 is not three times 0.1. The ratio for an integer number of
    // steps can exceed it by the roundings of both times, the step size, the difference and the quotient.
    let doubt = f64::EPSILON * (2.0 * ratio + ((start.abs() + end.abs()) / step_size).abs());
    let count = Float::ceil(ratio - doubt).max(1.0);
    if count < MAX_STEPS {
        Ok((count as u64, span / count))
    } else {
        Err(Error::StepCount {
            time: start,
            end,
            step_size,
        })
    }
}
