//! Results about the order of a method.

use std::fmt;

use num_rational::BigRational;

use super::class::HamiltonianClass;
use super::tree::BicolouredTree;
use crate::arithmetic::rounding::Decimal;
use crate::evidence::{Evidence, evidence_text};
use crate::properties::GRADIENT_KICKS;

/// The order of a method for each class of Hamiltonians.
#[derive(Debug, Clone, PartialEq, Eq)]
pub struct OrderReport {
    /// For every `H(q, p)`.
    pub general: ClassOrder,
    /// For `H = T(p) + U(q)`.
    pub separable: ClassOrder,
    /// For `H = pᵀM⁻¹p/2 + U(q)`.
    pub nystrom: ClassOrder,
}

impl OrderReport {
    /// The order for a class.
    pub fn class(&self, class: HamiltonianClass) -> &ClassOrder {
        match class {
            HamiltonianClass::General => &self.general,
            HamiltonianClass::Separable => &self.separable,
            HamiltonianClass::Nystrom => &self.nystrom,
        }
    }
}

/// The order of a method for one class of Hamiltonians.
#[derive(Debug, Clone, PartialEq, Eq)]
pub struct ClassOrder {
    /// The order `p`: all conditions up to it hold.
    pub order: usize,
    /// The evidence that they hold: proved, certified by a claim, or verified to some binary places.
    pub evidence: Evidence,
    /// A violated condition of order `p + 1`. If there is none, the order is at least `p`:
    /// trees of higher order were not evaluated.
    pub refuted_by: Option<ViolatedCondition>,
    /// The norm `(Σ_τ ((φ(τ) − 1/γ(τ))/σ(τ))²)^½` over the trees `τ` of order `p + 1` in the class, to 12
    /// digits; each term is `α(τ)/|τ|! · (γ(τ) φ(τ) − 1)`, the coefficient of the elementary differential in
    /// the local error. `None` if trees of that order are not enumerated.
    pub error_constant: Option<Decimal>,
}

impl ClassOrder {
    /// The report for a class that a method with gradient kicks does not step.
    pub(super) fn none() -> Self {
        ClassOrder {
            order: 0,
            evidence: Evidence::Refuted,
            refuted_by: None,
            error_constant: None,
        }
    }

    /// Whether the method steps Hamiltonians of this class. Gradient kicks are for quadratic `T` only; for other classes the order is 0.
    pub fn exists(&self) -> bool {
        self.evidence != Evidence::Refuted
    }
}

impl fmt::Display for ClassOrder {
    /// `4, proved; not 5: q[q^4] has the weight 5/24 instead of 1/5, a difference of 1/120`
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        if !self.exists() {
            return write!(f, "none: {GRADIENT_KICKS}");
        }
        if self.refuted_by.is_none() {
            f.write_str("at least ")?;
        }
        write!(f, "{}, ", self.order)?;
        f.write_str(&evidence_text(self.evidence))?;
        match &self.refuted_by {
            Some(violated) => write!(f, "; not {}: {violated}", self.order + 1),
            None => Ok(()),
        }
    }
}

/// A violated order condition.
#[derive(Debug, Clone, PartialEq, Eq)]
pub struct ViolatedCondition {
    /// The tree.
    pub tree: BicolouredTree,
    /// Its elementary weight `Σ_i b_i Φ_i`, exact if that is short, otherwise its first digits and `…`.
    pub value: String,
    /// Its required value, `1/γ`.
    pub wanted: BigRational,
    /// The value minus the required value, written like the value.
    pub residual: String,
    /// The residual to 12 significant digits.
    pub residual_decimal: Decimal,
}

impl fmt::Display for ViolatedCondition {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        let ViolatedCondition {
            tree,
            value,
            wanted,
            residual,
            ..
        } = self;
        write!(
            f,
            "{tree} has the weight {value} instead of {wanted}, a difference of {residual}"
        )
    }
}
