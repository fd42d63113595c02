//! The order of a method for each class of Hamiltonians, proved and sharp.
//!
//! A method has order `p` for a class iff `Σ_i b_i Φ_i(τ) = 1/γ(τ)` for every bicoloured rooted tree `τ`
//! of the class with at most `p` vertices (GNI III.2). An order is the largest such `p`
//! together with a tree of order `p + 1` whose condition is refuted. It is proved
//!
//! 1. by the [`SimplifyingAssumptions`] up to the order that they give,
//! 2. for a method with a [`Claim`](crate::certify::Claim) by its certificate, and for a triple jump or a Suzuki fractal
//!    by the theorem on symmetric compositions (GNI II.4),
//! 3. by evaluating conditions, order by order, up to [`OrderOptions::limit`]: all of them, or for
//!    symplectic methods one for each tree without a root,
//! 4. and refuted beyond the limit by the quadrature, `B(p + 1)`, which is a single tree.
//!
//! | order of the trees | 6 | 7 | 8 | 9 | 10 |
//! |---|---|---|---|---|---|
//! | conditions, general | 916 | 4 116 | 18 996 | 89 894 | 433 196 |
//! | conditions that remain for a symplectic method | 91 | 350 | 1 376 | 5 743 | 24 635 |
//! | all, three classes, Gauss with 5 stages | 20 ms | 60 ms | 0.3 s | 1.2 s | 6 s |
//! | memory for that | 14 MB | 14 MB | 14 MB | 18 MB | 72 MB |
//!
//! Measured on one core, optimised. With the default options the methods of the catalogue take at most 0.1 s each. The two of order
//! 9 take 1 s, and Gauss with 20 stages, order 40, takes 0.2 s. Conditions of an order are not enumerated if they take more than ten
//! million products of a coefficient and a stage, or four million if numbers are expressions. Then only the simplifying assumptions
//! give information about that order.
//!
//! The order [observed](crate::Tableau::observed_order) in a step of a pendulum does not use any of this.
//!
//! Splittings also have an order for perturbed systems, a [`PerturbedOrder`], from words instead of trees.

mod class;
pub(crate) mod composition;
mod conjugate;
mod enumeration;
mod error_constant;
mod exponential_words;
mod inherited;
mod modified;
mod observed;
mod perturbed;
mod plan;
mod report;
mod simplifying;
mod symplecticity;
mod tree;
mod unrooted;
mod weights;

pub use class::HamiltonianClass;
pub(crate) use conjugate::conjugate_order;
pub use conjugate::{ConjugateOrder, LieTerm, ViolatedKernel};
pub use enumeration::{TreeRule, Trees};
pub(crate) use inherited::GivenOrder;
pub use modified::ModifiedTerm;
pub(crate) use modified::modified_equation;
pub use observed::Pendulum;
pub(crate) use observed::observed_order;
pub(crate) use perturbed::listed;
pub(crate) use perturbed::perturbed_order;
pub use perturbed::{PerturbedOrder, PowerOrder, ViolatedWord};
#[doc(hidden)]
pub use plan::Plan;
pub use report::{ClassOrder, OrderReport, ViolatedCondition};
pub use simplifying::SimplifyingAssumptions;
pub(crate) use simplifying::simplifying_assumptions;
pub(crate) use symplecticity::symplecticity_order;
pub use symplecticity::{SymplecticityOrder, SymplecticityViolation};
pub use tree::{BicolouredTree, Colour, TreeError};
#[doc(hidden)]
pub use weights::one_of_each_rooting;

use num_rational::BigRational;
use num_traits::Signed;

use self::error_constant::Term;
use self::symplecticity::Symplecticity;
use self::weights::{MAX_ORDER, Weights};
use crate::algebra::{Balls, Dense, Field, Number, StageAlgebra, Zero};
use crate::evidence::Evidence;
use crate::exact::{Exact, over_algebra};
use crate::partitioned::Partitioned;
use crate::properties::shown;

/// Options for deciding orders.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub struct OrderOptions {
    /// The highest order of trees that are enumerated; 10 unless changed, and at most 20.
    ///
    /// Each order has about five times as many trees as the previous order.
    pub limit: usize,
    /// Evaluates the conditions of all trees from order 1 on, without using symplecticity
    /// or simplifying assumptions.
    pub all_conditions: bool,
}

impl Default for OrderOptions {
    fn default() -> Self {
        OrderOptions {
            limit: 10,
            all_conditions: false,
        }
    }
}

/// The order of a method for each class of Hamiltonians; `given` is the order that follows from its construction.
pub(crate) fn order(
    exact: &Exact,
    options: &OrderOptions,
    given: Option<&GivenOrder>,
) -> OrderReport {
    over_algebra!(exact, pair => order_of_pair(pair, options, given))
}

