//! Integrators written by hand for one problem each, as fast as their author could make them: what the benches and the
//! ratios hold the generated code against.
//!
//! They do what the library does and nothing beside it: no errors, no statistics, no checks, fixed dimension. A test
//! holds their end states to those of the library.

#![allow(
    clippy::needless_range_loop,
    reason = "one index runs through several arrays"
)]

pub mod chain;
pub mod chain_no_drift;
pub mod explicit;
pub mod gauss;
pub mod lanes;
pub mod no_drift;
pub mod systems;
