//! Stages side by side in SIMD lanes.

pub(crate) mod change;
pub(crate) mod gauss_seidel;
pub(crate) mod jacobi;
pub(crate) mod stages;
pub(crate) mod sums;
