//! Orbits: steps of variable size that keep the energy, for high eccentricities and close encounters, and the tangent map, for chaos
//!
//! The feature `orbits` of the package `symplectic` gives them to programs.

#![no_std]

#[cfg(feature = "alloc")]
extern crate alloc;

#[cfg(feature = "std")]
extern crate std;

pub mod adaptive;
mod error;
#[cfg(feature = "alloc")]
pub mod tangent;

pub use error::Error;
