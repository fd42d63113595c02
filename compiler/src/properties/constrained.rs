//! Whether a method steps systems with holonomic constraints `φ(q) = 0` (MW 3.5.6; Jay, 1996).
//!
//! ```text
//! force_j = −∂H/∂q(Q_j, P_j) − G(Q_j)ᵀ Λ_j      φ(Q_i) = 0, i = 2..s      Q_1 = q0, Q_s = q1
//! ```
//!
//! For small steps `φ(Q_i)` depends on `Λ_1 … Λ_{s−1}` through `−h² X ⊗ G M⁻¹ Gᵀ` with the matrix
//! `X = (A Ã)_ik`, `i = 2..s`, `k = 1..s−1`: the multipliers exist and are unique iff X is invertible.
//!
//! The stages count from the start to the end of the step, whatever their labels: in the adjoint of a method the first is `q1`.
//!
//! Enclosures prove `det X ≠ 0`. Whether `det X = 0` is decided exactly if the coefficients are in a field of constants: rational, algebraic,
//! or rational in one transcendental number. For other expressions it remains undecided.
//!
//! Symplectic Euler has one stage, `Q_1 = q0`, and `φ(q1) = 0` replaces the conditions on stages (GNI VII.1): its end is a second stage of
//! weight 0. Its adjoint has the stage `Q_1 = q1`, and the start is a stage of weight 0 before it.

use num_rational::BigRational;
use num_traits::One;

use super::end_stages::{self, Ends};
use super::{Evidence, Examined, Property, Zero, consistent, symplectic};
use crate::algebra::{Field, Number, StageAlgebra};
use crate::arithmetic::interval::Interval;
use crate::arithmetic::inverse::{self, BITS, Inverse};
use crate::arithmetic::rational::ratio;
use crate::coefficients::Coefficients;
use crate::partitioned::Partitioned;

/// Decides the conditions one after another.
pub(super) fn decide<A: StageAlgebra>(examined: &Examined<'_, A>) -> Property {
    if let Some(refuted) = examined.refuted_by_gradient_kicks() {
        return refuted;
    }
    if examined.numbers.b.len() == 1 {
        return with_an_end(examined);
    }
    let ends = match Ends::find(examined) {
        Ok(ends) => ends,
        Err(refuted) => return refuted,
    };
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
    let numbers = examined
        .numbers
        .reordered(&ends.order(examined.numbers.b.len()));
    let found = BITS
        .iter()
        .find_map(|&bits| Inverse::of(feedback(&numbers, bits)));
    let Some(Inverse { determinant, .. }) = found else {
        if is_singular(examined) {
            return Property::refuted("det (A Ã) = 0".to_owned());
        }
        let witness = "det (A Ã) cannot be told from zero".to_owned();
        return Property::undecided(BITS[BITS.len() - 1], witness);
    };
    let evidence = symplectic.evidence.and(ends.evidence);
    let determinant = Number::Rational(determinant.middle()).decimal(6);
    Property::holding(evidence, Some(format!("det (A Ã) ≈ {determinant}")))
}

