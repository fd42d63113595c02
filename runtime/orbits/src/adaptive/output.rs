//! States inside the last step.

use super::integrator::AdaptiveSteps;
use super::monitor::Monitor;
use crate::Error;
use symplectic_core::solver::Solver;
use symplectic_core::stepper::{DenseSteps, NamedSteps, Partitioned};
use symplectic_core::system::Named;
use symplectic_core::{Method, State, Summation, System, Vector};

impl<M, S, W, V, R, N> DenseSteps for AdaptiveSteps<M, S, W, V, R, N>
where
    M: Method,
    S: System<V>,
    W: Monitor,
    V: Vector<Scalar = f64>,
    R: Summation,
    N: Solver<V, S>,
{
    type Vector = V;
    type Scratch = <Partitioned<M, S, V, R, N> as DenseSteps>::Scratch;

    fn scratch(&self) -> Self::Scratch {
        self.integrator.stepper().scratch()
    }

    fn last_span(&self) -> Option<(f64, f64)> {
        self.integrator.stepper().last_span()
    }

    fn write_start(&self, out: &mut State<V>) {
        self.integrator.stepper().write_start(out);
    }

    fn prepare(&self, scratch: &mut Self::Scratch) -> Result<(), Error> {
        Ok(self.integrator.stepper().prepare(scratch)?)
    }

    fn look(
        &mut self,
        time: f64,
        scratch: &mut Self::Scratch,
        out: &mut State<V>,
    ) -> Result<(), Error> {
        let stepper = self.integrator.stepper_mut();
        Ok(stepper.look(time, scratch, out)?)
    }

    fn look_by_step(
        &mut self,
        time: f64,
        scratch: &mut Self::Scratch,
        out: &mut State<V>,
    ) -> Result<(), Error> {
        let stepper = self.integrator.stepper_mut();
        Ok(stepper.look_by_step(time, scratch, out)?)
    }

    fn slopes(&mut self, state: &State<V>, size: f64, velocity: &mut V, force: &mut V) {
        self.integrator
            .stepper_mut()
            .slopes(state, size, velocity, force);
    }
}

impl<M, S, W, V, R, N> NamedSteps for AdaptiveSteps<M, S, W, V, R, N>
where
    M: Method,
    S: System<V> + Named,
    W: Monitor,
    V: Vector<Scalar = f64>,
    R: Summation,
    N: Solver<V, S>,
{
    type System = S;

    fn system(&self) -> &S {
        self.system()
    }
}
