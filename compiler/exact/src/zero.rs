//! Whether a number is zero.

/// The evidence whether a number is zero.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum Zero {
    /// The number is zero, by exact arithmetic.
    Yes,
    /// The number is nonzero: some enclosure excludes zero.
    No,
    /// The magnitude is at most `2⁻ᵇⁱᵗˢ`; no exact argument decides whether the number is zero.
    Within(u32),
}

impl Zero {
    /// Whether the number is zero, as far as is known.
    pub fn may_be(self) -> bool {
        self != Zero::No
    }
}
