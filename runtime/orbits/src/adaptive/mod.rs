//! Steps of variable size without energy drift: for orbits of high eccentricity and close encounters.
//!
//! If the step size depends only on the state before the step, symplectic and symmetric methods lose their advantage: the energy drifts.
//! Three ways avoid that.
//!
//! | | What it is | Methods | Conserves |
//! |---|---|---|---|
//! | [`Adaptive`] | a reversible controller of the step size, for any system and [`Monitor`] | symmetric ones, explicit or implicit | the energy of reversible systems, without drift |
//! | [`Logarithmic`] | another Hamiltonian with the same orbits, for `T(p) + U(q)` with `U < 0` | all splittings for separable systems | the symplectic form; with compositions of `position-verlet` also Kepler orbits, exactly |
//! | [`Poincare`] | another Hamiltonian, `σ(q)(H − H_0)`, for any H and [`Monitor`] | implicit ones, for general systems | the symplectic form |
//!
//! The last two are systems for an ordinary [`Integrator`](symplectic_core::Integrator) with equal steps in a fictitious time τ; physical time is a
//! coordinate.

#[cfg(feature = "alloc")]
mod checkpoint;
#[cfg(feature = "alloc")]
mod extended;
mod integrator;
#[cfg(feature = "alloc")]
mod logarithmic;
mod monitor;
mod output;
#[cfg(feature = "alloc")]
mod poincare;

pub use crate::error::Error;
pub use integrator::{Adaptive, AdaptiveSteps};
#[cfg(feature = "alloc")]
pub use logarithmic::Logarithmic;
pub use monitor::{DistancePower, ForcePower, Monitor, PairDistances};
#[cfg(feature = "alloc")]
pub use poincare::Poincare;
pub use symplectic_core::inside::Symmetry;
