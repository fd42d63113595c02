//! When the iteration for coupled stages stops.

/// When the iteration for the coupled stages of a step stops: at last.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Stopping {
    /// Sweeps of one step, beyond which it has failed; at least one.
    pub max_iterations: u32,
    /// With [`Plain`](crate::Plain) sums: how far the last sweep may move the positions of the stages, and the momenta where they
    /// count, in their units. Zero: as far as rounding does. See [`Integrator::set_tolerance`](crate::Integrator::set_tolerance).
    pub tolerance: f64,
}

impl Stopping {
    /// 200 sweeps, down to rounding. An iteration that needs more gains less than a factor of 1.2 a sweep.
    pub const DEFAULT: Self = Self {
        max_iterations: 200,
        tolerance: 0.0,
    };
}

impl Default for Stopping {
    fn default() -> Self {
        Self::DEFAULT
    }
}
