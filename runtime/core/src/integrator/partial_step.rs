//! Shorter steps from the start of the last step.

use crate::error::Error;
use crate::integrator::{Partitioned, PlanOf, Stepper};
use crate::method::diagnosis::{Attempt, FirstFault};
use crate::method::{Method, Outcome, Plan, Solver, StageStorage, Step, WarmStart};
use crate::number::{Summation, Vector, copy};
use crate::state::State;
use crate::system::System;

/// Memory for partial steps, in addition to that of the stepper.
pub(crate) struct PartialSteps<M: Method, S: System<V>, V: Vector, N: Solver<V, S>> {
    memory: <PlanOf<M, S, V> as Plan>::Memory<V, S, N>,
    low: (V, V),
}

impl<M: Method, S: System<V>, V: Vector, N: Solver<V, S>> PartialSteps<M, S, V, N> {
    /// Memory for steps of this stepper.
    pub(crate) fn of<R: Summation>(stepper: &Partitioned<M, S, V, R, N>) -> Self {
        let prototype = &stepper.state().q;
        Self {
            memory: stepper.step_memory.memory.anew(prototype),
            low: (prototype.zeros_like(), prototype.zeros_like()),
        }
    }

    /// Takes a step from the start of the last step of a stepper to `time`, and writes the result into `state`.
    pub(crate) fn take<R: Summation>(
        &mut self,
        stepper: &Partitioned<M, S, V, R, N>,
        time: f64,
        state: &mut State<V>,
    ) -> Result<(), Error> {
        let last = stepper.last_step().ok_or(Error::NoStep)?;
        let ((q, q_low), (p, p_low)) = (last.positions.start, last.momenta.start);
        state.time = time;
        if time == last.start {
            copy(&mut state.q, q);
            copy(&mut state.p, p);
            return Ok(());
        }
        let step = Step {
            time: last.start,
            size: last.size * ((time - last.start) / (last.end - last.start)),
            q,
            q_low,
            p,
            p_low,
            linear_velocity: stepper.step_memory.linear_velocity,
        };
        let taken = <PlanOf<M, S, V> as Plan>::take::<R, V, S, N>(
            &step,
            stepper.system(),
            &mut self.memory,
            WarmStart::default(),
            stepper.stopping,
            Outcome {
                q: &mut state.q,
                q_low: &mut self.low.0,
                p: &mut state.p,
                p_low: &mut self.low.1,
            },
        );
        taken.map(|_| ()).map_err(|failure| {
            let attempt = Attempt::of(&step, stepper.statistics().steps).with_solver::<V, S, N>();
            let fault = FirstFault::new(attempt.dimension);
            attempt.error(Some(failure), &fault, &self.memory, &state.q)
        })
    }
}
