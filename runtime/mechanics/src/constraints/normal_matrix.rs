//! The matrix `S = G M⁻¹ Gᵀ` of the constraints, and its factors.

use alloc::vec;
use alloc::vec::Vec;

use super::Gradients;
use super::metric::InverseMasses;
use symplectic_core::solver::{Failure, Visit, scalar_words};
use symplectic_core::{Quantity, Scalar};

/// The products of entries of G that make up the entries of S.
#[derive(Clone, Debug)]
pub(super) struct Products {
    /// Two entries of G in the same column, the constraints of both (the second is not larger than the first), and the column.
    pairs: Vec<[u32; 5]>,
    half_bandwidth: usize,
}

impl Products {
    /// The products for gradients with this sparsity pattern. With [`InverseMasses::Full`] there are none, and the matrix is full.
    pub(super) fn new<T: Scalar>(gradients: &Gradients<T>, masses: &InverseMasses<T>) -> Self {
        if *masses == InverseMasses::Full {
            return Self {
                pairs: Vec::new(),
                half_bandwidth: gradients.constraints().saturating_sub(1),
            };
        }
        // The entries of each column, column by column.
        let mut by_column: Vec<(usize, usize, usize)> = gradients
            .entries()
            .enumerate()
            .map(|(entry, (constraint, component, _))| (component, constraint, entry))
            .collect();
        by_column.sort_unstable();
        let columns = || by_column.chunk_by(|a, b| a.0 == b.0);
        let widths = columns().map(|column| column[column.len() - 1].1 - column[0].1);
        let half_bandwidth = widths.max().unwrap_or(0);
        let mut pairs = Vec::new();
        for column in columns() {
            for (number, &(component, row, entry)) in column.iter().enumerate() {
                for &(_, other_row, other) in &column[..=number] {
                    pairs.push([entry, other, row, other_row, component].map(|x| x as u32));
                    // Two entries of one constraint in one column count in both orders.
                    if row == other_row && entry != other {
                        pairs.push([other, entry, row, other_row, component].map(|x| x as u32));
                    }
                }
            }
        }
        Self {
            pairs,
            half_bandwidth,
        }
    }
}

impl Products {
    pub(super) const fn half_bandwidth(&self) -> usize {
        self.half_bandwidth
    }

    /// Two entries of G in the same column, the constraints of both (the second is not larger than the first), and the column.
    #[inline]
    pub(super) fn pairs(&self) -> impl Iterator<Item = [usize; 5]> {
        self.pairs.iter().map(|pair| pair.map(|x| x as usize))
    }
}

/// A symmetric band matrix: row k holds the entries from column `k − half_bandwidth` to k. The factors `L D Lᵀ` take the same places.
#[derive(Clone, Debug)]
pub(super) struct NormalMatrix<T> {
    size: usize,
    half_bandwidth: usize,
    rows: Vec<T>,
}

impl<T: Scalar> NormalMatrix<T> {
    pub(super) fn new(size: usize, products: &Products) -> Self {
        let half_bandwidth = products.half_bandwidth;
        Self {
            size,
            half_bandwidth,
            rows: vec![T::zero(); size * (half_bandwidth + 1)],
        }
    }

    #[inline]
    const fn place(&self, row: usize, column: usize) -> usize {
        row * self.half_bandwidth + self.half_bandwidth + column
    }

    /// `G M⁻¹ Gᵀ` with diagonal masses.
    pub(super) fn assemble(
        &mut self,
        products: &Products,
        masses: &InverseMasses<T>,
        gradients: &Gradients<T>,
    ) {
        let values = gradients.values();
        self.rows.fill(T::zero());
        match masses {
            InverseMasses::Diagonal(inverse) => {
                for [a, b, row, column, component] in products.pairs() {
                    let place = self.place(row, column);
                    self.rows[place] += values[a] * values[b] * inverse[component];
                }
            }
            _ => {
                for [a, b, row, column, _] in products.pairs() {
                    let place = self.place(row, column);
                    self.rows[place] += values[a] * values[b];
                }
            }
        }
    }

