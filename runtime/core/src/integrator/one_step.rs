//! One step: computed, checked, and accepted or rejected.

use super::first_step::{may_depend_on_start, reason_of};
use super::memory::{Failed, StepMemory};
use super::partitioned::MemoryOf;
use super::{Partitioned, PlanOf};
use crate::error::Error;
use crate::method::diagnosis::{Attempt, FirstFault};
use crate::method::{Failure, Method, Plan, Solver, StepStatistics};
use crate::number::{Summation, Vector};
use crate::system::{Class, System};

/// An attempt at a step that failed.
pub(super) struct Rejected<V> {
    error: Error,
    /// The round-off of the state.
    low: (V, V),
}

impl<M: Method, S: System<V>, V: Vector, R: Summation, N: Solver<V, S>> Partitioned<M, S, V, R, N> {
    /// Computes a step of size `size`, to the time `time`, into `next`; returns its statistics.
    #[inline]
    pub(super) fn prepare(&mut self, size: f64, time: f64) -> Result<StepStatistics, Error> {
        self.check_progress(size, time)?;
        self.prepare_after(None, size)
    }

    /// Checks that a step changes the time.
    #[inline]
    pub(super) fn check_progress(&self, size: f64, time: f64) -> Result<(), Error> {
        if time == self.step_memory.state.time {
            return Err(Error::TimeResolution {
                time,
                step_size: size,
            });
        }
        Ok(())
    }

    /// [`prepare`](Self::prepare), perhaps after an attempt that failed. A second attempt is a turn of a loop, not a call of the same step:
    /// a program would contain the inlined code of the step once more.
    #[inline]
    fn prepare_after(
        &mut self,
        mut rejected: Option<Rejected<V>>,
        size: f64,
    ) -> Result<StepStatistics, Error> {
        loop {
            let attempt = self.step_memory.attempt::<PlanOf<M, S, V>, R, S, N>(
                &self.system,
                size,
                self.stopping,
            );
            match attempt {
                Ok(work) => {
                    return Ok(StepStatistics {
                        rejected: work.rejected + u32::from(rejected.is_some()),
                        ..work
                    });
                }
                Err(failed) => rejected = Some(self.reject(rejected.take(), size, failed)?),
            }
        }
    }

    /// Takes the step that [`prepare_after`](Self::prepare_after) computes. Not inlined, so that single steps and repeated ones share its
    /// code.
    #[inline(never)]
    pub(super) fn advance_after(
        &mut self,
        rejected: Option<Rejected<V>>,
        size: f64,
        time: f64,
    ) -> Result<(), Error> {
        let work = self.prepare_after(rejected, size)?;
        self.step_memory.accept::<R>(size, time, work);
        Ok(())
    }

    /// After an attempt that failed: how to take the step once more, as the first step of a new integrator. An error if it was one. The
    /// step then starts from the rounded state too: a long iteration may end elsewhere if its start differs by less than a rounding error.
    #[cold]
    pub(super) fn reject(
        &mut self,
        before: Option<Rejected<V>>,
        size: f64,
        failed: Failed,
    ) -> Result<Rejected<V>, Error> {
        // This also forgets what earlier steps left.
        let error = self.fail(size, failed.failure);
        match before {
            Some(Rejected { error: first, low }) => {
                self.step_memory.low = low;
                Err(reason_of(first, error))
            }
            None if failed.from_kept && may_depend_on_start(&error) => Ok(Rejected {
                error,
                low: self.step_memory.take_low(),
            }),
            None => Err(error),
        }
    }

    /// Returns the reason of a failed step, and forgets all data that the step left behind.
    #[cold]
    pub(super) fn fail(&mut self, size: f64, failure: Option<Failure>) -> Error {
        let number = self.step_memory.statistics.steps + 1;
        error_of::<M, S, V, R, N>(&mut self.step_memory, &self.system, size, number, failure)
    }
}

/// Returns the reason of a failed step of this number, and forgets all data that the step left behind.
#[cold]
pub(super) fn error_of<M: Method, S: System<V>, V: Vector, R: Summation, N: Solver<V, S>>(
    step_memory: &mut StepMemory<V, MemoryOf<M, S, V, N>>,
    system: &S,
    size: f64,
    number: u64,
    failure: Option<Failure>,
) -> Error {
    let (step, outcome, memory) = step_memory.lend(size);
    let attempt = Attempt::of(&step, number).with_solver::<V, S, N>();
    let mut fault = FirstFault::new(attempt.dimension);
    if failure.is_none() {
        <PlanOf<M, S, V> as Plan>::observe::<R, V, S, N, FirstFault>(
            &step, system, memory, outcome, &mut fault,
        );
    }
    let (memory, next) = (&step_memory.memory, &step_memory.next.0);
    let error = attempt.error(failure, &fault, memory, next);
    step_memory.forget();
    let error = S::Class::explain(system, error);
    system.explain(error, &step_memory.state.q)
}
