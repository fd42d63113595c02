//! Steps of the classes of systems with friction or constraints.

#[cfg(feature = "alloc")]
pub(crate) mod constrained;
mod damped;
#[cfg(feature = "alloc")]
mod nonholonomic;

#[cfg(feature = "alloc")]
pub use constrained::{
    ConstrainedPlan, ConstrainedStages, ConstraintForce, consistent, constraint_force,
};
pub use damped::{DampedMemory, DampedPlan, friction_growth};
#[cfg(feature = "alloc")]
pub use nonholonomic::{NonholonomicPlan, NonholonomicStages, consistent_momentum};
