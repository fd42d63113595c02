//! Sizes of residuals, in units of rounding, at which an iteration ends.

/// A residual of at most this size counts as zero if it has stopped decreasing.
pub(super) const ROUNDING: f64 = 2.0;
/// A residual of at most this size always counts as zero. A residual that still decreases always has the same sign. With 1/2 the relative
/// energy drift for a double pendulum on rods would be up to 10⁻²¹ per step.
pub(super) const SETTLED: f64 = 0.125;
/// A residual that no longer decreases is accepted up to this size.
pub(super) const NOISE: f64 = 256.0;
/// Number of sweeps without a smaller residual after which the iteration has ended.
pub(super) const PATIENCE: u32 = 4;
