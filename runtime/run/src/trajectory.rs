//! A trajectory as it is kept: in memory, and in the file from which an interrupted run continues.

use symplectic::ensemble::Row;
use symplectic::nalgebra::DVector;
use symplectic::{Error, State, Statistics, tangent};

use crate::advice;

/// The result of a trajectory, with its states at the output times or in a section: for each of them the time, the positions and
/// the momenta, without an allocation of their own.
#[derive(Debug, Clone, PartialEq)]
pub(super) struct Trajectory {
    /// Its number, from 0.
    pub(super) number: usize,
    pub(super) failure: Option<Failure>,
    /// The state at the end, or after the last successful step.
    pub(super) state: State<DVector<f64>>,
    pub(super) statistics: Statistics,
    pub(super) output: Vec<f64>,
}

/// Why a trajectory failed.
#[derive(Debug, Clone, PartialEq)]
pub(super) struct Failure {
    /// The kind, in a few words.
    pub(super) kind: String,
    pub(super) message: String,
}

impl From<Error> for Failure {
    fn from(error: Error) -> Self {
        Failure {
            kind: kind(&error).to_owned(),
            message: advice::message(error),
        }
    }
}

impl From<tangent::Error> for Failure {
    fn from(error: tangent::Error) -> Self {
        match error {
            tangent::Error::Core(error) => error.into(),
            error => Failure {
                kind: "other".to_owned(),
                message: error.to_string(),
            },
        }
    }
}

impl<E: Into<Failure>> From<Row<DVector<f64>, Vec<f64>, E>> for Trajectory {
    fn from(row: Row<DVector<f64>, Vec<f64>, E>) -> Self {
        Trajectory {
            number: row.trajectory,
            failure: row.outcome.err().map(E::into),
            state: row.state,
            statistics: row.statistics,
            output: row.output,
        }
    }
}

impl From<Row<DVector<f64>>> for Trajectory {
    fn from(row: Row<DVector<f64>>) -> Self {
        Trajectory {
            number: row.trajectory,
            failure: row.outcome.err().map(Failure::from),
            state: row.state,
            statistics: row.statistics,
            output: Vec::new(),
        }
    }
}

/// The kind of an error of a trajectory.
fn kind(error: &Error) -> &'static str {
    match error {
        Error::NonFinite { .. } | Error::NonFiniteState { .. } => "not finite",
        Error::NoConvergence { .. } => "no convergence",
        Error::Stagnation { .. } => "stagnation",
        Error::SingularMatrix { .. } => "singular matrix",
        Error::EventValue { .. } => "section is NaN",
        _ => "other",
    }
}
