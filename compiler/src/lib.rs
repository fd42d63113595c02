//! The exact compiler behind the crate `symplectic`: from a basis and nodes to the tableau of a symplectic
//! partitioned Runge–Kutta method, with proofs, exports and code.
//!
//! ```
//! use symplectic_compiler::{derive, export};
//!
//! let lobatto = derive("polynomial(3)", "lobatto(3)")?.named("Lobatto3");
//! let properties = lobatto.properties();
//! assert!(properties.symplectic.holds && properties.symmetric.holds);
//! println!("{}", export::text::write(&lobatto, 16));
//! # Ok::<(), symplectic_compiler::Error>(())
//! ```
//!
//! | what | where |
//! |---|---|
//! | what a tableau is derived from | [`Definition`], of [`symbolic`] functions and constants |
//! | methods whose coefficients are functions of a frequency | [`Fitted`] |
//! | bases, nodes and weights | [`Basis`], [`Nodes`], [`QuadratureRule`], [`FAMILIES`] |
//! | the derivation | [`derive()`], [`Definition::derive`], [`derive_from`] |
//! | the exact coefficients | [`Tableau`], in an [`algebra`] of one of three [`Tier`]s |
//! | adjoint methods and compositions | [`Tableau::adjoint`], [`Tableau::scale`], [`Tableau::compose`], [`Tableau::concatenate`] |
//! | what is proved about them | [`Properties`], each a [`Property`] with its [`Evidence`] |
//! | the order for each class of Hamiltonians, trees, the modified equation | [`order`] |
//! | the order of splittings for perturbed systems | [`Tableau::perturbed_order`] |
//! | linear stability on the oscillator | [`stability`] |
//! | what a user requires of a method | [`Requirement`], [`Tableau::require`], [`assert_order!`] |
//! | text, JSON, TOML; reading and checking files | [`export`], [`check`] |
//! | known methods | [`catalogue`] |
//! | explicit methods from printed digits, with a proof that an exact method is near | [`certify`] |
//! | Rust code | [`emit`], from the order of computation found in [`schedule`] |
//!
//! Tables in other languages, programs that take steps, and certificates are in the package `symplectic-tools`.
//!
//! Statements about a tableau are decided in exact arithmetic where its coefficients are functions of the
//! nodes or elements of a constant field, and refuted or verified by enclosures elsewhere. Numbers are rounded
//! from certified enclosures, ties decided exactly, so every printed digit and every double is the correct one.

pub mod algebra;
mod basis;
pub mod catalogue;
pub mod certify;
mod check;
mod coefficients;
#[cfg(test)]
mod decisions;
mod definition;
mod derive;
mod efficiency;
pub mod emit;
mod evidence;
mod exact;
pub mod export;
pub mod expression;
pub mod fitted;
mod hamiltonian_class;
#[doc(hidden)]
pub mod inside;
mod library;
mod limits;
mod numerals;
mod operations;
pub mod order;
mod partitioned;
mod properties;
mod quadrature;
mod requirement;
pub mod schedule;
pub mod stability;
pub mod symbolic;
mod tableau;

pub use basis::Basis;
pub use check::{check, check_and_list};
pub use coefficients::Coefficients;
pub use definition::{Definition, Key};
pub use evidence::Evidence;
pub use exact::Tier;
pub use fitted::Fitted;
pub use library::{Library, Stepping};
pub use limits::Limits;
pub use properties::{Properties, Property, SeparableProperties};
pub use quadrature::{FAMILIES, Family, Nodes, QuadratureRule};
pub use requirement::{Requirement, failed_assertion, require};
pub use symplectic_exact as arithmetic;
pub use symplectic_exact::error::{Error, ErrorKind, Place};
pub use symplectic_exact::suggestion::{did_you_mean, suggestion, with_suggestion};
use symplectic_exact::{error, suggestion};
pub use tableau::{Processed, Provenance, Tableau, derive, derive_from, derive_within};
