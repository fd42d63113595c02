//! What systems, methods and solvers know of each other: the traits that name each other, and the data of a step.

pub(crate) mod change;
pub(crate) mod class;
mod constrained_tableau;
#[cfg(feature = "alloc")]
pub(crate) mod coupled_step;
pub(crate) mod in_lanes;
pub(crate) mod interpolation;
#[cfg(feature = "alloc")]
mod jacobian;
mod kick_drift;
pub(crate) mod linearity;
mod masses;
mod method;
mod plan;
mod processed;
mod proved;
pub(crate) mod relax;
#[cfg(feature = "alloc")]
pub(crate) mod rows;
mod solver;
mod stage_plan;
mod stage_sums;
mod step;
mod stopping;
pub(crate) mod storage;
mod system;
pub(crate) mod tableau;
mod work;

pub use change::{HalfChange, StageChange};
pub use class::{
    Class, Conservative, FreePositions, FreePositionsOrDamped, Frictionless, General, Holonomic,
    HolonomicOrDamped, NotGeneral, Separable, SeparableOrDamped, SplitClass, Unconstrained,
    UnconstrainedOrDamped,
};
pub use constrained_tableau::{ConstrainedStep, ConstrainedTableau};
pub use in_lanes::SystemLanes;
pub(crate) use in_lanes::first;
#[doc(hidden)]
pub use in_lanes::{Join, LaneWork};
pub use interpolation::{Inside, Interpolation};
#[cfg(feature = "alloc")]
pub use jacobian::{BandMatrix, Jacobian};
pub use kick_drift::KickDrift;
pub use masses::Masses;
pub use method::Method;
pub use plan::Plan;
pub use processed::Processed;
pub use proved::{
    LowerOrder, Orders, Possible, ProvedFor, Splits, StoermerVerletSteps, SymmetricFor, Symmetry,
};
#[cfg(feature = "alloc")]
pub use rows::CoupledRows;
pub use solver::Solver;
pub use stage_plan::StagePlan;
pub use stage_sums::{StageSums, StartingValues, Sweep};
pub use step::{EvaluationCounts, EvaluationObserver, Outcome, Span, StageView, Step, WarmStart};
pub use stopping::Stopping;
pub use storage::{Evaluations, StageStorage, Stages};
#[cfg(feature = "alloc")]
pub use storage::{StagePart, StageVisit};
pub use system::{OverEveryScalar, System, SystemInLanes};
pub use tableau::{
    Decoupling, HalfTableau, SecondOrderTableau, StagePolynomial, StageTableau, StoredEvaluations,
    TableauWork,
};
pub use work::{Failure, StepStatistics};
