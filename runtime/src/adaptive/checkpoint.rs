//! Runs with steps of variable size that are interrupted and go on with the same bits.

use super::integrator::{Adaptive, Controller};
use super::monitor::Monitor;
use crate::integrator::{Checkpoint, CheckpointError};
use crate::method::{Method, Solver};
use crate::number::{Summation, Vector};
use crate::system::System;

/// What a checkpoint of such a run is of, beside its method.
const KIND: &str = "adaptive";

impl<M, S, W, V, R, N> Adaptive<M, S, W, V, R, N>
where
    M: Method,
    S: System<V>,
    W: Monitor,
    V: Vector<Scalar = f64>,
    R: Summation,
    N: Solver<V, S>,
{
    /// What the run needs to [go on](Self::restore) from here with the same bits: see [`Checkpoint`].
    ///
    /// # Errors
    ///
    /// Those of [`Integrator::checkpoint`](crate::Integrator::checkpoint).
    pub fn checkpoint(&self) -> Result<Checkpoint, CheckpointError> {
        let Controller {
            epsilon,
            density,
            unfinished,
            time_low,
        } = self.controller;
        let value = self.monitor.value(self.state().q.as_slice());
        self.integrator
            .checkpoint_with(KIND, &[epsilon, density, unfinished, time_low, value])
    }

    /// Goes on from a checkpoint of a run that was made in the same way, with the same monitor.
    ///
    /// # Errors
    ///
    /// [`CheckpointError`], with [`OtherSystem`](CheckpointError::OtherSystem) for another monitor too; the run is then as it was.
    pub fn restore(&mut self, checkpoint: &Checkpoint) -> Result<(), CheckpointError> {
        let mut found = [0.0; 5];
        let monitor = &self.monitor;
        let mine = |q: &V, words: &[f64]| {
            monitor.value::<f64>(q.as_slice()).to_bits() == words[4].to_bits()
        };
        self.integrator
            .restore_with(KIND, checkpoint, &mut found, mine)?;
        let [epsilon, density, unfinished, time_low, _] = found;
        self.controller = Controller {
            epsilon,
            density,
            unfinished,
            time_low,
        };
        Ok(())
    }
}
