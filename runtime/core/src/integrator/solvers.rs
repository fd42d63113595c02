//! Changing the solver of coupled stages.

use core::marker::PhantomData;

use super::memory::StepMemory;
use super::partitioned::MemoryOf;
use super::validation::has_linear_velocity;
use super::{Integrator, Partitioned, PlanOf, Run};
use crate::method::{Method, Plan, Solver};
use crate::number::{Summation, Vector};
#[cfg(feature = "alloc")]
use crate::solver::Newton;
use crate::state::State;
use crate::system::System;

impl<M: Method, S: System<V>, V: Vector, R: Summation, N: Solver<V, S>> Integrator<M, S, V, R, N> {
    /// The same integrator with another [`Solver`] for coupled stages from here on; the counts continue.
    pub fn with_solver<O: Solver<V, S>>(self, _solver: O) -> Integrator<M, S, V, R, O> {
        let Partitioned {
            system,
            step_memory,
            stopping,
            ..
        } = self.stepper;
        let linear_velocity = has_linear_velocity::<V, S, O>(&system, &step_memory.state);
        let mut step_memory: StepMemory<V, MemoryOf<M, S, V, O>> =
            step_memory.with_memory(linear_velocity);
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
                method: PhantomData,
            },
            clock: self.clock,
            step_size: self.step_size,
            retry: self.retry,
            last_event: self.last_event,
        }
    }

    /// The same integrator with [`Newton`]'s iteration, for stiff and strongly coupled systems. An explicit method does not change.
    /// With constraints nothing changes either: their steps have an iteration of their own.
    ///
    /// The second derivatives are exact if the system [implements them](System::second_derivatives), as a system from a
    /// [formula](crate::hamiltonian!) does. Otherwise they are difference quotients. The matrices are banded if the system provides its
    /// [half bandwidth](System::half_bandwidth), and full otherwise. The first step allocates them.
    ///
    /// ```
    /// symplectic::tableau! { Midpoint { basis: polynomial(1), nodes: gauss(1) } }
    /// # use symplectic::nalgebra::Vector1;
    /// # use symplectic::{Error, Integrator, State, separable};
    /// # fn main() -> Result<(), Error> {
    /// let stiff = separable::<Vector1<f64>, _, _>(|_, p, velocity| *velocity = *p, |_, q, force| *force = -q * 1e12);
    /// let start = State::new(0.0, Vector1::new(1.0), Vector1::new(0.0));
    /// let mut integrator = Integrator::new(Midpoint, stiff, start, 0.1)?.by_newton();
    /// integrator.integrate_to(10.0)?;
    /// assert_eq!(integrator.statistics().factorisations, 1);
    /// # Ok(())
    /// # }
    /// ```
    #[cfg(feature = "alloc")]
    pub fn by_newton(self) -> Integrator<M, S, V, R, Newton> {
        self.with_solver(Newton::new())
    }
}
