//! Symmetry of tableaux over the node algebra.

use num_rational::BigRational;

use super::{NO_ORDER, SEARCH_BITS, Symmetry, search};
use crate::algebra::{NodeAlgebra, Number, Tensor};
use crate::arithmetic::matrix;
use crate::arithmetic::polynomial::Polynomial;
use crate::arithmetic::rational::ratio;
use crate::coefficients::Coefficients;
use crate::evidence::Evidence;
use crate::partitioned::Partitioned;
use crate::properties::{Entry, Property, vanishing_matrix, vanishing_vector};

type NodePair = Partitioned<NodeAlgebra>;

impl Symmetry for NodeAlgebra {
    /// A symmetry `σ` maps every quantity that is built from the tableau in a known way: `c_σ(i) = Σ b − c_i`,
    /// for example. A quantity that has different values at all stages therefore determines `σ`, as a
    /// polynomial map of `K`, and the equations are decided in `K ⊗ K`.
    fn symmetric(pair: &NodePair, numbers: &Coefficients<Number<'_>>) -> Property {
        let candidates = quantities(pair);
        let determined = candidates
            .iter()
            .find_map(|(u, image)| permutation(&pair.algebra, u, image));
        match determined {
            Some(Ok(map)) => check(pair, &map),
            Some(Err(())) => Property::refuted(NO_ORDER.to_owned()),
            None => match search(numbers) {
                Ok(found) => {
                    let evidence = Evidence::Verified { bits: SEARCH_BITS };
                    Property::holding(evidence, Some(found.witness()))
                }
                Err(property) => property,
            },
        }
    }
}

/// Quantities of the stages, each with the quantity that a symmetry maps it to.
fn quantities(tableau: &NodePair) -> Vec<(Polynomial, Polynomial)> {
    let algebra = &tableau.algebra;
    let constant = |value: BigRational| Polynomial::constant(value);
    let reflected = |u: &Polynomial, sum: &BigRational| &constant(sum.clone()) - u;
    let (sum, sum_tilde) = (algebra.trace(&tableau.b), algebra.trace(&tableau.b_tilde));
    let (c, c_tilde) = (tableau.c(), tableau.c_tilde());
    let (image, image_tilde) = (reflected(&c, &sum), reflected(&c_tilde, &sum_tilde));
    // (A u)_σ(i) = Σ_j (b_j − a_ij) u_σ(j)
    let moved = |matrix: &Tensor, b: &Polynomial, u: &Polynomial, image: &Polynomial| {
        let total = algebra.trace(&(b * image));
        (
            matrix.apply(algebra, u),
            &constant(total) - &matrix.apply(algebra, image),
        )
    };
    let second = moved(&tableau.a, &tableau.b, &c, &image);
    let second_tilde = moved(&tableau.a_tilde, &tableau.b_tilde, &c_tilde, &image_tilde);
    let third = moved(&tableau.a, &tableau.b, &c_tilde, &image_tilde);
    let fourth = moved(&tableau.a_tilde, &tableau.b_tilde, &c, &image);
    let basic = vec![
        (c, image),
        (c_tilde, image_tilde),
        second,
        second_tilde,
        third,
        fourth,
        (tableau.b.clone(), tableau.b.clone()),
        (tableau.b_tilde.clone(), tableau.b_tilde.clone()),
    ];
    // A mixture separates all stages that any of them separates, unless the factors are unlucky.
    let mixture = |step: i64| {
        basic.iter().zip(1..).fold(
            (Polynomial::zero(), Polynomial::zero()),
            |(u, image), (next, k)| {
                let factor = ratio(step.pow(k), 1);
                (&u + &next.0.scale(&factor), &image + &next.1.scale(&factor))
            },
        )
    };
    let mixtures: Vec<_> = [2, 3, 5, 7].map(mixture).into();
    basic.into_iter().chain(mixtures).collect()
}

/// The map `g` of `K` with `u(g(x)) = image(x)`; `None` if `u` has equal values at two nodes, and an
/// error if `g` does not map nodes to nodes.
fn permutation(
    algebra: &NodeAlgebra,
    u: &Polynomial,
    image: &Polynomial,
) -> Option<Result<Polynomial, ()>> {
    let size = algebra.dimension();
    // u separates the nodes iff its powers are a basis of K.
    let powers = |u: &Polynomial| {
        let mut powers = vec![Polynomial::one()];
        for k in 1..size {
            powers.push(algebra.multiply(&powers[k - 1], u));
        }
        powers
    };
    let rows = |powers: &[Polynomial]| -> Vec<Vec<BigRational>> {
        let row = |p: &Polynomial| (0..size).map(|k| p.coefficient(k)).collect();
        powers.iter().map(row).collect()
    };
    let inverse = matrix::inverse(&rows(&powers(u))).ok()?;
    let images = powers(image);
    if matrix::inverse(&rows(&images)).is_err() {
        // A permutation would give the image as many values.
        return Some(Err(()));
    }
    // x = Σ_k w_k uᵏ, so g = Σ_k w_k imageᵏ.
    let x = algebra.variable();
    let weights = (0..size).map(|k| {
        (0..size)
            .map(|j| x.coefficient(j) * &inverse[j][k])
            .sum::<BigRational>()
    });
    let map = weights
        .zip(images)
        .fold(Polynomial::zero(), |sum, (w, p)| &sum + &p.scale(&w));
    Some(if compose(algebra, algebra.modulus(), &map).is_zero() {
        Ok(map)
    } else {
        Err(())
    })
}

/// Decides the equations for the only permutation that is possible.
fn check(tableau: &NodePair, map: &Polynomial) -> Property {
    let algebra = &tableau.algebra;
    let adjoint = tableau.adjoint();
    for (name, b) in [("b", &tableau.b), ("b̃", &tableau.b_tilde)] {
        if let Err((i, value)) = vanishing_vector(&**algebra, &(&compose(algebra, b, map) - b)) {
            return Property::refuted(format!(
                "{name}_σ({i}) − {name}_{i} = {value} where stage σ(i) is the mirror image of stage i"
            ));
        }
    }
    for (name, a, reflected) in [
        ("a", &tableau.a, &adjoint.a),
        ("ã", &tableau.a_tilde, &adjoint.a_tilde),
    ] {
        let residual = a.substitute(algebra, map).subtract(reflected);
        if let Err(Entry {
            row,
            column,
            index,
            value,
            ..
        }) = vanishing_matrix(&**algebra, &residual)
        {
            let b = if name == "a" { "b" } else { "b̃" };
            return Property::refuted(format!(
                "{name}_σ({row})σ({column}) + {name}_{index} − {b}_{column} = {value} where stage σ(i) is the mirror image of stage i"
            ));
        }
    }
    Property::holding(Evidence::Proved, None)
}

/// `f(g(x))` in `K`.
fn compose(algebra: &NodeAlgebra, f: &Polynomial, g: &Polynomial) -> Polynomial {
    f.coefficients()
        .iter()
        .rev()
        .fold(Polynomial::zero(), |value, c| {
            &algebra.multiply(&value, g) + &Polynomial::constant(c.clone())
        })
}
