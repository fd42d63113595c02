//! The core of the package `symplectic`: systems, methods, solvers of coupled stages, and the run of a stepper
//!
//! Programs depend on `symplectic`, which gives all names of this package. Generated code names `::symplectic`, too.

#![no_std]

// Generated code names everything `::symplectic::…`; with this it compiles inside the crate too.
#[allow(unused_extern_crates)]
extern crate self as symplectic;

#[cfg(feature = "alloc")]
extern crate alloc;

#[cfg(feature = "std")]
extern crate std;

mod contract;
mod error;
mod state;

#[doc(hidden)]
pub mod inside;
mod integrator;
mod method;
mod number;
pub mod output;
pub mod solver;
pub mod system;

pub use contract::{Method, Orders, ProvedFor};
pub use error::{Error, Quantity};
#[cfg(feature = "alloc")]
pub use integrator::{Checkpoint, CheckpointError};
pub use integrator::{Integrator, ProcessedIntegrator, Retry, Run, Statistics};
pub use method::{composition, splitting, tableau};
pub use nalgebra;
pub use num_traits;
pub use number::{Compensated, Plain, Scalar, Summation, Vector};
pub use output::{Event, Invariant, Progress};
pub use state::State;
pub use system::{
    General, Hamiltonian, Separable, SeparableHamiltonian, System, acceleration, hamiltonian,
    lagrangian, separable,
};

/// What is proved of a method, as bounds of generic code.
pub mod proved {
    pub use crate::contract::{
        LowerOrder, Method, Orders, Processed, ProvedFor, Splits, StoermerVerletSteps, SymmetricFor,
    };
}

/// All integrators, and your own: the trait of a stepper, and what a [`Run`] asks of it.
pub mod stepper {
    pub use crate::integrator::{
        DenseSteps, Equal, NamedSteps, Own, Pace, Partitioned, PhasePoint, ProcessedSteps, Reach,
        Reached, RemainingSteps, Run, StepMap, Stepper,
    };
    pub use crate::state::Timed;
}

/// Code that needs vectors on the heap.
#[cfg(feature = "alloc")]
#[doc(hidden)]
#[macro_export]
macro_rules! if_alloc {
    ($($code:tt)*) => { $($code)* };
}

/// Omits code that needs vectors on the heap: this build has no allocator.
#[cfg(not(feature = "alloc"))]
#[doc(hidden)]
#[macro_export]
macro_rules! if_alloc {
    ($($code:tt)*) => {};
}

/// Doubles side by side.
pub mod simd {
    pub use crate::number::{DefaultLanes, F64x2, F64x4, F64x8, F64x16, Lanes, MAX_LANES};
}

/// What emitted code names; not for people.
#[doc(hidden)]
pub mod emitted {
    #[cfg(feature = "alloc")]
    pub use alloc::vec::Vec;

    pub use num_traits::{One, Zero};

    pub use crate::contract::*;
    pub use crate::method::*;
    pub use crate::number::*;
    pub use crate::output::invariants;
    pub use crate::solver::*;
    pub use crate::system::chain::{Bonds, Chain};
    pub use crate::system::*;
    pub use crate::{chain_system, if_alloc};
}
