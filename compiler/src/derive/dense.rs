//! The constructions of [`super`] over a field: any basis, any nodes.

use std::sync::Arc;

use num_rational::BigRational;

use super::linear::{Singular, solve};
use crate::algebra::{Dense, Field, StageAlgebra, Zero};
use crate::error::ErrorKind;
use crate::partitioned::Partitioned;
use crate::symbolic::{Constant, Function};

/// The data of a basis `ψ_1, …, ψ_s` and nodes `c_1, …, c_r` for the constructions.
pub struct Samples<T> {
    /// `ψ_k(c_i)`, a row for each function.
    pub values: Vec<Vec<T>>,
    /// `∫_0^{c_i} ψ_k`, a row for each node.
    pub integrals: Vec<Vec<T>>,
    /// `∫_0^1 ψ_k`.
    pub totals: Vec<T>,
}

impl Samples<Constant> {
    /// The values and integrals of functions.
    ///
    /// # Errors
    /// If a value is beyond the bounds of constants.
    pub fn new(functions: &[Function], nodes: &[Constant]) -> Result<Self, ErrorKind> {
        let (zero, one) = (Constant::zero(), Constant::one());
        let integrals = functions.iter().map(Function::antiderivative);
        let integrals: Vec<Function> = integrals.collect::<Result<_, _>>()?;
        let at = |functions: &[Function], node: &Constant| -> Result<Vec<Constant>, _> {
            functions.iter().map(|f| f.evaluate(node)).collect()
        };
        let starts = at(&integrals, &zero)?;
        let up_to = |node: &Constant| -> Result<Vec<Constant>, _> {
            let ends = at(&integrals, node)?;
            let pairs = ends.iter().zip(&starts);
            pairs.map(|(end, start)| end.subtract(start)).collect()
        };
        let values = functions
            .iter()
            .map(|f| nodes.iter().map(|node| f.evaluate(node)).collect());
        Ok(Samples {
            values: values.collect::<Result<_, ErrorKind>>()?,
            integrals: nodes.iter().map(up_to).collect::<Result<_, _>>()?,
            totals: up_to(&one)?,
        })
    }

    /// All constants.
    pub fn constants(&self) -> impl Iterator<Item = &Constant> {
        let rows = self.values.iter().chain(&self.integrals);
        rows.flatten().chain(&self.totals)
    }

    /// The same data in a field, if all constants are elements.
    pub fn in_field<F: Field>(&self, field: &F) -> Option<Samples<F::Element>> {
        let row = |row: &Vec<Constant>| -> Option<Vec<F::Element>> {
            row.iter().map(|c| field.constant(c)).collect()
        };
        let rows = |rows: &[Vec<Constant>]| rows.iter().map(row).collect::<Option<Vec<_>>>();
        Some(Samples {
            values: rows(&self.values)?,
            integrals: rows(&self.integrals)?,
            totals: row(&self.totals)?,
        })
    }
}

/// The reason why a construction fails.
pub enum Failure<T> {
    /// The functions are dependent on the nodes.
    Singular(Singular<T>),
    /// A weight vanishes, or cannot be distinguished from zero.
    ZeroWeight(usize, Zero),
    /// Anything else.
    Kind(ErrorKind),
}

impl<T> From<(usize, Zero)> for Failure<T> {
    fn from((index, zero): (usize, Zero)) -> Self {
        Failure::ZeroWeight(index, zero)
    }
}

/// The square construction: `b = M⁻¹ B` and `A = A_ψ M⁻ᵀ` with `M = [ψ_i(c_j)]`.
///
/// # Errors
/// [`Failure`]
pub fn collocation<F: Field>(
    field: F,
    samples: &Samples<F::Element>,
) -> Result<Partitioned<Dense<F>>, Failure<F::Element>> {
    // The row of a at c_i solves Σ_j ψ_k(c_j) a_ij = ∫_0^{c_i} ψ_k, and so do the weights with c_i = 1.
    let mut right = samples.integrals.clone();
    right.push(samples.totals.clone());
    let mut rows = solve(&field, &samples.values, &right).map_err(Failure::Singular)?;
    let b = rows.pop().unwrap_or_default();
    // Where the integrals are those of the weights, the rows are identical: their difference
    // vanishes without any computation.
    for (row, integrals) in rows.iter_mut().zip(&samples.integrals) {
        if *integrals == samples.totals {
            row.clone_from(&b);
        }
    }
    let algebra = Arc::new(Dense::new(field, b.len()));
    Partitioned::symplectic(algebra, rows, b).map_err(Failure::from)
}

/// The rectangular construction with a quadrature formula `b_i, c_i`:
/// `a_ij = b_j Σ_kl (∫_0^{c_i} ψ_k) (G⁻¹)_kl ψ_l(c_j)` with `G = Ψ diag(b) Ψᵀ`.
///
/// # Errors
/// [`Failure`]
pub fn galerkin<F: Field>(
    field: F,
    samples: &Samples<F::Element>,
    b: Vec<F::Element>,
) -> Result<Partitioned<Dense<F>>, Failure<F::Element>> {
    let algebra = Arc::new(Dense::new(field, b.len()));
    let field = algebra.field();
    let dot = |x: &[F::Element], y: &[F::Element]| {
        let products = x.iter().zip(y).map(|(x, y)| field.multiply(x, y));
        let sum = products.reduce(|sum, product| field.add(&sum, &product));
        sum.unwrap_or_else(|| field.rational(&BigRational::default()))
    };
    let weighted: Vec<Vec<F::Element>> = samples
        .values
        .iter()
        .map(|values| algebra.multiply(values, &b))
        .collect();
    let gram: Vec<Vec<F::Element>> = weighted
        .iter()
        .map(|row| {
            samples
                .values
                .iter()
                .map(|values| dot(row, values))
                .collect()
        })
        .collect();
    let coordinates = solve(field, &gram, &samples.integrals).map_err(Failure::Singular)?;
    let columns = algebra_columns(&weighted, b.len());
    let row = |y: &Vec<F::Element>| columns.iter().map(|column| dot(y, column)).collect();
    let a = coordinates.iter().map(row).collect();
    Partitioned::symplectic(algebra, a, b).map_err(Failure::from)
}

/// The columns of rows of this length.
fn algebra_columns<T: Clone>(rows: &[Vec<T>], length: usize) -> Vec<Vec<T>> {
    let column = |j: usize| rows.iter().map(|row| row[j].clone()).collect();
    (0..length).map(column).collect()
}

/// The weights of the interpolatory rule at nodes: `Σ_j c_j^k b_j = 1/(k + 1)` for `k < r`.
///
/// # Errors
/// [`Failure::Singular`] if nodes coincide.
pub fn interpolatory_weights<F: Field>(
    field: &F,
    samples: &Samples<F::Element>,
) -> Result<Vec<F::Element>, Failure<F::Element>> {
    let right = [samples.totals.clone()];
    let solved = solve(field, &samples.values, &right).map_err(Failure::Singular)?;
    Ok(solved.into_iter().next().unwrap_or_default())
}
