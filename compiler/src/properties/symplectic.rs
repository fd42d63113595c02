//! Symplecticity (MW 2.6.7).

use super::{Entry, Examined, Property, vanishing_matrix, vanishing_vector};
use crate::algebra::StageAlgebra;

/// Decides `b_i ã_ij + b̃_j a_ji = b_i b̃_j` and `b = b̃`.
pub(super) fn decide<A: StageAlgebra>(examined: &Examined<'_, A>) -> Property {
    if let Some(refuted) = examined.refuted_by_gradient_kicks() {
        return refuted;
    }
    let pair = examined.pair;
    let algebra = &*pair.algebra;
    let weights = match vanishing_vector(algebra, &algebra.subtract(&pair.b, &pair.b_tilde)) {
        Ok(evidence) => evidence,
        Err((i, value)) => return Property::refuted(format!("b_{i} − b̃_{i} = {value}")),
    };
    match decide_matrices(examined) {
        Property {
            holds: true,
            evidence,
            ..
        } => Property::holding(evidence.and(weights), None),
        refuted => refuted,
    }
}

/// Decides `b_i ã_ij + b̃_j a_ji = b_i b̃_j`, which is enough for separable Hamiltonians.
pub(super) fn decide_matrices<A: StageAlgebra>(examined: &Examined<'_, A>) -> Property {
    let pair = examined.pair;
    let algebra = &*pair.algebra;
    let momenta = algebra.scale_rows(&pair.a_tilde, &pair.b);
    let positions = algebra.transpose(&algebra.scale_rows(&pair.a, &pair.b_tilde));
    let residual = algebra.subtract_matrices(
        &algebra.add_matrices(&momenta, &positions),
        &algebra.outer(&pair.b, &pair.b_tilde),
    );
    match vanishing_matrix(algebra, &residual) {
        Ok(evidence) => Property::holding(evidence, None),
        Err(Entry {
            index,
            transposed,
            row,
            column,
            value,
        }) => Property::refuted(format!(
            "b_{row} ã_{index} + b̃_{column} a_{transposed} − b_{row} b̃_{column} = {value}"
        )),
    }
}
