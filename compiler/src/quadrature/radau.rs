//! Radau: Gauss with one end point.

use super::Family;
use super::gauss::rodrigues;

pub(super) const LEFT: Family = Family {
    name: "radau-left",
    description: "Radau nodes with the left end point, degree of precision 2s − 2",
    minimum: 1,
    node_polynomial: |s| rodrigues(s - 1, s, s - 1),
    real_for: "every s",
    #[cfg(test)]
    degree_of_precision: |s| 2 * s - 2,
};

pub(super) const RIGHT: Family = Family {
    name: "radau-right",
    description: "Radau nodes with the right end point, degree of precision 2s − 2",
    minimum: 1,
    node_polynomial: |s| rodrigues(s - 1, s - 1, s),
    real_for: "every s",
    #[cfg(test)]
    degree_of_precision: |s| 2 * s - 2,
};
