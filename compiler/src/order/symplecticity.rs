//! The order up to which a method is symplectic.

use std::fmt;

use super::class::HamiltonianClass;
use super::enumeration::TreeRule;
use super::tree::{BicolouredTree, Colour};
use super::weights::{MAX_ORDER, Weights};
use crate::algebra::{StageAlgebra, Zero};
use crate::evidence::Evidence;
use crate::partitioned::Partitioned;
use crate::properties::{vanishing_matrix, vanishing_vector};

/// The order of symplecticity of a method that is not symplectic (pseudo-symplecticity, Aubry & Chartier
/// 1998): the step changes the symplectic form by `O(hᵖ⁺¹)`.
///
/// Whether a method is symplectic is decided by its coefficients, `b_i ã_ij + b̃_j a_ji = b_i b̃_j`. This is necessary only
/// for irreducible methods: a method with equal stages, or with stages that nothing depends on, can take
/// symplectic steps and violate it. It then has no order of symplecticity that could be refuted, and this is a
/// lower bound.
///
/// With the elementary weights `φ` of the method, the largest `p` such that for all trees `u` with a
/// root coloured `q` and `v` with one coloured `p`, `|u| + |v| ≤ p`,
///
/// ```text
/// φ(u∘v) + φ(v∘u) = φ(u) φ(v)
/// ```
///
/// and, for general `H`, such that weights of order up to `p` do not depend on the colour of the root
/// (GNI VI.7, the conditions for symplectic P-series).
#[derive(Debug, Clone, PartialEq, Eq)]
pub struct SymplecticityOrder {
    /// The order `p`.
    pub order: usize,
    /// The evidence that the conditions up to order `p` hold.
    pub evidence: Evidence,
    /// A violated condition of order `p + 1`, if one was found up to the limit.
    pub violated: Option<SymplecticityViolation>,
}

/// A violated condition of symplecticity.
#[derive(Debug, Clone, PartialEq, Eq)]
pub struct SymplecticityViolation {
    /// The tree `u` with a root coloured `q`.
    pub left: BicolouredTree,
    /// The tree `v` with a root coloured `p`; `None` for a condition on the colour of the root.
    pub right: Option<BicolouredTree>,
    /// `φ(u∘v) + φ(v∘u) − φ(u) φ(v)`, or the weight of `u` minus that of `u` with the other colour of the root.
    pub defect: String,
}

impl fmt::Display for SymplecticityViolation {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        match &self.right {
            Some(right) => write!(
                f,
                "the trees {} and {right} leave {}",
                self.left, self.defect
            ),
            None => write!(
                f,
                "the colour of the root of {} makes a difference of {}",
                self.left, self.defect
            ),
        }
    }
}

/// The evidence for the symplecticity conditions on the coefficients; `None` if a condition is violated.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub(super) struct Symplecticity {
    /// `b_i ã_ij + b̃_j a_ji = b_i b̃_j`
    pub(super) matrices: Option<Evidence>,
    /// `b = b̃`
    pub(super) weights: Option<Evidence>,
}

impl Symplecticity {
    pub(super) fn of<A: StageAlgebra>(pair: &Partitioned<A>) -> Self {
        let algebra = &*pair.algebra;
        let weights = algebra.subtract(&pair.b, &pair.b_tilde);
        let matrices = match pair.lower_triangular() {
            // A splitting is symplectic for all coefficients.
            Some(_) => Some(Evidence::Proved),
            None => vanishing_matrix(algebra, &defect(pair)).ok(),
        };
        Symplecticity {
            matrices,
            weights: vanishing_vector(algebra, &weights).ok(),
        }
    }

    /// The evidence that the method is symplectic for a class.
    pub(super) fn evidence(self, class: HamiltonianClass) -> Option<Evidence> {
        match class {
            HamiltonianClass::General => Some(self.matrices?.and(self.weights?)),
            HamiltonianClass::Separable | HamiltonianClass::Nystrom => self.matrices,
        }
    }
}

/// `b_i ã_ij + b̃_j a_ji − b_i b̃_j` (MW 2.6.7).
fn defect<A: StageAlgebra>(pair: &Partitioned<A>) -> A::Matrix {
    let algebra = &*pair.algebra;
    let momenta = algebra.scale_rows(&pair.a_tilde, &pair.b);
    let positions = algebra.transpose(&algebra.scale_rows(&pair.a, &pair.b_tilde));
    let sum = algebra.add_matrices(&momenta, &positions);
    algebra.subtract_matrices(&sum, &algebra.outer(&pair.b, &pair.b_tilde))
}

