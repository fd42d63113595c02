//! The memory of steps.

use core::mem;
#[cfg(feature = "alloc")]
use core::slice;

use crate::integrator::Statistics;
use crate::method::storage::is_finite;
use crate::method::{
    Failure, Outcome, Plan, Solver, StageStorage, Step, StepStatistics, Stopping, WarmStart,
};
use crate::number::{Summation, Vector};
#[cfg(feature = "alloc")]
use crate::number::{Visit, scalar_words, words::show_vectors};
use crate::state::State;
use crate::system::System;

/// A failed attempt at a step.
pub struct Failed {
    /// `None` if the result is not finite, or an evaluation has a wrong dimension.
    pub(super) failure: Option<Failure>,
    /// Whether it used anything that earlier steps left.
    pub(super) from_kept: bool,
}

/// The data that steps change: the state, and the values that a step leaves behind for the next one.
#[derive(Clone)]
pub struct StepMemory<V, T> {
    /// The present state.
    pub state: State<V>,
    /// Round-off of the position and the momentum of the state, in compensated sums.
    pub low: (V, V),
    /// The result of a step; swapped with the state when it is accepted.
    pub next: (V, V),
    /// Round-off of `next`.
    pub next_low: (V, V),
    /// The memory of the plan.
    pub memory: T,
    /// The parts of `memory` that the next step reuses.
    pub kept: WarmStart,
    /// Size of the previous step.
    pub last_size: f64,
    /// Time at the start of the previous step.
    pub last_time: f64,
    /// The statistics of all steps.
    pub statistics: Statistics,
    /// Whether the velocity is linear: see [`Step::linear_velocity`](Step::linear_velocity).
    pub linear_velocity: bool,
}

impl<V: Vector, T: StageStorage<V>> StepMemory<V, T> {
    /// The memory of a run that begins at a state.
    pub(super) fn new(memory: T, linear_velocity: bool, state: State<V>) -> Self {
        let zeros = || (state.q.zeros_like(), state.q.zeros_like());
        Self {
            low: zeros(),
            next: zeros(),
            next_low: zeros(),
            memory,
            kept: WarmStart::default(),
            last_size: 0.0,
            last_time: state.time,
            statistics: Statistics::default(),
            linear_velocity,
            state,
        }
    }

    /// Position, momentum and their round-off: of the state, then of the last result.
    #[cfg(feature = "alloc")]
    pub const fn vectors(&mut self) -> [&mut V; 8] {
        [
            &mut self.state.q,
            &mut self.state.p,
            &mut self.low.0,
            &mut self.low.1,
            &mut self.next.0,
            &mut self.next.1,
            &mut self.next_low.0,
            &mut self.next_low.1,
        ]
    }

    /// Shows `visit` copies of the words that [`scalar_words`](Self::scalar_words) visits.
    #[cfg(feature = "alloc")]
    pub(super) fn show_scalars(&self, visit: &mut Visit<'_>) {
        let Self {
            state,
            low,
            next,
            next_low,
            ..
        } = self;
        let vectors = [
            &state.q,
            &state.p,
            &low.0,
            &low.1,
            &next.0,
            &next.1,
            &next_low.0,
            &next_low.1,
        ];
        for vector in vectors {
            show_vectors(slice::from_ref(vector), visit);
        }
        self.memory.show_words(visit);
    }

    /// Shows `visit` the words of all scalars of state, result and memory.
    #[cfg(feature = "alloc")]
    pub fn scalar_words(&mut self, visit: &mut Visit<'_>) {
        for vector in self.vectors() {
            scalar_words(vector.as_mut_slice(), visit);
        }
        self.memory.words(visit);
    }

    /// The memory of a run from the present state, without reused data of previous steps.
    pub(super) fn anew(&self) -> Self {
        Self {
            low: self.low.clone(),
            statistics: self.statistics,
            ..Self::new(
                self.memory.anew(&self.state.q),
                self.linear_velocity,
                self.state.clone(),
            )
        }
    }

