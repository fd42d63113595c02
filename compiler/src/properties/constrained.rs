//! Whether a method steps systems with holonomic constraints `φ(q) = 0` (MW 3.5.6; Jay, 1996).
//!
//! ```text
//! force_j = −∂H/∂q(Q_j, P_j) − G(Q_j)ᵀ Λ_j      φ(Q_i) = 0, i = 2..s      Q_1 = q0, Q_s = q1
//! ```
//!
//! For small steps `φ(Q_i)` depends on `Λ_1 … Λ_{s−1}` through `−h² X ⊗ G M⁻¹ Gᵀ` with the matrix
//! `X = (A Ã)_ik`, `i = 2..s`, `k = 1..s−1`: the multipliers exist and are unique iff X is invertible.
//!
//! Symplectic Euler has one stage, `Q_1 = q0`, and `φ(q1) = 0` takes the place of the conditions on stages (GNI VII.1): its end
//! is a second stage of weight 0, with `X = 1`.

use super::{Evidence, Examined, Property, Zero, consistent, end_stages, symplectic};
use crate::algebra::{Number, StageAlgebra};
use crate::arithmetic::interval::Interval;
use crate::arithmetic::inverse::{self, BITS, Inverse};
use crate::arithmetic::rational::ratio;
use crate::coefficients::Coefficients;

/// Decides the conditions one after another.
pub(super) fn decide<A: StageAlgebra>(examined: &Examined<'_, A>) -> Property {
    if examined.numbers.b.len() == 1 {
        return with_its_end(examined);
    }
    let ends = [
        end_stages::first_row_zero(examined),
        end_stages::stiffly_accurate(examined),
    ];
    if let Some(refuted) = ends.iter().find(|property| !property.holds) {
        return refuted.clone();
    }
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
    let symplectic = symplectic::decide(examined);
    if !symplectic.holds {
        return symplectic;
    }
    if let Some((i, j)) = equal_stages(examined) {
        let witness = format!("Q_{i} = Q_{j}, so det (A Ã) = 0");
        return match examined.pair.algebra.verified_bits() {
            None => Property::refuted(witness),
            Some(bits) => Property::undecided(bits, witness),
        };
    }
    let found = BITS
        .iter()
        .find_map(|&bits| Inverse::of(feedback(examined.numbers, bits)));
    let Some(Inverse { determinant, .. }) = found else {
        let witness = "det (A Ã) cannot be told from zero".to_owned();
        return Property::undecided(BITS[BITS.len() - 1], witness);
    };
    let evidence = ends.iter().fold(symplectic.evidence, |evidence, property| {
        evidence.and(property.evidence)
    });
    let determinant = Number::Rational(determinant.middle()).decimal(6);
    Property::holding(evidence, Some(format!("det (A Ã) ≈ {determinant}")))
}

/// Decides it for one stage: `a_11 = 0`, `b_1 = b̃_1 = 1`, and so `ã_11 = 1`.
fn with_its_end<A: StageAlgebra>(examined: &Examined<'_, A>) -> Property {
    let needed = [
        end_stages::first_row_zero(examined),
        consistent::decide(examined),
        symplectic::decide(examined),
    ];
    if let Some(refuted) = needed.iter().find(|property| !property.holds) {
        return refuted.clone();
    }
    let evidence = needed.iter().fold(Evidence::Proved, |evidence, property| {
        evidence.and(property.evidence)
    });
    let witness = "q1 is a second stage, of weight 0".to_owned();
    Property::holding(evidence, Some(witness))
}

/// Two stages, counted from 1, that coincide.
fn equal_stages<A: StageAlgebra>(examined: &Examined<'_, A>) -> Option<(usize, usize)> {
    let algebra = &*examined.pair.algebra;
    let columns: Vec<Vec<usize>> = (0..algebra.stages()).map(|j| vec![j]).collect();
    let groups = algebra.equal_rows(&examined.pair.a, &columns);
    groups.iter().find_map(|group| match group[..] {
        [i, j, ..] => Some((i + 1, j + 1)),
        _ => None,
    })
}

