//! The stable steps of a method, computed in bounded time.

use super::{Stability, StabilityInterval};
use crate::evidence::{Evidence, evidence_text};

/// The largest number of stages for which all stable steps are computed. The real roots of polynomials of twice that degree take
/// a second or two; with 82 stages they take several. [`Tableau::stability`](crate::Tableau::stability) has no such bound.
pub const MAX_STAGES: usize = 36;

/// The stable steps of a method, computed in bounded time.
#[derive(Debug, Clone)]
pub enum StableSteps {
    /// All stable steps, for a method of at most [`MAX_STAGES`] stages.
    All(Box<Stability>),
    /// The [first interval](crate::Tableau::first_stable_interval) of a longer method.
    First {
        /// The interval. Its upper end is not stable, nor are the steps just beyond it.
        interval: StabilityInterval,
        /// The evidence.
        evidence: Evidence,
    },
    /// Undecided: the enclosures are too wide.
    NotDecided {
        /// The bits of the enclosures.
        bits: u32,
    },
    /// Not computed: the method has more than [`MAX_STAGES`] stages, and is not a palindromic splitting, or enclosures
    /// do not decide where its first interval ends.
    NotComputed,
}

impl std::fmt::Display for StableSteps {
    /// `(0, 2*sqrt(2)) ∪ (2*sqrt(3), 2*sqrt(6))`, `(0, 3.14159263115…) at first` or `not computed`.
    fn fmt(&self, f: &mut std::fmt::Formatter<'_>) -> std::fmt::Result {
        match self {
            StableSteps::All(stability) => f.write_str(&stability.intervals_text()),
            StableSteps::First { interval, .. } => write!(f, "{interval} at first"),
            StableSteps::NotDecided { bits } => {
                f.write_str(&evidence_text(Evidence::Undecided { bits: *bits }))
            }
            StableSteps::NotComputed => f.write_str("not computed"),
        }
    }
}
