//! Checkpoints of runs with steps of variable size; a restored run has the same bits.

use super::integrator::{Adaptive, AdaptiveSteps, Controller};
use super::monitor::{Monitor, Slopes, seen};
use crate::integrator::{Checkpoint, CheckpointError};
use crate::method::{Method, Solver};
use crate::number::{Summation, Vector};
use crate::system::System;

/// The kind of run that the checkpoint records with the method.
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
    /// All that the run needs to [continue](crate::adaptive::Adaptive#method.restore) from here with the same bits: see [`Checkpoint`].
    ///
    /// # Errors
    ///
    /// Those of [`Integrator::checkpoint`](crate::Integrator#method.checkpoint).
    pub fn checkpoint(&self) -> Result<Checkpoint, CheckpointError> {
        let Controller {
            epsilon,
            density,
            unfinished,
            time_low,
            ..
        } = self.stepper.controller;
        let [value, slope] = evaluated(
            &self.stepper.monitor,
            &self.stepper.slopes,
            seen::<S, V>(&self.state().q),
        );
        let beside = [epsilon, density, unfinished, time_low, value, slope];
        let integrator = &self.stepper.integrator;
        integrator.checkpoint_with(KIND, self.last_event, &beside)
    }

    /// Continues from a checkpoint of a run with the same method, system, solver, sums and monitor.
    ///
    /// # Errors
    ///
    /// [`CheckpointError`]; [`OtherSystem`](CheckpointError::OtherSystem) also for another monitor. The run is then unchanged.
    pub fn restore(&mut self, checkpoint: &Checkpoint) -> Result<(), CheckpointError> {
        let mut found = [0.0; 6];
        let AdaptiveSteps {
            integrator,
            monitor,
            slopes,
            ..
        } = &mut self.stepper;
        let mine = |q: &V, words: &[f64]| {
            let known = evaluated(monitor, slopes, seen::<S, V>(q)).map(f64::to_bits);
            words[4..].iter().map(|word| word.to_bits()).eq(known)
        };
        integrator.restore_with(KIND, checkpoint, &mut found, mine)?;
        self.last_event = integrator.last_event.take();
        let [epsilon, density, unfinished, time_low, ..] = found;
        let controller = &mut self.stepper.controller;
        *controller = Controller {
            epsilon,
            density,
            unfinished,
            time_low,
            ..*controller
        };
        Ok(())
    }
}

/// The value of a monitor at a position and its logarithmic derivative along `q`, which identify its parameters.
fn evaluated<W: Monitor, V: Vector<Scalar = f64>>(
    monitor: &W,
    slopes: &Slopes<V>,
    q: &[f64],
) -> [f64; 2] {
    let slope = slopes.clone().along(monitor, q, q);
    [monitor.value(q), slope]
}
