//! The constructions of [`super`] in the node algebra: polynomial bases, all roots of one polynomial.

use std::sync::Arc;

use num_rational::BigRational;

use crate::algebra::{NodeAlgebra, Tensor};
use crate::arithmetic::matrix;
use crate::arithmetic::polynomial::Polynomial;
use crate::partitioned::Partitioned;
use crate::quadrature::QuadratureRule;

/// The reason why a construction fails.
pub enum Failure {
    /// Coefficients of a combination of the functions that vanishes at all nodes.
    Singular(Vec<BigRational>),
    /// A weight vanishes.
    ZeroWeight(usize),
}

/// The square construction.
///
/// With `M = [ψ_i(c_j)]` and `B_i = ∫_0^1 ψ_i`, it is `b = M⁻¹ B`, `A = A_ψ M⁻ᵀ` where
/// `(A_ψ)_ij = ∫_0^{c_i} ψ_j`, and `ã_ij = (b_i b_j − b_j a_ji)/b_i`. `M⁻ᵀ` is the dual basis of `ψ`.
///
/// # Errors
/// [`Failure`]
pub fn collocation(
    basis: &[Polynomial],
    algebra: &Arc<NodeAlgebra>,
) -> Result<Partitioned<NodeAlgebra>, Failure> {
    let dual = dual_basis(basis, algebra).map_err(Failure::Singular)?;
    let integrals: Vec<Polynomial> = basis.iter().map(Polynomial::antiderivative).collect();
    let one = BigRational::from_integer(1.into());
    let b = integrals
        .iter()
        .zip(&dual)
        .fold(Polynomial::zero(), |sum, (integral, dual)| {
            &sum + &dual.scale(&integral.evaluate(&one))
        });
    let products: Vec<_> = integrals
        .iter()
        .map(|integral| algebra.reduce(integral))
        .zip(dual)
        .collect();
    let a = Tensor::from_products(algebra, &products);
    Partitioned::symplectic(Arc::clone(algebra), a, b)
        .map_err(|(index, _)| Failure::ZeroWeight(index))
}

/// Elements `d_i` of `K` with `Σ_i ψ_i(x) d_i(y) = δ(x, y)`: the columns of `M⁻¹`.
fn dual_basis(
    basis: &[Polynomial],
    algebra: &NodeAlgebra,
) -> Result<Vec<Polynomial>, Vec<BigRational>> {
    let size = algebra.dimension();
    // ψ_i = Σ_k P_ik xᵏ modulo the node polynomial; M is regular iff P is.
    let rows: Vec<Vec<BigRational>> = basis
        .iter()
        .map(|function| {
            let reduced = algebra.reduce(function);
            (0..size).map(|k| reduced.coefficient(k)).collect()
        })
        .collect();
    let inverse = matrix::inverse(&rows)?;
    let powers = algebra.dual_basis();
    let dual = |i: usize| {
        powers
            .iter()
            .zip(&inverse)
            .fold(Polynomial::zero(), |sum, (power, row)| {
                &sum + &power.scale(&row[i])
            })
    };
    Ok((0..size).map(dual).collect())
}

/// The rectangular construction with the weights of the rule:
/// `a(x, y) = b(y) Σ_kl (∫_0^x ψ_k) (G⁻¹)_kl ψ_l(y)` with `G_kl = Tr(b ψ_k ψ_l)` (T §2.2).
///
/// # Errors
/// [`Failure`]
pub fn galerkin(
    basis: &[Polynomial],
    rule: &QuadratureRule,
) -> Result<Partitioned<NodeAlgebra>, Failure> {
    let algebra = rule.algebra();
    let b = rule.weights();
    let functions: Vec<Polynomial> = basis.iter().map(|f| algebra.reduce(f)).collect();
    let gram: Vec<Vec<BigRational>> = functions
        .iter()
        .map(|f| {
            let weighted = algebra.multiply(b, f);
            let product = |g| algebra.trace(&algebra.multiply(&weighted, g));
            functions.iter().map(product).collect()
        })
        .collect();
    let inverse = matrix::inverse(&gram).map_err(Failure::Singular)?;
    let integrals = basis.iter().map(Polynomial::antiderivative);
    let products: Vec<_> = integrals
        .zip(&inverse)
        .map(|(integral, row)| {
            let pairs = row.iter().zip(&functions);
            let sum = pairs.fold(Polynomial::zero(), |sum, (c, f)| &sum + &f.scale(c));
            (algebra.reduce(&integral), algebra.multiply(b, &sum))
        })
        .collect();
    let a = Tensor::from_products(algebra, &products);
    Partitioned::symplectic(Arc::clone(algebra), a, b.clone())
        .map_err(|(index, _)| Failure::ZeroWeight(index))
}
