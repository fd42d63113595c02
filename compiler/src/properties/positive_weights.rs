//! Positive weights.

use std::cmp::Ordering;

use super::{Examined, Property, shown};

/// Decides the sign of every weight.
pub(super) fn decide(examined: &Examined<'_>) -> Property {
    for (name, weights) in [("b", &examined.numbers.b), ("b̃", &examined.numbers.b_tilde)] {
        for (i, weight) in weights.iter().enumerate() {
            match weight.sign() {
                Ordering::Greater => {}
                Ordering::Equal => return Property::refuted(format!("{name}_{} = 0", i + 1)),
                Ordering::Less => {
                    return Property::refuted(format!("{name}_{} = {}", i + 1, shown(weight)));
                }
            }
        }
    }
    Property::proved(None)
}
