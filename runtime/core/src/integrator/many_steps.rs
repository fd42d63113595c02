//! Many steps of one size, in place if possible.

use core::mem;

#[cfg(feature = "alloc")]
use super::Integrator;
use super::memory::StepMemory;
use super::partitioned::MemoryOf;
use super::{Partitioned, PlanOf, Statistics, Stepper};
use crate::error::Error;
use crate::integrator::clock::RemainingSteps;
use crate::integrator::memory::Failed;
use crate::method::{Method, Plan, Solver, Span, StageStorage, WarmStart};
use crate::number::vector::{LIGHT, is_in_place};
use crate::number::{Summation, Vector};
use crate::state::State;
use crate::system::System;

/// Number of steps of vectors of this dimension that are taken in place before the result is checked. The cost of the check is negligible
/// compared with theirs, and few steps are wasted if the result is NaN or infinite.
fn block(dimension: usize) -> u64 {
    (1 << 20) / (dimension as u64).clamp(16, 1 << 13)
}

impl<M: Method, S: System<V>, V: Vector, R: Summation, N: Solver<V, S>> Partitioned<M, S, V, R, N> {
    /// [`Stepper::take`](super::Stepper::take).
    #[inline]
    pub(super) fn take_all(&mut self, remaining: &mut RemainingSteps) -> Result<(), Error> {
        while remaining.left > 0 {
            let coupled = PlanOf::<M, S, V>::EVALUATIONS_IN_PLACE.is_none();
            if coupled && remaining.left > 1 && self.is_light() {
                let left = remaining.left;
                if let Apart::Failed(failed, time) = self.advance_apart(remaining, |_, _| true) {
                    self.accept_as_first(remaining.size, time, failed)?;
                    remaining.tick();
                }
                if remaining.left < left {
                    continue;
                }
            }
            self.take_block(self.block_of(remaining), remaining)?;
        }
        Ok(())
    }

    /// [`Stepper::take_while`](super::Stepper::take_while).
    #[inline]
    pub(super) fn take_some(
        &mut self,
        remaining: &mut RemainingSteps,
        mut goes_on: impl FnMut(&State<V>, &Statistics) -> bool,
    ) -> Result<bool, Error> {
        let is_light = self.is_light();
        while let Some((size, time)) = remaining.next() {
            // After a step that does not go on, the next one is taken alone.
            self.advance(size, time)?;
            remaining.tick();
            if !goes_on(&self.step_memory.state, &self.step_memory.statistics) {
                return Ok(false);
            }
            if !is_light || remaining.left < 2 {
                continue;
            }
            match self.advance_apart(remaining, &mut goes_on) {
                Apart::Taken => {}
                Apart::Stopped => return Ok(false),
                Apart::Failed(failed, time) => {
                    self.accept_as_first(size, time, failed)?;
                    remaining.tick();
                    if !goes_on(&self.step_memory.state, &self.step_memory.statistics) {
                        return Ok(false);
                    }
                }
            }
        }
        Ok(true)
    }

    /// Takes a step that failed once more as a first step.
    #[cold]
    fn accept_as_first(&mut self, size: f64, time: f64, failed: Failed) -> Result<(), Error> {
        let rejected = self.reject(None, size, failed)?;
        self.advance_after(Some(rejected), size, time)
    }

    /// Number of the remaining steps to take next: one, to provide an evaluation to continue from, or many in place.
    #[doc(hidden)]
    #[inline]
    pub fn block_of(&self, remaining: &RemainingSteps) -> u64 {
        // The last step is taken separately, so that the state before it remains available.
        let block = (remaining.left - 1).min(block(self.step_memory.state.q.dimension()));
        match self.step_memory.kept.evaluation {
            true => block.max(1),
            false => 1,
        }
    }

    /// Takes a [block](Self::block_of) of the remaining steps, in place or one by one.
    #[inline]
    pub(crate) fn take_block(
        &mut self,
        block: u64,
        remaining: &mut RemainingSteps,
    ) -> Result<(), Error> {
        let ready = self.step_memory.kept.evaluation && remaining.left > 1;
        if remaining.alone == 0 {
            if ready && self.advance_in_place(block, remaining) {
                return Ok(());
            }
            remaining.alone = block;
        }
        while remaining.alone > 0 {
            self.advance(remaining.size, remaining.next_time())?;
            remaining.tick();
        }
        Ok(())
    }

