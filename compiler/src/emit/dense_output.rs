//! Values inside a step, from its stages.

use std::cell::OnceCell;

use num_rational::BigRational;

use crate::algebra::Number;
use crate::arithmetic::interval::Interval;
use crate::arithmetic::rational::ratio;
use crate::arithmetic::rounding::to_f64;
use crate::coefficients::Coefficients;
use crate::schedule::{Class, Evaluation, Node, StepGraph};

use super::symplectic_rounding::decide;

/// The polynomials through the evaluations of a tableau at its nodes, computed on demand.
pub(super) struct StagePolynomials<'n, 'a> {
    numbers: &'n Coefficients<Number<'a>>,
    nodes: OnceCell<Option<Nodes<'n, 'a>>>,
}

/// The polynomial through the evaluations of a step, which gives values inside the step.
#[derive(Debug, PartialEq)]
pub(super) struct Extension {
    /// For k = 1, …, s − 1 an entry for each evaluation: its contribution to the Legendre coefficient of degree k.
    pub rows: Vec<Vec<f64>>,
    /// The largest m for which values inside a step of size h have errors of `O(hᵐ)`, apart from the error at its start.
    pub order: usize,
}

impl<'n, 'a> StagePolynomials<'n, 'a> {
    pub(super) const fn new(numbers: &'n Coefficients<Number<'a>>) -> Self {
        StagePolynomials {
            numbers,
            nodes: OnceCell::new(),
        }
    }

    /// The extension of the velocities or of the forces of a step. The index of `kind` does not matter.
    ///
    /// Let `ℓ_j` be the Lagrange polynomials of the nodes and `L_k` the Legendre polynomials on [0, 1]. Then `ℓ_j = Σ_k γ_jk L_k`; an
    /// entry is `γ_jk`, or `γ_jk/b_j` where evaluations are increments. Returns `None` if nodes coincide or if the weights are not the
    /// integrals of the `ℓ_j`. A polynomial through all evaluations would then not lead to the end of the step.
    pub(super) fn extension(
        &self,
        graph: &StepGraph<'_>,
        kind: Node,
        increments: bool,
    ) -> Option<Extension> {
        let nodes = self.nodes.get_or_init(|| Nodes::new(self.numbers));
        let nodes = nodes.as_ref()?;
        let evaluations = match kind {
            Node::Force(_) => &graph.forces,
            _ => &graph.velocities,
        };
        let groups: Vec<_> = evaluations.iter().map(|e| graph.stages_of(e)).collect();
        let count = nodes.times.len();
        if groups.iter().map(Vec::len).sum::<usize>() != count {
            return None;
        }
        let entry = |k: usize, (group, evaluation): (&Vec<usize>, &Evaluation<'_>)| {
            let enclose = |bits| {
                let sum = nodes.enclosed(bits, |nodes| nodes.legendre(group, k))?;
                match increments {
                    true => sum.divide(&evaluation.weight.enclose(bits)),
                    false => Some(sum),
                }
            };
            decide(enclose, to_f64).filter(|value| value.is_finite())
        };
        let row = |k| {
            let pairs = groups.iter().zip(evaluations);
            pairs.map(|pair| entry(k, pair)).collect()
        };
        let rows: Option<Vec<Vec<f64>>> = (1..count).map(row).collect();
        let stage_order = match (graph.class, kind) {
            (Class::General, _) => nodes.stage_orders[0].min(nodes.stage_orders[1]),
            (Class::Separable, Node::Force(_)) => nodes.stage_orders[0],
            (Class::Separable, _) => nodes.stage_orders[1],
        };
        Some(Extension {
            rows: rows?,
            order: count.min(stage_order + 1) + 1,
        })
    }
}

/// The nodes of a tableau.
struct Nodes<'n, 'a> {
    times: &'n [Number<'a>],
    first: Enclosed,
    /// Narrower enclosures, for values that `first` does not separate from zero.
    second: OnceCell<Enclosed>,
    /// The largest η with `Σ_j a_ij c_j^(k−1) = c_i^k/k` for all k ≤ η, for a and for ã.
    stage_orders: [usize; 2],
}

