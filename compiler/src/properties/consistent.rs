//! Consistency.

use super::{Examined, Property};

/// Decides `Σ_i b_i = Σ_i b̃_i = 1` by traces.
pub(super) fn decide(examined: &Examined<'_>) -> Property {
    let (b, b_tilde) = examined.tableau.weight_sums();
    if examined.tableau.weights_sum_to_one() {
        Property::proved(None)
    } else if b == b_tilde {
        Property::refuted(format!(
            "the weights sum to {b}; the basis does not span the constants"
        ))
    } else {
        Property::refuted(format!("the weights b sum to {b} and b̃ to {b_tilde}"))
    }
}
