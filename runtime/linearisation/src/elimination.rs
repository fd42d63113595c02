//! Gaussian elimination of banded matrices.

use alloc::vec;
use alloc::vec::Vec;
use core::ops::{Add, Mul, Neg, Sub};

use symplectic_core::Scalar;
use symplectic_core::inside::words;
use symplectic_core::solver::Visit;

/// A number of a field.
pub trait Entry: Copy + Add<Output = Self> + Sub<Output = Self> + Mul<Output = Self> {
    /// 0
    fn zero() -> Self;
    /// Its words, for checkpoints.
    fn words(&mut self, visit: &mut Visit<'_>);
    /// A norm, for the choice of the pivots.
    fn size(self) -> f64;
    /// 1/x
    fn inverse(self) -> Self;
}

impl<T: Scalar> Entry for T {
    #[cfg_attr(not(debug_assertions), inline(always))]
    fn zero() -> Self {
        T::zero()
    }

    fn words(&mut self, visit: &mut Visit<'_>) {
        self.as_words(visit);
    }

    #[cfg_attr(not(debug_assertions), inline(always))]
    fn size(self) -> f64 {
        self.magnitude()
    }

    #[cfg_attr(not(debug_assertions), inline(always))]
    fn inverse(self) -> Self {
        self.recip()
    }
}

/// A complex number.
#[derive(Clone, Copy, Debug)]
pub struct Complex<T> {
    /// The real part.
    pub re: T,
    /// The imaginary part.
    pub im: T,
}

impl<T: Add<Output = T>> Add for Complex<T> {
    type Output = Self;
    #[cfg_attr(not(debug_assertions), inline(always))]
    fn add(self, other: Self) -> Self {
        Self {
            re: self.re + other.re,
            im: self.im + other.im,
        }
    }
}

impl<T: Sub<Output = T>> Sub for Complex<T> {
    type Output = Self;
    #[cfg_attr(not(debug_assertions), inline(always))]
    fn sub(self, other: Self) -> Self {
        Self {
            re: self.re - other.re,
            im: self.im - other.im,
        }
    }
}

impl<T: Copy + Add<Output = T> + Sub<Output = T> + Mul<Output = T>> Mul for Complex<T> {
    type Output = Self;
    #[cfg_attr(not(debug_assertions), inline(always))]
    fn mul(self, other: Self) -> Self {
        Self {
            re: self.re * other.re - self.im * other.im,
            im: self.re * other.im + self.im * other.re,
        }
    }
}

impl<T: Scalar + Neg<Output = T>> Entry for Complex<T> {
    #[cfg_attr(not(debug_assertions), inline(always))]
    fn zero() -> Self {
        Self {
            re: T::zero(),
            im: T::zero(),
        }
    }

    fn words(&mut self, visit: &mut Visit<'_>) {
        self.re.as_words(visit);
        self.im.as_words(visit);
    }

    #[cfg_attr(not(debug_assertions), inline(always))]
    fn size(self) -> f64 {
        self.re.magnitude() + self.im.magnitude()
    }

    /// Scaled by the larger part, so that no square overflows (Smith).
    #[inline]
    fn inverse(self) -> Self {
        let Self { re, im } = self;
        if re.magnitude() >= im.magnitude() {
            let ratio = im / re;
            let denominator = (re + im * ratio).recip();
            Self {
                re: denominator,
                im: -(ratio * denominator),
            }
        } else {
            let ratio = re / im;
            let denominator = (re * ratio + im).recip();
            Self {
                re: ratio * denominator,
                im: -denominator,
            }
        }
    }
}

/// The factors of a banded square matrix, with partial pivoting (Golub & Van Loan, *Matrix Computations*, 4.3.5). Its entries `(i, j)` are
/// zero if `|i − j|` exceeds the half bandwidth.
#[derive(Clone, Debug)]
pub struct Elimination<E> {
    size: usize,
    half_bandwidth: usize,
    /// Number of stored entries of a row; the whole row where a band would need more.
    width: usize,
    /// By rows; the diagonal holds the inverses of the pivots.
    entries: Vec<E>,
    /// The row that each row was exchanged with.
    pivots: Vec<usize>,
    /// The right-hand side.
    pub right: Vec<E>,
}

impl<E: Entry> Elimination<E> {
    /// Memory for matrices of this size.
    pub fn new(size: usize, half_bandwidth: usize) -> Self {
        // Row exchanges add another half bandwidth beyond the band.
        let width = half_bandwidth.saturating_mul(3).saturating_add(1).min(size);
        Self {
            size,
            half_bandwidth,
            width,
            entries: vec![E::zero(); size * width],
            pivots: vec![0; size],
            right: vec![E::zero(); size],
        }
    }

