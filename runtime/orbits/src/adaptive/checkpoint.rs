//! Checkpoints of runs with steps of variable size; a restored run has the same bits.

use super::integrator::{AdaptiveSteps, Controller};
use super::monitor::{Monitor, Slopes, seen};
use symplectic_core::inside::{Parts, Save, parts_of};
use symplectic_core::solver::Solver;
use symplectic_core::stepper::Stepper;
use symplectic_core::{Checkpoint, CheckpointError, Method, Run, Summation, System, Vector};

/// The kind of run that the checkpoint records with the method.
const KIND: &str = "adaptive";

impl<M, S, W, V, R, N> Save for AdaptiveSteps<M, S, W, V, R, N>
where
    M: Method,
    S: System<V>,
    W: Monitor,
    V: Vector<Scalar = f64>,
    R: Summation,
    N: Solver<V, S>,
{
    fn checkpoint(run: &mut Run<Self>) -> Result<Checkpoint, CheckpointError> {
        let Parts {
            stepper,
            last_event,
            ..
        } = parts_of(run);
        let Controller {
            epsilon,
            density,
            unfinished,
            time_low,
            ..
        } = stepper.controller;
        let [value, slope] = evaluated(
            &stepper.monitor,
            &stepper.slopes,
            seen::<S, V>(&stepper.state().q),
        );
        let beside = [epsilon, density, unfinished, time_low, value, slope];
        (stepper.integrator).checkpoint_with(KIND, *last_event, &beside)
    }

    fn restore(run: &mut Run<Self>, checkpoint: &Checkpoint) -> Result<(), CheckpointError> {
        let mut found = [0.0; 6];
        let Parts {
            stepper,
            last_event,
            ..
        } = parts_of(run);
        let AdaptiveSteps {
            integrator,
            monitor,
            slopes,
            controller,
            ..
        } = stepper;
        let mine = |q: &V, words: &[f64]| {
            let known = evaluated(monitor, slopes, seen::<S, V>(q)).map(f64::to_bits);
            words[4..].iter().map(|word| word.to_bits()).eq(known)
        };
        integrator.restore_with(KIND, checkpoint, &mut found, mine)?;
        *last_event = parts_of(integrator).last_event.take();
        let [epsilon, density, unfinished, time_low, ..] = found;
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
