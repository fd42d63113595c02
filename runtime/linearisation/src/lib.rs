//! Linearised equations of the packages of `symplectic`: derivatives by dual numbers, and linear systems by elimination
//!
//! It is for these packages, which are published together; it makes no promise to other programs.

#![no_std]

#[cfg(feature = "alloc")]
extern crate alloc;

mod dual;
#[cfg(feature = "alloc")]
mod elimination;

pub use dual::{Dual, HyperDual};
#[cfg(feature = "alloc")]
pub use elimination::{Complex, Elimination, Entry};
