//! Many steps of one size, in place if possible.

use core::mem;
use core::ops::ControlFlow;

use super::{Integrator, MemoryOf, PlanOf, Statistics, StepMemory};
use crate::error::Error;
use crate::integrator::clock::RemainingSteps;
use crate::integrator::memory::Failed;
use crate::integrator::sight::Sight;
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

impl<M: Method, S: System<V>, V: Vector, R: Summation, N: Solver<V, S>> Integrator<M, S, V, R, N> {
    /// The steps of [`take_steps`](Self::take_steps).
    pub(crate) const fn steps_left(&self, count: u64) -> RemainingSteps {
        RemainingSteps {
            left: count,
            size: self.step_size,
            clock: self.clock,
            end: None,
        }
    }

    /// The steps of [`integrate_to`](Self::integrate_to).
    pub(crate) fn steps_to_time(&self, end: f64) -> Result<RemainingSteps, Error> {
        RemainingSteps::between(self.step_memory.state.time, end, self.step_size)
    }

    /// Takes all remaining steps.
    #[inline]
    pub(crate) fn take_remaining(&mut self, remaining: &mut RemainingSteps) -> Result<(), Error> {
        while remaining.left > 0 {
            let coupled = PlanOf::<M, S, V>::EVALUATIONS_IN_PLACE.is_none();
            if coupled && remaining.left > 1 && self.is_light() {
                let left = remaining.left;
                if let Apart::Failed(failed, time) = self.advance_apart(remaining, |_, _| true) {
                    let size = remaining.size;
                    match self.prepare_as_first(size, failed) {
                        Ok(work) => self.step_memory.accept::<R>(size, time, work),
                        Err(error) => self.take_again(size, time, error).map(|_| ())?,
                    }
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

    /// Takes remaining steps until `left` are left.
    #[cfg(feature = "alloc")]
    pub(crate) fn take_until(
        &mut self,
        left: u64,
        remaining: &mut RemainingSteps,
    ) -> Result<(), Error> {
        while remaining.left > left {
            let block = self.block_of(remaining).min(remaining.left - left);
            self.take_block(block, remaining)?;
        }
        Ok(())
    }

    /// [`integrate_to`](Self::integrate_to) in sight of `sight`, until it breaks.
    pub(crate) fn integrate_in_sight<B>(
        &mut self,
        end: f64,
        sight: &mut impl Sight<M, S, V, R, N, B>,
    ) -> Result<ControlFlow<B>, Error> {
        let mut remaining = self.steps_to_time(end)?;
        let outcome = self.take_in_sight(&mut remaining, sight);
        self.restart_clock();
        outcome
    }

    /// Takes the remaining steps in sight of `sight`, until it breaks.
    fn take_in_sight<B>(
        &mut self,
        remaining: &mut RemainingSteps,
        sight: &mut impl Sight<M, S, V, R, N, B>,
    ) -> Result<ControlFlow<B>, Error> {
        let mut seen = ControlFlow::Continue(());
        // After a step that does not pass, the next one is tried alone.
        let (light, mut passed) = (self.is_light(), true);
        while remaining.left > 0 && seen.is_continue() {
            let (size, left) = (remaining.size, remaining.left);
            if light && passed && left > 1 {
                let passes =
                    |state: &_, statistics: &Statistics| sight.passes(state, statistics.iterations);
                match self.advance_apart(remaining, passes) {
                    Apart::Taken => passed = remaining.left < left,
                    Apart::Seen => (passed, seen) = (false, sight.see(self)?),
                    Apart::Failed(failed, time) => {
                        seen = match self.prepare_as_first(size, failed) {
                            Ok(work) => {
                                self.step_memory.accept::<R>(size, time, work);
                                sight.see_or_pass(self)?
                            }
                            Err(error) => {
                                let mut see = |integrator: &_| sight.see_or_pass(integrator);
                                self.take_again_in_sight(size, time, error, &mut see)?
                            }
                        };
                        remaining.tick();
                    }
                }
                continue;
            }
            let time = remaining.next_time();
            seen = self.advance_in_sight(size, time, &mut |integrator| {
                passed = sight.passes(integrator.state(), integrator.iterations());
                match passed {
                    true => Ok(ControlFlow::Continue(())),
                    false => sight.see(integrator),
                }
            })?;
            remaining.tick();
        }
        Ok(seen)
    }

    /// Number of the remaining steps to take next: one, to provide an evaluation to continue from, or many in place.
    #[inline]
    pub(crate) fn block_of(&self, remaining: &RemainingSteps) -> u64 {
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
        if ready && self.advance_in_place(block, remaining) {
            return Ok(());
        }
        for _ in 0..block {
            self.advance(remaining.size, remaining.next_time())?;
            remaining.tick();
        }
        Ok(())
    }

    /// Takes steps in place. Returns `false`, with the state unchanged, if that is impossible or if a result is NaN or infinite.
    #[cfg_attr(not(debug_assertions), inline(always))]
    pub(super) fn advance_in_place(&mut self, steps: u64, remaining: &mut RemainingSteps) -> bool {
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

    /// Takes steps until one fails or does not pass. None is taken if the first one does not change the time.
    ///
    /// The memory of the steps is moved out of the integrator, so that it can stay in registers from step to step. If the system panics,
    /// the state is that before the steps.
    #[inline]
    fn advance_apart(
        &mut self,
        remaining: &mut RemainingSteps,
        mut passes: impl FnMut(&State<V>, &Statistics) -> bool,
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
                    if !passes(&step_memory.state, &step_memory.statistics) {
                        ended = Apart::Seen;
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

/// How several steps ended.
enum Apart {
    /// All are taken, up to one that does not change the time.
    Taken,
    /// The last one does not pass.
    Seen,
    /// The next one, to this time, failed.
    Failed(Failed, f64),
}
