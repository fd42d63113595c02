//! Stages that coincide with the ends of the step.

use super::{Examined, Property, shown, vanishing};
use crate::algebra::StageAlgebra;
use crate::coefficients::subscript;

/// Decides `a_1j = 0`.
pub(super) fn first_row_zero<A: StageAlgebra>(examined: &Examined<'_, A>) -> Property {
    let row = examined.numbers.a.first().map_or(&[][..], Vec::as_slice);
    match vanishing(row) {
        Ok(evidence) => Property::holding(evidence, None),
        Err(j) => Property::refuted(format!("a_{} = {}", subscript(1, j + 1), shown(&row[j]))),
    }
}

/// Decides `a_sj = b_j`.
pub(super) fn stiffly_accurate<A: StageAlgebra>(examined: &Examined<'_, A>) -> Property {
    let algebra = &*examined.pair.algebra;
    let last = algebra.stages() - 1;
    // b_j − a_ij is a matrix whose last row is in question.
    let residual = examined.pair.adjoint().a;
    let differences = algebra.row(&residual, last);
    match vanishing(&differences) {
        Ok(evidence) => Property::holding(evidence, None),
        Err(j) => Property::refuted(format!(
            "b_{} − a_{} = {}",
            j + 1,
            subscript(last + 1, j + 1),
            shown(&differences[j])
        )),
    }
}

/// Decides whether the last position stage of a step is the first of the next.
pub(super) fn first_same_as_last<A: StageAlgebra>(examined: &Examined<'_, A>) -> Property {
    let [first, last] = [first_row_zero(examined), stiffly_accurate(examined)];
    if !first.holds {
        return first;
    }
    if !last.holds {
        return last;
    }
    let witness = "Q_s = q1 is Q_1 of the next step".to_owned();
    Property::holding(first.evidence.and(last.evidence), Some(witness))
}
