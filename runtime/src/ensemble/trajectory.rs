//! Runs of trajectories, with fixed or variable steps.

use crate::adaptive::Adaptive;
use crate::integrator::{Integrator, Statistics};
use crate::method::{Method, Solver};
use crate::number::{Summation, Vector};
use crate::state::State;
use crate::system::System;

/// A run of a trajectory in [`Ensemble::each_as`](super::Ensemble::each_as): an [`Integrator`], a run with
/// [steps of variable size](Adaptive), or your own type.
pub trait Run<V> {
    /// The present state, which the row of the trajectory contains.
    fn state(&self) -> &State<V>;

    /// Statistics of the steps.
    fn statistics(&self) -> &Statistics;
}

impl<M, S, V, R, N> Run<V> for Integrator<M, S, V, R, N>
where
    M: Method,
    S: System<V>,
    V: Vector,
    R: Summation,
    N: Solver<V, S>,
{
    fn state(&self) -> &State<V> {
        self.state()
    }

    fn statistics(&self) -> &Statistics {
        self.statistics()
    }
}

impl<M, S, W, V, R, N> Run<V> for Adaptive<M, S, W, V, R, N>
where
    M: Method,
    S: System<V>,
    V: Vector,
    R: Summation,
    N: Solver<V, S>,
{
    fn state(&self) -> &State<V> {
        self.state()
    }

    fn statistics(&self) -> &Statistics {
        self.integrator().statistics()
    }
}
