//! Constants such as `1/2 - sqrt(2)/4` and functions such as `t^2*exp(-t/2)`, symbolically.
//!
//! A [`Constant`] is a real number as an expression. A [`Function`] is a sum of products of powers, waves and
//! exponentials of `t` with constant coefficients; this class is closed under products and integration. Both have a
//! canonical form with folded rationals. Whether different expressions have the same value is decided by enclosures and
//! in number fields.

mod calculus;
mod composition;
mod constant;
mod display;
mod enclosure;
mod frequency;
mod function;
mod magnitude;
mod operations;
mod read;
mod root;
mod size;
mod transcendental;
pub(crate) mod zero;

pub use constant::Constant;
pub(crate) use constant::Tree;
pub use frequency::Frequency;
pub use function::{Function, Term, Wave};

/// The functions of the expression language.
pub const FUNCTIONS: [&str; 10] = [
    "sqrt", "cbrt", "sin", "cos", "tan", "exp", "ln", "cosh", "sinh", "root",
];
/// The largest binary logarithm of an irrational constant, of its inverse, and of an argument of a function. Enclosures
/// need about this number of binary places.
pub const MAX_MAGNITUDE: i64 = 4096;
/// The largest size of a constant: its operations, where a transcendental operation counts 8, plus the words of its
/// rationals.
pub const MAX_SIZE: usize = 10_000;
/// The largest height of a constant's tree.
pub const MAX_HEIGHT: usize = 256;
/// The largest exponent in a product of powers of constants.
pub const MAX_POWER: u32 = 1 << 16;
/// The largest number of binary places of enclosures for a sign.
pub const MAX_SIGN_BITS: u32 = 4096;
/// The largest number of terms of a function.
pub const MAX_TERMS: usize = 256;
/// The largest size of all coefficients and frequencies of a function together.
pub const MAX_FUNCTION_SIZE: usize = 100_000;
/// The largest size of a product of functions before like terms are collected.
pub const MAX_PRODUCT_SIZE: usize = 400_000;
/// The longest numerator or denominator of a fraction, in bits. Integers may have
/// [`MAX_BITS`](crate::expression::MAX_BITS), because their sums need no common divisors.
pub const MAX_FRACTION_BITS: usize = 16_384;
/// The largest product of degree and coefficient bits of the polynomial of a root.
pub const MAX_ROOT_SIZE: usize = 4096;
/// The largest degree of the polynomial of a root.
pub const MAX_ROOT_DEGREE: usize = 32;
