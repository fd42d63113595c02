//! Output of a run with steps of variable size.

use super::integrator::{Adaptive, AdaptiveSteps};
use super::monitor::Monitor;
use crate::error::Error;
use crate::integrator::{DenseSteps, NamedSteps};
use crate::method::{Method, Solver};
use crate::number::{Summation, Vector};
use crate::state::State;
use crate::system::{Named, System};

impl<M, S, W, V, R, N> Adaptive<M, S, W, V, R, N>
where
    M: Method,
    S: System<V>,
    W: Monitor,
    V: Vector<Scalar = f64>,
    R: Summation,
    N: Solver<V, S>,
{
    /// Takes steps until `end` is reached or passed, and returns the state at `end`. If `end` is inside the last step, a shorter step from
    /// its start gives that state. The present state is that after the last step, so the step sizes do not depend on `end`.
    ///
    /// If `end` is already inside the last step, no step is taken.
    ///
    /// # Errors
    ///
    /// [`Error::OutputTime`] if `end` is not finite, or before the start of the last step in the direction of the run. Those of
    /// [`step`](Self::step); the state is then that after the last successful step.
    pub fn integrate_to(&mut self, end: f64) -> Result<State<V>, Error> {
        self.integrate_with(end, |_| ())
    }

    /// Like [`integrate_to`](crate::adaptive::Adaptive#method.integrate_to), and calls `observe` with the state after every step.
    ///
    /// # Errors
    ///
    /// As for [`integrate_to`](crate::adaptive::Adaptive#method.integrate_to).
    pub fn integrate_with<F: FnMut(&State<V>)>(
        &mut self,
        end: f64,
        observe: F,
    ) -> Result<State<V>, Error> {
        self.watch_to(end, observe)?;
        let mut state = self.state().clone();
        if end != state.time {
            let mut scratch = self.stepper.scratch();
            self.stepper.look_by_step(end, &mut scratch, &mut state)?;
        }
        Ok(state)
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