/// The order of a pair for each class of Hamiltonians.
pub(crate) fn order_of_pair<A: StageAlgebra>(
    pair: &Partitioned<A>,
    options: &OrderOptions,
    given: Option<&GivenOrder>,
) -> OrderReport {
    // The given order is used only where enclosures would merely verify it.
    let verified = pair.algebra.constants().verified_bits().is_some();
    let given = given.filter(|_| verified && !options.all_conditions);
    let known = Known::of(pair, options);
    // It remains to refute the next order, for which enclosures with few bits suffice.
    let enclosed = given.map(|_| pair.enclosed(BITS));
    let class = |class| {
        if pair.gradient.is_some() && class != HamiltonianClass::Nystrom {
            return ClassOrder::none();
        }
        let known = given.map_or_else(|| known.clone(), |given| known.with(given, class));
        let refuted = enclosed
            .as_ref()
            .and_then(|pair| refuted(pair, class, &known));
        refuted.unwrap_or_else(|| class_order(pair, class, &known))
    };
    OrderReport {
        general: class(HamiltonianClass::General),
        separable: class(HamiltonianClass::Separable),
        nystrom: class(HamiltonianClass::Nystrom),
    }
}

/// Knowledge that makes it unnecessary to evaluate conditions.
#[derive(Clone)]
struct Known {
    /// The order from the simplifying assumptions, a certificate or a construction.
    order: usize,
    evidence: Evidence,
    symplecticity: Symplecticity,
    /// The highest order of trees that are enumerated.
    limit: usize,
}

impl Known {
    fn of<A: StageAlgebra>(pair: &Partitioned<A>, options: &OrderOptions) -> Self {
        let limit = options.limit.min(MAX_ORDER);
        if options.all_conditions {
            return Known {
                limit,
                order: 0,
                evidence: Evidence::Proved,
                symplecticity: Symplecticity {
                    matrices: None,
                    weights: None,
                },
            };
        }
        let assumptions = simplifying_assumptions(pair);
        Known {
            limit,
            order: assumptions.map_or(0, |found| found.order()),
            evidence: assumptions.map_or(Evidence::Proved, |found| found.evidence),
            symplecticity: Symplecticity::of(pair),
        }
    }
}

impl Known {
    /// The same knowledge with an order that follows from the construction of the method.
    fn with(&self, given: &GivenOrder, class: HamiltonianClass) -> Self {
        let mut known = self.clone();
        let order = given.for_class(class);
        if order > 0 && order >= known.order {
            known.order = order;
            known.evidence = given.evidence;
            // These classes have few trees, and only one order has to be examined.
            if class != HamiltonianClass::General {
                known.limit = known.limit.max(order + 1).min(MAX_ORDER);
            }
        }
        known
    }
}

/// Bits of the enclosures that refute an order beyond a known one.
const BITS: u32 = 256;

/// The known order, if conditions of the next order are refuted and their error constant is found.
fn refuted(
    pair: &Partitioned<Dense<Balls>>,
    class: HamiltonianClass,
    known: &Known,
) -> Option<ClassOrder> {
    let next = Known {
        limit: known.order + 1,
        ..known.clone()
    };
    let affordable = next.order > 0 && next.limit <= known.limit;
    let found = affordable.then(|| class_order(pair, class, &next))?;
    (found.order == known.order && found.error_constant.is_some()).then_some(found)
}

/// The order of a pair for one class.
fn class_order<A: StageAlgebra>(
    pair: &Partitioned<A>,
    class: HamiltonianClass,
    known: &Known,
) -> ClassOrder {
    // Consequences of equations that are only verified are less certain than the equations themselves.
    let representatives = known.symplecticity.evidence(class) == Some(Evidence::Proved);
    let mut evidence = known.evidence;
    let mut weights = Weights::new(pair, TreeRule::Class(class));
    let mut limit = known.limit;
    for order in known.order + 1..=limit {
        if !weights.affordable(order) {
            limit = order - 1;
            break;
        }
        let conditions = weights.conditions(order, representatives);
        // The terms, and which of them are certainly not zero.
        let (mut refuted, mut terms) = (Vec::new(), Vec::new());
        // The evidence of this order counts only if all of its conditions hold.
        let mut held = evidence;
        for condition in conditions {
            let (value, wanted) = (weights.value(condition), weights.wanted(condition));
            match value.difference(&wanted) {
                Zero::Yes => continue,
                Zero::Within(bits) => held = held.and(Evidence::Verified { bits }),
                Zero::No => refuted.push(terms.len()),
            }
            terms.push((condition, value, wanted));
        }
        if refuted.is_empty() {
            evidence = held;
            continue;
        }
        let residuals = refuted.iter().map(|&at| (&terms[at].1, &terms[at].2));
        let (first, value, _) = &terms[refuted[error_constant::leading(residuals)]];
        let violated = ViolatedCondition::new(
            &*pair.algebra,
            weights.tree(*first),
            &weights.terms(*first),
            value,
        );
        let term = |(condition, value, wanted)| Term {
            value,
            wanted,
            weight: unrooted::weight(class, &weights.tree(condition), representatives),
        };
        let terms: Vec<Term<'_>> = terms.into_iter().map(term).collect();
        return ClassOrder {
            order: order - 1,
            evidence,
            refuted_by: Some(violated),
            error_constant: error_constant::norm(&terms),
        };
    }
    let order = known.order.max(limit);
    ClassOrder {
        order,
        evidence,
        refuted_by: refuted_by_quadrature(pair, class, order + 1),
        error_constant: None,
    }
}

