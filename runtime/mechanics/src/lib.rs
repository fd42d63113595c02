//! The mechanics of the package `symplectic`: rigid bodies, constraints, discrete and degenerate Lagrangians, generating functions, stages of steps
//!
//! Programs depend on `symplectic` with its feature `mechanics`, which gives all names of this package.

#![no_std]

#[cfg(feature = "alloc")]
extern crate alloc;

mod balance;
#[cfg(feature = "alloc")]
pub mod constraints;
mod error;
#[cfg(feature = "alloc")]
mod rank;
pub mod rotation;
#[cfg(feature = "alloc")]
pub mod variational;

pub use balance::Balance;
pub use error::Error;
