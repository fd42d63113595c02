//! Symplectic integrators for Hamilton's equations
//!
//! ```text
//! q' = ∂H/∂p(t, q, p)      p' = −∂H/∂q(t, q, p)
//! ```
//!
//! The methods are symplectic partitioned Runge–Kutta methods that a macro derives, proves and emits as Rust
//! types; this crate is what steps them. With step size `h` and stages `i = 1..s`:
//!
//! ```text
//! Q_i = q0 + h Σ_j a_ij velocity_j      q1 = q0 + h Σ_i b_i velocity_i
//! P_i = p0 + h Σ_j ã_ij force_j         p1 = p0 + h Σ_i b_i force_i
//! ```
//!
//! | What | Where |
//! |---|---|
//! | The system: a trait, or closures | [`Hamiltonian`], [`SeparableHamiltonian`], [`separable`], [`hamiltonian`], [`acceleration`]; [`Chain`] of [`Bonds`] |
//! | What it computes with | [`Scalar`] (f32, f64, dual numbers), [`Vector`] (static or dynamic nalgebra vectors) |
//! | The method | the macros [`tableau!`], [`splitting!`], [`composition!`] |
//! | Running it | [`State`], [`Integrator`], [`Error`], [`Retry`], [`Statistics`], [`Progress`], [`Invariant`] |
//! | How coupled stages are found | [`Solver`]: [`FixedPoint`], [`InLanes`], [`AtOnceInLanes`], [`SecondOrderInLanes`], [`Newton`], [`FixedPointThenNewton`] |
//! | Between the steps | [`DenseOutput`], [`Interpolation`], [`Event`], [`Events`], [`Moment`] |
//! | What generates a step | [`generating_function`], of Type II |
//! | Which method to take | the package `symplectic-report` |
//! | The method, as the macro emits it | [`Method`], [`StagePlan`], [`Composition`], [`Stages`], [`Coefficient`], [`combine`], [`relax`] |
//!
//! A [`Separable`] system with an [`Explicit`] plan is straight-line code with no solver in it; anything else
//! is [`Coupled`] and goes through the iteration of a [`Solver`]: of [`FixedPoint`] unless told otherwise, of [`Newton`] for
//! stiff systems. The types of the system and of the method decide
//! which, not a test at run time.
//!
//! ```
//! symplectic::tableau! { StoermerVerlet { basis: polynomial(2), nodes: lobatto(2) } }
//! use symplectic::nalgebra::Vector1;
//! use symplectic::{Error, Integrator, State, separable};
//!
//! # fn main() -> Result<(), Error> {
//! // The pendulum, H = p²/2 − cos q.
//! let pendulum = separable::<Vector1<f64>, _, _>(
//!     |_time, p, velocity| velocity[0] = p[0],
//!     |_time, q, force| force[0] = -q[0].sin(),
//! )
//! .with_energy(|_time, q, p| p[0] * p[0] / 2.0 - q[0].cos());
//!
//! let start = State::new(0.0, Vector1::new(1.0), Vector1::new(0.0));
//! let mut integrator = Integrator::new(StoermerVerlet, pendulum, start, 0.01)?;
//! let before = integrator.energy().expect("the system has an energy");
//! integrator.integrate_to(100.0)?;
//! let after = integrator.energy().expect("the system has an energy");
//! assert_eq!(integrator.state().time, 100.0);
//! assert!((after - before).abs() < 1e-5);
//! # Ok(())
//! # }
//! ```
//!
//! # Features
//!
//! * `std` (default): `tan`, inverse and hyperbolic functions, and all functions of singles, from the standard library; implies `alloc`.
//! * `alloc`: dynamic vectors, [`nalgebra::DVector`], [`Newton`], and [`generating_function`].
//! * `num-dual`: `num_dual::Dual64` is a [`Scalar`], and [`Newton`] takes derivatives by dual numbers; implies `std`.
//! * neither `std` nor `alloc`: `no_std` without an allocator; static vectors, the functions named under `std` from `libm`.

#![no_std]

// Generated code names everything `::symplectic::…`; with this it compiles inside the crate too.
#[allow(unused_extern_crates)]
extern crate self as symplectic;

#[cfg(feature = "alloc")]
extern crate alloc;

mod error;
mod state;

mod integrator;
mod method;
mod number;
mod output;
mod solver;
mod system;
#[cfg(feature = "alloc")]
mod variational;

pub use error::{Error, Quantity};
pub use integrator::{Integrator, Retry, Statistics};
pub use method::{
    Change, Composition, CompositionMemory, Coupled, Decoupling, Drift, EvaluationCounts,
    Evaluations, Explicit, Failure, Force, HalfTableau, Inside, Interpolation, Kept, LowerOrder,
    Method, Moves, Orders, Outcome, PartChange, Plan, ProvedFor, SecondOrderTableau, SeparableOnly,
    Solver, Span, Splitting, SplittingPlan, StagePlan, StagePolynomial, StageStorage, StageTableau,
    Stages, Step, Stopping, StoredEvaluations, Substep, Substeps, Witness, Work, composition, rows,
    splitting, staircase, tableau,
};
pub use nalgebra;
pub use num_traits;
pub use number::{
    Coefficient, Coefficients, Compensated, F64x2, F64x4, F64x8, Lanes, Plain, Scalar, Summation,
    Vector, advance, combine, copy, copy_to, factors, increment, relative, scale, total, transform,
    weighted_total, weights,
};
pub use output::{DenseOutput, Event, Events, Invariant, Moment, Progress, States};
#[cfg(feature = "alloc")]
pub use solver::{
    Analytic, BandMatrix, Banded, Coupling, Dense, Derivatives, Differences, EveryStage,
    FixedPointThenNewton, FixedPointThenNewtonMemory, Jacobian, LinearSolver, Linearized, Matrices,
    Newton, NewtonMemory, Parts,
};
pub use solver::{
    AtOnceInLanes, FixedPoint, InLanes, LaneStages, SecondOrderInLanes, SecondOrderStages, relax,
};
#[cfg(feature = "num-dual")]
pub use solver::{DualNumbers, HamiltonianInDuals};
pub use state::State;
pub use system::{
    Bonds, Chain, Class, Components, General, Hamiltonian, HamiltonianClosures, HamiltonianInLanes,
    Layout, MOST_ROW_STAGES, Momentum, NoEnergy, Separable, SeparableClosures,
    SeparableHamiltonian, StageRows, SystemLanes, acceleration, hamiltonian, separable,
};
#[cfg(feature = "alloc")]
pub use variational::{GeneratingFunction, generating_function};
