//! Discrete mechanics: what generates a step, its stages, and the balances of energy and momentum.

#[cfg(feature = "alloc")]
pub(crate) mod generating_function;
#[cfg(feature = "alloc")]
pub(crate) mod stages;
#[cfg(feature = "alloc")]
mod two_ends;

#[cfg(feature = "alloc")]
pub use generating_function::{GeneratingFunction, generating_function};
#[cfg(feature = "alloc")]
pub use stages::{StageOfStep, StagesOfStep};
