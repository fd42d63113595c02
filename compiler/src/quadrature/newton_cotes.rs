//! Closed Newton–Cotes: equidistant nodes with both end points.

use super::Family;
use crate::arithmetic::polynomial::Polynomial;

pub(super) const FAMILY: Family = Family {
    name: "newton-cotes",
    description: "closed Newton–Cotes, the equidistant nodes k/(s − 1)",
    minimum: 2,
    node_polynomial: |s| {
        let node = |k: usize| Polynomial::from_integers(&[-(k as i64), s as i64 - 1]);
        (0..s).fold(Polynomial::one(), |product, k| &product * &node(k))
    },
    real_for: "every s ≥ 2",
    #[cfg(test)]
    degree_of_precision: |s| if s % 2 == 1 { s } else { s - 1 },
};
