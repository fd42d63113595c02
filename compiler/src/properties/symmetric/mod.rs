//! Symmetry: equality with the adjoint.

mod dense;
mod node;

use num_rational::BigRational;

use super::{Examined, Property};
use crate::algebra::{Number, StageAlgebra};
use crate::arithmetic::interval::Interval;
use crate::coefficients::Coefficients;
use crate::partitioned::Partitioned;

/// Decides whether some permutation `σ` of the stages gives `a_σ(i)σ(j) = b_j − a_ij` and
/// `b_σ(i) = b_i`, and the same for `ã` and `b̃`.
pub(super) fn decide<A: Symmetry>(examined: &Examined<'_, A>) -> Property {
    match examined.refuted_by_gradient_kicks() {
        Some(refuted) => refuted,
        None => A::symmetric(examined.pair, examined.numbers),
    }
}

/// An algebra over which symmetry can be decided.
pub(crate) trait Symmetry: StageAlgebra {
    /// Decides whether a pair is its own adjoint for some order of the stages.
    fn symmetric(pair: &Partitioned<Self>, numbers: &Coefficients<Number<'_>>) -> Property;
}

const NO_ORDER: &str = "no order of the stages makes the tableau equal to its adjoint";
/// The number of partial permutations that are tried.
const SEARCH_BUDGET: u32 = 100_000;
/// Binary places of the enclosures by which permutations are excluded.
const SEARCH_BITS: u32 = 512;

/// The images of the stages, counted from 0, under a permutation for which enclosures do not exclude that a tableau is equal to its
/// adjoint.
pub fn images(numbers: &Coefficients<Number<'_>>) -> Option<Vec<usize>> {
    search(numbers).ok().map(|Permutation(images)| images)
}

/// A permutation of the stages that enclosures do not exclude: the images of the stages.
struct Permutation(Vec<usize>);

impl Permutation {
    /// The order of the stages, for a message, if it is not the reverse one.
    fn unusual(&self) -> Option<String> {
        let reverse = (0..self.0.len()).rev();
        (!reverse.eq(self.0.iter().copied())).then(|| self.witness())
    }

    /// The order of the stages, for a message.
    fn witness(&self) -> String {
        let images: Vec<String> = self.0.iter().map(|i| (i + 1).to_string()).collect();
        format!("with the stages in the order {}", images.join(", "))
    }
}

/// Looks for a permutation of the stages under which the equations hold as far as enclosures tell.
///
/// # Errors
/// Where all permutations are excluded, the property is refuted; where the budget is exhausted, it is
/// not decided.
fn search(numbers: &Coefficients<Number<'_>>) -> Result<Permutation, Property> {
    let first = numbers.iter().map(|number| number.enclose(0).bits());
    let bits = first.max().unwrap_or(0) + SEARCH_BITS;
    let enclosed = numbers.map(|number| number.enclose(bits));
    // Entry (i, j) of the matrix and entry (σ(i), σ(j)) must sum to b_j.
    let fits =
        |a: &[Vec<Interval>], b: &[Interval], (i, j): (usize, usize), (k, l): (usize, usize)| {
            let residual = a[k][l].add(&a[i][j]).subtract(&b[j]);
            residual.sign().is_none_or(std::cmp::Ordering::is_eq)
        };
    let equal = |b: &[Interval], j: usize, l: usize| {
        let residual = b[l].subtract(&b[j]);
        residual.sign().is_none_or(std::cmp::Ordering::is_eq)
    };
    // Summed over j: c_i + c_σ(i) = Σ b, which leaves few stages to choose from.
    let total = |b: &[Interval]| {
        let zero = Interval::enclosing(&BigRational::default(), bits);
        b.iter().fold(zero, |sum, weight| sum.add(weight))
    };
    let totals = [total(&enclosed.b), total(&enclosed.b_tilde)];
    let mirrored = |c: &[Interval], total: &Interval, i: usize, k: usize| {
        let residual = c[i].add(&c[k]).subtract(total);
        residual.sign().is_none_or(std::cmp::Ordering::is_eq)
    };
    let agrees = |from: (usize, usize), to: (usize, usize)| {
        mirrored(&enclosed.c, &totals[0], from.0, to.0)
            && mirrored(&enclosed.c_tilde, &totals[1], from.0, to.0)
            && fits(&enclosed.a, &enclosed.b, from, to)
            && fits(&enclosed.a_tilde, &enclosed.b_tilde, from, to)
            && equal(&enclosed.b, from.1, to.1)
            && equal(&enclosed.b_tilde, from.1, to.1)
    };
    let mut images: Vec<usize> = Vec::new();
    let mut budget = SEARCH_BUDGET;
    if extend(&mut images, enclosed.b.len(), &agrees, &mut budget) {
        return Ok(Permutation(images));
    }
    Err(if budget > 0 {
        Property::refuted(NO_ORDER.to_owned())
    } else {
        let tried = format!("{SEARCH_BUDGET} partial orders of the stages were tried");
        Property::undecided(SEARCH_BITS, tried)
    })
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
    use crate::arithmetic::polynomial::Polynomial;
    use crate::arithmetic::rational::ratio;
    use crate::evidence::Evidence;
    use crate::exact::Exact;
    use crate::tableau::Tableau;
    use std::sync::Arc;

    /// Two indistinguishable stages: all entries of both matrices are the same number.
    fn twins(entry: BigRational) -> Tableau {
        let mut tableau = crate::derive("polynomial(2)", "0, 1").expect("derived");
        let Exact::Nodes(pair) = Arc::make_mut(&mut tableau.exact) else {
            panic!("rational nodes");
        };
        let matrix = pair
            .algebra
            .outer(&Polynomial::constant(entry), &Polynomial::one());
        (pair.a, pair.a_tilde) = (matrix.clone(), matrix);
        tableau
    }

    #[test]
    fn symmetry_of_indistinguishable_stages_is_decided_by_search() {
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
