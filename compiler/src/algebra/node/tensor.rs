//! Quantities with two indices: elements of `K ⊗ K`.

use num_rational::BigRational;
use num_traits::One;

use super::NodeAlgebra;
use crate::arithmetic::interval::Interval;
use crate::arithmetic::polynomial::Polynomial;

/// An element `Σ_k f_k(x) yᵏ` of `K ⊗ K`: the matrix with entries `T(c_i, c_j)`.
#[derive(Debug, Clone, PartialEq, Eq)]
pub struct Tensor {
    /// The coefficient of each power of `y`, one for each dimension of `K`.
    columns: Vec<Polynomial>,
}

impl Tensor {
    /// The element with these coefficients of `1, y, y², …`, as many as the dimension of `K`.
    pub fn from_columns(columns: Vec<Polynomial>) -> Self {
        Tensor { columns }
    }

    /// The sum of products `Σ f(x) g(y)`.
    pub fn from_products(algebra: &NodeAlgebra, products: &[(Polynomial, Polynomial)]) -> Self {
        let columns = (0..algebra.dimension())
            .map(|k| {
                products.iter().fold(Polynomial::zero(), |sum, (f, g)| {
                    &sum + &f.scale(&g.coefficient(k))
                })
            })
            .collect();
        Tensor { columns }
    }

    /// The coefficients of `1, y, y², …`, polynomials in `x`.
    pub fn columns(&self) -> &[Polynomial] {
        &self.columns
    }

    /// Whether all entries are zero.
    pub fn is_zero(&self) -> bool {
        self.columns.iter().all(Polynomial::is_zero)
    }

    /// The sum.
    #[must_use]
    pub fn add(&self, other: &Tensor) -> Tensor {
        Tensor {
            columns: self
                .columns
                .iter()
                .zip(&other.columns)
                .map(|(a, b)| a + b)
                .collect(),
        }
    }

    /// The difference.
    #[must_use]
    pub fn subtract(&self, other: &Tensor) -> Tensor {
        Tensor {
            columns: self
                .columns
                .iter()
                .zip(&other.columns)
                .map(|(a, b)| a - b)
                .collect(),
        }
    }

    /// The transposed matrix, `T(y, x)`.
    #[must_use]
    pub fn transpose(&self) -> Tensor {
        let rows: Vec<Vec<BigRational>> =
            self.columns.iter().map(Polynomial::coefficients).collect();
        let columns = (0..self.columns.len())
            .map(|k| {
                let row: Vec<BigRational> = rows
                    .iter()
                    .map(|r| r.get(k).cloned().unwrap_or_default())
                    .collect();
                Polynomial::from_rationals(&row)
            })
            .collect();
        Tensor { columns }
    }

    /// The matrix with row `i` multiplied by `f(c_i)`.
    #[must_use]
    pub fn scale_rows(&self, algebra: &NodeAlgebra, factor: &Polynomial) -> Tensor {
        Tensor {
            columns: self
                .columns
                .iter()
                .map(|c| algebra.multiply(c, factor))
                .collect(),
        }
    }

    /// The sums along the rows `Σ_j T(x, c_j) f(c_j)`, by the trace in `y`.
    pub fn apply(&self, algebra: &NodeAlgebra, factor: &Polynomial) -> Polynomial {
        self.columns
            .iter()
            .enumerate()
            .fold(Polynomial::zero(), |sum, (k, column)| {
                let weight = algebra.trace(&(&Polynomial::monomial(k) * factor));
                &sum + &column.scale(&weight)
            })
    }

    /// The values on a graph `y = g(x)`: the entries `T(c_i, g(c_i))`.
    pub fn on_graph(&self, algebra: &NodeAlgebra, graph: &Polynomial) -> Polynomial {
        self.columns
            .iter()
            .rev()
            .fold(Polynomial::zero(), |value, column| {
                &algebra.multiply(&value, graph) + column
            })
    }

    /// The matrix with both indices mapped: `T(g(x), g(y))`.
    #[must_use]
    pub fn substitute(&self, algebra: &NodeAlgebra, map: &Polynomial) -> Tensor {
        let mut powers = vec![Polynomial::one()];
        while powers.len() < algebra.dimension() {
            let next = powers
                .last()
                .map_or_else(Polynomial::one, |p| algebra.multiply(p, map));
            powers.push(next);
        }
        let compose = |f: &Polynomial| {
            f.coefficients()
                .iter()
                .zip(&powers)
                .fold(Polynomial::zero(), |sum, (c, p)| &sum + &p.scale(c))
        };
        let rows = Tensor {
            columns: self.columns.iter().map(compose).collect(),
        };
        Tensor {
            columns: rows.transpose().columns.iter().map(compose).collect(),
        }
        .transpose()
    }

