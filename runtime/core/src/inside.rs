//! What the other packages of this workspace need of the core; no promise to anybody else.

pub use crate::error::FlowError;

#[cfg(feature = "alloc")]
pub use crate::integrator::CoupledLanes;
pub use crate::integrator::checkpoint::Save;
pub use crate::integrator::clock::Clock;
#[cfg(feature = "alloc")]
pub use crate::integrator::explicit_in_lanes::{SavedRun, evaluations, is_same};
pub use crate::integrator::fingerprint::hash;
#[cfg(feature = "alloc")]
pub use crate::integrator::fingerprint::system_fingerprint;
pub use crate::integrator::last_step::LastEvent;
pub use crate::integrator::parts::{Parts, parts_of};
#[cfg(feature = "alloc")]
pub use crate::integrator::validation::check_orders;
pub use crate::integrator::validation::{check_quadratic_kinetic, check_state, check_step_size};

pub use crate::method::storage::is_finite;
pub use crate::method::symmetric_steps::SymmetricSteps;
pub use crate::method::{KickDrift, Outcome, Plan, Span, StageStorage};

pub use crate::number::array::array;
pub use crate::number::registers::{Avx2, Avx512, Widest};
pub use crate::number::summation::{fast_two_sum, two_sum};
pub use crate::number::vector::same;
pub use crate::number::{Coefficient, Visit, Words, copy, vector_words};

pub use crate::output::at_times::{Output, is_after};

#[cfg(feature = "alloc")]
pub use crate::system::lane_registers::{may_be_found, over_lanes_of, widest, width};

pub use crate::words;
