//! Symmetry: equality with the adjoint.

use super::{Entry, Evidence, Examined, Property, first_nonzero_entry, first_nonzero_value};
use crate::algebra::{NodeAlgebra, Tensor};
use crate::arithmetic::interval::Interval;
use crate::arithmetic::matrix;
use crate::arithmetic::polynomial::Polynomial;
use crate::arithmetic::rational::ratio;
use crate::tableau::Tableau;
use num_rational::BigRational;

/// Decides whether some permutation `σ` of the stages gives `a_σ(i)σ(j) = b_j − a_ij` and
/// `b_σ(i) = b_i`, and the same for `ã` and `b̃`.
///
/// Such a `σ` maps every quantity that is built from the tableau in a known way: `c_σ(i) = Σ b − c_i`,
/// for example. A quantity that has different values at all stages therefore determines `σ`, as a
/// polynomial map of `K`, and the equations are decided in `K ⊗ K`.
pub(super) fn decide(examined: &Examined<'_>) -> Property {
    let tableau = examined.tableau;
    let candidates = quantities(tableau);
    let determined = candidates
        .iter()
        .find_map(|(u, image)| permutation(&tableau.algebra, u, image));
    match determined {
        Some(Ok(map)) => check(tableau, &map),
        Some(Err(())) => Property::refuted(NO_ORDER.to_owned()),
        None => search(tableau),
    }
}

/// Quantities of the stages, each with the quantity that a symmetry maps it to.
fn quantities(tableau: &Tableau) -> Vec<(Polynomial, Polynomial)> {
    let algebra = &tableau.algebra;
    let constant = |value: BigRational| Polynomial::constant(value);
    let reflected = |u: &Polynomial, sum: &BigRational| &constant(sum.clone()) - u;
    let (sum, sum_tilde) = tableau.weight_sums();
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
    let rows: Vec<Vec<BigRational>> = powers(u)
        .iter()
        .map(|p| (0..size).map(|k| p.coefficient(k)).collect())
        .collect();
    let inverse = matrix::inverse(&rows).ok()?;
    // x = Σ_k w_k uᵏ, so g = Σ_k w_k imageᵏ.
    let x = algebra.variable();
    let weights = (0..size).map(|k| {
        (0..size)
            .map(|j| x.coefficient(j) * &inverse[j][k])
            .sum::<BigRational>()
    });
    let map = weights
        .zip(powers(image))
        .fold(Polynomial::zero(), |sum, (w, p)| &sum + &p.scale(&w));
    Some(if compose(algebra, algebra.modulus(), &map).is_zero() {
        Ok(map)
    } else {
        Err(())
    })
}

