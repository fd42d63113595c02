//! The modified equation, whose exact flow is the method.
//!
//! See [`ModifiedTerm`].

use std::borrow::Cow;
use std::collections::BTreeMap;

use num_bigint::BigInt;
use num_rational::BigRational;
use num_traits::One;

use super::class::HamiltonianClass;
use super::enumeration::{TreeRule, Trees};
use super::tree::{BicolouredTree, Colour};
use super::weights::MAX_ORDER;
use crate::algebra::{Number, StageAlgebra};
use crate::arithmetic::rounding::Decimal;
use crate::partitioned::{LowerTriangular, Partitioned};

/// One term `h^(|τ|−1)/σ(τ) β(τ) F(τ)` of the modified equation, whose exact flow is the method.
///
/// A step is a P-series, `y1 = y0 + Σ_τ h^|τ|/σ(τ) φ(τ) F(τ)`, and so is the modified equation,
///
/// ```text
/// y' = Σ_τ h^(|τ|−1)/σ(τ) β(τ) F(τ)
/// ```
///
/// with the trees of root `q` in `q'` and those of root `p` in `p'`. The derivative of a P-series with
/// coefficients `κ` along the modified equation has the coefficients
///
/// ```text
/// (∂κ)(τ) = Σ κ(τ∖v) β(v)
/// ```
///
/// summed over the edges of `τ`, each of which cuts off a branch `v`. Taylor's formula at `t = h` gives
/// (GNI IX.9 for trees of one colour, IX.10 for two)
///
/// ```text
/// φ(τ) = Σ_{j=1}^{|τ|} (∂^(j−1) β)(τ)/j!
/// ```
///
/// Here `β(τ)` occurs once; all other terms belong to smaller trees.
#[derive(Debug, Clone, PartialEq, Eq)]
pub struct ModifiedTerm {
    /// The tree `τ`.
    pub tree: BicolouredTree,
    /// The coefficient `β(τ)` in a readable exact form, if there is one.
    pub exact: Option<String>,
    /// The coefficient to 16 digits.
    pub decimal: Decimal,
}

/// The coefficients of the modified equation for the trees of a class up to an order. With gradient kicks there is none except for
/// quadratic `T`.
pub(crate) fn modified_equation<A: StageAlgebra>(
    pair: &Partitioned<A>,
    class: HamiltonianClass,
    order: usize,
) -> Vec<ModifiedTerm> {
    if pair.gradient.is_some() && class != HamiltonianClass::Nystrom {
        return Vec::new();
    }
    let algebra = &*pair.algebra;
    let trees = Trees::up_to(TreeRule::Class(class), order.min(MAX_ORDER));
    let mut series = Series {
        pair,
        lower_triangular: pair.lower_triangular(),
        ones: algebra.outer(
            &algebra.constant(&BigRational::one()),
            &algebra.constant(&BigRational::one()),
        ),
        stages: BTreeMap::new(),
        derivatives: BTreeMap::new(),
    };
    let term = |tree: BicolouredTree| {
        let vector = series.add(&tree);
        let decimal = |number: &Number<'_>| number.decimal(16);
        let exact = algebra.exact_values(&vector).into_iter().next().flatten();
        let numbers = algebra.values(Cow::Owned(vector));
        ModifiedTerm {
            tree,
            exact,
            decimal: numbers
                .first()
                .map_or_else(|| Decimal::round(&BigRational::default(), 1), decimal),
        }
    };
    (1..=trees.order())
        .flat_map(|order| trees.of_order(order))
        .map(term)
        .collect()
}

/// The coefficients so far. Numbers are vectors with the same value at every stage, which every algebra has.
struct Series<'a, A: StageAlgebra> {
    pair: &'a Partitioned<A>,
    lower_triangular: Option<LowerTriangular>,
    /// The matrix of ones, which sums a vector.
    ones: A::Matrix,
    /// `Φ_i` of the trees so far.
    stages: BTreeMap<BicolouredTree, A::Vector>,
    /// `β, ∂β, ∂²β, …, ∂^(|τ|−1) β` of the trees so far; all others are zero.
    derivatives: BTreeMap<BicolouredTree, Vec<A::Vector>>,
}

