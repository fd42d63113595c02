//! Systems: Hamiltonians, Lagrangians, closures and chains of particles, and their classes.

pub(crate) mod chain;
pub(crate) mod closures;
pub(crate) mod hamiltonian;
pub(crate) mod hamiltonian_macro;
pub(crate) mod lagrangian;
pub(crate) mod lagrangian_macro;
pub(crate) mod lane_parameters;
#[cfg(feature = "alloc")]
pub(crate) mod lane_registers;
mod lengths;
mod named;
mod over_vectors;

pub(crate) use crate::contract::linearity;
#[cfg(feature = "alloc")]
pub use crate::contract::{BandMatrix, Jacobian};
pub use crate::contract::{
    Class, Conservative, FreePositions, FreePositionsOrDamped, Frictionless, General, Holonomic,
    HolonomicOrDamped, Masses, NotGeneral, OverEveryScalar, Separable, SeparableOrDamped,
    SplitClass, System, SystemInLanes, SystemLanes, Unconstrained, UnconstrainedOrDamped,
};
#[doc(hidden)]
pub use crate::contract::{Join, LaneWork};
pub use crate::error::ConstraintName;
pub use closures::{
    HamiltonianClosures, Momentum, NoEnergy, SeparableClosures, acceleration, hamiltonian,
    separable,
};
pub use hamiltonian::{Hamiltonian, SeparableHamiltonian};
pub use hamiltonian_macro::hamiltonian;
pub use lagrangian::Lagrangian;
pub use lagrangian_macro::lagrangian;
#[doc(hidden)]
pub use lane_parameters::LaneParameter;
#[doc(hidden)]
pub use lengths::{bodies, check_bodies, check_length, check_number, check_numbers, check_pairs};
pub use named::Named;
