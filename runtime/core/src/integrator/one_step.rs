//! One step: computed, checked, and accepted or rejected.

use super::first_step::or_as_first_step;
use super::memory::Failed;
use super::{Partitioned, PlanOf};
use crate::error::Error;
use crate::method::diagnosis::{Attempt, FirstFault};
use crate::method::{Failure, Method, Plan, Solver, StepStatistics};
use crate::number::{Summation, Vector};
use crate::system::{Class, System};

impl<M: Method, S: System<V>, V: Vector, R: Summation, N: Solver<V, S>> Partitioned<M, S, V, R, N> {
    /// Computes a step of size `size`, to the time `time`, into `next`; returns its statistics.
    #[inline]
    pub(super) fn prepare(&mut self, size: f64, time: f64) -> Result<StepStatistics, Error> {
        if time == self.step_memory.state.time {
            return Err(Error::TimeResolution {
                time,
                step_size: size,
            });
        }
        let attempt =
            self.step_memory
                .attempt::<PlanOf<M, S, V>, R, S, N>(&self.system, size, self.stopping);
        attempt.or_else(|failed| self.prepare_as_first(size, failed))
    }

    /// [`prepare`](Self::prepare) after an attempt that failed: once more as the first step of a new integrator, unless it was one. The
    /// step then starts from the rounded state too: a long iteration may end elsewhere if its start differs by less than a rounding error.
    #[cold]
    pub(super) fn prepare_as_first(
        &mut self,
        size: f64,
        failed: Failed,
    ) -> Result<StepStatistics, Error> {
        // This also forgets what earlier steps left.
        let error = self.fail(size, failed.failure);
        let forget = |_: &mut Self| failed.from_kept;
        or_as_first_step(self, Err(error), forget, |run| {
            let low = run.step_memory.take_low();
            match run.attempt_apart(size) {
                Ok(work) => Ok(StepStatistics {
                    rejected: work.rejected + 1,
                    ..work
                }),
                Err(failed) => {
                    run.step_memory.low = low;
                    Err(run.fail(size, failed.failure))
                }
            }
        })
    }

    /// [`StepMemory::attempt`](super::StepMemory::attempt), for steps that are rare: the code of a step is not repeated there.
    #[inline(never)]
    fn attempt_apart(&mut self, size: f64) -> Result<StepStatistics, Failed> {
        (self.step_memory).attempt::<PlanOf<M, S, V>, R, S, N>(&self.system, size, self.stopping)
    }

    /// Returns the reason of a failed step, and forgets all data that the step left behind.
    #[cold]
    pub(super) fn fail(&mut self, size: f64, failure: Option<Failure>) -> Error {
        let number = self.step_memory.statistics.steps + 1;
        let (step, outcome, memory) = self.step_memory.lend(size);
        let attempt = Attempt::of(&step, number).with_solver::<V, S, N>();
        let mut fault = FirstFault::new(attempt.dimension);
        if failure.is_none() {
            <PlanOf<M, S, V> as Plan>::observe::<R, V, S, N, FirstFault>(
                &step,
                &self.system,
                memory,
                outcome,
                &mut fault,
            );
        }
        let error = attempt.error(
            failure,
            &fault,
            &self.step_memory.memory,
            &self.step_memory.next.0,
        );
        self.step_memory.forget();
        let error = S::Class::explain(&self.system, error);
        self.system.explain(error, &self.step_memory.state.q)
    }
}