/// The matrix X, in enclosures with this many binary places.
fn feedback(numbers: &Coefficients<Number<'_>>, bits: u32) -> Vec<Vec<Interval>> {
    let enclosed = |rows: &[Vec<Number<'_>>]| -> Vec<Vec<Interval>> {
        let row = |row: &Vec<Number<'_>>| row.iter().map(|x| x.enclose(bits)).collect();
        rows.iter().map(row).collect()
    };
    let (a, a_tilde) = (enclosed(&numbers.a), enclosed(&numbers.a_tilde));
    let stages = a.len();
    let entry = |i: usize, k: usize| {
        let products = (0..stages).map(|j| a[i][j].multiply(&a_tilde[j][k]));
        let zero = Interval::enclosing(&ratio(0, 1), bits);
        products.fold(zero, |sum, product| sum.add(&product))
    };
    let row = |i| (0..stages - 1).map(|k| entry(i, k)).collect();
    (1..stages).map(row).collect()
}

/// `X⁻¹`, correctly rounded, of a method that is `constrained` and has more than one stage.
pub(crate) fn multiplier_matrix(numbers: &Coefficients<Number<'_>>) -> Option<Vec<Vec<f64>>> {
    inverse::rounded(|bits| feedback(numbers, bits))
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::catalogue;

    fn property(definition: &str) -> Property {
        let definition = crate::Definition::parse(definition).expect(definition);
        let tableau = definition
            .derive(&crate::Limits::default())
            .expect("derived");
        tableau.properties().constrained
    }

    /// The determinants of X of theory (Jay, 1996, and our own computation in 55 digits).
    #[test]
    fn determinants_of_known_methods() {
        for (definition, determinant) in [
            ("basis: polynomial(2), nodes: lobatto(2)", "0.5"),
            ("basis: polynomial(3), nodes: lobatto(3)", "0.0208333"),
            ("basis: polynomial(4), nodes: lobatto(4)", "0.000277778"),
            ("basis: polynomial(5), nodes: lobatto(5)", "0.00000177154"),
            ("basis: polynomial(6), nodes: lobatto(6)", "6.56127e-9"),
            (
                "basis: polynomial(4), nodes: newton-cotes(4)",
                "0.000228624",
            ),
            (
                "basis: polynomial(5), nodes: newton-cotes(5)",
                "0.0000015985",
            ),
            (
                "basis: polynomial(4), nodes: clenshaw-curtis(4)",
                "0.000366211",
            ),
            (
                "basis: polynomial(5), nodes: clenshaw-curtis(5)",
                "0.0000024414",
            ),
        ] {
            let found = property(definition);
            assert!(found.holds, "{definition}: {found}");
            let witness = found.witness.expect("a determinant");
            assert!(witness.contains(determinant), "{definition}: {witness}");
        }
    }

    #[test]
    fn what_refutes_it_is_named() {
        for (definition, witness) in [
            ("basis: polynomial(1), nodes: [1]", "a_11 = 1"),
            ("basis: polynomial(2), nodes: gauss(2)", "a_11 = "),
            (
                "basis: polynomial(2), nodes: radau-left(2)",
                "b_1 − a_21 = ",
            ),
            (
                "basis: polynomial(3), nodes: lobatto(3), exchange: true",
                "a_11 = ",
            ),
            ("base: lobatto-2, weights: triple_jump(4)", "Q_2 = Q_3"),
        ] {
            let found = property(definition);
            assert!(!found.holds, "{definition}");
            let text = found.to_string();
            assert!(text.contains(witness), "{definition}: {text}");
        }
    }

    #[test]
    fn symplectic_euler_ends_on_the_constraints() {
        let found = property("basis: polynomial(1), nodes: [0]");
        assert!(found.holds && found.evidence == Evidence::Proved, "{found}");
    }

    #[test]
    fn the_inverse_is_that_of_the_matrix() {
        let tableau = catalogue::find("lobatto-3")
            .expect("known")
            .derive()
            .expect("derived");
        // X = ((1/12, 1/24), (1/6, 1/3)) of Lobatto IIIA–IIIB with three stages.
        let inverse = multiplier_matrix(&tableau.numbers()).expect("regular");
        assert_eq!(inverse, [[16.0, -2.0], [-8.0, 4.0]]);
    }
}
