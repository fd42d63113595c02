//! The exact compiler behind the crate `symplectic`.
#![allow(missing_docs, dead_code)]
pub mod algebra;
pub mod arithmetic;
mod basis;
pub mod catalogue;
mod check;
mod derive;
pub mod emit;
mod error;
pub mod export;
pub mod expression;
mod limits;
mod properties;
mod quadrature;
pub mod schedule;
mod tableau;

pub use basis::Basis;
//pub use check::check;
pub use derive::{derive, derive_from, derive_within};
pub use error::{Error, ErrorKind, Place};
pub use limits::Limits;
pub use properties::{Evidence, Properties, Property};
pub use quadrature::{FAMILIES, Family, QuadratureRule};
pub use tableau::{Coefficients, Provenance, Tableau};