/// Decides it for one stage: `b_1 = b̃_1 = 1`, and `a_11 = 0`, `ã_11 = 1` or `a_11 = 1`, `ã_11 = 0`.
fn with_an_end<A: StageAlgebra>(examined: &Examined<'_, A>) -> Property {
    let (at_start, at_end) = (
        end_stages::first_row_zero(examined),
        end_stages::stiffly_accurate(examined),
    );
    let (end, witness) = if at_end.holds {
        (at_end, "q0 is a stage of weight 0 before it")
    } else {
        (at_start, "q1 is a second stage, of weight 0")
    };
    let needed = [
        end,
        consistent::decide(examined),
        symplectic::decide(examined),
    ];
    if let Some(refuted) = needed.iter().find(|property| !property.holds) {
        return refuted.clone();
    }
    let evidence = needed.iter().fold(Evidence::Proved, |evidence, property| {
        evidence.and(property.evidence)
    });
    Property::holding(evidence, Some(witness.to_owned()))
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

/// With more stages the rational functions of an elimination may become too long.
const MAX_STAGES: usize = 12;

/// Whether `det X = 0` by exact arithmetic, which needs a field of constants whose equations are decided.
///
/// The row of the start and the column of the end of `A Ã` are zero, so `det X = ± det (A Ã + 𝟙 𝟙ᵀ)`. This is the determinant of a linear map, in any
/// basis of the functions of the stages.
fn is_singular<A: StageAlgebra>(examined: &Examined<'_, A>) -> bool {
    let pair = examined.pair;
    let (algebra, stages) = (&*pair.algebra, pair.algebra.stages());
    let field = algebra.constants();
    if algebra.verified_bits().is_some() || field.is_costly() && stages > MAX_STAGES {
        return false;
    }
    let one = algebra.constant(&BigRational::one());
    let (ones, sums) = (algebra.coordinates(&one), algebra.functional(&one));
    let [a, a_tilde] = [&pair.a, &pair.a_tilde].map(|m| algebra.operator(m));
    let entry = |i: usize, k: usize| {
        let products = (0..stages).map(|j| field.multiply(&a[i][j], &a_tilde[j][k]));
        let first = field.multiply(&ones[i], &sums[k]);
        products.fold(first, |sum, product| field.add(&sum, &product))
    };
    let row = |i| (0..stages).map(|k| entry(i, k)).collect();
    let mut rows: Vec<Vec<_>> = (0..stages).map(row).collect();
    for column in 0..stages {
        let candidates: Vec<_> = rows[column..].iter().map(|row| &row[column]).collect();
        let Some(pivot) = field.pivot(&candidates) else {
            return candidates.iter().all(|x| field.zero(x) == Zero::Yes);
        };
        rows.swap(column, column + pivot);
        let reference = rows[column].clone();
        let Some(inverse) = field.inverse(&reference[column]) else {
            return false;
        };
        for row in &mut rows[column + 1..] {
            let factor = field.multiply(&row[column], &inverse);
            for (x, r) in row.iter_mut().zip(&reference) {
                *x = field.subtract(x, &field.multiply(&factor, r));
            }
        }
    }
    false
}

/// The coefficients with the stages from the start to the end of the step; `None` if these are no stages.
pub(crate) fn from_start_to_end<A: StageAlgebra>(
    pair: &Partitioned<A>,
) -> Option<Coefficients<Number<'_>>> {
    let numbers = pair.numbers();
    let examined = Examined {
        pair,
        numbers: &numbers,
    };
    let ends = Ends::find(&examined).ok()?;
    Some(numbers.reordered(&ends.order(numbers.b.len())))
}

/// The matrix X, in enclosures with this many binary places, of stages from the start to the end of the step.
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

