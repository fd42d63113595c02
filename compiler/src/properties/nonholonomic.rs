//! Whether the order of a method is that of its steps of systems with non-holonomic constraints `w(q)·q' = 0`.
//!
//! ```text
//! p = p0 − w(q0)ᵀλ      Q_i = q0 + h Σ_j a_ij velocity_j    P_i = p + h Σ_j ã_ij force_j
//! Σ_i b_i w(Q_i)·(q1 − q0) = 0      p1 = p + h Σ_i b_i force_i − w(q1)ᵀμ
//! ```
//!
//! These are consistent for every consistent tableau, and symmetric for a symmetric one: they have order 1, and order 2 where they are
//! symmetric (Leok & Ohsawa, arXiv:0810.0740v1, 4.28). A method of a higher order would lose it.

use num_rational::BigRational;

use super::{Examined, Property, Symmetry, Zero, consistent, shown, symmetric, symplectic};
use crate::algebra::StageAlgebra;
use crate::arithmetic::rational::ratio;
use crate::evidence::Evidence;
use crate::partitioned::Partitioned;

/// Decides whether a method has such steps, whatever their order.
pub(crate) fn has_steps<A: StageAlgebra>(pair: &Partitioned<A>) -> Property {
    let numbers = &pair.numbers();
    have_steps(&Examined { pair, numbers })
}

fn have_steps<A: StageAlgebra>(examined: &Examined<'_, A>) -> Property {
    for (i, weight) in examined.numbers.b.iter().enumerate() {
        match weight.zero() {
            Zero::No => {}
            Zero::Yes => return Property::refuted(format!("b_{} = 0", i + 1)),
            Zero::Within(bits) => {
                let witness = format!("b_{} cannot be told from zero", i + 1);
                return Property::undecided(bits, witness);
            }
        }
    }
    let [symplectic, consistent] = [symplectic::decide(examined), consistent::decide(examined)];
    for needed in [&symplectic, &consistent] {
        if !needed.holds {
            return needed.clone();
        }
    }
    Property::holding(symplectic.evidence.and(consistent.evidence), None)
}

/// Decides the conditions one after another, costly ones last.
pub(super) fn decide<A: Symmetry>(examined: &Examined<'_, A>) -> Property {
    if let Some(refuted) = examined.refuted_by_gradient_kicks() {
        return refuted;
    }
    let steps = have_steps(examined);
    if !steps.holds {
        return steps;
    }
    let (evidence, pair) = (steps.evidence, examined.pair);
    let (c, c_tilde) = (&pair.c(), &pair.c_tilde());
    // The condition of order 2 for each colour of the leaf of a tree, Σ b c = 1/2.
    if let Some(witness) = violated(examined, &[("c", &[c]), ("c̃", &[c_tilde])], &ratio(1, 2)) {
        return Property::holding(evidence, Some(format!("order 1: {witness}")));
    }
    // Those of order 3 that a symplectic method leaves: one for each tree without a root, Σ b c² = 1/3.
    let trees: [(_, &[&A::Vector]); 3] = [
        ("c²", &[c, c]),
        ("c c̃", &[c, c_tilde]),
        ("c̃²", &[c_tilde, c_tilde]),
    ];
    let Some(witness) = violated(examined, &trees, &ratio(1, 3)) else {
        return Property::refuted(
            "steps with non-holonomic constraints have order 2 at most".to_owned(),
        );
    };
    let symmetric = symmetric::decide(examined);
    if symmetric.holds {
        let evidence = evidence.and(symmetric.evidence);
        return Property::holding(evidence, Some(format!("order 2: {witness}")));
    }
    if let Evidence::Undecided { .. } = symmetric.evidence {
        return symmetric;
    }
    Property::refuted("not symmetric: steps with non-holonomic constraints have order 1".to_owned())
}

/// The first of these trees for which `Σ_i b_i Π_k f_k,i` is not the wanted value, with what it is.
fn violated<A: StageAlgebra>(
    examined: &Examined<'_, A>,
    trees: &[(&str, &[&A::Vector])],
    wanted: &BigRational,
) -> Option<String> {
    let (algebra, b) = (&*examined.pair.algebra, &examined.pair.b);
    trees.iter().find_map(|(name, factors)| {
        let terms = factors
            .iter()
            .fold(b.clone(), |terms, factor| algebra.multiply(&terms, factor));
        let sum = algebra.sum(&terms);
        let differs = sum.difference(wanted) == Zero::No;
        differs.then(|| format!("Σ b {name} = {} ≠ {wanted}", shown(&sum)))
    })
}

#[cfg(test)]
mod tests {
    use super::*;

    fn property(definition: &str) -> Property {
        let definition = crate::Definition::parse(definition).expect(definition);
        let tableau = definition
            .derive(&crate::Limits::default())
            .expect("derived");
        tableau.properties().nonholonomic
    }