impl<'n, 'a> Nodes<'n, 'a> {
    /// The nodes c, or otherwise c̃, if they are distinct and both b and b̃ are interpolatory.
    fn new(numbers: &'n Coefficients<Number<'a>>) -> Option<Self> {
        let nodes = |times: &'n [Number<'a>]| {
            let first = Enclosed::new(times, 0);
            let interpolating = [&numbers.b, &numbers.b_tilde]
                .iter()
                .all(|weights| first.integrates(weights));
            (first.legendre.is_some() && interpolating).then(|| Nodes {
                times,
                stage_orders: [&numbers.a, &numbers.a_tilde].map(|a| first.stage_order(a)),
                first,
                second: OnceCell::new(),
            })
        };
        nodes(&numbers.c).or_else(|| nodes(&numbers.c_tilde))
    }

    /// Evaluates `of` on enclosures with at least `bits` binary places.
    fn enclosed<T>(&self, bits: u32, of: impl Fn(&Enclosed) -> T) -> T {
        if bits <= self.first.bits {
            return of(&self.first);
        }
        let second = self.second.get_or_init(|| Enclosed::new(self.times, bits));
        if bits <= second.bits {
            return of(second);
        }
        of(&Enclosed::new(self.times, bits))
    }
}

/// Enclosures of the quantities that define the Lagrange polynomials.
struct Enclosed {
    bits: u32,
    /// The powers `c_j^m`, m ≤ s, for each m.
    powers: Vec<Vec<Interval>>,
    /// The Legendre coefficients of each Lagrange polynomial `ℓ_j`, from degree 0 on; `None` if the enclosures do not separate the nodes.
    legendre: Option<Vec<Vec<Interval>>>,
}

