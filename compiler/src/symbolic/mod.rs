//! Constants such as `1/2 - sqrt(2)/4` and functions such as `t^2*exp(-t/2)`, symbolically.
//!
//! A [`Constant`] is a real number as an expression; a [`Function`] is a sum of products of powers, waves
//! and exponentials of `t` with constant coefficients, a class that is closed under products and
//! integration. Both are kept in a canonical form that folds what is rational; that two different
//! expressions have the same value is decided elsewhere, from enclosures and in number fields.

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

/// The functions of the language of expressions.
pub const FUNCTIONS: [&str; 10] = [
    "sqrt", "cbrt", "sin", "cos", "tan", "exp", "ln", "cosh", "sinh", "root",
];
/// The largest binary logarithm of a constant that is not rational, of its inverse, and of an argument of a function.
/// Enclosures need about as many binary places.
pub const MAX_MAGNITUDE: i64 = 4096;
/// The largest size of a constant: its operations, of which a transcendental one counts 8, and the
/// words of its rationals.
pub const MAX_SIZE: usize = 10_000;
/// The largest height of a constant's tree.
pub const MAX_HEIGHT: usize = 256;
/// The largest exponent in a product of powers of constants.
pub const MAX_POWER: u32 = 1 << 16;
/// The binary places up to which a sign is sought in enclosures.
pub const MAX_SIGN_BITS: u32 = 4096;
/// The most terms of a function.
pub const MAX_TERMS: usize = 256;
/// The largest size of all coefficients and frequencies of a function together.
pub const MAX_FUNCTION_SIZE: usize = 100_000;
/// The largest size of a product of functions before like terms are collected.
pub const MAX_PRODUCT_SIZE: usize = 400_000;
/// The longest numerator or denominator of a fraction, in bits. Whole numbers may have
/// [`MAX_BITS`](crate::expression::MAX_BITS), for they are added without common divisors.
pub const MAX_FRACTION_BITS: usize = 16_384;
/// The largest product of degree and coefficient bits of the polynomial of a root.
pub const MAX_ROOT_SIZE: usize = 4096;
/// The largest degree of the polynomial of a root.
pub const MAX_ROOT_DEGREE: usize = 32;
