//! Symplectic integrators for Hamilton's equations
//!
//! ```text
//! q' = ∂H/∂p(t, q, p)      p' = −∂H/∂q(t, q, p)
//! ```
//!
//! The methods are symplectic partitioned Runge–Kutta methods. A macro derives them, proves their properties and emits them as Rust types;
//! this crate integrates with them. With step size `h` and stages `i = 1..s`:
//!
//! ```text
//! Q_i = q0 + h Σ_j a_ij velocity_j      q1 = q0 + h Σ_i b_i velocity_i      velocity_i = ∂H/∂p(Q_i, P_i)
//! P_i = p0 + h Σ_j ã_ij force_j         p1 = p0 + h Σ_i b̃_i force_i         force_i = −∂H/∂q(Q_i, P_i)
//!
//! symplectic for every H:   b_i ã_ij + b̃_j a_ji = b_i b̃_j      b_i = b̃_i
//! ```
//!
//! | What | Where |
//! |---|---|
//! | The system: a formula, closures or a trait | [`hamiltonian!`], [`lagrangian!`]; [`separable`], [`hamiltonian()`], [`acceleration`]; [`SeparableHamiltonian`], [`Hamiltonian`]; [`system`] |
//! | Numbers and vectors | [`Scalar`] (f32, f64, dual numbers), [`Vector`] (static or dynamic nalgebra vectors), [`simd`] |
//! | Constraints, friction and other forces | [`constraints`], feature `mechanics`; [`friction`], feature `flows`; [`Hamiltonian::applied_force`] |
//! | Steps of variable size, for close encounters | [`adaptive`], feature `orbits` |
//! | Splittings over flows of your own: harmonic, magnetic, damped, stochastic, Kepler | [`flow`], feature `flows` |
//! | A rigid body that turns about a point | [`rotation`], feature `mechanics` |
//! | Discrete and degenerate Lagrangians, generating functions, stages and balances | [`variational`], feature `mechanics` |
//! | The method | the macros [`tableau!`], [`splitting!`], [`composition!`]; [`at_run_time`], feature `at-run-time` |
//! | A run | [`Integrator`], [`State`], [`Error`], [`Retry`], [`Statistics`], [`Checkpoint`] |
//! | All integrators, and your own | [`Run`], [`stepper`]; their tests: [`stepper::StepMap`] |
//! | Output and events | [`Event`], [`Invariant`], [`Progress`]; [`output`] |
//! | Many trajectories, in lanes and on all cores | [`ensemble`] |
//! | Is an orbit chaotic? MEGNO, Lyapunov exponent, tangent map | [`tangent`], feature `orbits` |
//! | How coupled stages are found | [`solver`] |
//! | Choosing a method | the chapter of this name in the book (`docs/`); the package `symplectic-report` compares methods on your problem |
//!
//! The types of the system and of the method decide how a step is taken. Splittings of [`Separable`] systems are straight-line code.
//! Coupled stages are found by an iteration: by fixed points unless a [`solver`] such as Newton's is named.
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
//! * `alloc`: dynamic vectors ([`nalgebra::DVector`]), checkpoints.
//! * `at-run-time`: the module [`at_run_time`], methods whose coefficients are in a value; implies `alloc`.
//! * `newton`: Newton's iteration for stiff and strongly coupled systems, [`solver::ByNewton`]; implies `alloc`.
//! * `mechanics`: rigid bodies and balances; with `alloc` also constraints, discrete and degenerate Lagrangians, generating functions and stages of steps.
//! * `flows`: the modules [`flow`] and [`friction`]; Kepler orbits, linear, mollified and asynchronous flows, and correctors need `alloc`.
//! * `orbits`: the module [`adaptive`]; with `alloc` also [`adaptive::Logarithmic`], [`adaptive::Poincare`] and the module [`tangent`].
//! * `files`: the module [`files`], tables of a run and files that are replaced as a whole; implies `std`.
//! * `ensembles`: the module [`ensemble`], many trajectories at once; implies `alloc`.
//! * `parallel`: the trajectories of an ensemble are shared among threads; implies `ensembles` and `std`.
//! * `npz`: [recordings](files) and ensembles are written to files for NumPy; implies `files`.
//! * `parquet`: ensembles are written to tables of Apache Parquet; implies `ensembles` and `std`.
//! * `serde`: a [`Checkpoint`] can be written and read in any format; implies `alloc`.
//! * `num-dual`: `num_dual::Dual64` is a [`Scalar`], and with `newton` its iteration takes derivatives by dual numbers; implies `std`.
//! * `fma`: products in sums are rounded once, everywhere; very slow without the instruction.
//! * neither `std` nor `alloc`: `no_std` without an allocator; static vectors, the functions named under `std` from `libm`.

