//! Exact arithmetic: rational polynomials and matrices, real roots, enclosures, correct rounding.

pub mod interval;
pub mod matrix;
pub mod polynomial;
pub mod rational;
pub mod roots;
pub mod rounding;
