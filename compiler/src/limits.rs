//! Bounds on the work for an input.

/// Bounds on the work for an input.
///
/// The derivation of `s` stages takes time that grows roughly like `s³`, and with the length of the
/// nodes (the book has measured figures).
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub struct Limits {
    /// The largest number of stages; 36 unless changed, as all but three methods of the
    /// [`catalogue`](crate::catalogue) have at most.
    pub stages: usize,
}

impl Default for Limits {
    fn default() -> Self {
        Limits { stages: 36 }
    }
}

impl Limits {
    /// Limits with this largest number of stages.
    #[must_use]
    pub fn at_most(stages: impl Into<usize>) -> Self {
        Limits {
            stages: stages.into(),
        }
    }
}
