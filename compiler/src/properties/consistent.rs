//! Consistency.

use num_rational::BigRational;
use num_traits::One;

use super::{Examined, Property, Zero, shown};
use crate::algebra::StageAlgebra;
use crate::evidence::Evidence;

/// Decides `Σ_i b_i = Σ_i b̃_i = 1`.
pub(super) fn decide<A: StageAlgebra>(examined: &Examined<'_, A>) -> Property {
    let pair = examined.pair;
    let [b, b_tilde] = [&pair.b, &pair.b_tilde].map(|weights| pair.algebra.sum(weights));
    let evidence = [&b, &b_tilde].map(|sum| match sum.difference(&BigRational::one()) {
        Zero::Yes => Evidence::Proved,
        Zero::Within(bits) => Evidence::Verified { bits },
        Zero::No => Evidence::Refuted,
    });
    if !evidence.contains(&Evidence::Refuted) {
        return Property::holding(evidence[0].and(evidence[1]), None);
    }
    let [shown_b, shown_b_tilde] = [shown(&b), shown(&b_tilde)];
    Property::refuted(if pair.b == pair.b_tilde {
        format!("the weights sum to {shown_b} instead of 1")
    } else {
        format!("the weights b sum to {shown_b} and b̃ to {shown_b_tilde}")
    })
}
