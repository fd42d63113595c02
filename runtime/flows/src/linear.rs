//! The exact flow of linear systems.

use alloc::vec;
use alloc::vec::Vec;

use nalgebra::DMatrix;

use super::exponential::exponential;
use super::{Flow, FlowError, Span, check_count, check_dimension, check_parameter};
use crate::Error;
use symplectic_core::Vector;

/// The flow of a linear system: `z' = Az` with `z = (q, p)`, so `z ← e^{hA} z`.
///
/// `E = e^{hA} − 1` is computed once for each duration h (a method has only a few) by scaling and squaring (Moler & Van Loan, *SIAM Rev.*
/// 45, 2003, method 3). The 1-norm (largest column sum) of `2^{−s} hA` is at most 1/2, and its exponential series is summed up to the power
/// 15; the remainder is below 10⁻¹⁸. Then `(1 + E)² − 1 = 2E + E²` is applied s times.
///
/// If `e^{hA}` is bounded, the relative error and the deviation from symplecticity are about `nε(1 + ‖hA‖)`. If `nε‖hA‖` exceeds 1/1000,
/// the flow fails with [`FlowError::Other`]; if `e^{hA}` overflows, with [`FlowError::NonFinite`].
///
/// The first flow of a new duration allocates. Up to 64 durations are kept; the next one discards them all.
///
/// ```
/// use symplectic::flow::{Flow, Linear, Span};
/// use symplectic::nalgebra::{DMatrix, Vector1};
///
/// // H = p²/2 + 9q²/2.
/// let mut spring = Linear::oscillators(&[1.0], &DMatrix::from_element(1, 1, 9.0))?;
/// let (mut q, mut p) = (Vector1::new(1.0), Vector1::new(0.0));
/// spring.flow(Span { time: 0.0, size: 10.0 }, &mut q, &mut p).expect("a flow");
/// assert!((q[0] - 30.0_f64.cos()).abs() < 1e-14);
/// # Ok::<(), symplectic::flow::Error>(())
/// ```
#[derive(Clone, Debug)]
pub struct Linear {
    /// Number of components of the state, 2n.
    size: usize,
    /// A, row by row.
    matrix: Vec<f64>,
    /// Pairs of a duration h and `e^{hA} − 1`, row by row.
    exponentials: Vec<(f64, Vec<f64>)>,
    state: Vec<f64>,
}

/// The largest number of durations that are kept.
const MAX_EXPONENTIALS: usize = 64;

impl Linear {
    /// The flow of `z' = Az` for this matrix A, with 2n rows and columns.
    ///
    /// # Errors
    ///
    /// [`Error::FlowParameter`] for a matrix that is not square or has an odd number of rows, and for an entry that is not finite.
    pub fn new(matrix: &DMatrix<f64>) -> Result<Self, Error> {
        let (size, columns) = matrix.shape();
        check_count(
            "number of rows of the matrix",
            size,
            size == columns && size % 2 == 0,
            "even, and the number of columns",
        )?;
        let entries: Vec<f64> = matrix.transpose().iter().copied().collect();
        for (index, &value) in entries.iter().enumerate() {
            if !value.is_finite() {
                let (what, range) = ("entry of the matrix", "finite");
                return Err(Error::FlowParameter {
                    what,
                    index,
                    value,
                    range,
                });
            }
        }
        Ok(Self {
            size,
            matrix: entries,
            exponentials: Vec::new(),
            state: vec![0.0; size],
        })
    }

