//! From basis and nodes to the tableau (LZ §4.4, steps 1–5; theory.md §2).

use std::ops::Range;
use std::sync::Arc;

use num_rational::BigRational;

use crate::algebra::{NodeAlgebra, Tensor};
use crate::arithmetic::matrix;
use crate::arithmetic::polynomial::Polynomial;
use crate::basis::{Basis, combination};
use crate::definition::{Definition, Key};
use crate::error::{Error, ErrorKind, Place};
use crate::limits::Limits;
use crate::pair::Pair;
use crate::quadrature::{QuadratureRule, node_text};
use crate::tableau::{Exact, Provenance, Tableau};

/// Derives the tableau of a basis at nodes, both given as text, within the default [`Limits`].
///
/// # Errors
/// Everything that can be wrong with the texts ([`Basis::parse`], [`QuadratureRule::parse`]) and
/// everything that [`derive_from`] refuses, with the place in the text.
///
/// ```
/// let tableau = symplectic_compiler::derive("polynomial(3)", "lobatto(3)")?;
/// assert_eq!(tableau.stages(), 3);
/// assert!(tableau.properties().symplectic.holds);
///
/// let error = symplectic_compiler::derive("polynomial(2)", "0, 0").unwrap_err();
/// assert_eq!(error.to_string(), "nodes, column 4: the node 0 is listed twice; nodes must be distinct");
/// # Ok::<(), symplectic_compiler::Error>(())
/// ```
pub fn derive(basis: &str, nodes: &str) -> Result<Tableau, Error> {
    derive_within(basis, nodes, &Limits::default())
}

/// As [`derive()`], within given limits.
///
/// # Errors
/// As [`derive()`].
pub fn derive_within(basis: &str, nodes: &str, limits: &Limits) -> Result<Tableau, Error> {
    let functions = Basis::parse(basis, limits)?;
    let rule = QuadratureRule::parse(nodes, limits)?;
    derive_from(&functions, &rule).map_err(|kind| {
        let whole = |input: &str, text: &str| Place {
            input: input.to_owned(),
            text: text.to_owned(),
            span: trimmed(text),
        };
        let place = if kind.is_about_basis() {
            whole("basis", basis)
        } else {
            whole("nodes", nodes)
        };
        Error::at(kind, place)
    })
}

/// The part of a text that is not white space around it.
fn trimmed(text: &str) -> Range<usize> {
    let start = text.len() - text.trim_start().len();
    start..start + text.trim().len()
}

/// Derives the tableau of a basis `ψ_1, …, ψ_s` at the nodes `c_1, …, c_s` of a rule.
///
/// With `M = [ψ_i(c_j)]` and `B_i = ∫_0^1 ψ_i`, these are `b = M⁻¹ B`, `A = A_ψ M⁻ᵀ` where
/// `(A_ψ)_ij = ∫_0^{c_i} ψ_j`, and `ã_ij = (b_i b_j − b_j a_ji)/b_i`. All of it is done in the node
/// algebra, where `M⁻ᵀ` is the dual basis of `ψ`.
///
/// # Errors
/// [`ErrorKind::NotSquare`], [`ErrorKind::SingularBasis`], [`ErrorKind::ZeroWeight`].
pub fn derive_from(basis: &Basis, rule: &QuadratureRule) -> Result<Tableau, ErrorKind> {
    let algebra = rule.algebra();
    let size = algebra.dimension();
    if basis.len() != size {
        return Err(ErrorKind::NotSquare {
            basis: basis.len(),
            nodes: size,
        });
    }
    let dual = dual_basis(basis, algebra)?;

    let integrals: Vec<Polynomial> = basis
        .functions()
        .iter()
        .map(Polynomial::antiderivative)
        .collect();
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

    let pair =
        Pair::symplectic(Arc::clone(algebra), a, b).map_err(|index| zero_weight(algebra, index))?;
    Ok(Tableau {
        name: None,
        provenance: Provenance {
            definition: Definition::new([(Key::Basis, basis.name()), (Key::Nodes, rule.name())]),
            source: None,
        },
        exact: Exact::Nodes(pair),
    })
}

