//! Orbits of high eccentricity and close encounters: steps of variable size that keep the energy
//!
//! The feature `orbits` of the package `symplectic` gives them to programs.

#![no_std]

#[cfg(feature = "alloc")]
extern crate alloc;

#[cfg(feature = "std")]
extern crate std;

pub mod adaptive;