#![no_std]

#[cfg(feature = "at-run-time")]
#[doc(inline)]
pub use symplectic_at_run_time as at_run_time;
pub use symplectic_core::*;
#[cfg(feature = "ensembles")]
#[doc(inline)]
pub use symplectic_ensembles as ensemble;
#[cfg(feature = "files")]
#[doc(inline)]
pub use symplectic_files as files;
#[cfg(feature = "flows")]
#[doc(inline)]
pub use symplectic_flows as flow;
#[cfg(feature = "flows")]
#[doc(inline)]
pub use symplectic_flows::friction;
#[cfg(feature = "mechanics")]
#[doc(inline)]
pub use symplectic_mechanics::rotation;
#[cfg(all(feature = "mechanics", feature = "alloc"))]
#[doc(inline)]
pub use symplectic_mechanics::{constraints, variational};
#[cfg(feature = "orbits")]
#[doc(inline)]
pub use symplectic_orbits::adaptive;
#[cfg(all(feature = "orbits", feature = "alloc"))]
#[doc(inline)]
pub use symplectic_orbits::tangent;

/// How coupled stages are found.
pub mod solver {
    pub use symplectic_core::solver::*;
    #[cfg(feature = "newton")]
    #[doc(inline)]
    pub use symplectic_newton::*;
}

/// Output of a run: states, dense output, events, invariants, balances, progress.
pub mod output {
    pub use symplectic_core::output::*;
    #[cfg(feature = "mechanics")]
    pub use symplectic_mechanics::Balance;
}

/// The Rust code of the README and of the book, compiled and run by `cargo test --doc`.
#[cfg(doctest)]
mod book {
    #[doc = include_str!("../../README.md")]
    struct Readme;
    #[doc = include_str!("../../docs/src/guide/tutorial.md")]
    struct Tutorial;
    #[doc = include_str!("../../docs/src/guide/formulas.md")]
    struct Formulas;
    #[doc = include_str!("../../docs/src/guide/hamiltonian.md")]
    struct Hamiltonian;
    #[doc = include_str!("../../docs/src/guide/choosing.md")]
    struct Choosing;
    #[doc = include_str!("../../docs/src/guide/methods.md")]
    struct Methods;
    #[doc = include_str!("../../docs/src/guide/design.md")]
    struct Design;
    #[doc = include_str!("../../docs/src/guide/at-run-time.md")]
    struct AtRunTime;
    #[doc = include_str!("../../docs/src/guide/long-runs.md")]
    struct LongRuns;
    #[doc = include_str!("../../docs/src/guide/events.md")]
    struct Events;
    #[doc = include_str!("../../docs/src/guide/variable-steps.md")]
    struct VariableSteps;
    #[doc = include_str!("../../docs/src/guide/constraints.md")]
    struct Constraints;
    #[doc = include_str!("../../docs/src/guide/forces.md")]
    struct Forces;
    #[doc = include_str!("../../docs/src/guide/flows.md")]
    struct Flows;
    #[doc = include_str!("../../docs/src/guide/rigid-bodies.md")]
    struct RigidBodies;
    #[doc = include_str!("../../docs/src/guide/lagrangians.md")]
    struct Lagrangians;
    #[doc = include_str!("../../docs/src/guide/discrete-lagrangians.md")]
    struct DiscreteLagrangians;
    #[doc = include_str!("../../docs/src/guide/nonholonomic.md")]
    struct Nonholonomic;
    #[doc = include_str!("../../docs/src/guide/degenerate.md")]
    struct Degenerate;
    #[doc = include_str!("../../docs/src/guide/newton.md")]
    struct Newton;
    #[doc = include_str!("../../docs/src/guide/speed.md")]
    struct Speed;
    #[doc = include_str!("../../docs/src/guide/restart.md")]
    struct Restart;
    #[doc = include_str!("../../docs/src/guide/ensembles.md")]
    struct Ensembles;
    #[doc = include_str!("../../docs/src/guide/chaos.md")]
    struct Chaos;
    #[doc = include_str!("../../docs/src/guide/from-rebound.md")]
    struct FromRebound;
    #[doc = include_str!("../../docs/src/guide/from-scipy.md")]
    struct FromScipy;
    #[doc = include_str!("../../docs/src/guide/from-sciml.md")]
    struct FromSciml;
    #[doc = include_str!("../../docs/src/reference/errors.md")]
    struct Errors;
}
