//! Coefficients for second-order systems `q'' = M⁻¹ f(q)` with a constant M, whose velocity is `v(p) = M⁻¹p`. The momentum
//! stages are eliminated:
//!
//! ```text
//! Q_i = q0 + h c_i v(p0) + h Σ_k ν_ik v(w_k)      q1 = q0 + h v(p0) + h Σ_k (1 − c_k) v(w_k)
//! p1 = p0 + Σ_k w_k                               w_k = h b̃_k f(Q_k)
//! ```
//!
//! with `ν_ik = Σ_j a_ij μ̃_jk` (Nyström, 1925). Where `μ̃_ij + μ_ji = 1`,
//!
//! ```text
//! ν_ik = c_i − S_ik      S_ik = Σ_j a_ij a_kj/b_j
//! ```
//!
//! with a symmetric S, which is the condition of Suris (1989) for symplecticity. It holds exactly for rounded coefficients
//! too, if c and S are rounded to multiples of a power of two: the differences are exact.

use num_integer::Integer;
use num_rational::BigRational;

use super::symplectic_rounding::decide;
use crate::algebra::Number;
use crate::arithmetic::interval::Interval;
use crate::arithmetic::rational::{dyadic, ratio};
use crate::arithmetic::rounding::to_f64;
use crate::schedule::{Class, StepGraph};

/// Binary places of the rounded coefficients: every sum of two below 2 is exact.
const PLACES: u32 = 52;

/// The coefficients of a step of a second-order system.
#[derive(Debug)]
pub struct SecondOrder {
    /// `c_i`, of the positions of the forces.
    pub nodes: Vec<f64>,
    /// `ν_ik`
    pub matrix: Vec<Vec<f64>>,
}

impl SecondOrder {
    /// The coefficients of a symplectic method with the weights `Σ b_j = 1`. Returns `None` if the method is not symplectic,
    /// if a weight is zero, or if a coefficient is 2 or more.
    pub fn new(graph: &StepGraph<'_>) -> Option<Self> {
        if graph.class != Class::Separable {
            return None;
        }
        let rows: Option<Vec<_>> = graph.forces.iter().map(|force| force.position).collect();
        let rows: Vec<&[Number<'_>]> = rows?
            .into_iter()
            .map(|position| graph.positions[position].coefficients.as_slice())
            .collect();
        let weights: Vec<&Number<'_>> = graph.velocities.iter().map(|v| &v.weight).collect();
        let all = weights.iter().map(|weight| weight.enclose(0));
        if !sum(all)?.contains(&ratio(1, 1)) {
            return None;
        }
        let node = |i: usize| {
            let enclose = |bits| sum(rows[i].iter().map(|a| a.enclose(bits)));
            decide(enclose, on_grid)
        };
        let symmetric = |i: usize, k: usize| {
            let enclose = |bits| {
                let products = rows[i].iter().zip(rows[k]).zip(&weights);
                let products: Option<Vec<Interval>> = products
                    .map(|((a, other), weight)| {
                        let product = a.enclose(bits).multiply(&other.enclose(bits));
                        product.divide(&weight.enclose(bits))
                    })
                    .collect();
                sum(products?.into_iter())
            };
            decide(enclose, on_grid)
        };
        let count = rows.len();
        let nodes: Vec<f64> = (0..count).map(node).collect::<Option<_>>()?;
        let mut matrix = vec![vec![0.0; count]; count];
        for i in 0..count {
            for k in 0..=i {
                let value = symmetric(i, k)?;
                matrix[i][k] = nodes[i] - value;
                matrix[k][i] = nodes[k] - value;
            }
        }
        let mut all = nodes.iter().chain(matrix.iter().flatten());
        all.all(|value| value.abs() < 2.0)
            .then_some(SecondOrder { nodes, matrix })
    }
}

fn sum(mut intervals: impl Iterator<Item = Interval>) -> Option<Interval> {
    let first = intervals.next()?;
    Some(intervals.fold(first, |sum, interval| sum.add(&interval)))
}

/// The multiple of 2^-[`PLACES`] nearest to a number.
fn on_grid(value: &BigRational) -> f64 {
    // Round to nearest: the floor of the scaled number plus one half.
    let scaled = (value.numer() << (PLACES + 1)) + value.denom();
    let nearest = scaled.div_floor(&(value.denom() << 1));
    to_f64(&dyadic(&nearest, PLACES))
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::arithmetic::rounding::exact;
    use crate::{Limits, catalogue};

    /// ν_ik − ν_ki = c_i − c_k in exact arithmetic for every method of the catalogue with Nyström coefficients; the rounded
    /// coefficients are close to the exact ones.
    #[test]
    #[ignore = "thorough"]
    fn rounded_coefficients_are_symplectic_exactly() {
        let mut methods = 0;
        // At most the number of stages that the macros take.
        let usual = |entry: &catalogue::Entry| entry.stages <= Limits::default().stages;
        for entry in catalogue::entries().filter(usual) {
            let tableau = entry.derive().expect("derived");
            let numbers = tableau.numbers();
            let graph = StepGraph::new(Class::Separable, &tableau.exact, &numbers);
            let Some(rounded) = SecondOrder::new(&graph) else {
                continue;
            };
            methods += 1;
            let nodes: Vec<_> = rounded.nodes.iter().map(|&c| exact(c)).collect();
            for (i, row) in rounded.matrix.iter().enumerate() {
                for (k, &value) in row.iter().enumerate() {
                    let opposite = exact(rounded.matrix[k][i]);
                    assert_eq!(
                        exact(value) - opposite,
                        &nodes[i] - &nodes[k],
                        "{}",
                        entry.name
                    );
                }
            }
            for (node, force) in rounded.nodes.iter().zip(&graph.forces) {
                // Half a unit of the grid, plus half a unit in the last place of the other number.
                assert!((node - force.time.to_f64()).abs() <= 2.0 * f64::EPSILON);
            }
        }
        assert!(methods > 50, "{methods}");
    }

    /// Gauss with two stages: ν = μ̃-weighted products of a = [[1/4, 1/4 − √3/6], [1/4 + √3/6, 1/4]].
    #[test]
    fn the_second_order_matrix_of_gauss_2_is_its_closed_form() {
        let tableau = crate::derive("polynomial(2)", "gauss(2)").expect("derived");
        let numbers = tableau.numbers();
        let graph = StepGraph::new(Class::Separable, &tableau.exact, &numbers);
        let rounded = SecondOrder::new(&graph).expect("symplectic");
        let r = 3.0_f64.sqrt() / 6.0;
        let a = [[0.25, 0.25 - r], [0.25 + r, 0.25]];
        for i in 0..2 {
            for k in 0..2 {
                let product: f64 = (0..2).map(|j| a[i][j] * a[j][k] * 2.0).sum();
                assert!((rounded.matrix[i][k] - product).abs() < 4.0 * f64::EPSILON);
            }
        }
    }
}