    /// The factors, for checkpoints.
    pub fn words(&mut self, visit: &mut Visit<'_>) {
        for entry in &mut self.entries {
            entry.words(visit);
        }
        words!(visit: self.pivots[..]);
        // A checkpoint that someone changed must not lead outside the matrix; its numbers are not checked otherwise.
        let last = self.size.saturating_sub(1);
        self.pivots.iter_mut().for_each(|row| *row = last.min(*row));
    }

    /// The index of an entry.
    #[cfg_attr(not(debug_assertions), inline(always))]
    fn place(&self, i: usize, j: usize) -> usize {
        if self.width == self.size {
            i * self.width + j
        } else {
            i * self.width + j + self.half_bandwidth - i
        }
    }

    /// The columns of a row within the band.
    fn band(&self, i: usize) -> core::ops::Range<usize> {
        let end = i.saturating_add(self.half_bandwidth).saturating_add(1);
        i.saturating_sub(self.half_bandwidth)..end.min(self.size)
    }

    /// Factors the matrix with these entries; returns whether every pivot is finite and nonzero.
    pub fn factor(&mut self, entry: impl Fn(usize, usize) -> E) -> bool {
        self.first_without_pivot(entry).is_none()
    }

    /// Factors the matrix as [`factor`](Self::factor) does; returns the first column whose pivot is zero, NaN or infinite.
    pub fn first_without_pivot(&mut self, entry: impl Fn(usize, usize) -> E) -> Option<usize> {
        self.clear();
        for i in 0..self.size {
            for j in self.band(i) {
                self.set(i, j, entry(i, j));
            }
        }
        self.eliminate_all()
    }

    /// Sets all entries to zero.
    pub fn clear(&mut self) {
        self.entries.fill(E::zero());
    }

    /// Sets an entry within the band of a matrix that is then [factored](Self::eliminate_all).
    #[cfg_attr(not(debug_assertions), inline(always))]
    pub fn set(&mut self, i: usize, j: usize, entry: E) {
        let place = self.place(i, j);
        self.entries[place] = entry;
    }

    /// Factors the matrix of the entries that were [`set`](Self::set); returns the first column whose pivot is zero, NaN or infinite.
    pub fn eliminate_all(&mut self) -> Option<usize> {
        (0..self.size).find(|&k| !self.eliminate(k))
    }

    /// The pivot of a column.
    pub fn pivot(&self, column: usize) -> E {
        self.entries[self.place(column, column)].inverse()
    }

    /// Eliminates one column; returns whether it has a pivot.
    fn eliminate(&mut self, k: usize) -> bool {
        let rows = self.band(k).end;
        let (mut pivot, mut largest) = (k, self.entries[self.place(k, k)].size());
        for i in k + 1..rows {
            let size = self.entries[self.place(i, k)].size();
            if size > largest || size.is_nan() {
                (pivot, largest) = (i, size);
            }
        }
        if largest == 0.0 || !largest.is_finite() {
            return false;
        }
        self.pivots[k] = pivot;
        let columns = 2 * self.half_bandwidth.min(self.size) + k + 1;
        let length = columns.min(self.size) - k;
        if pivot != k {
            let (a, b) = (self.place(k, k), self.place(pivot, k));
            let (upper, lower) = self.entries.split_at_mut(b);
            upper[a..a + length].swap_with_slice(&mut lower[..length]);
        }
        let diagonal = self.place(k, k);
        let inverse = self.entries[diagonal].inverse();
        self.entries[diagonal] = inverse;
        for i in k + 1..rows {
            let start = self.place(i, k);
            let (upper, lower) = self.entries.split_at_mut(start);
            let (row, pivot_row) = (&mut lower[..length], &upper[diagonal..diagonal + length]);
            let factor = row[0] * inverse;
            row[0] = factor;
            for (entry, &above) in row.iter_mut().zip(pivot_row).skip(1) {
                *entry = *entry - factor * above;
            }
        }
        true
    }

