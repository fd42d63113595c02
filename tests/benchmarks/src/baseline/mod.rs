//! Hand-written integrators, each for one problem and as fast as possible: the baseline of the benches and the ratios
//! for the generated code.
//!
//! They compute the same as the library and nothing else: no errors, no statistics, no checks, fixed dimension. A test
//! compares their end states with those of the library.

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