impl<A: StageAlgebra> Series<'_, A> {
    /// Computes the coefficients of a tree whose parts are known already, and returns `β`.
    fn add(&mut self, tree: &BicolouredTree) -> A::Vector {
        let algebra = &*self.pair.algebra;
        let zero = algebra.constant(&BigRational::default());
        let order = tree.order();
        let cuts = cuts(tree);
        let mut derivatives = vec![zero.clone()];
        for level in 1..order {
            let sum = cuts.iter().fold(zero.clone(), |sum, (rest, branch)| {
                let below = self.derivatives.get(rest).and_then(|d| d.get(level - 1));
                let along = self.derivatives.get(branch).and_then(|d| d.first());
                match (below, along) {
                    (Some(below), Some(along)) => {
                        algebra.add(&sum, &algebra.multiply(below, along))
                    }
                    _ => sum,
                }
            });
            derivatives.push(sum);
        }
        let mut factorial = BigInt::one();
        let mut value = self.weight(tree);
        for (level, derivative) in derivatives.iter().enumerate().skip(1) {
            factorial *= level + 1;
            let share = BigRational::new(BigInt::one(), factorial.clone());
            let term = algebra.multiply(derivative, &algebra.constant(&share));
            value = algebra.subtract(&value, &term);
        }
        derivatives[0] = value.clone();
        self.derivatives.insert(tree.clone(), derivatives);
        value
    }

    /// The elementary weight `φ`.
    fn weight(&mut self, tree: &BicolouredTree) -> A::Vector {
        let weighted = self.weighted(tree);
        self.pair.algebra.apply(&self.ones, &weighted)
    }

    /// `b_i Φ_i`, with what gradient kicks add: see [`Weights`](super::weights::Weights).
    fn weighted(&mut self, tree: &BicolouredTree) -> A::Vector {
        let stages = self.stages(tree);
        let pair = self.pair;
        let algebra = &*pair.algebra;
        let Some(gradient) = pair
            .gradient
            .as_ref()
            .filter(|_| tree.colour() == Colour::P)
        else {
            let weights = match tree.colour() {
                Colour::Q => &pair.b,
                Colour::P => &pair.b_tilde,
            };
            return algebra.multiply(weights, &stages);
        };
        let mut weighted = algebra.multiply(&pair.b_tilde, &stages);
        for (index, child) in tree.children().iter().enumerate() {
            let [force] = child.children() else {
                continue;
            };
            // The children of the force are at the same stage as the other children.
            let mut children = tree.children().to_vec();
            children.remove(index);
            children.extend_from_slice(force.children());
            let product = self.stages(&BicolouredTree::new(Colour::P, children));
            let added = algebra.multiply(gradient, &product);
            weighted = algebra.add(&algebra.add(&weighted, &added), &added);
        }
        weighted
    }

    fn stages(&mut self, tree: &BicolouredTree) -> A::Vector {
        if let Some(known) = self.stages.get(tree) {
            return known.clone();
        }
        let algebra = &*self.pair.algebra;
        let one = algebra.constant(&BigRational::one());
        let product = tree.children().iter().fold(one, |product, child| {
            let matrix = match child.colour() {
                Colour::Q => &self.pair.a,
                Colour::P => &self.pair.a_tilde,
            };
            // With gradient kicks the method is a splitting, whose matrices sum weighted terms.
            let sums = self.pair.gradient.as_ref().and_then(|_| {
                let own = match child.colour() {
                    Colour::Q => LowerTriangular::has_own_drift,
                    Colour::P => LowerTriangular::has_own_kick,
                };
                algebra.partial_sums(&self.weighted(child), own(self.lower_triangular?))
            });
            let applied = sums.unwrap_or_else(|| algebra.apply(matrix, &self.stages(child)));
            algebra.multiply(&product, &applied)
        });
        self.stages.insert(tree.clone(), product.clone());
        product
    }
}

