//! Exact arithmetic: rational polynomials and matrices, factorisation, real roots, enclosures, elementary functions,
//! correct rounding. Beside it, what the packages above share: inputs, their errors, code.

pub mod algebraic_number;
pub mod ball;
pub mod code;
mod common_divisor;
pub mod eigen;
pub mod elementary;
pub mod enclosure_cache;
pub mod error;
pub mod factor;
pub mod fixed;
pub mod gcd;
pub mod input;
pub mod interval;
pub mod inverse;
pub mod linear_solver;
pub mod matrix;
pub mod polynomial;
pub mod power_sums;
pub mod prime_field;
pub mod rational;
pub mod residues;
pub mod roots;
pub mod rounding;
pub mod suggestion;
pub mod zero;
