//! All trees of a class, order by order.
//!
//! Every tree with more than one vertex consists, in exactly one way, of a smaller tree `rest` and an additional child
//! `last` at its root. In the enumeration `last` does not come before the other children. So orders grow from products of
//! smaller ones without repetition, a tree takes 16 bytes, and `Φ(rest)` times the stages of `last` is `Φ` of the tree.

use std::ops::Range;

use super::class::HamiltonianClass;
use super::tree::{BicolouredTree, Colour};

/// The rule that selects the enumerated trees.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum TreeRule {
    /// The trees of a class of Hamiltonians.
    Class(HamiltonianClass),
    /// The trees whose vertices are all coloured `q`: those of a single Runge–Kutta method, `ã = a` and
    /// `b̃ = b`, for which colours do not matter.
    OneColour,
}

impl TreeRule {
    fn colours(self) -> &'static [Colour] {
        match self {
            TreeRule::Class(_) => &[Colour::Q, Colour::P],
            TreeRule::OneColour => &[Colour::Q],
        }
    }

    /// Whether a root of colour `root` can have another child of colour `child`.
    fn allows(self, root: Colour, is_single: bool, child: Colour) -> bool {
        match self {
            TreeRule::Class(HamiltonianClass::General) | TreeRule::OneColour => true,
            TreeRule::Class(HamiltonianClass::Separable) => root != child,
            TreeRule::Class(HamiltonianClass::Nystrom) => {
                root != child && (root == Colour::P || is_single)
            }
        }
    }
}

/// A tree in an enumeration: a product of two earlier trees, or a single vertex.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub(super) struct Entry {
    pub(super) colour: Colour,
    /// The tree without its last child, and that child.
    pub(super) product: Option<(u32, u32)>,
}

/// All trees of a class up to some order.
///
/// ```
/// use symplectic_compiler::order::{HamiltonianClass, TreeRule, Trees};
///
/// let trees = Trees::up_to(TreeRule::Class(HamiltonianClass::Separable), 3);
/// let text: Vec<String> = trees.of_order(3).map(|tree| tree.to_string()).collect();
/// assert_eq!(text, ["q[p,p]", "q[p[q]]", "p[q,q]", "p[q[p]]"]);
/// ```
#[derive(Debug, Clone)]
pub struct Trees {
    rule: TreeRule,
    entries: Vec<Entry>,
    /// `starts[n]` is the index of the first tree of order `n + 1`.
    starts: Vec<usize>,
}

impl Trees {
    /// All trees up to this order.
    pub fn up_to(rule: TreeRule, order: usize) -> Self {
        let vertex = |&colour| Entry {
            colour,
            product: None,
        };
        let entries: Vec<Entry> = rule.colours().iter().map(vertex).collect();
        let mut trees = Trees {
            rule,
            starts: vec![0, entries.len()],
            entries,
        };
        trees.grow(order);
        trees
    }

    /// Adds the trees of higher orders up to this one.
    pub fn grow(&mut self, order: usize) {
        for next in self.order() + 1..=order {
            let products: Vec<Entry> = self
                .products(next)
                .map(|(rest, last)| Entry {
                    colour: self.colour(rest),
                    product: Some((rest, last)),
                })
                .collect();
            self.entries.extend(products);
            self.starts.push(self.entries.len());
        }
    }

    /// The rule of these trees.
    pub fn rule(&self) -> TreeRule {
        self.rule
    }

    /// The highest order.
    pub fn order(&self) -> usize {
        self.starts.len() - 1
    }

    /// The trees of one order; none beyond the highest.
    pub fn of_order(&self, order: usize) -> impl Iterator<Item = BicolouredTree> {
        self.indices(order).map(|index| self.tree(index))
    }

    /// The number of trees of an order. The order may be one higher than the highest; trees of that order are counted
    /// without being stored.
    pub fn count(&self, order: usize) -> usize {
        if order > self.order() {
            self.products(order).count()
        } else {
            self.indices(order).len()
        }
    }

    /// The number of trees of all orders.
    pub(super) fn len(&self) -> usize {
        self.entries.len()
    }

    /// The indices of the trees of one order.
    pub(super) fn indices(&self, order: usize) -> Range<u32> {
        match order.checked_sub(1).and_then(|n| self.starts.get(n..n + 2)) {
            // The enumeration ends long before 2³² trees.
            Some(&[start, end]) => start as u32..end as u32,
            _ => 0..0,
        }
    }

    /// The trees of an order at most one higher than the highest, as `(rest, last)`.
    pub(super) fn products(&self, order: usize) -> impl Iterator<Item = (u32, u32)> {
        self.products_with_last(order, order)
    }

    /// [`Trees::products`], restricted to trees whose children all have orders below `bound`.
    pub(super) fn products_with_last(
        &self,
        order: usize,
        bound: usize,
    ) -> impl Iterator<Item = (u32, u32)> {
        // Roots coloured q come first, and among them children of low order.
        let colours = self.rule.colours().iter();
        let sizes = colours.flat_map(move |&root| (1..order.min(bound)).map(move |n| (root, n)));
        sizes.flat_map(move |(root, size)| {
            self.indices(size).flat_map(move |last| {
                let rests = self.indices(order - size);
                rests
                    .filter(move |&rest| self.colour(rest) == root && self.is_product(rest, last))
                    .map(move |rest| (rest, last))
            })
        })
    }

    fn is_product(&self, rest: u32, last: u32) -> bool {
        let Entry { colour, product } = self.entry(rest);
        let allowed = self
            .rule
            .allows(colour, product.is_none(), self.colour(last));
        allowed && product.is_none_or(|(_, before)| before <= last)
    }

