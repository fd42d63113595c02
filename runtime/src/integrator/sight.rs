//! Steps that are seen only if there is something to see.

use core::ops::ControlFlow;

use super::Integrator;
use crate::error::Error;
use crate::method::{Method, Solver};
use crate::number::{Summation, Vector};
use crate::state::State;
use crate::system::System;

/// What is to be seen in the steps of a run: output and events.
pub(crate) trait Sight<M, S, V, R, N, B>
where
    M: Method,
    S: System<V>,
    V: Vector,
    R: Summation,
    N: Solver<V, S>,
{
    /// Whether nothing is to be seen in the step to `state`. `iterations` is the number of sweeps up to there. The state before the step and
    /// its stages may be unavailable.
    fn passes(&mut self, state: &State<V>, iterations: u64) -> bool;

    /// Sees the last step, unless it passes.
    fn see(&mut self, integrator: &Integrator<M, S, V, R, N>) -> Result<ControlFlow<B>, Error>;

    /// Sees the last step if it does not pass.
    fn see_or_pass(
        &mut self,
        integrator: &Integrator<M, S, V, R, N>,
    ) -> Result<ControlFlow<B>, Error> {
        match self.passes(integrator.state(), integrator.iterations()) {
            true => Ok(ControlFlow::Continue(())),
            false => self.see(integrator),
        }
    }
}
