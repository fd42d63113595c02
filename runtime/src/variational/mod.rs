//! Discrete mechanics: what generates a step.

#[cfg(feature = "alloc")]
pub(crate) mod generating_function;

#[cfg(feature = "alloc")]
pub use generating_function::{GeneratingFunction, generating_function};
