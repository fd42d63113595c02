//! What the commands of `symplectic` print on a terminal: errors with their place, and aligned tables.

pub mod errors;
mod output;

pub use output::{aligned, print};
