//! Clenshaw–Curtis: the extrema of a Chebyshev polynomial, end points included.

use super::Family;
use super::fejer::second_kind;
use crate::arithmetic::polynomial::Polynomial;

pub(super) const FAMILY: Family = Family {
    name: "clenshaw-curtis",
    description: "the extrema (1 − cos(kπ/(s − 1)))/2, k = 0, …, s − 1",
    minimum: 2,
    // x(x − 1) U_{s−2}(2x − 1)
    node_polynomial: |s| &Polynomial::from_integers(&[0, -1, 1]) * &second_kind(s - 2),
    real_for: "every s ≥ 2",
    #[cfg(test)]
    degree_of_precision: |s| if s % 2 == 1 { s } else { s - 1 },
};