    /// The same run with memory of another type.
    pub(super) fn with_memory<U>(self, memory: U, linear_velocity: bool) -> StepMemory<V, U> {
        StepMemory {
            memory,
            kept: WarmStart::default(),
            state: self.state,
            low: self.low,
            next: self.next,
            next_low: self.next_low,
            last_size: self.last_size,
            last_time: self.last_time,
            statistics: self.statistics,
            linear_velocity,
        }
    }

    /// Replaces the state by a copy of another of the same dimension.
    pub(super) fn copy_state(&mut self, state: &State<V>) {
        self.state.copy_from(state);
        for low in [&mut self.low.0, &mut self.low.1] {
            low.as_mut_slice().fill(num_traits::Zero::zero());
        }
        self.kept = WarmStart::default();
    }

    /// Rounds the state; returns what was cut off.
    pub(super) fn take_low(&mut self) -> (V, V) {
        let zeros = || self.state.q.zeros_like();
        mem::replace(&mut self.low, (zeros(), zeros()))
    }

    /// Computes a step of size `size` into `next` and checks it; returns its statistics.
    #[cfg_attr(not(debug_assertions), inline(always))]
    pub fn attempt<P, R, S, N>(
        &mut self,
        system: &S,
        size: f64,
        stopping: Stopping,
    ) -> Result<StepStatistics, Failed>
    where
        P: Plan<Class = S::Class, Memory<V, S, N> = T>,
        R: Summation,
        S: System<V>,
        N: Solver<V, S>,
    {
        // Nothing is kept until the step is accepted, because the system may panic.
        let before = mem::take(&mut self.kept);
        let kept = WarmStart {
            stages: before.stages && size == self.last_size,
            ..before
        };
        let (step, outcome, memory) = self.lend(size);
        let failure = match P::take::<R, V, S, N>(&step, system, memory, kept, stopping, outcome) {
            Ok(work) if self.is_sound() => return Ok(work),
            Ok(_) => None,
            Err(failure) => Some(failure),
        };
        Err(Failed {
            failure,
            from_kept: kept.evaluation || kept.stages,
        })
    }

    /// Whether `next` is finite, and all evaluations have the right dimension.
    #[cfg_attr(not(debug_assertions), inline(always))]
    pub(super) fn is_sound(&self) -> bool {
        let (q1, p1) = &self.next;
        let dimension = self.state.q.dimension();
        self.memory.mismatch(dimension).is_none() && is_finite(q1) && is_finite(p1)
    }

    /// Exchanges the state and `next`.
    #[cfg_attr(not(debug_assertions), inline(always))]
    pub(super) fn swap<R: Summation>(&mut self) {
        mem::swap(&mut self.state.q, &mut self.next.0);
        mem::swap(&mut self.state.p, &mut self.next.1);
        if R::COMPENSATED {
            mem::swap(&mut self.low.0, &mut self.next_low.0);
            mem::swap(&mut self.low.1, &mut self.next_low.1);
        }
    }

    /// Makes the step computed by [`attempt`](Self::attempt), to the time `time`, the present state.
    #[cfg_attr(not(debug_assertions), inline(always))]
    pub fn accept<R: Summation>(&mut self, size: f64, time: f64, work: StepStatistics) {
        self.swap::<R>();
        self.last_time = mem::replace(&mut self.state.time, time);
        self.statistics.count(work);
        self.last_size = size;
        self.kept = WarmStart {
            evaluation: true,
            stages: true,
            scales: work.scales,
        };
    }

    /// Forgets all data of previous steps.
    pub fn forget(&mut self) {
        self.memory.forget(&self.state.q);
        self.kept = WarmStart::default();
    }

    /// A step of size `size` from the present state, the places of its result, and the memory.
    #[cfg_attr(not(debug_assertions), inline(always))]
    pub(super) const fn lend(&mut self, size: f64) -> (Step<'_, V>, Outcome<'_, V>, &mut T) {
        let step = Step {
            time: self.state.time,
            size,
            q: &self.state.q,
            q_low: &self.low.0,
            p: &self.state.p,
            p_low: &self.low.1,
            linear_velocity: self.linear_velocity,
        };
        let outcome = Outcome {
            q: &mut self.next.0,
            q_low: &mut self.next_low.0,
            p: &mut self.next.1,
            p_low: &mut self.next_low.1,
        };
        (step, outcome, &mut self.memory)
    }
}
