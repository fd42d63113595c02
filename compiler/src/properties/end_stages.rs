//! Stages that coincide with the ends of the step.

use super::{Examined, Property, shown};
use crate::algebra::Number;
use crate::tableau::subscript;

/// Decides `a_1j = 0`.
pub(super) fn first_row_zero(examined: &Examined<'_>) -> Property {
    let row = examined.numbers.a.first().map_or(&[][..], Vec::as_slice);
    match row.iter().enumerate().find(|(_, entry)| !entry.is_zero()) {
        None => Property::proved(None),
        Some((j, entry)) => {
            Property::refuted(format!("a_{} = {}", subscript(1, j + 1), shown(entry)))
        }
    }
}

/// Decides `a_sj = b_j`.
pub(super) fn stiffly_accurate(examined: &Examined<'_>) -> Property {
    let tableau = examined.tableau;
    let last = tableau.stages() - 1;
    // b_j − a_ij is an element of K ⊗ K whose last row is in question.
    let residual = tableau.adjoint().a;
    let differences = Number::of_tensor(&tableau.algebra, &residual).swap_remove(last);
    match differences
        .iter()
        .enumerate()
        .find(|(_, entry)| !entry.is_zero())
    {
        None => Property::proved(None),
        Some((j, entry)) => Property::refuted(format!(
            "b_{} − a_{} = {}",
            j + 1,
            subscript(last + 1, j + 1),
            shown(entry)
        )),
    }
}

/// Decides whether the last position stage of a step is the first of the next.
pub(super) fn first_same_as_last(examined: &Examined<'_>) -> Property {
    let ends = [first_row_zero(examined), stiffly_accurate(examined)];
    ends.into_iter()
        .find(|end| !end.holds)
        .unwrap_or_else(|| Property::proved(Some("Q_s = q1 is Q_1 of the next step".to_owned())))
}
