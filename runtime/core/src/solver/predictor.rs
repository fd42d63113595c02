//! Predictor: stage values at the start of an iteration, directly from the increments of the previous step.

use core::marker::PhantomData;

use crate::contract::{HalfTableau, StageTableau};

/// The largest number of stages whose starting values are computed directly.
pub const MAX_STAGES: usize = 16;

/// The columns of `μ E`. The matrix `E` extrapolates the increments of one half to the next step, and `μ` turns them into stage values
/// of the other half. The product is rounded to doubles, because it only gives starting values.
pub type StartingColumns = [[f64; MAX_STAGES]; MAX_STAGES];

/// Whether the increments of a half can be extrapolated, and are few enough for `starting_columns`.
pub const fn starts_at_once(half: &HalfTableau) -> bool {
    !half.extrapolation.is_empty() && half.extrapolation.len() <= MAX_STAGES
}

/// The product of the matrix with these columns and the extrapolation matrix of a half; zero if the half does not
/// [start at once](starts_at_once).
pub(crate) const fn starting_columns(matrix: &[&[f64]], half: &HalfTableau) -> StartingColumns {
    let mut product = [[0.0; MAX_STAGES]; MAX_STAGES];
    if !starts_at_once(half) {
        return product;
    }
    let extrapolation = half.extrapolation;
    let mut k = 0;
    while k < extrapolation.len() {
        let mut j = 0;
        while j < matrix.len() {
            let mut i = 0;
            while i < matrix[j].len() && i < MAX_STAGES {
                product[k][i] += matrix[j][i] * extrapolation[k][j];
                i += 1;
            }
            j += 1;
        }
        k += 1;
    }
    product
}

/// Multiplies each column by its weight.
pub(crate) const fn weighted(columns: &StartingColumns, weights: &[f64]) -> StartingColumns {
    let mut product = *columns;
    let mut k = 0;
    while k < MAX_STAGES && k < weights.len() {
        let mut i = 0;
        while i < MAX_STAGES {
            product[k][i] *= weights[k];
            i += 1;
        }
        k += 1;
    }
    product
}

/// The `starting_columns` for positions and for momenta.
pub struct Starting<P>(PhantomData<P>);

impl<P: StageTableau> Starting<P> {
    /// The columns for positions.
    pub const POSITIONS: &'static StartingColumns =
        &starting_columns(P::POSITIONS.columns, &P::MOMENTA);
    /// The columns for momenta.
    pub const MOMENTA: &'static StartingColumns =
        &starting_columns(P::MOMENTA.columns, &P::POSITIONS);
}
