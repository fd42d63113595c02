//! The real fields in which coefficients live: `Q(θ)` for a real algebraic `θ`, and the rational
//! functions of one transcendental number over it.
//!
//! Every element has a unique representation, so equality is structural equality; no number is
//! approximated to decide it. Enclosures are only used for the signs of numbers known to be nonzero, and
//! to choose between the roots of a polynomial.

mod constant_display;
mod constant_enclosure;
mod constant_field;
mod cosines;
mod extension;
mod field_element;
mod function_gcd;
mod function_ring;
mod notation;
mod number_field;
mod radicals;
mod real_root;
mod transcendental;

pub use constant_field::ConstantField;
pub use extension::Extension;
pub use field_element::FieldElement;
pub use notation::Notation;
pub use number_field::{MAX_DEGREE, NumberField};
pub use transcendental::Transcendental;
