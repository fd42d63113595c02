//! Elementary weights over a pair of matrices, exactly.
//!
//! `Φ_i(u∘v) = Φ_i(u) Σ_j a_ij Φ_j(v)`. So if the stages of all smaller trees are stored, a tree takes one product of vectors,
//! and a condition one inner product: in a node algebra a trace. For each tree `Φ_i`, `b_i Φ_i` and `Σ_j a_ij Φ_j` are stored,
//! each computed when it is first needed. For conditions of the highest order nothing is stored.
//!
//! **Gradient kicks.** For quadratic `T` a gradient kick adds `2g f′(Q) M⁻¹f(Q)` to the force of its stage. Expanded about `q0`, a child
//! `q[v]` of a root coloured `p` then has the force of `v` at the same stage. So with children `u_k` of that root, in place of `b̃_i Φ_i`,
//!
//! ```text
//! b̃_i Φ_i + 2 g_i D_i,     D_i = Σ_{k: u_k = q[v]} Φ_i(v) Π_{l≠k} Σ_j a_ij Φ_j(u_l),
//! ```
//!
//! where `D` is a derivation: `D(u∘w) = D(u) Σ_j a_ij Φ_j(w) + Φ(u) Φ(v)`, the last term only for `w = q[v]`.

use std::cell::OnceCell;

use num_bigint::BigInt;
use num_rational::BigRational;
use num_traits::One;

use super::class::HamiltonianClass;
use super::enumeration::{TreeRule, Trees};
use super::tree::{BicolouredTree, Colour};
use crate::algebra::{Dense, Field, Number, Rationals, StageAlgebra};
use crate::partitioned::{LowerTriangular, Partitioned};

/// The highest order of enumerated trees: densities, at most `order!`, are stored in 64 bits.
pub(super) const MAX_ORDER: usize = 20;

/// The largest number of products of a coefficient and a stage, for all trees: half a minute with rationals.
const MAX_PRODUCTS: usize = 10_000_000;

/// The same if numbers are expressions, about 500 bytes each, which are stored with their enclosures: 2 GB.
const MAX_EXPRESSIONS: usize = 4_000_000;

/// The largest number of products of elements of a field.
pub(super) fn most_products<F: Field>(field: &F) -> usize {
    match field.keeps_operands() {
        false => MAX_PRODUCTS,
        true => MAX_EXPRESSIONS,
    }
}

/// The conditions for quadratic `T` of these orders that remain for a symplectic method, as trees, with the elementary weights.
pub fn one_of_each_rooting(
    pair: &Partitioned<Dense<Rationals>>,
    orders: impl Iterator<Item = usize>,
) -> Vec<(BicolouredTree, BigRational)> {
    let mut weights = Weights::new(pair, TreeRule::Class(HamiltonianClass::Nystrom));
    let mut found = Vec::new();
    for order in orders {
        for condition in weights.conditions(order, true) {
            if let Number::Rational(value) = weights.value(condition) {
                found.push((weights.tree(condition), value));
            }
        }
    }
    found
}

/// The tree of a condition: one vertex, or a product of trees in the enumeration.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub(super) struct Condition {
    rest: u32,
    last: Option<u32>,
}

/// The stored values of a tree, each computed on demand.
struct Kept<V> {
    /// `γ`
    density: u64,
    /// `Φ_i`
    stages: OnceCell<V>,
    /// `D_i` of gradient kicks.
    gradient: OnceCell<V>,
    /// `b_i Φ_i`, or with `b̃` for a root coloured `p`.
    weighted: OnceCell<V>,
    /// `Σ_j a_ij Φ_j`, or with `ã` for a root coloured `p`.
    applied: OnceCell<V>,
}

/// The elementary weights of a method.
pub(super) struct Weights<'a, A: StageAlgebra> {
    pair: &'a Partitioned<A>,
    lower_triangular: Option<LowerTriangular>,
    /// `2 g_i` of gradient kicks.
    gradient: Option<A::Vector>,
    trees: Trees,
    kept: Vec<Kept<A::Vector>>,
    /// The number of products of a coefficient and a stage per tree.
    products: usize,
}

