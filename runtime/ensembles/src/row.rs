//! Result of a trajectory.

use symplectic_core::{Error, State, Statistics};

/// The result of one trajectory of an ensemble.
#[derive(Clone, Debug, PartialEq)]
pub struct Row<V, A = (), E = Error> {
    /// Number of the trajectory, from 0.
    pub trajectory: usize,
    /// Success, or the error of the run, for an [`Integrator`](symplectic_core::Integrator) with its time.
    pub outcome: Result<(), E>,
    /// The state at the end, or after the last successful step.
    pub state: State<V>,
    /// Statistics of its steps.
    pub statistics: Statistics,
    /// The output collected along the trajectory.
    pub output: A,
}
