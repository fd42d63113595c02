//! Tableaux at run time: methods whose coefficients are in a value, not in a type. They are derived by the program, or read from a file
//!
//! The feature `at-run-time` of the package `symplectic` gives them to programs.

#![no_std]

extern crate alloc;

mod coefficients;
mod decoupling;
mod error;
mod fitted;
mod plan;
mod rows;
mod schedule;
mod tableau;
mod wide;

pub use coefficients::RunTimeCoefficients;
pub use error::TableauError;
pub use fitted::{FittedCoefficients, FittedEntry, FittedTerm};
pub use tableau::RunTimeTableau;
