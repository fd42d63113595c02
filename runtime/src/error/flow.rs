//! Why a flow could not be taken.

use super::Quantity;

/// Why a [`Flow`](crate::flow::Flow) could not be taken; an integrator says at which step, in
/// [`Error::Flow`](crate::Error::Flow).
#[derive(Clone, Copy, Debug, PartialEq, thiserror::Error)]
#[non_exhaustive]
pub enum FlowError {
    /// What a flow has computed is infinite or not a number.
    #[error(
        "the {what} is not finite; take a smaller step, or keep the state where the flow is defined"
    )]
    NonFinite {
        /// What is not finite.
        what: Quantity,
    },

    /// The state has another number of components than the flow is for.
    #[error("the flow is for {expected} components of the position, and there are {found}")]
    Dimension {
        /// Components that the flow is for.
        expected: usize,
        /// Components of the state.
        found: usize,
    },

    /// A flow that has no inverse was asked to go backward: the step size is negative, or a coefficient of the method.
    #[error(
        "the flow cannot go backward, by {size}; take a positive step size and a method whose coefficients are positive"
    )]
    Backward {
        /// The duration asked for.
        size: f64,
    },

    /// Two bodies are in one place.
    #[error("bodies {first} and {second} are in one place; their gravity is infinite")]
    Collision {
        /// The first body, from 0.
        first: usize,
        /// The second one.
        second: usize,
    },

    /// A body is at the centre of its Kepler orbit, at the start or at the end of the flow.
    #[error("body {body} is at the centre of its orbit; its velocity is infinite")]
    AtCentre {
        /// The body, from 0.
        body: usize,
    },

    /// A Kepler orbit that was followed for too many periods: less than half of the digits of its phase are left.
    #[error(
        "the flow takes body {body} through {periods:e} periods of its orbit, and the phase at the end is known to less than half of \
         its digits; take a smaller step"
    )]
    Periods {
        /// The body, from 0.
        body: usize,
        /// The periods.
        periods: f64,
    },

    /// The end of a Kepler orbit is not finite, or less than half of the digits of its distance are left.
    #[error(
        "the end of the orbit of body {body} is not finite, or known to less than half of its digits; take a smaller step"
    )]
    NoOrbit {
        /// The body, from 0.
        body: usize,
    },

    /// A flow cannot be taken, for a reason of its own: also for flows of yours.
    #[error("{reason}")]
    Other {
        /// Why, and what to do.
        reason: &'static str,
    },
}