impl Enclosed {
    fn new(times: &[Number<'_>], bits: u32) -> Self {
        let times: Vec<Interval> = times.iter().map(|time| time.enclose(bits)).collect();
        let bits = times.first().map_or(bits, Interval::bits);
        let one = Interval::enclosing(&ratio(1, 1), bits);
        let mut powers = vec![vec![one.clone(); times.len()]];
        for m in 0..times.len() {
            let next = powers[m].iter().zip(&times).map(|(c, t)| c.multiply(t));
            powers.push(next.collect());
        }
        let others = |j: usize| {
            let others = times.iter().enumerate().filter(move |&(i, _)| i != j);
            others.map(|(_, time)| time)
        };
        let product = |j: usize| {
            others(j).fold(vec![one.clone()], |product, time| {
                let zero = Interval::enclosing(&ratio(0, 1), bits);
                let shifted = std::iter::once(&zero).chain(&product);
                let lower = product.iter().map(Some).chain([None]);
                let terms = shifted.zip(lower).map(|(shifted, own)| match own {
                    Some(own) => shifted.subtract(&own.multiply(time)),
                    None => shifted.clone(),
                });
                terms.collect()
            })
        };
        let divisor = |j: usize| {
            others(j).fold(one.clone(), |product, time| {
                product.multiply(&times[j].subtract(time))
            })
        };
        let moments: Vec<_> = (0..times.len()).map(|k| moments(k, times.len())).collect();
        let legendre = |j: usize| {
            // ℓ_j = Π_{i≠j} (x − c_i)/(c_j − c_i)
            let (product, divisor) = (product(j), divisor(j));
            let coefficient = |(k, moments): (usize, &Vec<BigRational>)| {
                let zero = Interval::enclosing(&ratio(0, 1), bits);
                let terms = product[k..].iter().zip(moments);
                let sum = terms.fold(zero, |sum, (c, moment)| sum.add(&c.scale(moment)));
                sum.divide(&divisor)
            };
            moments.iter().enumerate().map(coefficient).collect()
        };
        Enclosed {
            legendre: (0..times.len()).map(legendre).collect(),
            powers,
            bits,
        }
    }

    /// Whether the enclosures admit `Σ_j w_j c_j^m = 1/(m + 1)` for all m < s.
    fn integrates(&self, weights: &[Number<'_>]) -> bool {
        let weights: Vec<_> = weights.iter().map(|w| w.enclose(self.bits)).collect();
        let exact = |m: usize| self.sum(&weights, m).contains(&ratio(1, m as i64 + 1));
        (0..weights.len()).all(exact)
    }

    /// The largest η ≤ s for which the enclosures admit `Σ_j a_ij c_j^(k−1) = c_i^k/k` for k ≤ η.
    fn stage_order(&self, matrix: &[Vec<Number<'_>>]) -> usize {
        let enclose = |row: &Vec<Number<'_>>| row.iter().map(|a| a.enclose(self.bits)).collect();
        let rows: Vec<Vec<Interval>> = matrix.iter().map(enclose).collect();
        let holds = |k: usize| {
            rows.iter().zip(&self.powers[k]).all(|(row, power)| {
                let rest = self.sum(row, k - 1);
                let rest = rest.subtract(&power.scale(&ratio(1, k as i64)));
                rest.contains(&ratio(0, 1))
            })
        };
        (1..=rows.len()).take_while(|&k| holds(k)).count()
    }

    /// `Σ_j factor_j c_j^m`
    fn sum(&self, factors: &[Interval], m: usize) -> Interval {
        let zero = Interval::enclosing(&ratio(0, 1), self.bits);
        let products = factors.iter().zip(&self.powers[m]);
        products.fold(zero, |sum, (factor, power)| {
            sum.add(&factor.multiply(power))
        })
    }

    /// The Legendre coefficient of degree k of the sum of the Lagrange polynomials of some stages.
    fn legendre(&self, stages: &[usize], k: usize) -> Option<Interval> {
        let legendre = self.legendre.as_ref()?;
        let zero = Interval::enclosing(&ratio(0, 1), self.bits);
        Some(stages.iter().fold(zero, |sum, &j| sum.add(&legendre[j][k])))
    }
}

/// `(2k + 1) ∫_0^1 x^m L_k = (2k + 1) m!²/((m − k)! (m + k + 1)!)` for m = k, …, s − 1; for a smaller m it is zero.
fn moments(k: usize, stages: usize) -> Vec<BigRational> {
    let (mut moment, k) = (ratio(1, 1), k as i64);
    for i in 1..=k {
        moment *= ratio(i, k + i);
    }
    let mut moments = Vec::new();
    for m in k..stages as i64 {
        moments.push(moment.clone());
        moment *= ratio((m + 1) * (m + 1), (m + 1 - k) * (m + k + 2));
    }
    moments
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::definition::Definition;
    use crate::limits::Limits;

    /// The extensions of velocities and forces, for systems of a class.
    fn extensions(definition: &str, class: Class, increments: bool) -> [Option<Extension>; 2] {
        let definition = Definition::parse(definition).expect("a definition");
        let tableau = definition.derive(&Limits::default()).expect("derived");
        let numbers = tableau.numbers();
        let graph = StepGraph::new(class, &tableau.exact, &numbers);
        let polynomials = StagePolynomials::new(&numbers);
        [Node::Velocity(0), Node::Force(0)]
            .map(|kind| polynomials.extension(&graph, kind, increments))
    }

    /// With Gauss nodes `γ_jk/b_j = (2k + 1) L_k(c_j)`.
    #[test]
    fn gauss_nodes_have_legendre_polynomials() {
        let [velocities, forces] = extensions(
            "basis: polynomial(3), nodes: gauss(3)",
            Class::General,
            true,
        );
        let velocities = velocities.expect("a polynomial");
        let root = 0.6_f64.sqrt();
        assert_eq!(
            velocities.rows,
            [[-3.0 * root, 0.0, 3.0 * root], [2.0, -2.5, 2.0]]
        );
        assert_eq!(velocities.order, 4);
        assert_eq!(Some(velocities), forces);
        let [evaluations, _] = extensions(
            "basis: polynomial(3), nodes: gauss(3)",
            Class::General,
            false,
        );
        let rows = evaluations.expect("a polynomial").rows;
        assert_eq!(
            rows[1],
            [2.0 * (5.0 / 18.0), -2.5 * (4.0 / 9.0), 2.0 * (5.0 / 18.0)]
        );
    }

    #[test]
    fn orders_follow_from_those_of_the_stages() {
        let orders = |definition: &str, class| {
            extensions(definition, class, false).map(|half| half.map(|half| half.order))
        };
        let lobatto = "basis: polynomial(4), nodes: lobatto(4)";
        assert_eq!(orders(lobatto, Class::Separable), [Some(4), Some(5)]);
        assert_eq!(orders(lobatto, Class::General), [Some(4), Some(4)]);
        let exchanged = "basis: polynomial(4), nodes: lobatto(4), exchange: true";
        assert_eq!(orders(exchanged, Class::Separable), [Some(5), Some(4)]);
        let midpoint = "basis: polynomial(1), nodes: gauss(1)";
        assert_eq!(orders(midpoint, Class::General), [Some(2), Some(2)]);
    }

    /// Weights that are not interpolatory, even by a small perturbation, and nodes that coincide.
    #[test]
    fn methods_with_weights_that_do_not_interpolate_have_no_dense_output() {
        for definition in [
            "basis: [1, cos(pi*t), sin(pi*t)], nodes: [0, 1/2, 1]",
            "a: [[1/4, 1/4 - sqrt(3)/6], [1/4 + sqrt(3)/6, 1/4]], b: [1/2 + 1e-40, 1/2 - 1e-40]",
            "a: [[1/2, 0], [1/2, 0]], b: [1/2, 1/2]",
        ] {
            let extensions = extensions(definition, Class::General, false);
            assert_eq!(extensions, [None, None], "{definition}");
        }
        let gauss = "a: [[1/4, 1/4 - sqrt(3)/6], [1/4 + sqrt(3)/6, 1/4]], b: [1/2, 1/2]";
        assert!(extensions(gauss, Class::General, false)[0].is_some());
    }
}
