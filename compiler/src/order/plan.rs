//! Order conditions as a plan, for numbers that do not belong to an algebra of this crate.

use num_bigint::BigInt;
use num_rational::BigRational;
use num_traits::One;

use super::enumeration::{TreeRule, Trees};
use super::tree::Colour;

/// A tree from which other trees are formed.
#[derive(Debug, Clone, Copy)]
pub struct Planned {
    /// Whether its root is coloured `p`: it takes `b̃` and, as a child, `ã`.
    pub momentum: bool,
    /// An earlier tree, and another one that becomes an additional child of its root.
    pub product: Option<(usize, usize)>,
}

/// `Σ_i b_i Φ_i(rest) Σ_j a_ij Φ_j(last) = wanted`.
#[derive(Debug, Clone)]
pub struct PlannedCondition {
    /// The tree whose root is that of the whole.
    pub rest: usize,
    /// The tree that becomes an additional child of that root.
    pub last: usize,
    /// The value.
    pub wanted: BigRational,
}

/// The conditions of some orders.
#[derive(Debug, Clone)]
pub struct Plan {
    /// The trees, each formed from earlier ones.
    pub trees: Vec<Planned>,
    /// The conditions on them.
    pub conditions: Vec<PlannedCondition>,
}

impl Plan {
    /// The conditions of orders from 2 on: all, or with `representatives` one for each tree without a root, which are
    /// those that remain for a symplectic method.
    pub fn new(rule: TreeRule, orders: &[usize], representatives: bool) -> Self {
        let highest = orders.iter().max().copied().unwrap_or(1);
        let trees = Trees::up_to(rule, highest.saturating_sub(1).max(1));
        let planned = |index: usize| {
            let entry = trees.entry(index as u32);
            Planned {
                momentum: entry.colour == Colour::P,
                product: entry
                    .product
                    .map(|(rest, last)| (rest as usize, last as usize)),
            }
        };
        let mut densities: Vec<BigInt> = Vec::new();
        for index in 0..trees.len() {
            let density = match trees.entry(index as u32).product {
                None => BigInt::one(),
                Some(parts) => density(&trees, &densities, parts),
            };
            densities.push(density);
        }
        let of_order = |&order: &usize| -> Vec<(u32, u32)> {
            match representatives {
                true => trees.representatives(order).collect(),
                false => trees.products(order).collect(),
            }
        };
        let pairs = orders
            .iter()
            .filter(|order| **order >= 2)
            .flat_map(of_order);
        let condition = |(rest, last): (u32, u32)| PlannedCondition {
            rest: rest as usize,
            last: last as usize,
            wanted: BigRational::new(BigInt::one(), density(&trees, &densities, (rest, last))),
        };
        Plan {
            conditions: pairs.map(condition).collect(),
            trees: (0..trees.len()).map(planned).collect(),
        }
    }
}

/// The density `γ`: the factor `|rest|` of `γ(rest)` becomes `|rest| + |last|`.
fn density(trees: &Trees, densities: &[BigInt], (rest, last): (u32, u32)) -> BigInt {
    let (before, added) = (trees.size(rest), trees.size(last));
    &densities[rest as usize] / before * (before + added) * &densities[last as usize]
}
