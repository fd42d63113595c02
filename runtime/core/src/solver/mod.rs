//! Solvers for coupled stages.

pub(crate) mod automatic;
pub(crate) mod convergence;
pub(crate) mod fixed_point;
#[cfg(feature = "alloc")]
pub(crate) mod newton;
pub(crate) mod nystrom;
pub(crate) mod predictor;
#[cfg(feature = "alloc")]
pub(crate) mod run_time;
pub(crate) mod stages_in_lanes;
#[cfg(feature = "alloc")]
pub(crate) mod trajectories_in_lanes;

pub use crate::contract::{
    Decoupling, EvaluationCounts, Failure, HalfChange, HalfTableau, Outcome, SecondOrderTableau,
    Solver, Span, StageChange, StagePolynomial, StageStorage, StageTableau, Step, StepStatistics,
    Stopping, StoredEvaluations, WarmStart,
};
pub use crate::number::{Coefficient, Coefficients, Visit, Words, scalar_words, vector_words};
pub use automatic::{Automatic, AutomaticStages};
pub use fixed_point::FixedPoint;
#[cfg(feature = "alloc")]
pub use newton::{
    AnalyticOrDifferences, BandOrDense, Banded, Coupling, Dense, Derivatives, Differences,
    EveryStage, FixedPointThenNewton, FixedPointThenNewtonMemory, LinearSolver, Matrices, Newton,
    NewtonMemory, Parts,
};
#[cfg(feature = "num-dual")]
pub use newton::{DualNumbers, SystemInDuals};
pub use stages_in_lanes::stages::SimdStages;
pub use stages_in_lanes::{SimdFixedPoint, SimdJacobi};