/// The order for a class up to a tolerance of the conditions, for rounded numbers, and the first condition violated by more than
/// that. The order is at most `limit`.
pub fn order_within<A: StageAlgebra>(
    pair: &Partitioned<A>,
    class: HamiltonianClass,
    tolerance: &BigRational,
    limit: usize,
) -> (usize, Option<ViolatedCondition>) {
    let pair = pair.enclosed(BITS);
    let symplecticity = Symplecticity::of(&pair);
    let representatives = symplecticity.evidence(class) == Some(Evidence::Proved);
    let mut weights = Weights::new(&pair, TreeRule::Class(class));
    for order in 1..=limit {
        if !weights.affordable(order) {
            return (order - 1, None);
        }
        let violated = weights
            .conditions(order, representatives)
            .into_iter()
            .find(|&condition| {
                let value = weights.value(condition).enclose(BITS).middle();
                (value - weights.wanted(condition)).abs() > *tolerance
            });
        if let Some(condition) = violated {
            let (tree, terms) = (weights.tree(condition), weights.terms(condition));
            let value = weights.value(condition);
            let violated = ViolatedCondition::new(&*pair.algebra, tree, &terms, &value);
            return (order - 1, Some(violated));
        }
    }
    (limit, None)
}

/// A tree of an order whose children are leaves, if its condition is refuted.
fn refuted_by_quadrature<A: StageAlgebra>(
    pair: &Partitioned<A>,
    class: HamiltonianClass,
    order: usize,
) -> Option<ViolatedCondition> {
    let algebra = &*pair.algebra;
    [Colour::P, Colour::Q].into_iter().find_map(|colour| {
        let tree = BicolouredTree::bushy(colour, order);
        let (leaves, weights) = match colour {
            Colour::P => (pair.c(), &pair.b_tilde),
            Colour::Q => (pair.c_tilde(), &pair.b),
        };
        if !class.contains(&tree) {
            return None;
        }
        let leaf = |terms, _| algebra.multiply(&terms, &leaves);
        let terms = (1..order).fold(weights.clone(), leaf);
        let value = algebra.sum(&terms);
        let violated = value.difference(&tree.wanted()) == Zero::No;
        violated.then(|| ViolatedCondition::new(algebra, tree, &terms, &value))
    })
}

impl ViolatedCondition {
    fn new<A: StageAlgebra>(
        algebra: &A,
        tree: BicolouredTree,
        terms: &A::Vector,
        value: &Number<'_>,
    ) -> Self {
        let wanted = tree.wanted();
        // The same fraction of the wanted value at each stage, so that the sum is the residual.
        let share = &wanted / BigRational::from_integer(algebra.stages().into());
        let residual = algebra.subtract(terms, &algebra.constant(&share));
        let number = algebra.sum(&residual);
        ViolatedCondition {
            value: short_sum(algebra, terms, value),
            residual: short_sum(algebra, &residual, &number),
            residual_decimal: number.decimal(12),
            wanted,
            tree,
        }
    }
}

/// Exact values with more characters are written as decimals.
const SHORT: usize = 40;

/// `Σ_i f_i`, equal to `number`: exact if that is short, otherwise its first digits and `…`.
fn short_sum<A: StageAlgebra>(algebra: &A, f: &A::Vector, number: &Number<'_>) -> String {
    match algebra.exact_sum(f) {
        Some(exact) if exact.chars().count() <= SHORT => exact,
        _ => short(number),
    }
}

/// The first digits of a number without a short exact form.
fn short(number: &Number<'_>) -> String {
    let text = shown(number);
    if text.chars().count() <= SHORT {
        text
    } else {
        format!("{}…", number.decimal(12))
    }
}

#[cfg(test)]
mod tests;
