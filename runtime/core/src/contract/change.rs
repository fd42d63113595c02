//! How much a sweep changed the stages.

use crate::number::{Scalar, larger_or_nan};

/// How much one fixed-point sweep changed the stage values. Positions and momenta are separate because their units differ.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub struct StageChange {
    /// Change of the positions.
    pub q: HalfChange,
    /// Change of the momenta.
    pub p: HalfChange,
}

impl StageChange {
    /// The larger of the two [relative changes](HalfChange::relative); NaN if either is.
    ///
    /// ```
    /// use symplectic::solver::StageChange;
    ///
    /// let mut change = StageChange::default();
    /// assert_eq!(change.residual(), 0.0);
    /// change.q.record(1.0, 3.0, 4.0);
    /// change.p.record(0.0, 8.0, 8.0);
    /// assert_eq!(change.residual(), 0.25);
    ///
    /// let mut change = StageChange::default();
    /// change.q.record(0.0, 3.0, 0.0);
    /// assert_eq!(change.residual(), 1.0);
    /// change.p.record(0.0, 1.0, f64::NAN);
    /// change.p.record(0.0, 1.0, 1.0);
    /// assert!(change.residual().is_nan());
    /// ```
    pub fn residual(&self) -> f64 {
        larger_or_nan(self.q.relative(), self.p.relative())
    }

    /// Whether the relative change of the positions or that of the momenta is NaN.
    #[cfg_attr(not(debug_assertions), inline(always))]
    pub const fn is_undefined(&self) -> bool {
        self.q.is_undefined() || self.p.is_undefined()
    }

    /// The largest position and the largest momentum.
    #[cfg_attr(not(debug_assertions), inline(always))]
    pub const fn scales(&self) -> [f64; 2] {
        [self.q.scale, self.p.scale]
    }
}

/// How much the positions, or the momenta, of all stages changed in one sweep.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub struct HalfChange {
    difference: f64,
    scale: f64,
}

impl HalfChange {
    /// Whether the [relative](Self::relative) change is NaN.
    #[cfg_attr(not(debug_assertions), inline(always))]
    pub const fn is_undefined(&self) -> bool {
        self.difference.is_nan() || self.difference.is_infinite() && self.scale.is_infinite()
    }

    /// The largest |new − old|.
    #[cfg_attr(not(debug_assertions), inline(always))]
    pub const fn difference(&self) -> f64 {
        self.difference
    }

    /// The largest of all |base| and |new|.
    #[cfg_attr(not(debug_assertions), inline(always))]
    pub const fn scale(&self) -> f64 {
        self.scale
    }

    /// Records that a component of a stage value, `base` plus an increment, changed from `old` to `new`.
    #[cfg_attr(not(debug_assertions), inline(always))]
    pub fn record<T: Scalar>(&mut self, base: T, old: T, new: T) {
        self.difference = larger_or_nan(self.difference, (new - old).magnitude());
        // The rounding error of `base + increment` scales with the larger of the base and the result. Where base and increment nearly
        // cancel, the result alone would demand digits that the sum does not have.
        self.scale = larger_or_nan(self.scale, larger_or_nan(base.magnitude(), new.magnitude()));
    }

    /// Records a change of size `difference` among values of size `scale`.
    #[cfg_attr(not(debug_assertions), inline(always))]
    pub(crate) fn join(&mut self, difference: f64, scale: f64) {
        self.difference = larger_or_nan(self.difference, difference);
        self.scale = larger_or_nan(self.scale, scale);
    }

    /// The largest |new − old| divided by the largest of all |base| and |new|.
    ///
    /// Returns 0 if nothing was recorded or everything is zero. Returns 1 if everything changed to zero, and NaN if a new value is NaN or
    /// infinite.
    #[cfg_attr(not(debug_assertions), inline(always))]
    pub fn relative(&self) -> f64 {
        // Without a branch, whether both, one or neither of the two are zero.
        let alone = if self.difference == 0.0 {
            1.0
        } else {
            self.difference
        };
        let scale = if self.scale == 0.0 { alone } else { self.scale };
        self.difference / scale
    }
}
