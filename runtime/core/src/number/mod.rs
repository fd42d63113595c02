//! Numbers: scalars, vectors, SIMD lanes, sums and linear combinations.

pub(crate) mod array;
pub(crate) mod coefficient;
pub(crate) mod dither;
#[cfg(feature = "num-dual")]
mod dual64;
pub(crate) mod elementary;
pub(crate) mod lanes;
pub(crate) mod linear_combination;
pub(crate) mod registers;
pub(crate) mod rows;
pub(crate) mod scalar;
mod sixteen_lanes;
pub(crate) mod summation;
pub(crate) mod vector;
pub(crate) mod words;

pub use coefficient::{Coefficient, Coefficients, exact, rounded};
pub use lanes::{F64x2, F64x4, F64x8, Lanes, MAX_LANES};
pub(crate) use lanes::{WideF64x4, WideF64x8, WidestF64x8};
pub use linear_combination::{
    advance, combine, copy, copy_to, factors, increment, reset, scale, scale_all, total, transform,
    weighted_total, weights,
};
pub use scalar::Scalar;
pub(crate) use scalar::larger_or_nan;
#[cfg(feature = "alloc")]
pub(crate) use sixteen_lanes::WidestF64x16;
pub use sixteen_lanes::{DefaultLanes, F64x16};
pub use summation::{Compensated, Plain, Summation};
pub use vector::Vector;
pub use words::{Visit, Words, scalar_words, vector_words};
