//! Splittings over flows.

#[path = "../common/mod.rs"]
mod common;

mod asynchronous;
mod in_time;
mod kepler;
mod parts;
mod planets;
mod splittings;
mod substeps;
