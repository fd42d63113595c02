//! Many steps of one size, in place where that can be.

use core::{hint, mem};

use super::{Integrator, MemoryOf, PlanOf, StepMemory};
use crate::error::Error;
use crate::integrator::clock::Clock;
use crate::method::kick_drift::FusedKicks;
use crate::method::{KickDrift, Method, Outcome, Plan, Solver, Span, StageStorage, WarmStart};
use crate::number::vector::{LIGHT, SHORT, is_in_place};
use crate::number::{Summation, Vector, copy};
use crate::system::System;

/// Steps of vectors of this dimension that are taken in place before what comes out is looked at: what that costs does not
/// show beside them, and where something is not finite, few of them are in vain.
fn block(dimension: usize) -> u64 {
    (1 << 20) / (dimension as u64).clamp(16, 1 << 13)
}

/// Components of a vector from which on forces and kicks wait for the drift after them.
const LONG: usize = 1 << 6;

/// Bytes of a vector of a few components, or of one whose components are elsewhere.
const FEW: usize = 1 << 6;

impl<M: Method, S: System<V>, V: Vector, R: Summation, N: Solver<V, S>> Integrator<M, S, V, R, N> {
    /// Steps of one size by a clock; the last one to the time `end`, if it is given.
    #[inline]
    pub(super) fn advance_by(
        &mut self,
        count: u64,
        size: f64,
        clock: &mut Clock,
        end: Option<f64>,
    ) -> Result<(), Error> {
        let mut left = count;
        while left > 0 {
            let coupled = PlanOf::<M, S, V>::EVALUATIONS_IN_PLACE.is_none();
            if coupled && left > 1 && self.is_light() {
                let taken = self.advance_apart(left, size, clock, end)?;
                left -= taken;
                if taken > 0 {
                    continue;
                }
            }
            let block = self.next_block(left);
            self.advance_block(block, left, size, clock, end)?;
            left -= block;
        }
        Ok(())
    }

    /// How many of the steps that are left are taken next: one to have an evaluation to go on from, or many in place.
    #[inline]
    pub(super) fn next_block(&self, left: u64) -> u64 {
        // The last step is taken by itself: the state before it stays at hand.
        let block = (left - 1).min(block(self.course.state.q.dimension()));
        match self.course.kept.evaluation {
            true => block.max(1),
            false => 1,
        }
    }

    /// Takes a [block](Self::next_block) of the steps that are left, in place or one by one.
    #[inline]
    pub(super) fn advance_block(
        &mut self,
        block: u64,
        mut left: u64,
        size: f64,
        clock: &mut Clock,
        end: Option<f64>,
    ) -> Result<(), Error> {
        let ready = self.course.kept.evaluation && left > 1;
        if ready && self.advance_in_place(block, size, clock) {
            return Ok(());
        }
        for _ in 0..block {
            left -= 1;
            let time = end.filter(|_| left == 0).unwrap_or_else(|| clock.next());
            self.advance(size, time)?;
            clock.tick();
        }
        Ok(())
    }

    /// Takes some steps in place; `false` where that cannot be, or where something is not finite: then nothing has changed.
    #[inline]
    pub(super) fn advance_in_place(&mut self, steps: u64, size: f64, clock: &mut Clock) -> bool {
        let Some(evaluations) = PlanOf::<M, S, V>::EVALUATIONS_IN_PLACE else {
            return false;
        };
        let (first, last) = (clock.next(), clock.later(steps));
        if first == self.course.state.time || clock.later(steps - 1) == last && steps > 1 {
            return false;
        }
        // The state stays as it is, and nothing of what is left behind is used if the system panics.
        let before = mem::take(&mut self.course.kept);
        let StepMemory {
            state,
            low,
            next,
            next_low,
            ..
        } = &mut self.course;
        copy(&mut next.0, &state.q);
        copy(&mut next.1, &state.p);
        if R::COMPENSATED {
            copy(&mut next_low.0, &low.0);
            copy(&mut next_low.1, &low.1);
        }
        let waits = !R::COMPENSATED && self.course.state.q.dimension() >= LONG;
        let alone = !R::COMPENSATED || size_of::<V>() <= FEW;
        match (size_of::<V>() <= SHORT, alone) {
            _ if waits => self.run_here(clock, steps, size, FusedKicks::new(steps)),
            (true, true) => self.run_alone(clock, steps, size),
            (true, false) => self.run_apart(clock, steps, size),
            (false, _) => self.run_here(clock, steps, size, ()),
        }
        if !self.course.is_sound() {
            self.course.memory = StageStorage::like(&self.course.state.q);
            return false;
        }
        self.course.swap::<R>();
        self.course.kept = WarmStart {
            stages: false,
            ..before
        };
        clock.skip(steps);
        self.course.state.time = last;
        self.course.last_size = size;
        self.course.statistics.count_explicit(steps, evaluations);
        true
    }

