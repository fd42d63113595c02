//! The parts of a run.

use super::Run;
use super::clock::Clock;
use super::last_step::LastEvent;

/// What a [`Run`] consists of, for checkpoints and for runs that contain a run.
pub struct Parts<'a, S> {
    /// The stepper.
    pub stepper: &'a mut S,
    /// The times of the steps.
    pub clock: &'a mut Clock,
    /// The step size.
    pub step_size: &'a mut f64,
    /// The event from which the next search continues.
    pub last_event: &'a mut Option<LastEvent>,
}

/// The parts of a run.
pub const fn parts_of<S>(run: &mut Run<S>) -> Parts<'_, S> {
    Parts {
        stepper: &mut run.stepper,
        clock: &mut run.clock,
        step_size: &mut run.step_size,
        last_event: &mut run.last_event,
    }
}
