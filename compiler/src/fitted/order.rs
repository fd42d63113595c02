//! The order of a fitted method: `h → 0` for a fixed frequency.
//!
//! The elementary weight of a tree with m vertices is a power series in `ν = wh`. The method has order p iff that series is
//! `1/γ + O(ν^{p+1−m})` for every tree with m ≤ p vertices, because the tree enters the error with `hᵐ`. The method is symplectic for
//! every `ν`, so one tree for each tree without a root suffices: with the conditions of the smaller trees, the residuals of two trees
//! that differ in the place of the root are equal up to the sign and up to terms of higher order.

use num_rational::BigRational;
use num_traits::One;

use super::waves::Ring;
use super::{Fitted, Series};
use crate::algebra::Field;
use crate::coefficients::Coefficients;
use crate::error::ErrorKind;
use crate::hamiltonian_class::HamiltonianClass;
use crate::order::{Plan, TreeRule};

/// The highest order that is decided.
const LIMIT: usize = 9;

/// The order for a class of Hamiltonians.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub struct FittedOrder {
    /// The largest p that is proved.
    pub order: usize,
    /// Why it is not larger: the vertices of a tree, and the power of `ν` at which its weight misses `1/γ`.
    pub violated: Option<(usize, usize)>,
}

/// The order for each class.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub struct FittedOrders {
    /// Every Hamiltonian.
    pub general: FittedOrder,
    /// `T(p) + U(q)`.
    pub separable: FittedOrder,
    /// Quadratic `T`.
    pub nystrom: FittedOrder,
}

impl Fitted {
    /// The order for each class of Hamiltonians, for `h → 0` with a fixed frequency.
    ///
    /// # Errors
    /// [`ErrorKind::Definition`] if a coefficient has no limit at `ν = 0`.
    pub fn orders(&self) -> Result<FittedOrders, ErrorKind> {
        let series = self.series(LIMIT)?;
        let class = |class| self.order(&series, TreeRule::Class(class));
        Ok(FittedOrders {
            general: class(HamiltonianClass::General),
            separable: class(HamiltonianClass::Separable),
            nystrom: class(HamiltonianClass::Nystrom),
        })
    }

    fn order(&self, series: &Coefficients<Series>, rule: TreeRule) -> FittedOrder {
        // The quadrature alone has at most order 2s.
        let limit = (2 * self.stages() + 1).min(LIMIT);
        for order in 1..=limit {
            if let Some(violated) = self.violated(series, rule, order) {
                return FittedOrder {
                    order: order - 1,
                    violated: Some(violated),
                };
            }
        }
        FittedOrder {
            order: limit,
            violated: None,
        }
    }

    /// A condition of an order that does not hold, while all of lower orders do: its vertices, and the power of `ν`.
    fn violated(
        &self,
        series: &Coefficients<Series>,
        rule: TreeRule,
        order: usize,
    ) -> Option<(usize, usize)> {
        let ring = &self.ring;
        let misses = |mut sum: Series, wanted: BigRational, vertices: usize| {
            if let Some(first) = sum.first_mut() {
                *first = ring.field.subtract(first, &ring.rational(wanted));
            }
            let power = sum.iter().position(|x| !x.is_zero());
            power.map(|power| (vertices, power))
        };
        for weights in [&series.b, &series.b_tilde] {
            if let found @ Some(_) = misses(ring.total(weights, order), BigRational::one(), 1) {
                return found;
            }
        }
        let orders: Vec<usize> = (2..=order).collect();
        if orders.is_empty() {
            return None;
        }
        let plan = Plan::new(rule, &orders, true);
        let mut trees = Trees {
            ring,
            series,
            plan: &plan,
            order,
            sizes: Vec::new(),
            stages: vec![None; plan.trees.len()],
        };
        for tree in &plan.trees {
            let size = tree
                .product
                .map_or(1, |(rest, last)| trees.sizes[rest] + trees.sizes[last]);
            trees.sizes.push(size);
        }
        plan.conditions.iter().find_map(|condition| {
            let vertices = trees.sizes[condition.rest] + trees.sizes[condition.last];
            let length = order + 1 - vertices;
            let weights = match plan.trees[condition.rest].momentum {
                true => &series.b_tilde,
                false => &series.b,
            };
            let rest = trees.stages(condition.rest);
            let last = trees.applied(condition.last);
            let terms: Vec<Series> = weights
                .iter()
                .zip(rest.iter().zip(&last))
                .map(|(b, (x, y))| ring.times(b, &ring.times(x, y, length), length))
                .collect();
            misses(
                ring.total(&terms, length),
                condition.wanted.clone(),
                vertices,
            )
        })
    }
}

/// The stages of trees, as series, each computed when it is first needed.
struct Trees<'a> {
    ring: &'a Ring,
    series: &'a Coefficients<Series>,
    plan: &'a Plan,
    order: usize,
    sizes: Vec<usize>,
    stages: Vec<Option<Vec<Series>>>,
}

impl Trees<'_> {
    /// A larger tree adds at least one vertex, so that fewer terms of its stages are needed.
    fn length(&self, tree: usize) -> usize {
        self.order - self.sizes[tree]
    }

    /// `Φ_i`
    fn stages(&mut self, tree: usize) -> Vec<Series> {
        if let Some(known) = &self.stages[tree] {
            return known.clone();
        }
        let (ring, length) = (self.ring, self.length(tree));
        let stages = match self.plan.trees[tree].product {
            None => {
                let one = ring.rational(BigRational::one());
                vec![vec![one]; self.series.b.len()]
            }
            Some((rest, last)) => {
                let (rest, last) = (self.stages(rest), self.applied(last));
                let pairs = rest.iter().zip(&last);
                pairs.map(|(x, y)| ring.times(x, y, length)).collect()
            }
        };
        self.stages[tree] = Some(stages.clone());
        stages
    }

    /// `Σ_j a_ij Φ_j`
    fn applied(&mut self, tree: usize) -> Vec<Series> {
        let (ring, length) = (self.ring, self.length(tree));
        let stages = self.stages(tree);
        let matrix = match self.plan.trees[tree].momentum {
            true => &self.series.a_tilde,
            false => &self.series.a,
        };
        let row = |row: &Vec<Series>| {
            let products = row.iter().zip(&stages);
            let products: Vec<Series> = products.map(|(a, x)| ring.times(a, x, length)).collect();
            ring.total(&products, length)
        };
        matrix.iter().map(row).collect()
    }
}
