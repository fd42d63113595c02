//! Trees without a root: the order conditions that remain for a symplectic method.
//!
//! Let `u` have a root coloured `q` and `v` a root coloured `p`. Let `u∘v` be `u` with `v` as an additional child of its root, and
//! write `φ` for elementary weights. `b_i ã_ij + b̃_j a_ji = b_i b̃_j` gives
//!
//! ```text
//! φ(u∘v) + φ(v∘u) = Σ_ij Φ_i(u) (b_i ã_ij + b̃_j a_ji) Φ_j(v) = φ(u) φ(v)
//! ```
//!
//! and the exact flow, being symplectic too, satisfies the same for `1/γ`. Hence if the conditions of lower orders hold, the
//! residuals of `u∘v` and `v∘u` are equal up to the sign. The condition of a tree is equivalent to that of any tree that differs only
//! in the place of the root (GNI VI.7). Moving the root along an edge does not change which end of the edge is differentiated by `q`
//! and which by `p`: a child coloured `q` makes the old root a child coloured `p` and vice versa. In a separable class this leaves
//! all colours unchanged. For general `H` the colour of the root itself does not matter if `b = b̃`, so the classes are trees with
//! directed edges. For one tableau, `ã = a`, colours do not matter at all, and the condition of a tree `u∘u` follows from lower
//! orders: it is superfluous.
//!
//! On the way the root may pass a Nyström vertex for `q'` with two neighbours: its tree is not in the
//! class, but the identity still holds for it.
//!
//! Each class has one representative, whose root is the centroid: no child has more than half of
//! the vertices. So only the stages of trees of half the order are needed.

use num_bigint::BigInt;
use num_rational::BigRational;
use num_traits::One;
use std::collections::BTreeSet;

use super::class::HamiltonianClass;
use super::enumeration::{TreeRule, Trees};
use super::tree::{BicolouredTree, Colour};

impl Trees {
    /// One tree for each condition of this order that remains for a symplectic method, as `(rest, last)`. The order is at least 2 and
    /// at most one higher than the highest.
    pub(super) fn representatives(&self, order: usize) -> impl Iterator<Item = (u32, u32)> {
        let products = self.products_with_last(order, order.div_ceil(2) + 1);
        products.filter(move |&(rest, last)| self.is_representative(order, rest, last))
    }

    /// Whether a product of this order represents its class; the order of `last` is at most half of it,
    /// rounded up.
    fn is_representative(&self, order: usize, rest: u32, last: u32) -> bool {
        let size = self.size(last);
        let (below, half) = (2 * size <= order, 2 * size == order);
        match self.rule() {
            // Of two centroids the earlier comes below the later; equal halves are superfluous.
            TreeRule::OneColour => below && (!half || rest > last),
            // One end of the edge between two centroids has a child coloured p at the other end.
            TreeRule::Class(HamiltonianClass::General) => {
                let root = self.colour(rest) == Colour::Q;
                root && below && (!half || self.colour(last) == Colour::P)
            }
            TreeRule::Class(HamiltonianClass::Separable) => {
                below && (!half || self.colour(rest) == Colour::P)
            }
            // The root is coloured p; a centroid coloured q has two branches of the same order, and the
            // later of them takes the root.
            TreeRule::Class(HamiltonianClass::Nystrom) => {
                let branch = self.entry(last).product.map(|(_, child)| child);
                let centroid = below || branch.is_some_and(|branch| rest >= branch);
                self.colour(rest) == Colour::P && centroid
            }
        }
    }
}

impl BicolouredTree {
    /// The trees that differ from this one only in the place of the root, including this tree.
    ///
    /// A new root has the colour that it has as a child; its old parent gets the opposite colour. See the head of this file.
    pub fn rerooted(&self) -> BTreeSet<BicolouredTree> {
        let mut found = BTreeSet::from([self.clone()]);
        let mut pending = vec![self.clone()];
        while let Some(tree) = pending.pop() {
            for index in 0..tree.children().len() {
                let moved = tree.rooted_at(index);
                if found.insert(moved.clone()) {
                    pending.push(moved);
                }
            }
        }
        found
    }

    /// The tree with its root at a child.
    fn rooted_at(&self, index: usize) -> BicolouredTree {
        let mut others = self.children().to_vec();
        let child = others.remove(index);
        let mut children = child.children().to_vec();
        children.push(BicolouredTree::new(child.colour().opposite(), others));
        BicolouredTree::new(child.colour(), children)
    }

    /// The tree with its root where no child has more than half of the vertices.
    fn rooted_at_centroid(mut self) -> BicolouredTree {
        let order = self.order();
        let heavy = |child: &BicolouredTree| 2 * child.order() > order;
        while let Some(index) = self.children().iter().position(heavy) {
            self = self.rooted_at(index);
        }
        self
    }

    /// `Σ k²` over the orbits of `k` vertices, of a tree or of a subtree, that can be roots in a class.
    fn squares_of_orbits(&self, class: HamiltonianClass, is_root: bool) -> BigInt {
        // In the Nyström class a vertex for q' has at most one child: as the root one neighbour, elsewhere two.
        let neighbours = self.children().len() + usize::from(!is_root);
        let can_be_root =
            class != HamiltonianClass::Nystrom || self.colour() == Colour::P || neighbours <= 1;
        let own = BigInt::from(u8::from(can_be_root));
        let groups = self.children().chunk_by(|left, right| left == right);
        groups.fold(own, |sum, group| {
            let one = group
                .first()
                .map(|child| child.squares_of_orbits(class, false));
            sum + one.unwrap_or_default() * (group.len() * group.len())
        })
    }
}

