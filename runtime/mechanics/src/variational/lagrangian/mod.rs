//! Lagrangians: momenta and velocities, and steps that need no Hamiltonian.

mod coefficients;
pub(crate) mod derivatives;
mod integrator;
mod legendre;
mod linear;
mod stages;

pub use integrator::{LagrangianIntegrator, LagrangianSteps};
pub use legendre::{momentum_of_velocity, velocity_of_momentum};
