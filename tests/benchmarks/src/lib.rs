//! The library against hand-written integrators and other crates: the same problems, methods, steps and sums.
//!
//! Not published. `cargo run --release -p symplectic-benchmarks --example ratios` prints the ratios, `--example instructions` counts
//! instructions, `cargo bench -p symplectic-benchmarks` adds the other crates.

pub mod baseline;
mod pairs;

pub use pairs::{Pair, Run, pairs};
