//! Discrete mechanics: what generates a step.
//!
//! A method has a [generating function](generating_function()) for each of its steps; and a [`DiscreteLagrangian`] that is given has steps that it generates, by
//! a [`VariationalIntegrator`]. What holds for it is asked of a [`DiscretePath`].

mod checks;
mod discrete_lagrangian;
pub(crate) mod generating_function;
mod integrator;
mod regular;

pub use checks::DiscretePath;
pub use discrete_lagrangian::DiscreteLagrangian;
pub use generating_function::{GeneratingFunction, generating_function};
pub use integrator::VariationalIntegrator;