    /// The flow of `H = Σ p_k²/(2m_k) + qᵀKq/2` with these masses and a symmetric stiffness K.
    ///
    /// # Errors
    ///
    /// Those of [`new`](Self::new). [`Error::FlowParameter`] if a mass is not finite and positive, or the stiffness is not symmetric: two
    /// mirrored entries differ by more than 10⁻¹² of the geometric mean of the
    /// largest entries of their rows.
    pub fn oscillators(masses: &[f64], stiffness: &DMatrix<f64>) -> Result<Self, Error> {
        let n = masses.len();
        check_count(
            "number of masses",
            n,
            stiffness.shape() == (n, n),
            "that of the rows and of the columns of the stiffness",
        )?;
        for (index, &mass) in masses.iter().enumerate() {
            check_parameter("mass", index, mass, false)?;
        }
        // Rounding errors are relative to the largest entries of both rows; entries that are not finite have their own error.
        let largest: Vec<f64> = (0..n).map(|i| stiffness.row(i).amax()).collect();
        for i in 0..n {
            for j in 0..i {
                let (value, mirrored) = (stiffness[(i, j)], stiffness[(j, i)]);
                let scale = num_traits::Float::sqrt(largest[i] * largest[j]);
                if (value - mirrored).abs() > 1e-12 * scale {
                    let (what, index) = ("stiffness", i * n + j);
                    let range =
                        "equal to the entry with exchanged indices: the matrix is symmetric";
                    return Err(Error::FlowParameter {
                        what,
                        index,
                        value,
                        range,
                    });
                }
            }
        }
        Self::new(&DMatrix::from_fn(2 * n, 2 * n, |i, j| {
            if i < n && j == i + n {
                1.0 / masses[i]
            } else if i >= n && j < n {
                -stiffness[(i - n, j)]
            } else {
                0.0
            }
        }))
    }

    /// Number of components of the position.
    pub(super) const fn dimension(&self) -> usize {
        self.size / 2
    }

    /// The matrix, row by row, that maps initial positions to the mean positions of the motion from rest over the time τ = `duration`. It
    /// is the position block of `1/τ ∫_0^τ e^{sA} ds`, which is a block of `e^{τB}/τ` with `B = (A, 1; 0, 0)`.
    pub(super) fn mean_positions(&self, duration: f64) -> Result<Vec<f64>, FlowError> {
        let (n, size) = (self.size / 2, self.size);
        let rows = size + n;
        let mut extended = vec![0.0; rows * rows];
        for (i, row) in self.matrix.chunks_exact(size.max(1)).enumerate() {
            extended[i * rows..i * rows + size].copy_from_slice(row);
        }
        (0..n).for_each(|i| extended[i * rows + size + i] = 1.0);
        let exponential = exponential(rows, &extended, duration)?;
        let mean = |place: usize| {
            let (i, j) = (place / n, place % n);
            match duration == 0.0 {
                true => f64::from(i == j),
                false => exponential[i * rows + size + j] / duration,
            }
        };
        Ok((0..n * n).map(mean).collect())
    }

    /// The index of `e^{hA} − 1` in `exponentials`; computes the matrix if it is missing.
    fn place(&mut self, h: f64) -> Result<usize, FlowError> {
        if let Some(found) = self.exponentials.iter().position(|(size, _)| *size == h) {
            return Ok(found);
        }
        let exponential = exponential(self.size, &self.matrix, h)?;
        if self.exponentials.len() == MAX_EXPONENTIALS {
            self.exponentials.clear();
        }
        self.exponentials.push((h, exponential));
        Ok(self.exponentials.len() - 1)
    }
}

impl<V: Vector<Scalar = f64>> Flow<V> for Linear {
    fn flow(&mut self, span: Span, q: &mut V, p: &mut V) -> Result<(), FlowError> {
        let (n, size) = (self.size / 2, self.size);
        check_dimension(n, q)?;
        check_dimension(n, p)?;
        if n == 0 {
            return Ok(());
        }
        let place = self.place(span.size)?;
        let (q, p) = (q.as_mut_slice(), p.as_mut_slice());
        self.state[..n].copy_from_slice(q);
        self.state[n..].copy_from_slice(p);
        let rows = self.exponentials[place].1.chunks_exact(size);
        for (z, row) in q.iter_mut().chain(p).zip(rows) {
            *z += row.iter().zip(&self.state).map(|(e, z)| e * z).sum::<f64>();
        }
        Ok(())
    }
}
