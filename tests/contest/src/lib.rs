//! The library against integrators written by hand, and against other crates: the same problems, methods, steps and sums.
//!
//! Not published. `cargo run --release --example ratios` prints the ratios, `--example instructions` counts instructions,
//! `cargo bench -p symplectic-contest` has the other crates beside them.

pub mod baseline;
mod pairs;

pub use pairs::{Pair, Run, pairs};
