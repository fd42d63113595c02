//! The parts of a run.

use super::clock::Clock;
use super::last_step::LastEvent;
use super::memory::StepMemory;
use super::partitioned::MemoryOf;
use super::{Partitioned, Retry, Run};
use crate::method::{Method, Solver, Stopping};
use crate::number::words::{Visit, Words, words};
use crate::number::{Summation, Vector};
use crate::system::System;

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

/// What the steps of an [`Integrator`](crate::Integrator) read and change.
pub struct StepParts<'a, S, V, T> {
    /// The system.
    pub system: &'a mut S,
    /// The state, and what a step leaves for the next one.
    pub step_memory: &'a mut StepMemory<V, T>,
    /// When the iteration of coupled stages ends.
    pub stopping: &'a mut Stopping,
}

/// The parts of the steps of a method.
#[cfg_attr(not(debug_assertions), inline(always))]
pub const fn step_parts_of<M, S, V, R, N>(
    stepper: &mut Partitioned<M, S, V, R, N>,
) -> StepParts<'_, S, V, MemoryOf<M, S, V, N>>
where
    M: Method,
    S: System<V>,
    V: Vector,
    R: Summation,
    N: Solver<V, S>,
{
    StepParts {
        system: &mut stepper.system,
        step_memory: &mut stepper.step_memory,
        stopping: &mut stepper.stopping,
    }
}