    /// Sets row `row` of `G M⁻¹ Gᵀ` from `direction`, which is `M⁻¹` times the gradient of that constraint; for a full matrix.
    pub(super) fn set_row(&mut self, row: usize, gradients: &Gradients<T>, direction: &[T]) {
        for column in 0..=row {
            let place = self.place(row, column);
            self.rows[place] = T::zero();
        }
        for (column, component, value) in gradients.entries().filter(|entry| entry.0 <= row) {
            let place = self.place(row, column);
            self.rows[place] += value * direction[component];
        }
    }

    /// Factors the matrix.
    ///
    /// # Errors
    /// [`Failure::DependentConstraints`] if a pivot is lost in rounding errors: the gradient of the constraint depends linearly on those of
    /// the previous constraints, or vanishes; [`Failure::NonFinite`].
    pub(super) fn factor(&mut self) -> Result<(), Failure> {
        let (size, half) = (self.size, self.half_bandwidth);
        for k in 0..size {
            let diagonal = self.rows[self.place(k, k)].magnitude();
            for column in k.saturating_sub(half)..=k {
                // Column by column: (k, column) −= Σ_j L_kj D_j L_column,j.
                let mut entry = self.rows[self.place(k, column)];
                for j in k.saturating_sub(half)..column {
                    let factor = self.rows[self.place(k, j)] * self.rows[self.place(j, j)];
                    if column - j <= half {
                        entry -= factor * self.rows[self.place(column, j)];
                    }
                }
                if column < k {
                    entry *= self.rows[self.place(column, column)].recip();
                }
                let place = self.place(k, column);
                self.rows[place] = entry;
            }
            let pivot = self.rows[self.place(k, k)].magnitude();
            if !(pivot.is_finite() && diagonal.is_finite()) {
                return Err(Failure::NonFinite {
                    what: Quantity::Constraint,
                    stage: None,
                });
            }
            let regular = pivot > LOST * T::EPSILON * diagonal;
            if !regular {
                return Err(Failure::DependentConstraints {
                    constraint: k,
                    // A gradient that vanishes has neither.
                    pivot: if diagonal == 0.0 {
                        0.0
                    } else {
                        pivot / diagonal
                    },
                });
            }
        }
        Ok(())
    }

    /// Solves for a right-hand side in place.
    pub(super) fn solve(&self, unknown: &mut [T]) {
        if let ([unknown], [pivot]) = (&mut *unknown, &*self.rows) {
            *unknown *= pivot.recip();
            return;
        }
        for k in 0..self.size {
            let (before, rest) = unknown.split_at_mut(k);
            let (row, first) = self.row(k);
            let products = row.iter().zip(&before[first..]);
            rest[0] = products.fold(rest[0], |sum, (&entry, &known)| sum - entry * known);
        }
        for (k, unknown) in unknown.iter_mut().enumerate() {
            *unknown *= self.rows[self.place(k, k)].recip();
        }
        for k in (0..self.size).rev() {
            let (before, rest) = unknown.split_at_mut(k);
            let (row, first) = self.row(k);
            for (unknown, &entry) in before[first..].iter_mut().zip(row) {
                *unknown -= entry * rest[0];
            }
        }
    }

    /// The entries of a row before the diagonal, and the column of the first.
    #[inline]
    fn row(&self, row: usize) -> (&[T], usize) {
        let first = row.saturating_sub(self.half_bandwidth);
        (
            &self.rows[self.place(row, first)..self.place(row, row)],
            first,
        )
    }

    /// The words of the factors.
    pub(super) fn words(&mut self, visit: &mut Visit<'_>) {
        scalar_words(&mut self.rows, visit);
    }
}

/// A pivot below this many units of rounding of its diagonal entry has no correct digit.
const LOST: f64 = 4096.0;
