//! One step, as a plan sees it.

use crate::{Coefficient, Scalar};

/// The step that is taken: from `(q, p)` at `time` to `time + size`.
#[derive(Debug)]
pub struct Step<'a, V> {
    /// Time at the start, t0.
    pub time: f64,
    /// Step size h; negative for a step backward.
    pub size: f64,
    /// Position at the start, q0.
    pub q: &'a V,
    /// Momentum at the start, p0.
    pub p: &'a V,
}

impl<V> Step<'_, V> {
    /// The time `t0 + c h` of the node `c`; in double precision, as times are, whatever the scalar.
    #[inline(always)]
    pub fn at<T: Scalar>(&self, c: Coefficient) -> T {
        T::from_f64(self.time + c.double() * self.size)
    }
}
