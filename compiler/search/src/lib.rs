//! Methods by design: splittings and compositions that are found by a search, and proved.
//!
//! A [`Problem`] says what is wanted: the class of Hamiltonians and the order, the structure, and the force evaluations a step. The unknowns
//! are the coefficients of the [`Structure`]. [`Problem::search`] leads random starts to solutions of the order conditions, and these along
//! the manifold of solutions to minima of the leading error. [`Problem::prove`] makes of a solution in doubles a definition whose order is
//! proved, with short decimals for its free parameters. [`Trial`] compares errors at equal cost on scenes, since a small error constant is
//! not yet a good method.
//!
//! The order conditions are those of [`symplectic_compiler::certify`]. Nothing in a definition is taken from floating-point numbers without
//! a proof.
//!
//! ```
//! use std::ops::ControlFlow;
//! use symplectic_compiler::certify::Claim;
//! use symplectic_compiler::order::HamiltonianClass;
//! use symplectic_search::{Norm, Problem, Progress, Structure};
//!
//! let problem = Problem {
//!     claim: Claim::Nystrom(4),
//!     structure: Structure::Bab,
//!     kicks: 6,
//!     gradient: 0,
//!     norm: Norm::Error,
//!     largest: 1.0,
//!     dispersion: false,
//!     at_least_stable: 0.0,
//! };
//! let mut progress = Progress::new(1);
//! problem.search(&mut progress, 128, |_| ControlFlow::Continue(()))?;
//! let method = problem.prove(&progress.solutions[0])?;
//! assert_eq!(method.tableau.orders().nystrom.order, 4);
//! println!("{}", method.definition);
//! # Ok::<(), Box<dyn std::error::Error>>(())
//! ```

mod command;
mod display;
mod figure;
mod hunt;
mod lie;
mod manifold;
mod polynomials;
mod proof;
mod scenes;
mod stability;
mod state;
mod structure;
mod trial;
mod words;

pub use command::{Found, Options, command};
pub use figure::Norm;
pub use hunt::{Problem, Progress, Solution};
pub use proof::{Method, ProofError};
pub use structure::Structure;
pub use trial::{Comparison, Known, Splitting, Trial, rivals};