/// `X⁻¹`, correctly rounded, of a method that is `constrained` and has more than one stage, in the order of [`from_start_to_end`].
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
    fn constraint_determinants_agree_with_known_digits() {
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
            ("basis: polynomial(3), nodes: [0, 1/4, 1]", "0.0177083"),
            // Leok & Zhang, Example 4
            (
                "basis: [1, cos(pi*t), sin(pi*t)], nodes: [0, 1/2, 1]",
                "0.0322515",
            ),
        ] {
            let found = property(definition);
            assert!(found.holds, "{definition}: {found}");
            let witness = found.witness.expect("a determinant");
            assert!(witness.contains(determinant), "{definition}: {witness}");
        }
    }

    #[test]
    fn methods_that_cannot_keep_constraints_name_the_witness() {
        for (definition, witness) in [
            ("basis: polynomial(1), nodes: [1/2]", "a_11 = 1/2"),
            ("basis: polynomial(2), nodes: gauss(2)", "a_11 = "),
            (
                "basis: polynomial(2), nodes: radau-left(2)",
                "b_1 − a_21 = ",
            ),
            (
                "basis: polynomial(3), nodes: lobatto(3), exchange: true",
                "a_11 = ",
            ),
            // A part does not qualify.
            (
                "compose: [[1/2, basis: polynomial(2), nodes: lobatto(2)], [1/2, basis: polynomial(1), nodes: gauss(1)]]",
                "its part `basis: polynomial(1), nodes: gauss(1)` is not: a_11 = 1/2",
            ),
            // Radau on the right has its end as a stage, and its adjoint the start, as the last stage.
            (
                "basis: polynomial(2), nodes: radau-right(2), adjoint: true",
                "b_1 − a_21 = 3/4",
            ),
        ] {
            let found = property(definition);
            assert!(!found.holds, "{definition}");
            let text = found.to_string();
            assert!(text.contains(witness), "{definition}: {text}");
        }
    }

    /// Stages of neighbouring steps coincide, so that the coefficients alone do not qualify.
    #[test]
    fn compositions_of_methods_that_qualify_do() {
        for (definition, steps) in [
            ("base: lobatto-2, weights: triple_jump(4)", 3),
            ("base: lobatto-3, weights: suzuki(6)", 5),
            (
                "compose: [[1/3, basis: polynomial(2), nodes: lobatto(2)], [2/3, basis: polynomial(3), nodes: lobatto(3)]]",
                2,
            ),
            // A composition of a composition, and one whose weights are not rational.
            (
                "compose: [[1/2, base: lobatto-2, weights: triple_jump(4)], [1/2, base: lobatto-2, weights: suzuki(4)]]",
                8,
            ),
            (
                "base: lobatto-2, weights: [1/(2 - cbrt(2)), -cbrt(2)/(2 - cbrt(2)), 1/(2 - cbrt(2))]",
                3,
            ),
        ] {
            let found = property(definition);
            let text = format!("yes, proved: each of its {steps} steps is constrained");
            assert_eq!(found.to_string(), text, "{definition}");
        }
    }

    /// The adjoint of a step that keeps the constraints keeps them. Its coefficients have the end as the first stage and the start as the last.
    #[test]
    fn adjoints_of_methods_that_qualify_do() {
        for (definition, determinant) in [
            ("base: lobatto-2, adjoint: true", "0.500000"),
            ("base: lobatto-3, adjoint: true", "0.0208333"),
            ("base: lobatto-4, adjoint: true", "0.000277778"),
            // Not symmetric: computed in fractions from A* and Ã* with the stages 3, 2, 1.
            (
                "basis: polynomial(3), nodes: [0, 1/4, 1], adjoint: true",
                "-0.0295139",
            ),
            (
                "basis: [1, cos(pi*t), sin(pi*t)], nodes: [0, 1/2, 1], adjoint: true",
                "0.0322515",
            ),
            // Lobatto IIIA–IIIB with three stages, in an order of its own.
            (
                "a: [[1/3, 5/24, -1/24], [0, 0, 0], [2/3, 1/6, 1/6]], b: [2/3, 1/6, 1/6], a_tilde: symplectic_partner",
                "0.0208333",
            ),
        ] {
            let found = property(definition);
            assert!(found.holds, "{definition}: {found}");
            let witness = found.witness.expect("a determinant");
            assert!(witness.contains(determinant), "{definition}: {witness}");
        }
        for (definition, steps) in [
            ("base: lobatto-2, weights: [1/2, adjoint(1/2)]", 2),
            ("base: lobatto-3, weights: [1/4, adjoint(1/2), 1/4]", 3),
            ("base: lobatto-3, weights: triple_jump(6), adjoint: true", 3),
            (
                "base: [base: lobatto-2, weights: [1/2, adjoint(1/2)]], weights: triple_jump(4)",
                6,
            ),
            (
                "base: [base: symplectic-euler, weights: [adjoint(1/2), 1/2]], weights: triple_jump(4)",
                6,
            ),
            (
                "compose: [[3/2, base: lobatto-3, adjoint: true], [-1/2, base: lobatto-2]]",
                2,
            ),
        ] {
            let text = format!("yes, proved: each of its {steps} steps is constrained");
            assert_eq!(property(definition).to_string(), text, "{definition}");
        }
    }

    /// Three stages with `a_2j = c b_j` up to `change` in `a_21`: `det X = b_1 b_2 (Σ_j a_2j²/b_j − c_2²)` is zero without the change,
    /// and `5/9 change²` with it.
    fn three_stages(c: &str, change: &str) -> Property {
        // ã_ij = b_j (1 − a_ji/b_i)
        property(&format!(
            "a: [[0, 0, 0], [{c}/6 + {change}, 2/3*{c}, {c}/6], [1/6, 2/3, 1/6]], b: [1/6, 2/3, 1/6], \
             a_tilde: [[1/6, 2/3 - 2/3*{c} - 4*{change}, 0], [1/6, 2/3 - 2/3*{c}, 0], [1/6, 2/3 - 2/3*{c}, 0]], \
             b_tilde: [1/6, 2/3, 1/6]"
        ))
    }

    /// No two stages coincide, and yet the multipliers are not unique.
    #[test]
    fn a_zero_determinant_is_decided_exactly() {
        for c in ["1/2", "sqrt(3)/3", "cos(1)"] {
            let found = three_stages(c, "0");
            assert_eq!(found.to_string(), "no, refuted: det (A Ã) = 0", "{c}");
            let found = three_stages(c, "1/10^30");
            assert!(found.holds, "{c}: {found}");
            assert!(
                found.witness.expect("a determinant").contains("e-61"),
                "{c}"
            );
        }
    }

    /// Expressions of two transcendental numbers have no exact arithmetic.
    #[test]
    fn a_zero_determinant_of_expressions_remains_undecided() {
        let c = "cos(1)*exp(1)/3";
        let found = three_stages(c, "0");
        assert!(!found.holds, "{found}");
        assert_eq!(
            found.evidence,
            Evidence::Undecided { bits: 4096 },
            "{found}"
        );
        assert!(
            found
                .to_string()
                .contains("det (A Ã) cannot be told from zero"),
            "{found}"
        );
        assert!(three_stages(c, "1/10^30").holds);
    }

    #[test]
    fn symplectic_euler_and_its_adjoint_end_on_the_constraints() {
        for (node, witness) in [(0, "q1 is a second stage"), (1, "q0 is a stage")] {
            let found = property(&format!("basis: polynomial(1), nodes: [{node}]"));
            assert!(found.holds && found.evidence == Evidence::Proved, "{found}");
            assert!(found.to_string().contains(witness), "{found}");
        }
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