    #[test]
    fn symmetric_methods_have_nonholonomic_order_2_and_others_order_1() {
        for (definition, witness) in [
            (
                "basis: polynomial(1), nodes: gauss(1)",
                "order 2: Σ b c² = 1/4 ≠ 1/3",
            ),
            (
                "basis: polynomial(2), nodes: lobatto(2)",
                "order 2: Σ b c² = 1/2 ≠ 1/3",
            ),
            ("basis: polynomial(4), nodes: newton-cotes(4)", "order 2: "),
            (
                "basis: polynomial(1), nodes: [0]",
                "order 1: Σ b c = 0 ≠ 1/2",
            ),
            (
                "basis: polynomial(1), nodes: [1]",
                "order 1: Σ b c = 1 ≠ 1/2",
            ),
        ] {
            let found = property(definition);
            assert!(
                found.holds && found.evidence == Evidence::Proved,
                "{definition}: {found}"
            );
            let found = found.witness.expect("an order");
            assert!(found.starts_with(witness), "{definition}: {found}");
        }
    }

    #[test]
    fn compositions_of_methods_that_qualify_do() {
        let cubic =
            "base: gauss-1, weights: [1/(2 - cbrt(2)), -cbrt(2)/(2 - cbrt(2)), 1/(2 - cbrt(2))]";
        for (definition, text) in [
            (
                "base: gauss-1, weights: triple_jump(4)",
                "yes, proved: order 4: each of its 3 steps is non-holonomic",
            ),
            (
                "base: gauss-1, weights: suzuki(6)",
                "yes, proved: order 6: each of its 25 steps is non-holonomic",
            ),
            (
                cubic,
                "yes, proved: order 4: each of its 3 steps is non-holonomic",
            ),
            // Gauss with two stages loses its order 4, but the composition has order 2 with and without constraints.
            (
                "compose: [[1/2, base: gauss-1], [1/2, base: gauss-2]]",
                "yes, proved: order 2: each of its 2 steps is non-holonomic",
            ),
            // Steps of order 1: two of a method that is not symmetric, two of its adjoint, no palindrome.
            (
                "base: [basis: polynomial(3), nodes: [0, 1/4, 1]], weights: [1/6, 1/3, adjoint(1/6), adjoint(1/3)]",
                "yes, proved: order 2: each of its 4 steps is non-holonomic",
            ),
            (
                "base: [base: symplectic-euler, weights: [1/2, adjoint(1/2)]], weights: triple_jump(4)",
                "yes, proved: order 4: each of its 6 steps is non-holonomic",
            ),
            // Different methods of order 2.
            (
                "compose: [[1/3, basis: polynomial(1), nodes: gauss(1)], [2/3, basis: polynomial(2), nodes: lobatto(2)]]",
                "yes, proved: order 2: each of its 2 steps is non-holonomic",
            ),
        ] {
            assert_eq!(property(definition).to_string(), text, "{definition}");
        }
    }

    #[test]
    fn methods_that_lose_order_with_nonholonomic_rows_are_refused() {
        for (definition, witness) in [
            ("basis: polynomial(2), nodes: gauss(2)", "order 2 at most"),
            (
                "basis: polynomial(2), nodes: radau-left(2)",
                "order 2 at most",
            ),
            ("basis: polynomial(3), nodes: [0, 1/4, 1]", "not symmetric"),
            // Of order 4 on other systems: its parts have order 2.
            (
                "compose: [[1/2, basis: polynomial(2), nodes: gauss(2)], [1/2, basis: polynomial(2), nodes: gauss(2)]]",
                "order 2 at most",
            ),
            (
                "base: gauss-2, weights: triple_jump(6)",
                "with non-holonomic constraints its steps give order 2, not 6: \
                 its part `basis: polynomial(2), nodes: gauss(2)` is not: steps with non-holonomic constraints have order 2 at most",
            ),
            (
                "compose: [[1/2, base: gauss-1], [1/2, basis: polynomial(3), nodes: [0, 1/4, 1]]]",
                "with non-holonomic constraints its steps give order 1, not 2: \
                 its part `basis: polynomial(3), nodes: [0, 1/4, 1]` is not: not symmetric",
            ),
            (
                "compose: [[1/2, base: gauss-1], [1/2, a: [[0, 0], [1, 0]], b: [1/2, 1/2]]]",
                "its part `a: [[0, 0], [1, 0]], b: [1/2, 1/2]` is not: b_1 ã_11",
            ),
            // The adjoint has the term h²E₂ with the opposite sign, and 2/4² ≠ 1/2².
            (
                "base: [basis: polynomial(3), nodes: [0, 1/4, 1]], weights: [1/4, adjoint(1/2), 1/4]",
                "with non-holonomic constraints its steps give order 1, not 2: \
                 its part `basis: polynomial(3), nodes: [0, 1/4, 1]` is not: not symmetric",
            ),
            ("kick: [1/2, 1/2], drift: [1, 0]", "b_2 = 0"),
            ("kick: [1/3, 2/3], drift: [1/2, 1/2]", "b_1 − b̃_1 = 1/6"),
        ] {
            let found = property(definition);
            assert!(!found.holds, "{definition}: {found}");
            let text = found.to_string();
            assert!(text.contains(witness), "{definition}: {text}");
        }
    }
}
