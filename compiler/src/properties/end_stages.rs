//! Stages that coincide with the ends of the step.

use super::{Evidence, Examined, Property, shown, vanishing};
use crate::algebra::StageAlgebra;
use crate::coefficients::subscript;

/// Decides `a_1j = 0`.
pub(super) fn first_row_zero<A: StageAlgebra>(examined: &Examined<'_, A>) -> Property {
    is_start(examined, 0)
}

/// Decides `a_sj = b_j`.
pub(super) fn stiffly_accurate<A: StageAlgebra>(examined: &Examined<'_, A>) -> Property {
    let last = examined.pair.algebra.stages() - 1;
    is_end(examined, &examined.pair.adjoint().a, last)
}

/// Decides `a_ij = 0` for a stage i.
fn is_start<A: StageAlgebra>(examined: &Examined<'_, A>, i: usize) -> Property {
    let row = &examined.numbers.a[i];
    match vanishing(row) {
        Ok(evidence) => Property::holding(evidence, None),
        Err(j) => Property::refuted(format!(
            "a_{} = {}",
            subscript(i + 1, j + 1),
            shown(&row[j])
        )),
    }
}

/// Decides `a_ij = b_j` for a stage i, given the matrix of all `b_j − a_ij`.
fn is_end<A: StageAlgebra>(examined: &Examined<'_, A>, residual: &A::Matrix, i: usize) -> Property {
    let differences = examined.pair.algebra.row(residual, i);
    match vanishing(&differences) {
        Ok(evidence) => Property::holding(evidence, None),
        Err(j) => Property::refuted(format!(
            "b_{} − a_{} = {}",
            j + 1,
            subscript(i + 1, j + 1),
            shown(&differences[j])
        )),
    }
}

/// The stages of a method that are the ends of its step, whatever their labels.
pub(super) struct Ends {
    /// `Q_i = q0`, which is the first stage in the order of ascending nodes.
    pub start: usize,
    /// `Q_i = q1`, which is the last one.
    pub end: usize,
    /// How that is known.
    pub evidence: Evidence,
}

impl Ends {
    /// Finds them; the error says why the first stage is not the start, or the last not the end.
    pub fn find<A: StageAlgebra>(examined: &Examined<'_, A>) -> Result<Self, Property> {
        let stages = examined.pair.algebra.stages();
        let residual = examined.pair.adjoint().a;
        let (start, at_start) = first_that_holds(0..stages, |i| is_start(examined, i))?;
        let (end, at_end) =
            first_that_holds((0..stages).rev(), |i| is_end(examined, &residual, i))?;
        Ok(Ends {
            start,
            end,
            evidence: at_start.evidence.and(at_end.evidence),
        })
    }

    /// The stages with the start first and the end last.
    pub fn order(&self, stages: usize) -> Vec<usize> {
        let between = (0..stages).filter(|i| ![self.start, self.end].contains(i));
        let start = std::iter::once(self.start);
        start.chain(between).chain([self.end]).collect()
    }
}

/// The first stage with a property, or the property of the first stage.
fn first_that_holds(
    mut stages: impl Iterator<Item = usize> + Clone,
    property: impl Fn(usize) -> Property,
) -> Result<(usize, Property), Property> {
    let decided = stages.clone().map(|i| (i, property(i)));
    match decided.into_iter().find(|(_, property)| property.holds) {
        Some(found) => Ok(found),
        None => Err(property(stages.next().unwrap_or_default())),
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
