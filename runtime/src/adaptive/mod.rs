//! Steps of variable size that keep what matters: for orbits of high eccentricity and close encounters.
//!
//! A step size taken from the state before the step spoils what a symplectic or symmetric method is for: the energy drifts. Three
//! ways keep it.
//!
//! | | What it is | Methods | Keeps |
//! |---|---|---|---|
//! | [`Adaptive`] | a reversible controller of the step size, for any system and [`Monitor`] | symmetric ones, explicit or implicit | the energy of reversible systems |
//! | [`Logarithmic`] | another Hamiltonian with the same orbits, for `T(p) + U(q)` with `U < 0` | all splittings for separable systems | the symplectic form; with compositions of `position-verlet` Kepler orbits exactly |
//! | [`Poincare`] | another Hamiltonian, `σ(q)(H − H_0)`, for any H and [`Monitor`] | implicit ones, for general systems | the symplectic form |
//!
//! The last two are systems for an ordinary [`Integrator`](crate::Integrator), with steps of one size in a time τ of their own; physical
//! time is a coordinate.

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

pub use crate::method::Symmetry;
pub use integrator::Adaptive;
#[cfg(feature = "alloc")]
pub use logarithmic::Logarithmic;
pub use monitor::{DistancePower, ForcePower, Monitor, PairDistances};
#[cfg(feature = "alloc")]
pub use poincare::Poincare;
