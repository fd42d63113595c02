//! What the other packages of this workspace need of the core; no promise to anybody else.

pub use crate::error::debug::debug_by_message;
pub use crate::error::phrases::Short;

pub use crate::contract::in_lanes::first;

#[cfg(feature = "alloc")]
pub use crate::contract::{Possible, StagePart, StageVisit};

#[cfg(feature = "alloc")]
pub use crate::integrator::checkpoint::{Save, SaveWords};
pub use crate::integrator::clock::Clock;
#[cfg(feature = "alloc")]
pub use crate::integrator::fingerprint::{hash, system_fingerprint};
pub use crate::integrator::first_step::{OfTheCore, or_as_first_step};
pub use crate::integrator::last_step::LastEvent;
pub use crate::integrator::memory::StepMemory;
pub use crate::integrator::partitioned::{MemoryOf, PlanOf};
pub use crate::integrator::parts::{Parts, StepParts, parts_of, step_parts_of};
pub use crate::integrator::stepper::advance_in_time;
pub use crate::integrator::steps_beside::StepsBeside;
pub use crate::integrator::validation::{check_start, check_state, check_step_size};

pub use crate::method::composition::in_turn;
pub use crate::method::diagnosis::{Attempt, FirstFault};
pub use crate::method::storage::{
    first_mismatch, first_non_finite, first_non_finite_of, is_finite,
};
pub use crate::method::symmetric_steps::{Part, SymmetricSteps};
pub use crate::method::{
    ConstrainedStep, ConstrainedTableau, EvaluationObserver, Evaluations, KickDrift, Plan,
    StagePlan, StageView, Symmetry, TableauWork,
};

pub use crate::number::array::array;
pub use crate::number::dither::{dither_last_sweep, dither_side};
pub use crate::number::linear_combination::{add_products, totals_by};
pub use crate::number::registers::{
    Avx2, Avx512, EightLanes, Widest, Work, in_eight_lanes, in_eight_lanes_of,
};
pub use crate::number::scalar::larger_or_nan;
pub use crate::number::summation::{add, add_sum, fast_two_sum, two_sum};
pub use crate::number::vector::{beside, same, same_mut};
pub use crate::number::words::{show_vectors, words};
pub use crate::number::{advance, copy, scale};

pub use crate::output::at_times::{Output, is_after};

#[cfg(feature = "alloc")]
pub use crate::solver::convergence::{Progress, ROUNDING, STAGNATION, non_finite};
pub use crate::solver::fixed_point::by_stages;

#[cfg(feature = "alloc")]
pub use crate::system::lane_registers::{may_be_found, over_lanes_of, widest, width};
pub use crate::system::linearity::non_linear_velocity;

/// The coefficients of a tableau at run time, and a step with them.
#[cfg(feature = "alloc")]
pub mod rows {
    pub use crate::contract::CoupledRows;
    pub use crate::contract::coupled_step::CoupledStep;
    pub use crate::contract::rows::{
        Evaluation, HalfRows, Kind, MAX_EVALUATIONS, Row, RowDecoupling,
    };
}

/// What sweeps over the stages of several trajectories share with those over the stages of one.
pub mod sweeps {
    pub use crate::contract::tableau::{Columns, eliminates};
    pub use crate::number::linear_combination::{TermsOfComponents, shortest, sum_of_products};
    pub use crate::number::summation::{Overrelaxed, Terms, moved};
    pub use crate::solver::convergence::PATIENCE;
    pub use crate::solver::nystrom::{Start, position, tableau};
    pub use crate::solver::predictor::{Starting, starts_at_once};
    pub use crate::solver::stages_in_lanes::change::{LaneMovement, noted};
    pub use crate::solver::stages_in_lanes::sums::{BasePlusSum, StageValue};
    pub use crate::solver::stages_in_lanes::sweeps::{are_at_one_time, extrapolates};
}

/// An error with the name of its constraint, if it has one.
pub fn named(
    error: crate::error::Error,
    of: impl Fn(usize) -> Option<crate::error::ConstraintName>,
) -> crate::error::Error {
    error.named(of)
}
