//! Stopping criterion of the stage iteration.

/// Stopping criterion of the iteration for the coupled stages of a step.
///
/// The iteration stops earlier once the stages have converged: see [`FixedPoint`](crate::solver::FixedPoint) and
/// `solver::Newton`.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Stopping {
    /// Maximum number of sweeps in one attempt to find the stages, at least one; after these the attempt has failed.
    /// `solver::Newton` makes up to three attempts. They start from the stages of the previous step and from the start of
    /// the step; the last one uses the derivatives at every stage.
    pub max_iterations: u32,
    /// With [`Plain`](crate::Plain) sums: how far the last sweep may move the positions of the stages, and the momenta if they matter, in
    /// their units. Zero: iterates down to round-off. See [`Integrator::set_tolerance`](crate::Integrator::set_tolerance).
    pub tolerance: f64,
}

impl Stopping {
    /// 200 sweeps, down to round-off. A fixed-point iteration that needs more gains less than a factor of 1.2 per sweep.
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