/// Decides the equations for the only permutation that is possible.
fn check(tableau: &Tableau, map: &Polynomial) -> Property {
    let algebra = &tableau.algebra;
    let adjoint = tableau.adjoint();
    for (name, b) in [("b", &tableau.b), ("b̃", &tableau.b_tilde)] {
        if let Some((i, value)) = first_nonzero_value(algebra, &(&compose(algebra, b, map) - b)) {
            return Property::refuted(format!(
                "{name}_σ({i}) − {name}_{i} = {value} where stage σ(i) is the mirror image of stage i"
            ));
        }
    }
    for (name, a, reflected) in [
        ("a", &tableau.a, &adjoint.a),
        ("ã", &tableau.a_tilde, &adjoint.a_tilde),
    ] {
        if let Some(Entry {
            row,
            column,
            index,
            value,
            ..
        }) = first_nonzero_entry(algebra, &a.substitute(algebra, map).subtract(reflected))
        {
            let b = if name == "a" { "b" } else { "b̃" };
            return Property::refuted(format!(
                "{name}_σ({row})σ({column}) + {name}_{index} − {b}_{column} = {value} where stage σ(i) is the mirror image of stage i"
            ));
        }
    }
    Property::proved(None)
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

const NO_ORDER: &str = "no order of the stages makes the tableau equal to its adjoint";
/// The number of partial permutations that are tried.
const SEARCH_BUDGET: u32 = 100_000;
/// Binary places of the enclosures by which permutations are excluded.
const SEARCH_BITS: u32 = 512;

/// Tries all permutations of stages that nothing told apart, with enclosures: a permutation that an
/// enclosure excludes is refuted; one that survives is verified, not proved.
fn search(tableau: &Tableau) -> Property {
    let numbers = tableau.numbers();
    let first = numbers.iter().map(|number| number.enclose(0).bits());
    let bits = first.max().unwrap_or(0) + SEARCH_BITS;
    let enclosed = numbers.map(|number| number.enclose(bits));
    // Entry (i, j) of the matrix and entry (σ(i), σ(j)) must sum to b_j.
    let fits =
        |a: &[Vec<Interval>], b: &[Interval], (i, j): (usize, usize), (k, l): (usize, usize)| {
            a[k][l]
                .add(&a[i][j])
                .subtract(&b[j])
                .sign()
                .is_none_or(std::cmp::Ordering::is_eq)
        };
    let agrees = |from: (usize, usize), to: (usize, usize)| {
        fits(&enclosed.a, &enclosed.b, from, to)
            && fits(&enclosed.a_tilde, &enclosed.b_tilde, from, to)
    };
    let mut images: Vec<usize> = Vec::new();
    let mut budget = SEARCH_BUDGET;
    let found = extend(&mut images, tableau.stages(), &agrees, &mut budget);
    if !found && budget > 0 {
        return Property::refuted(NO_ORDER.to_owned());
    }
    let order = images
        .iter()
        .map(|i| (i + 1).to_string())
        .collect::<Vec<_>>()
        .join(", ");
    let witness = if found {
        format!("with the stages in the order {order}")
    } else {
        format!("not decided: {SEARCH_BUDGET} partial orders of the stages were tried")
    };
    Property {
        holds: found,
        evidence: Evidence::Verified { bits: SEARCH_BITS },
        witness: Some(witness),
    }
}

/// Extends the images of the first stages to a permutation under which all pairs agree, if the budget
/// of partial permutations lasts.
fn extend(
    images: &mut Vec<usize>,
    size: usize,
    agrees: &impl Fn((usize, usize), (usize, usize)) -> bool,
    budget: &mut u32,
) -> bool {
    let i = images.len();
    if i == size {
        return true;
    }
    for image in (0..size)
        .filter(|image| !images.contains(image))
        .collect::<Vec<_>>()
    {
        *budget = budget.saturating_sub(1);
        if *budget == 0 {
            return false;
        }
        images.push(image);
        let compatible = (0..=i)
            .all(|j| agrees((i, j), (image, images[j])) && agrees((j, i), (images[j], image)));
        if compatible && extend(images, size, agrees, budget) {
            return true;
        }
        images.pop();
    }
    false
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::properties::Evidence;

    /// Two stages that nothing tells apart: all entries of both matrices are the same number.
    fn twins(entry: BigRational) -> Tableau {
        let mut tableau = crate::derive("polynomial(2)", "0, 1").expect("derived");
        let matrix = Tensor::from_products(
            &tableau.algebra,
            &[(Polynomial::constant(entry), Polynomial::one())],
        );
        (tableau.a, tableau.a_tilde) = (matrix.clone(), matrix);
        tableau
    }

    #[test]
    fn stages_that_nothing_tells_apart_are_searched() {
        let symmetric = twins(ratio(1, 4)).properties().symmetric;
        assert!(symmetric.holds);
        assert_eq!(symmetric.evidence, Evidence::Verified { bits: SEARCH_BITS });
        let asymmetric = twins(ratio(1, 3)).properties().symmetric;
        assert!(!asymmetric.holds);
        assert_eq!(asymmetric.evidence, Evidence::Refuted);
    }

    #[test]
    fn symmetry_is_proved_and_refuted() {
        for (basis, nodes, symmetric) in [
            ("polynomial(4)", "gauss(4)", true),
            ("polynomial(5)", "lobatto(5)", true),
            ("polynomial(3)", "0, 1/2, 1", true),
            ("polynomial(3)", "radau-left(3)", false),
            ("polynomial(3)", "0, 1/4, 1", false),
            // Not consistent: c is not the node, but the method is its own adjoint.
            ("t - t^2", "1/2", true),
            ("t", "1/2", false),
            ("t^2 - t, 2*t - 1", "1/4, 3/4", true),
        ] {
            let property = crate::derive(basis, nodes)
                .expect("derived")
                .properties()
                .symmetric;
            assert_eq!(property.holds, symmetric, "{basis} at {nodes}: {property}");
            let evidence = if symmetric {
                Evidence::Proved
            } else {
                Evidence::Refuted
            };
            assert_eq!(property.evidence, evidence);
        }
    }
}
