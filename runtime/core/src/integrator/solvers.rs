//! Changing the solver of coupled stages.

use core::marker::PhantomData;

use super::partitioned::memory_of;
use super::validation::has_linear_velocity;
use super::{Integrator, Partitioned, PlanOf, Run};
use crate::method::{Method, Plan, Solver};
use crate::number::{Summation, Vector};
use crate::state::State;
use crate::system::System;

impl<M: Method, S: System<V>, V: Vector, R: Summation, N: Solver<V, S>> Integrator<M, S, V, R, N> {
    /// The same integrator with another [`Solver`] for coupled stages from here on; the counts continue.
    pub fn with_solver<O: Solver<V, S>>(self, _solver: O) -> Integrator<M, S, V, R, O> {
        let Partitioned {
            method,
            system,
            step_memory,
            stopping,
            ..
        } = self.stepper;
        let linear_velocity = has_linear_velocity::<V, S, O>(&system, &step_memory.state);
        let memory = memory_of::<M, S, V, O>(&method, &step_memory.state.q);
        let mut step_memory = step_memory.with_memory(memory, linear_velocity);
        let State { time, q, p } = &step_memory.state;
        <PlanOf<M, S, V> as Plan>::prepare::<V, S, O>(
            &mut step_memory.memory,
            &system,
            *time,
            q,
            p,
        );
        Run {
            stepper: Partitioned {
                step_memory,
                system,
                stopping,
                method,
                kind: PhantomData,
            },
            clock: self.clock,
            step_size: self.step_size,
            retry: self.retry,
            output_by_steps: self.output_by_steps,
            last_event: self.last_event,
        }
    }
}
