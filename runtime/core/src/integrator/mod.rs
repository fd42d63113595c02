//! Runs and their steppers; the stepper of a partitioned Runge–Kutta method.

pub(crate) mod clock;
mod dense_steps;
pub(crate) mod first_step;
pub(crate) mod last_step;
mod pace;
pub(crate) mod partial_step;
pub(crate) mod parts;
pub(crate) mod reach;
pub(crate) mod retry;
pub(crate) mod run;
pub(crate) mod sight;
pub(crate) mod statistics;
pub(crate) mod stepper;
pub(crate) mod steps_beside;

#[cfg(feature = "alloc")]
pub use checkpoint::{Checkpoint, CheckpointError};
pub use clock::RemainingSteps;
pub use dense_steps::DenseSteps;
pub use named_steps::NamedSteps;
pub use pace::{Equal, Own, Pace};
pub use partitioned::PlanOf;
pub use partitioned::{Integrator, Partitioned};
pub use processed::{ProcessedIntegrator, ProcessedSteps};
pub use reach::{Reach, Reached};
pub use retry::Retry;
pub use run::Run;
pub use statistics::Statistics;
pub use step_map::{PhasePoint, StepMap};
pub use stepper::Stepper;

#[cfg(feature = "alloc")]
pub(crate) mod checkpoint;
#[cfg(feature = "serde")]
mod checkpoint_format;
#[cfg(feature = "alloc")]
pub(crate) mod fingerprint;
mod many_steps;
pub(crate) mod memory;
mod named_steps;
mod one_step;
pub(crate) mod partitioned;
mod processed;
mod solvers;
mod step_map;
pub(crate) mod validation;
