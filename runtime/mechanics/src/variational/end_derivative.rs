//! Derivative of the end of a step with respect to the position or momentum at its start, by central differences.

use crate::Error;
use alloc::vec;
use alloc::vec::Vec;

use num_traits::Float;

use crate::variational::regular::{Factors, Singular, largest};
use symplectic_core::Vector;

/// Length of a difference relative to the unknown, about the cube root of the rounding error.
const DIFFERENCE: f64 = 6e-6;
/// A movement of the end whose half is at most this, relative to the end, is a rounding error: 27 ε.
const NOISE: f64 = 6e-15;
/// The smallest length, and the largest for an unknown that is zero: 2^−200 and 2^200.
const LENGTHS: [f64; 2] = [6.2e-61, 1.6e60];
/// A length that does not move the end measurably grows by this factor: at most 40 times between these bounds.
const GROWTH: f64 = 1024.0;

/// The derivative, and lengths of differences that move the end measurably.
pub(super) struct EndDerivative {
    /// `l_j ∂end_i/∂x_j`, by rows, for the length `l_j` of the difference of column j.
    moves: Vec<f64>,
    lengths: Vec<f64>,
    scaled: Vec<f64>,
    factors: Factors,
}

impl EndDerivative {
    pub(super) fn new(n: usize) -> Self {
        Self {
            moves: vec![0.0; n * n],
            lengths: vec![LENGTHS[0]; n],
            scaled: vec![0.0; n * n],
            factors: Factors::new(n),
        }
    }

    /// `Σ_j |∂end_i/∂x_j| |x_j|` for component i of the end.
    pub(super) fn terms(&self, i: usize, x: &[f64]) -> f64 {
        let row = self.row(i).iter().zip(&self.lengths).zip(x);
        row.map(|((moved, length), x)| Float::abs(moved / length * x))
            .sum()
    }

    fn row(&self, i: usize) -> &[f64] {
        let n = self.lengths.len();
        &self.moves[i * n..][..n]
    }

    /// Measures the derivative. `shifted(j, by)` is the end with `x_j` shifted; `unknown` are x and the same quantity at the end, which set
    /// the scale of x; `sizes` are the sizes of the components of the end. A length grows up to the largest unknown or its last value. For
    /// an unknown that is zero it starts at its last value and grows without this limit.
    ///
    /// # Errors
    ///
    /// Those of a step from the first length of a column.
    pub(super) fn measure<V: Vector<Scalar = f64>>(
        &mut self,
        unknown: [&[f64]; 2],
        sizes: &[f64],
        shifted: impl Fn(usize, f64) -> Result<V, Error>,
    ) -> Result<(), Error> {
        let n = self.lengths.len();
        let of_all = largest(&unknown.map(largest));
        for (j, length) in self.lengths.iter_mut().enumerate() {
            let own = largest(&unknown.map(|unknown| unknown[j]));
            let limit = if own > 0.0 {
                let last = core::mem::replace(length, LENGTHS[0].max(DIFFERENCE * own));
                of_all.max(last)
            } else {
                LENGTHS[1]
            };
            let both =
                |by: f64| -> Result<[V; 2], Error> { Ok([shifted(j, -by)?, shifted(j, by)?]) };
            let mut ends = both(*length)?;
            loop {
                let [low, high] = ends.each_ref().map(Vector::as_slice);
                let mut is_measured = false;
                for (i, size) in sizes.iter().enumerate() {
                    let moved = (high[i] - low[i]) / 2.0;
                    self.moves[i * n + j] = moved;
                    is_measured |= Float::abs(moved) > NOISE * size;
                }
                if is_measured || *length >= limit {
                    break;
                }
                let longer = limit.min(GROWTH * *length);
                // A long difference may leave the domain of H.
                let Ok(longer_ends) = both(longer) else { break };
                (*length, ends) = (longer, longer_ends);
            }
        }
        Ok(())
    }

    /// Adds the solution of `Σ_j ∂end_i/∂x_j Δx_j = right_i` to x. Rows are relative to `sizes`, columns to the lengths.
    pub(super) fn solve(
        &mut self,
        right: &[f64],
        sizes: &[f64],
        x: &mut [f64],
    ) -> Result<(), Singular> {
        let n = self.lengths.len();
        let sizes = || {
            let rows = self.moves.chunks_exact(n.max(1)).zip(sizes);
            rows.map(|(row, size)| size.max(largest(row)))
        };
        let rows = self.scaled.chunks_exact_mut(n.max(1));
        for ((scaled, row), size) in rows.zip(self.moves.chunks_exact(n.max(1))).zip(sizes()) {
            for (scaled, moved) in scaled.iter_mut().zip(row) {
                *scaled = if size > 0.0 { moved / size } else { 0.0 };
            }
        }
        self.factors.factor_above(&self.scaled, NOISE)?;
        let right = right.iter().zip(sizes()).map(|(right, size)| right / size);
        let changes = self.factors.solve(right);
        for ((x, change), length) in x.iter_mut().zip(changes).zip(&self.lengths) {
            *x += change * length;
        }
        Ok(())
    }
}
