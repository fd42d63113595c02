//! Orders that follow from the construction of a method, independent of its coefficients.

use super::class::HamiltonianClass;
use crate::certify::Claim;
use crate::evidence::Evidence;

/// A lower bound on the order that is known before any condition is evaluated.
///
/// It comes from a certificate or from a symmetric composition. Let a symmetric method of even order `p` be composed with palindromic
/// fractions `γ_1, …, γ_m` of a step, with `Σ γ_i = 1` and `Σ γ_i^{p+1} = 0`. Then the leading term of the local error is
/// `Σ γ_i^{p+1} C h^{p+1} = 0` (GNI II.4, Theorem 4.1), so the order is at least `p + 1`. The order of a symmetric method is even (GNI
/// II.3, Theorem 3.2), hence at least `p + 2`. This holds for every Hamiltonian for which the base has its order and is symmetric.
///
/// A certificate for quadratic `T` also gives order 3 for separable Hamiltonians, and order 4 if the method is symmetric. Of the terms of
/// the modified equation up to degree 4, only `[B, [B, [B, A]]]` vanishes for quadratic `T`. Terms with one or two letters `B` do not
/// vanish, so that in `ε` and `ε²` the order is that for quadratic `T`.
#[derive(Debug, Clone, PartialEq, Eq)]
pub(crate) struct GivenOrder {
    /// The claim for separable Hamiltonians.
    pub claim: Claim,
    /// The order for every Hamiltonian.
    pub general: usize,
    /// The evidence.
    pub evidence: Evidence,
    /// Whether the method is a palindromic splitting, so that its orders for separable
    /// Hamiltonians are even.
    pub symmetric: bool,
}

impl GivenOrder {
    /// The order of a method that a certificate proves to exist. Kicks and drifts that sum to 1 give order 1 for every class.
    pub fn certified(claim: Claim) -> Self {
        GivenOrder {
            claim,
            general: 1,
            evidence: Evidence::Certified,
            symmetric: false,
        }
    }

    /// A lower bound on the order for a class of Hamiltonians.
    pub fn for_class(&self, class: HamiltonianClass) -> usize {
        match class {
            HamiltonianClass::General => self.general,
            _ => self.even(self.claim.order_for(class)),
        }
    }

    /// A lower bound on the order in a power of `ε` for perturbed systems.
    pub fn in_power(&self, power: usize) -> usize {
        self.even(self.claim.order_in_power(power))
    }

    /// The next even order for a symmetric method.
    fn even(&self, order: usize) -> usize {
        order + usize::from(self.symmetric && order % 2 == 1)
    }
}
