//! Gauss–Legendre: the shifted Legendre polynomial by Rodrigues' formula.

use super::Family;
use crate::arithmetic::polynomial::Polynomial;

pub(super) const FAMILY: Family = Family {
    name: "gauss",
    description: "Gauss–Legendre nodes, degree of precision 2s − 1",
    minimum: 1,
    node_polynomial: |s| rodrigues(s, s, s),
    real_for: "every s",
    #[cfg(test)]
    degree_of_precision: |s| 2 * s - 1,
};

/// `dⁿ/dxⁿ [xᵖ (x − 1)^q]`, the Jacobi polynomials that Gauss, Radau and Lobatto nodes are roots of
/// (GNI II.1.3).
pub(super) fn rodrigues(derivatives: usize, p: usize, q: usize) -> Polynomial {
    let product = &Polynomial::monomial(p) * &Polynomial::from_integers(&[-1, 1]).power(q as u32);
    (0..derivatives).fold(product, |f, _| f.derivative())
}
