//! One matrix for positions and momenta.

use super::{Entry, Evidence, Examined, Property, vanishing_matrix, vanishing_vector};
use crate::algebra::StageAlgebra;

/// Decides `ã = a` and `b̃ = b`.
pub(super) fn decide<A: StageAlgebra>(examined: &Examined<'_, A>) -> Property {
    let pair = examined.pair;
    let algebra = &*pair.algebra;
    if pair.equal_halves() == (true, true) {
        return Property::holding(Evidence::Proved, None);
    }
    let matrices = algebra.subtract_matrices(&pair.a, &pair.a_tilde);
    let evidence = match vanishing_matrix(algebra, &matrices) {
        Ok(evidence) => evidence,
        Err(Entry { index, value, .. }) => {
            return Property::refuted(format!("a_{index} − ã_{index} = {value}"));
        }
    };
    match vanishing_vector(algebra, &algebra.subtract(&pair.b, &pair.b_tilde)) {
        Ok(weights) => Property::holding(evidence.and(weights), None),
        Err((i, value)) => Property::refuted(format!("b_{i} − b̃_{i} = {value}")),
    }
}
