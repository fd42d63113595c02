//! How it is known what holds.

/// How it is known whether a property holds.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum Evidence {
    /// It holds, by exact arithmetic.
    Proved,
    /// It holds: the equations are solved by coefficients that are proved to exist, near given digits.
    Certified,
    /// It does not hold, by exact arithmetic or by an enclosure that excludes it.
    Refuted,
    /// Known only up to enclosures: each number that has to vanish is at most `2⁻ᵇⁱᵗˢ` in size, relative to the largest
    /// term of its sum or to 1. All inequalities are proved. This is not a proof.
    Verified {
        /// The width of the enclosures.
        bits: u32,
    },
    /// Not known: enclosures of this many bits do not decide it.
    Undecided {
        /// The bits of the enclosures.
        bits: u32,
    },
}

/// The evidence of what holds, in words.
pub fn evidence_text(evidence: Evidence) -> String {
    match evidence {
        Evidence::Verified { bits } => format!("verified to 2^-{bits}"),
        Evidence::Certified => "certified".to_owned(),
        Evidence::Undecided { bits } => format!("not decided by enclosures of {bits} bits"),
        _ => "proved".to_owned(),
    }
}

impl Evidence {
    /// The evidence for two statements that both hold.
    pub(crate) fn and(self, other: Evidence) -> Evidence {
        match (self, other) {
            (undecided @ Evidence::Undecided { .. }, _)
            | (_, undecided @ Evidence::Undecided { .. }) => undecided,
            (Evidence::Verified { bits }, Evidence::Verified { bits: others }) => {
                Evidence::Verified {
                    bits: bits.min(others),
                }
            }
            (Evidence::Proved, other) => other,
            (Evidence::Certified, other @ Evidence::Verified { .. }) => other,
            (known, _) => known,
        }
    }
}