/// Elements `d_i` of `K` with `Σ_i ψ_i(x) d_i(y) = δ(x, y)`: the columns of `M⁻¹`.
fn dual_basis(basis: &Basis, algebra: &NodeAlgebra) -> Result<Vec<Polynomial>, ErrorKind> {
    let size = algebra.dimension();
    // ψ_i = Σ_k P_ik xᵏ modulo the node polynomial; M is regular iff P is.
    let rows: Vec<Vec<BigRational>> = basis
        .functions()
        .iter()
        .map(|function| {
            let reduced = algebra.reduce(function);
            (0..size).map(|k| reduced.coefficient(k)).collect()
        })
        .collect();
    let inverse = matrix::inverse(&rows).map_err(|c| ErrorKind::SingularBasis {
        combination: combination(basis.functions(), &c),
    })?;
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

/// The error for a weight that vanishes.
fn zero_weight(algebra: &NodeAlgebra, index: usize) -> ErrorKind {
    ErrorKind::ZeroWeight {
        index: index + 1,
        node: node_text(algebra, index),
    }
}

/// Whether a basis of polynomials spans the constants, on which consistency rests.
#[cfg(test)]
fn spans_constants(basis: &Basis) -> bool {
    let mut functions = basis.functions().to_vec();
    functions.push(Polynomial::one());
    Basis::new(functions).is_err()
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::arithmetic::rational::ratio;
    use proptest::prelude::*;

    #[test]
    fn what_cannot_be_derived_is_refused_at_its_place() {
        let cases = [
            (
                "polynomial(2)",
                "gauss(3)",
                "basis, column 1: 2 basis functions and 3 nodes",
            ),
            ("1", "0, 1", "basis, column 1: 1 basis function and 2 nodes"),
            // t(t − 1) vanishes at both nodes.
            (
                "1, t - t^2",
                "0, 1",
                "nodes, column 1: the matrix of the basis at the nodes is singular: -t^2 + t vanishes at every node",
            ),
            (
                "1, t^2 - t^4",
                "0, 1",
                "nodes, column 1: the matrix of the basis at the nodes is singular",
            ),
            (
                "polynomial(2)",
                "1/2, 1",
                "nodes, column 1: the weight b_2 at the node c_2 = 1 is zero",
            ),
        ];
        for (basis, nodes, message) in cases {
            let error = derive(basis, nodes).expect_err(message).to_string();
            assert!(error.starts_with(message), "{basis} at {nodes}: {error}");
        }
    }

    fn nodes_of(tableau: &Tableau) -> &Pair<NodeAlgebra> {
        let Exact::Nodes(pair) = &tableau.exact;
        pair
    }

    proptest! {
        /// LZ's formulas evaluated directly at rational nodes, with a matrix inverse: another route.
        #[test]
        fn the_tableau_follows_the_formulas(
            nodes in prop::collection::btree_set(0i64..12, 1..5),
            coefficients in prop::collection::vec(-4i64..5, 20),
        ) {
            let size = nodes.len();
            let c: Vec<BigRational> = nodes.iter().map(|&n| ratio(n, 11)).collect();
            let functions: Vec<Polynomial> = coefficients.chunks(5).take(size).map(Polynomial::from_integers).collect();
            let Ok(basis) = Basis::new(functions.clone()) else { return Ok(()) };
            let text = c.iter().map(ToString::to_string).collect::<Vec<_>>().join(",");
            let rule = QuadratureRule::parse(&text, &Limits::default()).expect("nodes");
            let m: Vec<Vec<BigRational>> = functions.iter().map(|f| c.iter().map(|x| f.evaluate(x)).collect()).collect();
            match (derive_from(&basis, &rule), matrix::inverse(&m)) {
                (Err(ErrorKind::SingularBasis { .. }), inverse) => prop_assert!(inverse.is_err()),
                (result, Ok(inverse)) => {
                    let integral = |k: usize, x: &BigRational| functions[k].antiderivative().evaluate(x);
                    let b: Vec<BigRational> = (0..size)
                        .map(|j| (0..size).map(|k| &inverse[j][k] * integral(k, &ratio(1, 1))).sum())
                        .collect();
                    let a: Vec<Vec<BigRational>> = c.iter().map(|x| (0..size)
                        .map(|j| (0..size).map(|k| integral(k, x) * &inverse[j][k]).sum()).collect()).collect();
                    let zero = b.iter().position(|b| *b == ratio(0, 1));
                    match result {
                        Err(ErrorKind::ZeroWeight { index, .. }) => prop_assert_eq!(Some(index - 1), zero),
                        Err(other) => prop_assert!(false, "{}", other),
                        Ok(tableau) => {
                            prop_assert_eq!(zero, None);
                            let pair = nodes_of(&tableau);
                            for i in 0..size {
                                prop_assert_eq!(pair.b.evaluate(&c[i]), b[i].clone());
                                for j in 0..size {
                                    prop_assert_eq!(pair.a.row_at(&c[i]).evaluate(&c[j]), a[i][j].clone());
                                    let tilde = (&b[i] * &b[j] - &b[j] * &a[j][i]) / &b[i];
                                    prop_assert_eq!(pair.a_tilde.row_at(&c[i]).evaluate(&c[j]), tilde);
                                }
                            }
                            prop_assert!(tableau.properties().symplectic.holds);
                            if spans_constants(&basis) {
                                prop_assert_eq!(pair.c(), pair.algebra.variable());
                                prop_assert!(tableau.properties().consistent.holds);
                            }
                        }
                    }
                }
                (result, Err(_)) => prop_assert!(false, "singular, but {:?}", result.map(|_| ())),
            }
        }

        #[test]
        fn the_tableau_depends_on_the_span_only(entries in prop::collection::vec(-3i64..4, 9), nodes in prop::sample::select(vec!["gauss(3)", "lobatto(3)", "0, 1/5, 1", "chebyshev(3)"])) {
            let rows: Vec<Vec<BigRational>> = entries.chunks(3).map(|r| r.iter().map(|&x| ratio(x, 1)).collect()).collect();
            prop_assume!(matrix::inverse(&rows).is_ok());
            let changed = Basis::new(entries.chunks(3).map(Polynomial::from_integers).collect()).expect("independent");
            let rule = QuadratureRule::parse(nodes, &Limits::default()).expect("nodes");
            let (one, other) = (derive_from(&Basis::monomials(3), &rule).expect("derived"), derive_from(&changed, &rule).expect("derived"));
            prop_assert!(one.has_coefficients_of(&other));
        }
    }

    #[test]
    fn polynomial_bases_give_the_weights_of_the_rule() {
        for nodes in ["gauss(4)", "radau-left(3)", "fejer(5)", "newton-cotes(4)"] {
            let rule = QuadratureRule::parse(nodes, &Limits::default()).expect("nodes");
            let tableau = derive_from(&Basis::monomials(rule.len()), &rule).expect("derived");
            assert_eq!(nodes_of(&tableau).b, *rule.weights());
            assert!(tableau.properties().consistent.holds);
        }
    }
}