    /// Takes steps in place. Returns `false`, with the state unchanged, if that is impossible or if a result is NaN or infinite.
    #[doc(hidden)]
    #[cfg_attr(not(debug_assertions), inline(always))]
    pub fn advance_in_place(&mut self, steps: u64, remaining: &mut RemainingSteps) -> bool {
        let RemainingSteps { size, clock, .. } = *remaining;
        let Some(evaluations) = PlanOf::<M, S, V>::EVALUATIONS_IN_PLACE else {
            return false;
        };
        let (first, last) = (clock.next(), clock.later(steps));
        if first == self.step_memory.state.time || clock.later(steps - 1) == last && steps > 1 {
            return false;
        }
        // The state stays unchanged. If the system panics, nothing that the previous steps left behind is reused.
        let before = mem::take(&mut self.step_memory.kept);
        let (step, mut state, memory) = self.step_memory.lend(size);
        state.copy_from::<R>(&step);
        for number in 0..steps {
            // The compiler removes this if the system does not depend on time.
            let time = clock.later(number);
            let span = Span { time, size };
            let (system, place) = (&self.system, state.reborrow());
            <PlanOf<M, S, V> as Plan>::take_in_place::<R, V, S, N, _>(
                span,
                system,
                memory,
                place,
                &mut (),
            );
        }
        if !self.step_memory.is_sound() {
            self.step_memory.memory = StageStorage::like(&self.step_memory.state.q);
            return false;
        }
        self.step_memory.swap::<R>();
        self.step_memory.kept = WarmStart {
            stages: false,
            ..before
        };
        remaining.skip(steps);
        self.step_memory.state.time = last;
        self.step_memory.last_size = size;
        self.step_memory
            .statistics
            .count_explicit(steps, evaluations);
        true
    }

    /// Whether the memory that steps change is small and contiguous, so that copying it is cheap compared with a few steps.
    fn is_light(&self) -> bool {
        let bytes = size_of::<StepMemory<V, MemoryOf<M, S, V, N>>>();
        let at_run_time = <MemoryOf<M, S, V, N> as StageStorage<V>>::AT_RUN_TIME;
        !at_run_time && is_in_place(&self.step_memory.state.q) && bytes <= LIGHT
    }

    /// Takes steps until one fails or they are not to go on. None is taken if the first one does not change the time.
    ///
    /// The memory of the steps is moved out of the integrator, so that it can stay in registers from step to step. If the system panics,
    /// the state is that before the steps.
    #[inline]
    fn advance_apart(
        &mut self,
        remaining: &mut RemainingSteps,
        mut goes_on: impl FnMut(&State<V>, &Statistics) -> bool,
    ) -> Apart {
        let mut steps = *remaining;
        let size = steps.size;
        let before = self.step_memory.anew();
        let mut step_memory = mem::replace(&mut self.step_memory, before);
        let mut ended = Apart::Taken;
        while steps.left > 0 && matches!(ended, Apart::Taken) {
            let time = steps.next_time();
            if time == step_memory.state.time {
                break;
            }
            let attempt =
                step_memory.attempt::<PlanOf<M, S, V>, R, S, N>(&self.system, size, self.stopping);
            match attempt {
                Ok(work) => {
                    step_memory.accept::<R>(size, time, work);
                    steps.tick();
                    if !goes_on(&step_memory.state, &step_memory.statistics) {
                        ended = Apart::Stopped;
                    }
                }
                Err(failed) => ended = Apart::Failed(failed, time),
            }
        }
        self.step_memory = step_memory;
        *remaining = steps;
        ended
    }
}

#[cfg(feature = "alloc")]
impl<M: Method, S: System<V>, V: Vector, R: Summation, N: Solver<V, S>> Integrator<M, S, V, R, N> {
    /// Takes remaining steps until `left` are left.
    #[doc(hidden)]
    pub fn take_until(&mut self, left: u64, remaining: &mut RemainingSteps) -> Result<(), Error> {
        while remaining.left > left {
            let block = (self.stepper.block_of(remaining)).min(remaining.left - left);
            if let Err(error) = self.stepper.take_block(block, remaining) {
                self.take_next_again(remaining, error)?;
            }
        }
        Ok(())
    }
}

/// How several steps ended.
enum Apart {
    /// All are taken, up to one that does not change the time.
    Taken,
    /// After the last one they were not to go on.
    Stopped,
    /// The next one, to this time, failed.
    Failed(Failed, f64),
}