    /// The row at a rational node, a polynomial in `y`.
    pub fn row_at(&self, node: &BigRational) -> Polynomial {
        let values: Vec<BigRational> = self.columns.iter().map(|c| c.evaluate(node)).collect();
        Polynomial::from_rationals(&values)
    }

    /// The column at a rational node, a polynomial in `x`.
    pub fn column_at(&self, node: &BigRational) -> Polynomial {
        let node = Polynomial::constant(node.clone());
        self.columns
            .iter()
            .rev()
            .fold(Polynomial::zero(), |value, column| {
                &(&value * &node) + column
            })
    }

    /// Enclosures of the entries in one row, from enclosures of all nodes.
    pub(crate) fn enclose_row(&self, nodes: &[Interval], row: usize) -> Vec<Interval> {
        // The powers of the node are computed once for all columns, whose coefficients are short.
        let node = &nodes[row];
        let length = self.columns.iter().map(|c| c.numerators().len()).max();
        let mut powers = vec![Interval::enclosing(&BigRational::one(), node.bits())];
        for k in 1..length.unwrap_or(0) {
            powers.push(powers[k - 1].multiply(node));
        }
        let coefficients: Vec<Interval> = self
            .columns
            .iter()
            .map(|c| Interval::combination(&powers, c))
            .collect();
        nodes
            .iter()
            .map(|y| {
                let mut terms = coefficients.iter().rev().cloned();
                let top = terms
                    .next()
                    .unwrap_or_else(|| Interval::enclosing(&BigRational::default(), y.bits()));
                terms.fold(top, |value, c| value.multiply(y).add(&c))
            })
            .collect()
    }

    /// The number of bits of the largest coefficient, a measure of cancellation in the entries.
    pub(crate) fn bits(&self) -> u32 {
        self.columns.iter().map(magnitude_bits).max().unwrap_or(0)
    }
}

/// The number of bits of the largest coefficient of a polynomial.
pub(crate) fn magnitude_bits(polynomial: &Polynomial) -> u32 {
    let largest = polynomial
        .numerators()
        .iter()
        .map(num_bigint::BigInt::bits)
        .max()
        .unwrap_or(0);
    largest.saturating_sub(polynomial.denominator().bits()) as u32
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::arithmetic::rational::ratio;
    use proptest::prelude::*;

    fn tensor() -> impl Strategy<Value = Tensor> {
        prop::collection::vec(-9i64..9, 9).prop_map(|c| {
            Tensor::from_columns(c.chunks(3).map(Polynomial::from_integers).collect())
        })
    }

    /// Nodes 0, 1/2, 1, where everything can be checked by evaluation.
    fn algebra() -> NodeAlgebra {
        NodeAlgebra::new(&Polynomial::from_integers(&[0, 1, -3, 2])).expect("nodes")
    }

    fn entry(t: &Tensor, x: &BigRational, y: &BigRational) -> BigRational {
        t.row_at(x).evaluate(y)
    }

    proptest! {
        #[test]
        fn operations_act_on_the_entries(t in tensor(), u in tensor(), f in prop::collection::vec(-9i64..9, 3)) {
            let k = algebra();
            let f = Polynomial::from_integers(&f);
            let nodes = [ratio(0, 1), ratio(1, 2), ratio(1, 1)];
            let reflection = Polynomial::from_integers(&[1, -1]);
            for x in &nodes {
                for y in &nodes {
                    let (a, b) = (entry(&t, x, y), entry(&u, x, y));
                    prop_assert_eq!(t.column_at(y).evaluate(x), a.clone());
                    prop_assert_eq!(entry(&t.transpose(), y, x), a.clone());
                    prop_assert_eq!(entry(&t.add(&u), x, y), &a + &b);
                    prop_assert_eq!(entry(&t.subtract(&u), x, y), &a - &b);
                    prop_assert_eq!(entry(&t.scale_rows(&k, &f), x, y), &a * f.evaluate(x));
                    let mirrored = t.substitute(&k, &reflection);
                    prop_assert_eq!(entry(&mirrored, x, y), entry(&t, &reflection.evaluate(x), &reflection.evaluate(y)));
                }
                let sum: BigRational = nodes.iter().map(|y| entry(&t, x, y) * f.evaluate(y)).sum();
                prop_assert_eq!(t.apply(&k, &f).evaluate(x), sum);
                prop_assert_eq!(t.on_graph(&k, &reflection).evaluate(x), entry(&t, x, &reflection.evaluate(x)));
            }
        }
    }
}
