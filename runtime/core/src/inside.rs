//! What the other packages of this workspace need of the core; no promise to anybody else.

// Ensembles.
#[cfg(feature = "alloc")]
pub use crate::integrator::CoupledLanes;
#[cfg(feature = "alloc")]
pub use crate::integrator::explicit_in_lanes::{SavedRun, evaluations, is_same};
#[cfg(feature = "alloc")]
pub use crate::integrator::fingerprint::system_fingerprint;
#[cfg(feature = "alloc")]
pub use crate::integrator::validation::check_orders;
pub use crate::integrator::validation::{check_quadratic_kinetic, check_step_size};
pub use crate::number::registers::{Avx2, Avx512, Widest};
pub use crate::number::vector::same;
pub use crate::output::at_times::{Output, is_after};
#[cfg(feature = "alloc")]
pub use crate::system::lane_registers::{may_be_found, over_lanes_of, widest, width};