impl<'a, A: StageAlgebra> Weights<'a, A> {
    pub(super) fn new(pair: &'a Partitioned<A>, rule: TreeRule) -> Self {
        let stages = pair.algebra.stages();
        // A splitting takes one product per stage for each of the stored vectors.
        let for_all = stages * stages;
        let lower_triangular = pair.lower_triangular();
        let products = lower_triangular.map_or(for_all, |_| for_all.min(3 * stages));
        let gradient = pair.gradient.as_ref();
        Weights {
            products: products * if gradient.is_some() { 2 } else { 1 },
            gradient: gradient.map(|gradient| pair.algebra.add(gradient, gradient)),
            pair,
            lower_triangular,
            trees: Trees::up_to(rule, 0),
            kept: Vec::new(),
        }
    }

    /// The trees of all conditions of an order, or only those that remain for a symplectic method; the order
    /// is between 1 and [`MAX_ORDER`].
    pub(super) fn conditions(&mut self, order: usize, representatives: bool) -> Vec<Condition> {
        self.grow(order - 1);
        let product = |(rest, last)| Condition {
            rest,
            last: Some(last),
        };
        let trees = &self.trees;
        if order == 1 {
            let vertex = |rest| Condition { rest, last: None };
            trees.indices(1).map(vertex).collect()
        } else if representatives {
            trees.representatives(order).map(product).collect()
        } else {
            trees.products(order).map(product).collect()
        }
    }

    /// Makes the trees up to an order available.
    pub(super) fn grow(&mut self, order: usize) {
        self.trees.grow(order);
        for index in self.kept.len()..self.trees.len() {
            let density = match self.trees.entry(index as u32).product {
                None => 1,
                Some((rest, last)) => self.density(rest, last),
            };
            self.kept.push(Kept {
                density,
                stages: OnceCell::new(),
                gradient: OnceCell::new(),
                weighted: OnceCell::new(),
                applied: OnceCell::new(),
            });
        }
    }

    /// Whether the conditions of an order, at least 1, can be evaluated in bounded time and memory.
    pub(super) fn affordable(&mut self, order: usize) -> bool {
        let algebra = &*self.pair.algebra;
        self.grow(order - 1);
        let most = most_products(algebra.constants());
        self.trees.len() * self.products <= most
    }

    fn density(&self, rest: u32, last: u32) -> u64 {
        let (before, added) = (self.trees.size(rest) as u64, self.trees.size(last) as u64);
        // The factor |rest| of γ(rest) becomes |rest| + |last|.
        let grown = self.kept[rest as usize].density / before * (before + added);
        grown * self.kept[last as usize].density
    }

    /// The required value of the elementary weight: `1/γ`.
    pub(super) fn wanted(&self, condition: Condition) -> BigRational {
        let Condition { rest, last } = condition;
        let density = last.map_or(1, |last| self.density(rest, last));
        BigRational::new(BigInt::one(), density.into())
    }

    /// The tree of a condition.
    pub(super) fn tree(&self, condition: Condition) -> BicolouredTree {
        let Condition { rest, last } = condition;
        last.map_or_else(
            || self.trees.tree(rest),
            |last| self.trees.product(rest, last),
        )
    }

