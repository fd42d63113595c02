//! Splittings over flows.

#[path = "../common/mod.rs"]
mod common;

mod asynchronous;
mod corrector;
mod in_time;
mod kepler;
mod kepler_digits;
mod methods;
mod mollified;
mod output;
mod parts;
mod planets;
mod restart;
mod splittings;
mod substeps;
