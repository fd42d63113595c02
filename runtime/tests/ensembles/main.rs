//! Ensembles: every trajectory has the bits that it has alone, and what comes of many is right.

#[path = "../common/mod.rs"]
mod common;

mod adaptive;
mod bits;
mod coupled;
mod errors;
mod failures;
mod formulas;
mod outputs;
mod parameters;
mod restart;
mod run_time;
mod systems;
mod tangent;
mod wrappers;
