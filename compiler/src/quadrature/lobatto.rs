//! Lobatto: Gauss with both end points.

use super::Family;
use super::gauss::rodrigues;

pub(super) const FAMILY: Family = Family {
    name: "lobatto",
    description: "Lobatto nodes with both end points, degree of precision 2s − 3",
    minimum: 2,
    node_polynomial: |s| rodrigues(s - 2, s - 1, s - 1),
    real_for: "every s ≥ 2",
    #[cfg(test)]
    degree_of_precision: |s| 2 * s - 3,
};
