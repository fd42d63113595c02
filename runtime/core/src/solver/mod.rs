//! Solvers for coupled stages.

pub(crate) mod automatic;
pub(crate) mod convergence;
pub(crate) mod fixed_point;
pub(crate) mod nystrom;
pub(crate) mod predictor;
pub(crate) mod stages_in_lanes;

pub use crate::contract::{
    Decoupling, EvaluationCounts, Failure, HalfChange, HalfTableau, Outcome, SecondOrderTableau,
    Solver, Span, StageChange, StagePolynomial, StageStorage, StageTableau, Step, StepStatistics,
    Stopping, StoredEvaluations, WarmStart,
};
pub use crate::number::{Coefficient, Coefficients, Visit, Words, scalar_words, vector_words};
pub use automatic::{Automatic, AutomaticStages};
pub use fixed_point::FixedPoint;
pub use stages_in_lanes::stages::SimdStages;
pub use stages_in_lanes::{SimdFixedPoint, SimdJacobi};