    /// Takes steps in the places of `next`.
    #[inline]
    fn run_here(&mut self, clock: &Clock, steps: u64, size: f64, moves: impl KickDrift) {
        let StepMemory {
            next,
            next_low,
            memory,
            ..
        } = &mut self.course;
        let system = &self.system;
        Self::run(system, clock, steps, size, (next, next_low), memory, moves);
    }

    /// Takes steps in these places moved out of the memory of the integrator, so that they are in registers from step to step.
    #[inline(always)]
    fn run_apart(&mut self, clock: &Clock, steps: u64, size: f64) {
        let blank = || (V::blank(), V::blank());
        // The order shows in how registers are given to six components: see `ratios`, springs, and `instructions`.
        let mut low = mem::replace(&mut self.course.next_low, blank());
        let mut memory = mem::replace(&mut self.course.memory, StageStorage::like(&V::blank()));
        let mut next = mem::replace(&mut self.course.next, blank());
        Self::run(
            &self.system,
            clock,
            steps,
            size,
            (&mut next, &mut low),
            &mut memory,
            (),
        );
        (self.course.next, self.course.next_low) = (next, low);
        self.course.memory = memory;
    }

    /// [`run_apart`](Self::run_apart), in a function of its own: steps that are plain, or of a few components, are so short that it
    /// shows what is in registers around them, and that the compiler packs components for the sake of what is made of the last step.
    #[inline(never)]
    fn run_alone(&mut self, clock: &Clock, steps: u64, size: f64) {
        self.run_apart(clock, steps, size);
    }

    /// Takes steps in the places of a state.
    #[inline(always)]
    fn run(
        system: &S,
        clock: &Clock,
        steps: u64,
        size: f64,
        ((q, p), (q_low, p_low)): (&mut (V, V), &mut (V, V)),
        memory: &mut MemoryOf<M, S, V, N>,
        mut moves: impl KickDrift,
    ) {
        for number in 0..steps {
            // Nothing of this remains where the system does not look at the time.
            let time = clock.later(number);
            let state = Outcome {
                q: &mut *q,
                q_low: &mut *q_low,
                p: &mut *p,
                p_low: &mut *p_low,
            };
            let span = Span { time, size };
            <PlanOf<M, S, V> as Plan>::take_in_place::<R, V, S, N, _>(
                span, system, memory, state, &mut moves,
            );
        }
        let state = Outcome { q, q_low, p, p_low };
        <PlanOf<M, S, V> as Plan>::settle_in_place::<R, V, S, N, _>(
            system, memory, state, &mut moves,
        );
    }

    /// Whether what steps change is little and all in one place: copies of it do not show beside a few steps.
    fn is_light(&self) -> bool {
        let bytes = size_of::<StepMemory<V, MemoryOf<M, S, V, N>>>();
        let at_run_time = <MemoryOf<M, S, V, N> as StageStorage<V>>::AT_RUN_TIME;
        !at_run_time && is_in_place(&self.course.state.q) && bytes <= LIGHT
    }

    /// Takes steps until one fails; returns how many were taken, none where the first does not change the time. The last of
    /// them goes to the time `end`, if it is given.
    ///
    /// What they change is moved out of the memory of the integrator, so that it is in registers from step to step, or where it is read
    /// faster. If the system panics, the state is that before.
    #[inline]
    fn advance_apart(
        &mut self,
        steps: u64,
        size: f64,
        clock: &mut Clock,
        end: Option<f64>,
    ) -> Result<u64, Error> {
        let before = self.course.anew();
        let mut course = mem::replace(&mut self.course, before);
        // Increments wait for their weights, and would wait again until they are in memory.
        if !R::COMPENSATED && <MemoryOf<M, S, V, N> as StageStorage<V>>::BROADCASTS {
            // Nothing is done with it, but the compiler does not know, and leaves it in memory.
            hint::black_box(&mut course);
        }
        let mut failed = None;
        let mut taken = 0;
        while taken < steps && failed.is_none() {
            let time = match end {
                Some(end) if taken + 1 == steps => end,
                _ => clock.next(),
            };
            if time == course.state.time {
                break;
            }
            let attempt =
                course.attempt::<PlanOf<M, S, V>, R, S, N>(&self.system, size, self.stopping);
            match attempt {
                Ok(()) => {
                    course.accept::<R>(size, time);
                    clock.tick();
                    taken += 1;
                }
                Err(failure) => failed = Some((failure, time)),
            }
        }
        self.course = course;
        if let Some((failure, time)) = failed {
            let error = self.fail(size, failure);
            self.take_again(size, time, error)?;
            clock.tick();
            taken += 1;
        }
        Ok(taken)
    }
}
