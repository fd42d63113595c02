//! The parts of a run.

use super::clock::Clock;
use super::last_step::LastEvent;
use super::{Retry, Run};
use crate::number::words::{Visit, Words, words};

/// What a [`Run`] consists of, for checkpoints and for runs that contain a run.
pub struct Parts<'a, S> {
    /// The stepper.
    pub stepper: &'a mut S,
    /// The times of the steps.
    pub clock: &'a mut Clock,
    /// The step size.
    pub step_size: &'a mut f64,
    /// The reaction to a failed step.
    pub retry: &'a mut Retry,
    /// The event from which the next search continues.
    pub last_event: &'a mut Option<LastEvent>,
}

/// The parts of a run.
pub const fn parts_of<S>(run: &mut Run<S>) -> Parts<'_, S> {
    Parts {
        stepper: &mut run.stepper,
        clock: &mut run.clock,
        step_size: &mut run.step_size,
        retry: &mut run.retry,
        last_event: &mut run.last_event,
    }
}

/// Those of the run itself.
impl<S> Words for Parts<'_, S> {
    fn words(&mut self, visit: &mut Visit<'_>) {
        words!(visit: *self.step_size, *self.clock, *self.retry, *self.last_event);
    }
}
