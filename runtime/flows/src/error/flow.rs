//! The errors of flows.

use symplectic_core::Quantity;
use symplectic_core::inside::{Short, debug_by_message};

debug_by_message!(FlowError);

/// The reason why a [`Flow`](crate::Flow) failed; an integrator adds the step, in [`Error::Flow`](crate::Error::Flow).
#[derive(Clone, Copy, PartialEq, thiserror::Error)]
#[non_exhaustive]
pub enum FlowError {
    /// A result of a flow is NaN or infinite.
    #[error(
        "the {what} is not finite; take a smaller step, or keep the state where the flow is defined"
    )]
    NonFinite {
        /// The quantity that is not finite.
        what: Quantity,
    },

    /// The number of components of the state differs from that of the flow.
    #[error("the flow has {expected} components, the state {found}")]
    Dimension {
        /// Number of components of the flow.
        expected: usize,
        /// Number of components of the state.
        found: usize,
    },

    /// A flow without an inverse cannot run backward: the step size or a coefficient of the method is negative.
    #[error(
        "the flow cannot run backward (duration {size}); take a positive step size and a method whose coefficients are positive",
        size = Short(*.size)
    )]
    Backward {
        /// The requested duration.
        size: f64,
    },

    /// Two bodies are at the same position.
    #[error("bodies {first} and {second} are at the same position; their gravity is infinite")]
    Collision {
        /// The first body, from 0.
        first: usize,
        /// The second body, from 0.
        second: usize,
    },

    /// A body is at the centre of its Kepler orbit, at the start or at the end of the flow.
    #[error("body {body} is at the centre of its orbit; its velocity is infinite")]
    AtCentre {
        /// The body, from 0.
        body: usize,
    },

    /// A Kepler orbit was followed for too many periods: less than half of the digits of its phase remain.
    #[error(
        "the flow takes body {body} through {periods:e} periods of its orbit, and the phase at the end is known to less than half of \
         its digits; take a smaller step"
    )]
    Periods {
        /// The body, from 0.
        body: usize,
        /// Number of periods.
        periods: f64,
    },

    /// The end of a Kepler orbit is not finite, or less than half of the digits of its distance remain.
    #[error(
        "the end of the orbit of body {body} is not finite, or known to less than half of its digits; take a smaller step"
    )]
    NoOrbit {
        /// The body, from 0.
        body: usize,
    },

    /// The flow failed for another reason; user-defined flows can return it, too.
    #[error("{reason}")]
    Other {
        /// The reason, and what to do.
        reason: &'static str,
    },
}
