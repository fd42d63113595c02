//! The stable steps of a method, computed in bounded time.

use super::{Stability, StabilityInterval};
use crate::evidence::{Evidence, evidence_text};
use crate::tableau::Tableau;

/// The largest number of stages for which all stable steps are computed. The real roots of polynomials of twice that degree take
/// a second or two; with 82 stages they take several. [`Tableau::stability`] has no such bound.
pub const MOST_STAGES: usize = 36;

/// The stable steps of a method, computed in bounded time.
#[derive(Debug, Clone)]
pub enum StableSteps {
    /// All stable steps, for a method of at most [`MOST_STAGES`] stages.
    All(Box<Stability>),
    /// The [first interval](Tableau::first_stable_interval) of a longer method.
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
    /// Not computed: the method has more than [`MOST_STAGES`] stages, and is not a palindromic splitting, or enclosures
    /// do not decide where its first interval ends.
    NotComputed,
}

impl Tableau {
    /// The stable steps, computed in bounded time.
    ///
    /// ```
    /// use symplectic_compiler::{catalogue, stability::StableSteps};
    ///
    /// let steps = |name| catalogue::find(name).expect("a known method").derive().map(|t| t.stable_steps());
    /// assert!(matches!(steps("gauss-3")?, StableSteps::All(_)));
    /// assert!(matches!(steps("suzuki-8")?, StableSteps::First { .. }));
    /// assert_eq!(steps("suzuki-8")?.to_string(), "(0, 3.14152750352…) at first");
    /// # Ok::<(), symplectic_compiler::Error>(())
    /// ```
    pub fn stable_steps(&self) -> StableSteps {
        if self.stages() <= MOST_STAGES {
            let stability = self.stability();
            return match stability.evidence {
                Evidence::Undecided { bits } => StableSteps::NotDecided { bits },
                _ => StableSteps::All(Box::new(stability)),
            };
        }
        let Some(interval) = self.first_stable_interval() else {
            return StableSteps::NotComputed;
        };
        // Enclosures apply to the given method, or to one that is proved to exist.
        let given = self.given.as_ref();
        let evidence = given.map_or(Evidence::Proved, |given| given.evidence);
        StableSteps::First { interval, evidence }
    }
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
