//! What comes of a trajectory.

use crate::error::Error;
use crate::integrator::Statistics;
use crate::state::State;

/// What comes of one trajectory of an ensemble.
#[derive(Clone, Debug, PartialEq)]
pub struct Row<V, A = ()> {
    /// The number of the trajectory, from 0.
    pub trajectory: usize,
    /// Whether it came to its end, or else why not: the error, with its time, that an [`Integrator`](crate::Integrator) gives.
    pub outcome: Result<(), Error>,
    /// The state at its end, or after its last good step.
    pub state: State<V>,
    /// What its steps have taken.
    pub statistics: Statistics,
    /// What was made of it on its way, up to where it came.
    pub output: A,
}
