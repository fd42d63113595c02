//! Errors.

mod flow;

pub use flow::FlowError;

use symplectic_core::inside::{Short, debug_by_message};

debug_by_message!(Error);

/// The error type of flows and their steps. After an error the state of an integrator is that of the last successful step.
#[derive(Clone, PartialEq, thiserror::Error)]
#[non_exhaustive]
pub enum Error {
    /// An error of the core, such as a step of size zero or a state that is not finite.
    #[error(transparent)]
    Core(#[from] symplectic_core::Error),

    /// A flow of a splitting failed.
    #[error("step {step} of size {step_size} at time {time}: {failure}",
        time = Short(*.time),
        step_size = Short(*.step_size)
    )]
    Flow {
        /// Time at the start of the step.
        time: f64,
        /// Step size.
        step_size: f64,
        /// Number of the step, from 1.
        step: u64,
        /// Why.
        failure: FlowError,
    },

    /// A parameter of a flow is not finite or out of range.
    #[error("the {what} (index {index}) is {value}; it must be {range}",
        value = Short(*.value)
    )]
    FlowParameter {
        /// Name of the parameter.
        what: &'static str,
        /// Its index, from 0.
        index: usize,
        /// Its value.
        value: f64,
        /// Its range.
        range: &'static str,
    },
}