/// The order of symplecticity for a class; `None` for a method that is symplectic by its coefficients.
///
/// Trees are examined up to order `limit`; a method that is symplectic to that order has no violated
/// condition.
pub(crate) fn symplecticity_order<A: StageAlgebra>(
    pair: &Partitioned<A>,
    class: HamiltonianClass,
    limit: usize,
) -> Option<SymplecticityOrder> {
    let known = Symplecticity::of(pair);
    if known.evidence(class).is_some() {
        return None;
    }
    let algebra = &*pair.algebra;
    // If it is proved to be zero, no pair of trees is examined.
    let defect = (known.matrices != Some(Evidence::Proved)).then(|| defect(pair));
    let unequal = algebra.subtract(&pair.b, &pair.b_tilde);
    let mut weights = Weights::new(pair, TreeRule::Class(class));
    let mut evidence = Evidence::Proved;
    // (M Φ(v))_i for the trees v coloured p, order by order.
    let mut transferred: Vec<Vec<(u32, A::Vector)>> = Vec::new();
    let mut limit = limit.min(MAX_ORDER);
    for order in 1..=limit {
        // The stages of trees of this order are needed, as for conditions of the next.
        if !weights.affordable(order + 1) {
            limit = order - 1;
            break;
        }
        let mut check =
            |terms: A::Vector, trees: &dyn Fn() -> (BicolouredTree, Option<BicolouredTree>)| {
                let number = algebra.sum(&terms);
                match number.zero() {
                    Zero::Yes => None,
                    Zero::Within(bits) => {
                        evidence = evidence.and(Evidence::Verified { bits });
                        None
                    }
                    Zero::No => {
                        let (left, right) = trees();
                        let defect = super::short_sum(algebra, &terms, &number);
                        Some(SymplecticityViolation {
                            left,
                            right,
                            defect,
                        })
                    }
                }
            };
        weights.grow(order);
        let mut violated = None;
        if class == HamiltonianClass::General {
            let trees = weights.coloured(order, Colour::Q);
            violated = trees.into_iter().find_map(|u| {
                let terms = algebra.multiply(&unequal, weights.stages(u));
                check(terms, &|| (weights.enumerated(u), None))
            });
        }
        for size in 1..order {
            let Some(right) = transferred.get(order - size - 1) else {
                break;
            };
            for u in weights.coloured(size, Colour::Q) {
                violated = violated.or_else(|| {
                    right.iter().find_map(|(v, transferred)| {
                        let terms = algebra.multiply(weights.stages(u), transferred);
                        let trees = || (weights.enumerated(u), Some(weights.enumerated(*v)));
                        check(terms, &trees)
                    })
                });
            }
        }
        if violated.is_some() {
            return Some(SymplecticityOrder {
                order: order - 1,
                evidence,
                violated,
            });
        }
        if let Some(defect) = &defect {
            let black = weights.coloured(order, Colour::P).into_iter();
            let transfer = |v| (v, algebra.apply(defect, weights.stages(v)));
            transferred.push(black.map(transfer).collect());
        }
    }
    Some(SymplecticityOrder {
        order: limit,
        evidence,
        violated: None,
    })
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::exact::Exact;
    use crate::order::tests::methods::{decimal, explicit_runge_kutta, rational, splitting};
    use num_rational::BigRational;

    #[test]
    fn known_methods_have_their_orders_of_symplecticity() {
        let order = |pair: &Partitioned<_>| {
            let found =
                symplecticity_order(pair, HamiltonianClass::General, 8).expect("not symplectic");
            assert_eq!(found.evidence, Evidence::Proved);
            let violated = found.violated.expect("violated below order 8");
            (found.order, violated)
        };
        // RK4 has only its own order: a method of order p preserves the symplectic form to order p, like the exact flow.
        let (rk4, violated) = order(&explicit_runge_kutta("rk4"));
        assert_eq!(rk4, 4);
        let right = violated.right.expect("a pair of trees");
        assert_eq!(violated.left.order() + right.order(), 5);
        assert_eq!(order(&explicit_runge_kutta("kutta3")).0, 3);
        let (euler, violated) = order(&explicit_runge_kutta("euler"));
        // b ã + b̃ a − b b̃ = −1.
        assert_eq!((euler, violated.defect.as_str()), (1, "-1"));
    }

    #[test]
    fn the_explicit_midpoint_rule_is_symplectic_to_order_2() {
        let pair = explicit_runge_kutta("midpoint");
        let found =
            symplecticity_order(&pair, HamiltonianClass::General, 6).expect("not symplectic");
        assert_eq!(found.order, 2);
    }

    #[test]
    fn symplectic_methods_have_an_unbounded_order_of_symplecticity() {
        let lobatto = crate::derive("polynomial(3)", "lobatto(3)").expect("derived");
        let Exact::Nodes(pair) = &*lobatto.exact else {
            panic!("classical nodes");
        };
        assert_eq!(
            symplecticity_order(pair, HamiltonianClass::General, 8),
            None
        );
        // Drifts and kicks of different weights: symplectic for separable H only.
        let ruth = splitting(
            &[rational("2/3"), rational("-2/3"), rational("1")],
            &[rational("7/24"), rational("3/4"), rational("-1/24")],
        );
        assert_eq!(
            symplecticity_order(&ruth, HamiltonianClass::Separable, 8),
            None
        );
        let general =
            symplecticity_order(&ruth, HamiltonianClass::General, 8).expect("not symplectic");
        assert_eq!(general.order, 1);
        let violated = general.violated.expect("a violated condition");
        assert_eq!(
            (violated.left.to_string().as_str(), violated.right),
            ("q[q]", None)
        );
        // With one digit changed it is no longer symplectic for any class.
        let mut changed = ruth;
        changed.a[1][0] = &changed.a[1][0] + decimal("0.001");
        let separable = symplecticity_order(&changed, HamiltonianClass::Separable, 8);
        assert_eq!(separable.map(|found| found.order), Some(1));
    }

    #[test]
    fn symplecticity_defects_agree_with_elementary_weights() {
        let rational = |n: i64, d: i64| BigRational::new(n.into(), d.into());
        let pair = explicit_runge_kutta("rk4");
        let weights = |text: &str| {
            let tree: BicolouredTree = text.parse().expect(text);
            crate::order::tests::methods::weight(&pair, &tree)
        };
        // For RK4 u = q[q] and v = p[p[p]]: φ(u∘v) + φ(v∘u) − φ(u) φ(v).
        let defect = weights("q[q,p[p[p]]]") + weights("p[p[p],q[q]]")
            - weights("q[q]") * weights("p[p[p]]");
        assert_ne!(defect, rational(0, 1));
        let low = weights("q[p[p]]") + weights("p[p,q]") - weights("q") * weights("p[p]");
        assert_eq!(low, rational(0, 1));
    }
}
