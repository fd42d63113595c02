//! Discrete mechanics: generating functions and stages of steps, and the balances of energy and momentum.
//!
//! Every step of a method has a [generating function](generating_function()), and [stages](StagesOfStep) with the work and the impulse of
//! applied forces. A [`DiscreteLagrangian`] supplied by the user generates the steps of a [`VariationalIntegrator`], or of an
//! [`EnergyMomentumIntegrator`], which chooses the step size. A [`DiscretePath`] tests its properties. A [`LagrangianIntegrator`] applies
//! a method to a [`Lagrangian`](symplectic_core::system::Lagrangian). A [`DiracIntegrator`] is for degenerate Lagrangians and for constraints on
//! velocities.

mod checks;
mod cotangent_lift;
mod dirac;
mod discrete_lagrangian;
mod end_derivative;
mod ends;
mod energies;
mod energy_momentum;
mod failure;
mod generating_function;
mod given_ends;
mod hamilton_jacobi;
mod integrator;
mod lagrangian;
mod momentum_map;
mod newmark;
mod observed_order;
mod regular;
mod stages;
mod two_ends;

pub use crate::Error;
pub use checks::DiscretePath;
pub use cotangent_lift::{PointTransformation, cotangent_lift};
pub use dirac::{
    DiracIntegrator, DiracRule, DiracSteps, DiracSystem, PrimaryConstraint, primary_constraints,
};
pub use discrete_lagrangian::DiscreteLagrangian;
pub use energy_momentum::{EnergyMomentumIntegrator, EnergyMomentumSteps};
pub use generating_function::{
    GeneratingFunction, generating_function, step_with_generating_function,
};
pub use given_ends::{GeneratingFunctions, GivenEnds};
pub use hamilton_jacobi::DiscreteHamiltonJacobi;
pub use integrator::{VariationalIntegrator, VariationalSteps};
pub use lagrangian::{
    LagrangianIntegrator, LagrangianSteps, momentum_of_velocity, velocity_of_momentum,
};
pub use momentum_map::momentum_map;
pub use newmark::Newmark;
pub use observed_order::observed_order;
pub use stages::{StageOfStep, StagesOfStep, StepWithStages};
