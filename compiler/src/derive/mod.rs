//! From a definition to the tableau (LZ §4.4, steps 1–5; T §2.2).
//!
//! The tier follows from the definition. Polynomial bases at all roots of one polynomial are derived in the node
//! algebra. Anything else is derived in a constant field, if one holds all values and integrals of the basis,
//! and otherwise as certified enclosures. Splittings and their compositions are derived in the field of their
//! fractions. Results of [operations](crate::Tableau::concatenate) on tableaux are derived from the definitions
//! of the operands by the same operations.

mod base_method;
mod certified;
mod claim;
mod composition;
mod concatenate;
mod construction_kind;
mod dense;
mod fractions;
mod linear;
mod named_compositions;
mod node;
mod problem;
mod processed;
mod reading;
mod sequence;
mod splitting;
mod tiers;

pub(crate) use self::composition::{Step, check_depth};
pub(crate) use self::concatenate::concatenate;
pub use self::named_compositions::Scheme;
pub(crate) use self::problem::Problem;

#[cfg(test)]
mod tests;
