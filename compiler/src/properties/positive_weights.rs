//! Positive weights.

use std::cmp::Ordering;

use super::{Evidence, Examined, Property, Zero, shown};
use crate::algebra::StageAlgebra;

/// Decides the sign of every weight.
pub(super) fn decide<A: StageAlgebra>(examined: &Examined<'_, A>) -> Property {
    for (name, weights) in [("b", &examined.numbers.b), ("b̃", &examined.numbers.b_tilde)] {
        for (i, weight) in weights.iter().enumerate() {
            let name = format!("{name}_{}", i + 1);
            match (weight.sign(), weight.zero()) {
                (Ordering::Greater, _) => {}
                (Ordering::Equal, Zero::Within(bits)) => {
                    return Property::undecided(bits, format!("{name} cannot be told from zero"));
                }
                (Ordering::Equal, _) => return Property::refuted(format!("{name} = 0")),
                (Ordering::Less, _) => {
                    return Property::refuted(format!("{name} = {}", shown(weight)));
                }
            }
        }
    }
    Property::holding(Evidence::Proved, None)
}