    /// The elementary weight `Σ_i b_i Φ_i`.
    pub(super) fn value(&self, condition: Condition) -> Number<'a> {
        let algebra = &*self.pair.algebra;
        let weighted = self.weighted(condition.rest);
        match condition.last {
            Some(last) if self.at_one_stage(condition.rest, last).is_some() => {
                algebra.sum(&self.terms(condition))
            }
            Some(last) => algebra.inner(weighted, self.applied(last)),
            None => algebra.sum(weighted),
        }
    }

    /// The terms `b_i Φ_i` of the elementary weight.
    pub(super) fn terms(&self, condition: Condition) -> A::Vector {
        let algebra = &*self.pair.algebra;
        let weighted = self.weighted(condition.rest);
        let Some(last) = condition.last else {
            return weighted.clone();
        };
        let terms = algebra.multiply(weighted, self.applied(last));
        match (&self.gradient, self.at_one_stage(condition.rest, last)) {
            (Some(gradient), Some(product)) => {
                algebra.add(&terms, &algebra.multiply(gradient, &product))
            }
            _ => terms,
        }
    }

    /// The trees of an order with a root of this colour.
    pub(super) fn coloured(&self, order: usize, colour: Colour) -> Vec<u32> {
        let indices = self.trees.indices(order);
        indices
            .filter(|&index| self.trees.colour(index) == colour)
            .collect()
    }

    /// A tree in the enumeration.
    pub(super) fn enumerated(&self, index: u32) -> BicolouredTree {
        self.trees.tree(index)
    }

    /// `Φ_i` of a tree in the enumeration.
    pub(super) fn stages(&self, index: u32) -> &A::Vector {
        self.kept[index as usize].stages.get_or_init(|| {
            let algebra = &*self.pair.algebra;
            match self.trees.entry(index).product {
                None => algebra.constant(&BigRational::one()),
                Some((rest, last)) if self.trees.entry(rest).product.is_none() => {
                    self.applied(last).clone()
                }
                Some((rest, last)) => algebra.multiply(self.stages(rest), self.applied(last)),
            }
        })
    }

    fn weighted(&self, index: u32) -> &A::Vector {
        self.kept[index as usize].weighted.get_or_init(|| {
            let weights = match self.trees.colour(index) {
                Colour::Q => &self.pair.b,
                Colour::P => &self.pair.b_tilde,
            };
            let algebra = &*self.pair.algebra;
            let weighted = algebra.multiply(weights, self.stages(index));
            match &self.gradient {
                Some(gradient) if self.trees.colour(index) == Colour::P => {
                    let added = algebra.multiply(gradient, self.derived(index));
                    algebra.add(&weighted, &added)
                }
                _ => weighted,
            }
        })
    }

    /// `D_i` of a tree in the enumeration with a root coloured `p`.
    fn derived(&self, index: u32) -> &A::Vector {
        self.kept[index as usize].gradient.get_or_init(|| {
            let algebra = &*self.pair.algebra;
            let Some((rest, last)) = self.trees.entry(index).product else {
                return algebra.constant(&BigRational::default());
            };
            let derived = algebra.multiply(self.derived(rest), self.applied(last));
            match self.at_one_stage(rest, last) {
                Some(product) => algebra.add(&derived, &product),
                None => derived,
            }
        })
    }

    /// `Φ_i(rest) Φ_i(v)` for `last = q[v]` and a root coloured `p`: a gradient kick has the force of `v` at its own stage.
    fn at_one_stage(&self, rest: u32, last: u32) -> Option<A::Vector> {
        self.gradient.as_ref()?;
        if self.trees.colour(rest) != Colour::P {
            return None;
        }
        let (_, force) = self.trees.entry(last).product?;
        let algebra = &*self.pair.algebra;
        Some(algebra.multiply(self.stages(rest), self.stages(force)))
    }

    fn applied(&self, index: u32) -> &A::Vector {
        self.kept[index as usize].applied.get_or_init(|| {
            let (algebra, colour) = (&*self.pair.algebra, self.trees.colour(index));
            // The entries of the matrices are the weights.
            let sums = self.lower_triangular.and_then(|lower_triangular| {
                let own = match colour {
                    Colour::Q => lower_triangular.has_own_drift(),
                    Colour::P => lower_triangular.has_own_kick(),
                };
                algebra.partial_sums(self.weighted(index), own)
            });
            let matrix = match colour {
                Colour::Q => &self.pair.a,
                Colour::P => &self.pair.a_tilde,
            };
            sums.unwrap_or_else(|| algebra.apply(matrix, self.stages(index)))
        })
    }
}
