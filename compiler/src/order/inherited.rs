//! Orders that follow from how a method is made, whatever its coefficients show.

use super::class::HamiltonianClass;
use crate::certify::Claim;
use crate::evidence::Evidence;

/// An order, at least, that is known before any condition is looked at.
///
/// It is that of a certificate, or that of a symmetric composition: if a symmetric method of the even order `p` is
/// made with the fractions `γ_1, …, γ_m` of a step, the same from both ends, and `Σ γ_i = 1` and `Σ γ_i^{p+1} = 0`,
/// the leading term `C h^{p+1}` of the local error is `Σ γ_i^{p+1} C h^{p+1} = 0` (GNI II.4, Theorem 4.1), so that the
/// order is `p + 1` at least, and that of a symmetric method is even (GNI II.3, Theorem 3.2): `p + 2`. This is so for
/// every Hamiltonian for which the base has its order and is symmetric.
///
/// A certificate for quadratic `T` is one of order 3 for separable Hamiltonians too, and so of order 4 if the method is
/// symmetric: of the terms of the modified equation up to degree 4 only `[B, [B, [B, A]]]` vanishes for quadratic `T`.
#[derive(Debug, Clone, PartialEq, Eq)]
pub(crate) struct GivenOrder {
    /// What is known for separable Hamiltonians.
    pub claim: Claim,
    /// The order for every Hamiltonian.
    pub general: usize,
    /// How it is known.
    pub evidence: Evidence,
    /// Whether the method is a splitting that reads the same from both ends, so that its orders for separable
    /// Hamiltonians are even.
    pub symmetric: bool,
}

impl GivenOrder {
    /// That of a method which a certificate proves to exist. Kicks and drifts which sum to 1 are of order 1 for all.
    pub fn certified(claim: Claim) -> Self {
        GivenOrder {
            claim,
            general: 1,
            evidence: Evidence::Certified,
            symmetric: false,
        }
    }

    /// The order for a class of Hamiltonians, at least.
    pub fn for_class(&self, class: HamiltonianClass) -> usize {
        match class {
            HamiltonianClass::General => self.general,
            _ => self.even(self.claim.order_for(class)),
        }
    }

    /// The order in a power of `ε` for perturbed systems, at least.
    pub fn in_power(&self, power: usize) -> usize {
        self.even(self.claim.order_in_power(power))
    }

    /// The next even order for a symmetric method.
    fn even(&self, order: usize) -> usize {
        order + usize::from(self.symmetric && order % 2 == 1)
    }
}
