//! Splittings over flows.

#[path = "../common/mod.rs"]
mod common;

mod kepler;
mod parts;
mod planets;
mod splittings;
mod substeps;