    /// The parts of a tree.
    pub(super) fn entry(&self, index: u32) -> Entry {
        self.entries[index as usize]
    }

    /// The order of a tree.
    pub(super) fn size(&self, index: u32) -> usize {
        self.starts
            .partition_point(|&start| start <= index as usize)
    }

    /// The colour of the root.
    pub(super) fn colour(&self, index: u32) -> Colour {
        self.entry(index).colour
    }

    /// A tree of the enumeration.
    pub(super) fn tree(&self, index: u32) -> BicolouredTree {
        let Entry { colour, product } = self.entry(index);
        match product {
            None => BicolouredTree::vertex(colour),
            Some((rest, last)) => self.product(rest, last),
        }
    }

    /// The product of two trees of the enumeration.
    pub(super) fn product(&self, rest: u32, last: u32) -> BicolouredTree {
        let colour = self.colour(rest);
        let mut children = vec![self.tree(last)];
        let mut rest = self.entry(rest).product;
        while let Some((before, child)) = rest {
            children.push(self.tree(child));
            rest = self.entry(before).product;
        }
        BicolouredTree::new(colour, children)
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use num_bigint::BigInt;
    use std::collections::HashSet;

    fn counts(rule: TreeRule, order: usize) -> Vec<usize> {
        let trees = Trees::up_to(rule, order - 1);
        (1..=order).map(|n| trees.count(n)).collect()
    }

    /// The number of multisets of trees with `size` vertices in total, for each size, from the number of
    /// trees of each order (the Euler transform). With `single`, only multisets of at most one tree.
    fn multisets(trees: &[u64], single: bool) -> Vec<u64> {
        let mut sets = vec![1u64];
        for size in 1..=trees.len() {
            if single {
                sets.push(trees[size - 1]);
                continue;
            }
            let divisors = |k: usize| -> u64 {
                (1..=k)
                    .filter(|d| k.is_multiple_of(*d))
                    .map(|d| d as u64 * trees[d - 1])
                    .sum()
            };
            let sum: u64 = (1..=size).map(|k| divisors(k) * sets[size - k]).sum();
            sets.push(sum / size as u64);
        }
        sets
    }

    /// The numbers of trees by recursion over generating functions instead of enumeration.
    fn recursion(rule: TreeRule, order: usize) -> Vec<usize> {
        let (mut q, mut p): (Vec<u64>, Vec<u64>) = (Vec::new(), Vec::new());
        for n in 0..order {
            let mix = |f: &dyn Fn(u64, u64) -> u64| -> Vec<u64> {
                q.iter().zip(&p).map(|(&q, &p)| f(q, p)).collect()
            };
            let (below_q, below_p, single) = match rule {
                TreeRule::OneColour => (q.clone(), vec![0; n], false),
                TreeRule::Class(HamiltonianClass::General) => {
                    (mix(&|q, p| q + p), mix(&|q, p| q + p), false)
                }
                TreeRule::Class(HamiltonianClass::Separable) => (p.clone(), q.clone(), false),
                TreeRule::Class(HamiltonianClass::Nystrom) => (p.clone(), q.clone(), true),
            };
            let next_q = multisets(&below_q, single)[n];
            let next_p = match rule {
                TreeRule::OneColour => 0,
                TreeRule::Class(_) => multisets(&below_p, false)[n],
            };
            q.push(next_q);
            p.push(next_p);
        }
        q.iter().zip(&p).map(|(q, p)| (q + p) as usize).collect()
    }

    /// The first numbers were found by several independent programs, and orders 9 and 10
    /// together with these. The trees of order 10 are counted without being stored.
    #[test]
    fn the_numbers_of_trees_are_known() {
        let general = TreeRule::Class(HamiltonianClass::General);
        let known = [2, 4, 14, 52, 214, 916, 4116, 18996, 89894, 433_196];
        assert_eq!(counts(general, 10), known);
        assert_eq!(recursion(general, 10), known);
        // Rooted trees with one colour (OEIS A000081); a tree has two alternating colourings.
        let rooted = [1, 1, 2, 4, 9, 20, 48, 115, 286, 719];
        assert_eq!(counts(TreeRule::OneColour, 10), rooted);
        assert_eq!(recursion(TreeRule::OneColour, 10), rooted);
        let separable = TreeRule::Class(HamiltonianClass::Separable);
        assert_eq!(counts(separable, 10), rooted.map(|n| 2 * n));
        assert_eq!(recursion(separable, 10), rooted.map(|n| 2 * n));
        let nystrom = TreeRule::Class(HamiltonianClass::Nystrom);
        assert_eq!(counts(nystrom, 12), recursion(nystrom, 12));
        // The trees with roots coloured p are the special Nyström trees of HNW II.14, those with roots coloured q one order
        // higher: 1, 1, 2, 3, 6, 10, 20, …
        assert_eq!(counts(nystrom, 6), [2, 2, 3, 5, 9, 16]);
    }

    /// Every tree occurs once and is in the class, and the monotonic labellings are complete.
    #[test]
    fn trees_are_different_and_complete() {
        for class in HamiltonianClass::ALL {
            let trees = Trees::up_to(TreeRule::Class(class), 6);
            for order in 1..=6 {
                let all: HashSet<BicolouredTree> = trees.of_order(order).collect();
                assert_eq!(all.len(), trees.count(order));
                assert!(all.iter().all(|t| t.order() == order && class.contains(t)));
                if class == HamiltonianClass::General {
                    // (n − 1)! labelled trees with 2ⁿ colourings.
                    let labelled: BigInt = (1..order).map(BigInt::from).product();
                    let sum: BigInt = all.iter().map(BicolouredTree::labellings).sum();
                    assert_eq!(sum, labelled << order);
                }
            }
        }
    }
}