/// `Σ 1/σ(τ)²` over all trees `τ` with the same condition as `tree`: only that tree, or for a
/// representative all trees that differ in the place of the root and, for general `H`, in its colour.
///
/// An automorphism of the tree without a root keeps its centroid: to exchange two centroids it would have to reverse the edge between
/// them, which has a direction. With the root there, all `σ` automorphisms keep the root. With the root at another vertex, whose
/// orbit has `k` vertices, `σ/k` of them do. The sum is `Σ k²/σ²`, one term for each orbit of possible roots.
pub(super) fn weight(
    class: HamiltonianClass,
    tree: &BicolouredTree,
    representative: bool,
) -> BigRational {
    if !representative || tree.children().is_empty() {
        let symmetry = tree.symmetry();
        return BigRational::new(BigInt::one(), &symmetry * &symmetry);
    }
    let tree = tree.clone().rooted_at_centroid();
    let colours = match class {
        // A root of either colour.
        HamiltonianClass::General => 2,
        HamiltonianClass::Separable | HamiltonianClass::Nystrom => 1,
    };
    let symmetry = tree.symmetry();
    BigRational::new(
        tree.squares_of_orbits(class, true) * colours,
        &symmetry * &symmetry,
    )
}

#[cfg(test)]
mod tests {
    use super::*;

    fn counts(rule: TreeRule, order: usize) -> Vec<usize> {
        let trees = Trees::up_to(rule, order - 1);
        (2..=order)
            .map(|n| trees.representatives(n).count())
            .collect()
    }

    #[test]
    fn the_numbers_of_conditions_are_known() {
        // Oriented trees, OEIS A000238.
        let general = TreeRule::Class(HamiltonianClass::General);
        assert_eq!(counts(general, 9), [1, 3, 8, 27, 91, 350, 1376, 5743]);
        // Trees without a root, OEIS A000055, minus those with two equal halves, OEIS A000081.
        let free = [1, 1, 2, 3, 6, 11, 23, 47, 106];
        let equal_halves = [1, 0, 1, 0, 2, 0, 4, 0, 9];
        let expected = |each: fn(usize, usize) -> usize| -> Vec<usize> {
            free.iter()
                .zip(equal_halves)
                .map(|(f, e)| each(*f, e))
                .collect()
        };
        assert_eq!(counts(TreeRule::OneColour, 10), expected(|f, e| f - e));
        // Two colourings each, which coincide for two equal halves.
        let separable = TreeRule::Class(HamiltonianClass::Separable);
        assert_eq!(counts(separable, 10), expected(|f, e| 2 * f - e));
    }

    /// The place of the root divides the trees into classes with one representative each.
    #[test]
    #[ignore = "thorough"]
    fn each_class_has_one_representative() {
        for class in HamiltonianClass::ALL {
            let trees = Trees::up_to(TreeRule::Class(class), 7);
            let key = |tree: &BicolouredTree| -> BTreeSet<BicolouredTree> {
                let rerooted = tree.rerooted().into_iter();
                match class {
                    HamiltonianClass::General => rerooted
                        .map(|t| BicolouredTree::new(Colour::Q, t.children().to_vec()))
                        .collect(),
                    _ => rerooted.collect(),
                }
            };
            for order in 2..=8 {
                let all: BTreeSet<_> = trees
                    .products(order)
                    .map(|(rest, last)| key(&trees.product(rest, last)))
                    .collect();
                let chosen: Vec<_> = trees
                    .representatives(order)
                    .map(|(rest, last)| key(&trees.product(rest, last)))
                    .collect();
                let different: BTreeSet<_> = chosen.iter().cloned().collect();
                assert_eq!(chosen.len(), different.len(), "{class} {order}");
                assert_eq!(different, all, "{class} {order}");
            }
        }
    }

    #[test]
    fn weights_are_those_of_all_trees() {
        let square = |tree: &BicolouredTree| {
            let symmetry = tree.symmetry();
            BigRational::new(BigInt::one(), &symmetry * &symmetry)
        };
        for class in HamiltonianClass::ALL {
            let trees = Trees::up_to(TreeRule::Class(class), 8);
            for order in 2..=8 {
                let all: BigRational = trees.of_order(order).map(|tree| square(&tree)).sum();
                let mut sum = BigRational::default();
                for (rest, last) in trees.representatives(order) {
                    let tree = trees.product(rest, last);
                    let rerooted = tree.rerooted().into_iter().map(|tree| match class {
                        HamiltonianClass::General => {
                            BicolouredTree::new(Colour::Q, tree.children().to_vec())
                        }
                        _ => tree,
                    });
                    let different: BTreeSet<_> =
                        rerooted.filter(|tree| class.contains(tree)).collect();
                    let one_by_one: BigRational = different.iter().map(square).sum();
                    let colours = if class == HamiltonianClass::General {
                        2
                    } else {
                        1
                    };
                    let found = weight(class, &tree, true);
                    assert_eq!(
                        found,
                        one_by_one * BigRational::from_integer(colours.into()),
                        "{class}: {tree}"
                    );
                    sum += found;
                }
                assert_eq!(sum, all, "{class} {order}");
            }
        }
    }

    #[test]
    fn moving_the_root_keeps_the_direction_of_edges() {
        let tree: BicolouredTree = "q[p,q]".parse().expect("a tree");
        let rerooted: Vec<String> = tree.rerooted().iter().map(ToString::to_string).collect();
        assert_eq!(rerooted, ["q[q,p]", "q[p[p]]", "p[q,p]", "p[q[q]]"]);
    }
}