    /// Solves in place for the right-hand side in `right`.
    pub fn solve(&mut self) {
        for k in 0..self.size {
            self.right.swap(k, self.pivots[k]);
            let known = self.right[k];
            for i in k + 1..self.band(k).end {
                let factor = self.entries[self.place(i, k)];
                self.right[i] = self.right[i] - factor * known;
            }
        }
        for k in (0..self.size).rev() {
            let columns = 2 * self.half_bandwidth.min(self.size) + k + 1;
            let start = self.place(k, k);
            let row = &self.entries[start..start + columns.min(self.size) - k];
            let mut sum = self.right[k];
            for (&entry, &known) in row.iter().zip(&self.right[k..]).skip(1) {
                sum = sum - entry * known;
            }
            self.right[k] = sum * row[0];
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    fn entry(i: usize, j: usize) -> f64 {
        // Small on the diagonal, so that the elimination has to exchange rows.
        match i.abs_diff(j) {
            0 => 1e-3 * (1.0 + i as f64),
            distance => ((3 * i + 7 * j) as f64).sin() / distance as f64,
        }
    }

    /// The largest residual of the solution for the right-hand side 1, 2, …
    fn residual(size: usize, half_bandwidth: usize) -> f64 {
        let banded = |i: usize, j: usize| match i.abs_diff(j) <= half_bandwidth {
            true => entry(i, j),
            false => 0.0,
        };
        let mut elimination = Elimination::new(size, half_bandwidth);
        assert!(elimination.factor(banded));
        for (i, right) in elimination.right.iter_mut().enumerate() {
            *right = 1.0 + i as f64;
        }
        elimination.solve();
        let rows = (0..size).map(|i| {
            let products = (0..size).map(|j| banded(i, j) * elimination.right[j]);
            (products.sum::<f64>() - 1.0 - i as f64).abs()
        });
        rows.fold(0.0, f64::max)
    }

    #[test]
    fn bands_of_any_width_are_solved() {
        for size in [1, 2, 3, 7, 20] {
            for half_bandwidth in [0, 1, 2, 3, 6, size - 1, size, 100] {
                let residual = residual(size, half_bandwidth);
                assert!(residual < 1e-11, "{size} {half_bandwidth}: {residual:e}");
            }
        }
    }

    #[test]
    fn elimination_refuses_singular_matrices() {
        let mut elimination = Elimination::new(3, 2);
        assert!(!elimination.factor(|i, j| (i * j) as f64));
        assert!(!elimination.factor(|i, j| if i == j { f64::NAN } else { 1.0 }));
        assert!(elimination.factor(|i, j| if i + j == 2 { 2.0 } else { 0.0 }));
    }

    #[test]
    fn elimination_solves_complex_equations() {
        let mut elimination = Elimination::new(2, 1);
        let number = |re: f64, im: f64| Complex { re, im };
        let matrix = [
            [number(0.0, 1.0), number(2.0, 0.0)],
            [number(1.0, -3.0), number(0.5, 4.0)],
        ];
        assert!(elimination.factor(|i, j| matrix[i][j]));
        elimination.right = vec![number(1.0, 2.0), number(-1.0, 0.0)];
        elimination.solve();
        let x = &elimination.right;
        for (row, expected) in matrix.iter().zip([number(1.0, 2.0), number(-1.0, 0.0)]) {
            let difference = row[0] * x[0] + row[1] * x[1] - expected;
            assert!(difference.size() < 1e-15);
        }
    }

    #[test]
    fn factors_from_a_changed_checkpoint_lead_to_no_panic() {
        let mut elimination = Elimination::new(4, 4);
        assert!(elimination.factor(entry));
        elimination.words(&mut |word| *word = u64::MAX);
        elimination.solve();
    }
}
