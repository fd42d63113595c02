//! Exact and certified arithmetic on functions of the stages.
//!
//! A quantity with one index is a vector over the stages, a quantity with two indices a matrix. Three algebras hold
//! them, and all computations on tableaux are written once, over [`StageAlgebra`]:
//!
//! | tier | algebra | holds |
//! |---|---|---|
//! | 1 | [`NodeAlgebra`] | functions on the roots of a rational polynomial: sums are traces |
//! | 2 | [`Dense`] over [`Constants`] | numbers in `Q(α)(X)`, `X` one transcendental |
//! | 3 | [`Dense`] over [`Reals`] | expressions that can be enclosed to any precision |

mod balls;
mod constants;
mod dense;
pub mod field;
mod images;
pub mod node;
mod number;
mod rationals;
mod real;
mod stage_algebra;

pub use balls::Balls;
pub use constants::Constants;
pub use dense::{Dense, Field};
pub use field::{ConstantField, FieldElement};
pub use images::Image;
pub use node::{ClosedForm, NodeAlgebra, Tensor};
pub use number::Number;
pub use rationals::Rationals;
pub use real::{ROUNDING_BITS, Real, Reals, ZERO_BITS};
pub(crate) use stage_algebra::group_by;
pub use stage_algebra::{Scalar, StageAlgebra};

pub use crate::arithmetic::ball::Ball;
pub use crate::arithmetic::zero::Zero;
