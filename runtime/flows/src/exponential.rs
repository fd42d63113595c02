//! The exponential of a matrix.

use alloc::vec::Vec;

use num_traits::Float;

use super::FlowError;
use symplectic_core::Quantity;

/// The largest estimated relative error of an exponential.
const LARGEST_ERROR: f64 = 1e-3;

/// The highest power in the exponential series.
const POWERS: u32 = 15;

/// `e^{hA} − 1` of a matrix A with n rows, row by row: see [`Linear`](super::Linear).
pub(super) fn exponential(n: usize, matrix: &[f64], h: f64) -> Result<Vec<f64>, FlowError> {
    let column = |j: usize| (0..n).map(|i| matrix[i * n + j].abs()).sum::<f64>();
    let norm = (0..n).map(column).fold(0.0, f64::max) * h.abs();
    let error = norm * n as f64 * f64::EPSILON;
    if error.is_nan() || error > LARGEST_ERROR {
        return Err(FlowError::Other {
            reason: "the step is so long that less than three digits of the linear flow are known; take a smaller step",
        });
    }
    let (mut scale, mut squarings) = (1.0, 0);
    while norm * scale > 0.5 {
        scale /= 2.0;
        squarings += 1;
    }
    let x: Vec<f64> = matrix.iter().map(|a| a * h * scale).collect();
    // X(1 + X/2 (1 + X/3 (1 + …))).
    let mut sum = x.clone();
    for power in (2..=POWERS).rev() {
        let mut inner: Vec<f64> = sum.iter().map(|e| e / f64::from(power)).collect();
        (0..n).for_each(|i| inner[i * n + i] += 1.0);
        sum = product(n, &x, &inner);
    }
    for _ in 0..squarings {
        let square = product(n, &sum, &sum);
        sum.iter_mut()
            .zip(square)
            .for_each(|(e, square)| *e = 2.0 * *e + square);
    }
    let what = Quantity::Derivative;
    let finite = sum.iter().all(|e| Float::is_finite(*e));
    finite.then_some(sum).ok_or(FlowError::NonFinite { what })
}

/// The product of two matrices with n rows.
fn product(n: usize, left: &[f64], right: &[f64]) -> Vec<f64> {
    let entry = |place: usize| {
        let (i, j) = (place / n, place % n);
        (0..n).map(|k| left[i * n + k] * right[k * n + j]).sum()
    };
    (0..n * n).map(entry).collect()
}
