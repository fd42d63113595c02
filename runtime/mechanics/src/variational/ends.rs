//! The ends of the last step.

use symplectic_core::inside::{check_state, words};
use symplectic_core::solver::{Visit, Words};
use symplectic_core::{Error, State, Statistics, Vector};

/// The present state, the start of the last step, and the statistics.
#[derive(Clone)]
pub struct Ends<V> {
    pub(super) state: State<V>,
    /// The start of the last step; during a step its end, as far as it is known.
    pub(super) next: State<V>,
    /// The size of the last step, if `next` is its start.
    size: Option<f64>,
    pub(super) statistics: Statistics,
}

impl<V: Vector<Scalar = f64>> Ends<V> {
    /// Before the first step from `state`.
    pub(super) fn new(state: State<V>) -> Self {
        Self {
            next: state.clone(),
            state,
            size: None,
            statistics: Statistics::default(),
        }
    }

    /// Checks a new state.
    pub(super) fn check(&self, State { time, q, p }: &State<V>) -> Result<(), Error> {
        check_state(*time, q, p, self.state.q.dimension())
    }

    /// Replaces the present state.
    pub(super) fn set(&mut self, state: &State<V>) {
        self.state.copy_from(state);
        self.size = None;
    }

    /// Replaces the present state by the start of a step beside `run`, which is counted as its last step.
    pub(super) fn set_beside(&mut self, run: &Self, state: &State<V>) {
        self.set(state);
        self.statistics.steps = run.statistics.steps.saturating_sub(1);
    }

    /// Begins a step; returns its number.
    pub(super) fn begin(&mut self) -> u64 {
        self.size = None;
        self.statistics.steps + 1
    }

    /// Ends a step of size `size` at the time `end`.
    pub(super) fn end(&mut self, size: f64, end: f64) {
        self.next.time = end;
        core::mem::swap(&mut self.state, &mut self.next);
        self.size = Some(size);
        self.statistics.steps += 1;
    }

    /// The start of the last step and its size.
    pub(super) fn last_step(&self) -> Option<(&State<V>, f64)> {
        Some((&self.next, self.size?))
    }
}

impl<V: Vector<Scalar = f64>> Words for Ends<V> {
    fn words(&mut self, visit: &mut Visit<'_>) {
        words!(visit: self.state, self.next, self.size, self.statistics);
    }
}
