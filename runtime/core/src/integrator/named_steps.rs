//! Steppers whose systems name their coordinates.

use super::{DenseSteps, Partitioned};
use crate::method::{Method, Solver};
use crate::number::{Summation, Vector};
use crate::system::{Named, System};

/// The steps of a system with [names](Named), whose runs can be recorded: those of an [`Integrator`](super::Integrator), or of an
/// `Adaptive` run with steps of variable size.
pub trait NamedSteps: DenseSteps<Vector: Vector<Scalar = f64>> {
    /// The system.
    type System: Named;

    /// The system.
    fn system(&self) -> &Self::System;
}

impl<M, S, V, R, N> NamedSteps for Partitioned<M, S, V, R, N>
where
    M: Method,
    S: System<V> + Named,
    V: Vector<Scalar = f64>,
    R: Summation,
    N: Solver<V, S>,
{
    type System = S;

    fn system(&self) -> &S {
        self.system()
    }
}
