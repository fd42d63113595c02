//! Systems: Hamiltonians, Lagrangians, closures and chains of particles, and their classes.

pub(crate) mod chain;
pub(crate) mod class;
pub(crate) mod closures;
#[cfg(feature = "alloc")]
pub(crate) mod gradients;
pub(crate) mod hamiltonian;
pub(crate) mod hamiltonian_macro;
pub(crate) mod in_lanes;
#[cfg(feature = "alloc")]
pub(crate) mod jacobian;
pub(crate) mod lagrangian;
pub(crate) mod lagrangian_macro;
pub(crate) mod lane_parameters;
mod lengths;
pub(crate) mod linearity;
pub(crate) mod masses;
mod named;
mod over_vectors;

pub use class::{
    Class, Conservative, Damped, FreePositions, FreePositionsOrDamped, Frictionless, General,
    Holonomic, HolonomicOrDamped, Separable, SplitClass, Unconstrained, UnconstrainedOrDamped,
};
#[cfg(feature = "alloc")]
pub use class::{Constrained, Nonholonomic};
pub use closures::{
    HamiltonianClosures, Momentum, NoEnergy, SeparableClosures, acceleration, hamiltonian,
    separable,
};
#[cfg(feature = "alloc")]
pub use gradients::Gradients;
#[cfg(feature = "alloc")]
pub(crate) use gradients::Terms;
pub use hamiltonian::{Hamiltonian, SeparableHamiltonian};
pub use hamiltonian_macro::hamiltonian;
pub use in_lanes::SystemLanes;
pub(crate) use in_lanes::first;
#[doc(hidden)]
pub use in_lanes::{Join, LaneWork};
#[cfg(feature = "alloc")]
pub use jacobian::{BandMatrix, Jacobian};
pub use lagrangian::Lagrangian;
pub use lagrangian_macro::lagrangian;
#[doc(hidden)]
pub use lane_parameters::LaneParameter;
#[doc(hidden)]
pub use lengths::{bodies, check_bodies, check_length, check_number, check_numbers, check_pairs};
pub use masses::Masses;
pub use named::Named;
pub use over_vectors::{OverEveryScalar, System, SystemInLanes};