/// For each edge, the tree without the branch above the edge, and the branch.
fn cuts(tree: &BicolouredTree) -> Vec<(BicolouredTree, BicolouredTree)> {
    let mut found = Vec::new();
    for (index, child) in tree.children().iter().enumerate() {
        let mut others = tree.children().to_vec();
        others.remove(index);
        for (rest, branch) in cuts(child) {
            let mut children = others.clone();
            children.push(rest);
            found.push((BicolouredTree::new(tree.colour(), children), branch));
        }
        found.push((BicolouredTree::new(tree.colour(), others), child.clone()));
    }
    found
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::arithmetic::rational::{parse, ratio};
    use num_traits::Zero;

    fn terms(basis: &str, nodes: &str, order: usize) -> Vec<(BicolouredTree, BigRational)> {
        let tableau = crate::derive(basis, nodes).expect("derived");
        let terms = tableau.modified_equation(HamiltonianClass::Separable, order);
        let value = |term: ModifiedTerm| {
            let exact = term.exact.expect("exact");
            (term.tree, parse(&exact).expect("rational"))
        };
        terms.into_iter().map(value).collect()
    }

    fn text(terms: &[(BicolouredTree, BigRational)]) -> Vec<String> {
        let text = |(tree, value): &(BicolouredTree, BigRational)| format!("{tree} {value}");
        terms.iter().map(text).collect()
    }

    /// From `H − h/2 H_p H_q + h²/12 (H_pp H_q² + H_qq H_p²)` for kick, then drift.
    #[test]
    fn symplectic_euler_has_the_known_coefficients() {
        let expected = [
            "q 1",
            "p 1",
            "q[p] 1/2",
            "p[q] -1/2",
            "q[p,p] 1/6",
            "q[p[q]] -1/6",
            "p[q,q] 1/6",
            "p[q[p]] -1/6",
        ];
        assert_eq!(text(&terms("polynomial(1)", "0", 3)), expected);
    }

    /// From `T + U + h²/12 U_qq T_p² − h²/24 T_pp U_q²` for kick, drift, kick.
    #[test]
    fn stormer_verlet_has_the_known_coefficients() {
        let expected = [
            "q 1",
            "p 1",
            "q[p] 0",
            "p[q] 0",
            "q[p,p] -1/12",
            "q[p[q]] -1/6",
            "p[q,q] 1/6",
            "p[q[p]] 1/12",
        ];
        assert_eq!(text(&terms("polynomial(2)", "lobatto(2)", 3)), expected);
    }

    /// Gauss with 3 stages has order 6.
    #[test]
    fn up_to_the_order_the_equation_is_its_own_modified_one() {
        for (tree, value) in terms("polynomial(3)", "gauss(3)", 6) {
            let expected = if tree.order() == 1 {
                ratio(1, 1)
            } else {
                ratio(0, 1)
            };
            assert_eq!(value, expected, "{tree}");
        }
    }

    /// `log [[1 − h², h], [−h, 1]] = g(h) [[−h²/2, h], [−h, h²/2]]`, `g = Σ (n!)²/(2n + 1)! h²ⁿ`: the step of
    /// the harmonic oscillator, for which only trees without branches matter.
    #[test]
    fn the_oscillator_has_its_logarithm() {
        let factorial = |n: usize| BigRational::from_integer((1..=n).map(BigInt::from).product());
        let g = |n: usize| &factorial(n) * &factorial(n) / factorial(2 * n + 1);
        for (tree, value) in terms("polynomial(1)", "0", 9) {
            let mut vertex = &tree;
            while let [child] = vertex.children() {
                vertex = child;
            }
            if !vertex.children().is_empty() {
                continue;
            }
            let (order, half) = (tree.order(), tree.order() / 2);
            let size = if order % 2 == 1 {
                g(half)
            } else {
                -g(half - 1) / ratio(2, 1)
            };
            let alternating = if half % 2 == 0 { size } else { -size };
            let expected = match tree.colour() {
                Colour::P if order % 2 == 0 => -alternating,
                _ => alternating,
            };
            assert_eq!(value, expected, "{tree}");
        }
    }

    /// A polynomial in `q` and `p`.
    #[derive(Debug, Clone, Default, PartialEq)]
    struct Bivariate(BTreeMap<(u32, u32), BigRational>);

    impl Bivariate {
        fn monomial(q: u32, p: u32, value: BigRational) -> Self {
            Bivariate(BTreeMap::from([((q, p), value)]))
        }

        fn plus(&self, other: &Self, factor: &BigRational) -> Self {
            let mut sum = self.0.clone();
            for (power, value) in &other.0 {
                *sum.entry(*power).or_insert_with(BigRational::zero) += value * factor;
            }
            sum.retain(|_, value| !value.is_zero());
            Bivariate(sum)
        }

        fn times(&self, other: &Self) -> Self {
            self.0
                .iter()
                .fold(Bivariate::default(), |sum, ((q, p), x)| {
                    let shifted = other
                        .0
                        .iter()
                        .map(|((r, s), y)| ((q + r, p + s), y.clone()));
                    sum.plus(&Bivariate(shifted.collect()), x)
                })
        }

        fn derivative(&self, by: Colour) -> Self {
            let mut sum = Bivariate::default();
            for (&(q, p), value) in &self.0 {
                let (power, rest) = match by {
                    Colour::Q => (q, (q.wrapping_sub(1), p)),
                    Colour::P => (p, (q, p.wrapping_sub(1))),
                };
                if power > 0 {
                    let term = Bivariate::monomial(rest.0, rest.1, value.clone());
                    sum = sum.plus(&term, &BigRational::from_integer(power.into()));
                }
            }
            sum
        }

        /// `[f, g] = −{f, g}`, so that the Lie derivatives `{·, f}` multiply like the functions.
        fn bracket(&self, other: &Self) -> Self {
            let first = self
                .derivative(Colour::P)
                .times(&other.derivative(Colour::Q));
            let second = self
                .derivative(Colour::Q)
                .times(&other.derivative(Colour::P));
            first.plus(&second, &ratio(-1, 1))
        }
    }

    /// The elementary differential for one degree of freedom.
    fn differential(tree: &BicolouredTree, t: &Bivariate, u: &Bivariate) -> Bivariate {
        let (function, by, sign) = match tree.colour() {
            Colour::Q => (t, Colour::P, 1),
            Colour::P => (u, Colour::Q, -1),
        };
        let mut derivative = function.derivative(by);
        for _ in tree.children() {
            derivative = derivative.derivative(by);
        }
        let signed = Bivariate::default().plus(&derivative, &ratio(sign, 1));
        let children = tree.children().iter();
        children.fold(signed, |product, child| {
            product.times(&differential(child, t, u))
        })
    }

    /// The modified Hamiltonians of the splittings by the Baker–Campbell–Hausdorff formula.
    #[test]
    fn modified_equations_are_those_of_the_modified_hamiltonians() {
        let polynomial = |coefficients: &[(u32, i64, i64)], colour: Colour| {
            coefficients
                .iter()
                .fold(Bivariate::default(), |sum, &(power, n, d)| {
                    let (q, p) = if colour == Colour::Q {
                        (power, 0)
                    } else {
                        (0, power)
                    };
                    sum.plus(&Bivariate::monomial(q, p, ratio(n, d)), &ratio(1, 1))
                })
        };
        let t = polynomial(
            &[(1, 2, 7), (2, 1, 2), (3, 1, 3), (4, 1, 5), (5, -1, 7)],
            Colour::P,
        );
        let u = polynomial(
            &[(1, 3, 5), (2, 1, 3), (3, 2, 3), (4, -1, 5), (5, 1, 3)],
            Colour::Q,
        );
        let ut = u.bracket(&t);
        let (uut, tut) = (u.bracket(&ut), t.bracket(&ut));
        let zero = Bivariate::default();
        let euler = [
            u.plus(&t, &ratio(1, 1)),
            zero.plus(&ut, &ratio(1, 2)),
            zero.plus(&uut, &ratio(1, 12)).plus(&tut, &ratio(-1, 12)),
            zero.plus(&t.bracket(&uut), &ratio(-1, 24)),
        ];
        // exp(U/2) exp(T) exp(U/2)
        let verlet = [
            euler[0].clone(),
            zero.clone(),
            zero.plus(&uut, &ratio(-1, 24)).plus(&tut, &ratio(-1, 12)),
            zero.clone(),
        ];
        for (basis, nodes, hamiltonian) in [
            ("polynomial(1)", "0", euler),
            ("polynomial(2)", "lobatto(2)", verlet),
        ] {
            let terms = terms(basis, nodes, 4);
            for (index, part) in hamiltonian.iter().enumerate() {
                for (colour, sign) in [(Colour::Q, 1), (Colour::P, -1)] {
                    let series = terms
                        .iter()
                        .filter(|(tree, _)| tree.order() == index + 1 && tree.colour() == colour)
                        .fold(zero.clone(), |sum, (tree, value)| {
                            let factor = value / BigRational::from_integer(tree.symmetry());
                            sum.plus(&differential(tree, &t, &u), &factor)
                        });
                    let expected = zero.plus(&part.derivative(colour.opposite()), &ratio(sign, 1));
                    assert_eq!(series, expected, "{nodes} h^{index} {colour:?}");
                }
            }
        }
    }
}
