//! The second derivatives of H, and matrices that hold them.

use alloc::vec;
use alloc::vec::Vec;

use crate::number::Scalar;

/// A square matrix whose entries `(i, j)` are zero if `|i − j|` exceeds the half bandwidth.
#[derive(Clone, Debug)]
pub struct BandMatrix<T> {
    size: usize,
    half_bandwidth: usize,
    /// By rows; every row has room for the whole band.
    entries: Vec<T>,
}

impl<T: Scalar> BandMatrix<T> {
    /// A zero matrix.
    ///
    /// ```
    /// use symplectic::system::BandMatrix;
    ///
    /// let mut tridiagonal = BandMatrix::new(3, 1);
    /// tridiagonal.set(0, 1, 2.0);
    /// tridiagonal.set(0, 2, 4.0);
    /// assert_eq!((tridiagonal.get(0, 1), tridiagonal.get(0, 2)), (2.0, 0.0));
    /// let mut product = [0.0; 3];
    /// tridiagonal.multiply(&[1.0, 10.0, 100.0], &mut product);
    /// assert_eq!(product, [20.0, 0.0, 0.0]);
    /// ```
    pub fn new(size: usize, half_bandwidth: usize) -> Self {
        let half_bandwidth = half_bandwidth.min(size.saturating_sub(1));
        Self {
            size,
            half_bandwidth,
            entries: vec![T::zero(); size * (2 * half_bandwidth + 1)],
        }
    }

    /// The entries, including those of the band outside the matrix.
    #[doc(hidden)]
    pub fn entries_mut(&mut self) -> &mut [T] {
        &mut self.entries
    }

    /// The number of rows.
    pub const fn size(&self) -> usize {
        self.size
    }

    /// The largest `|i − j|` of a stored entry.
    pub const fn half_bandwidth(&self) -> usize {
        self.half_bandwidth
    }

    /// The index of an entry; `None` outside the band.
    #[cfg_attr(not(debug_assertions), inline(always))]
    fn place(&self, i: usize, j: usize) -> Option<usize> {
        let inside = i < self.size && j < self.size && i.abs_diff(j) <= self.half_bandwidth;
        inside.then(|| i * (2 * self.half_bandwidth + 1) + j + self.half_bandwidth - i)
    }

    /// An entry; zero outside the band.
    #[inline]
    pub fn get(&self, i: usize, j: usize) -> T {
        self.place(i, j)
            .map_or_else(T::zero, |place| self.entries[place])
    }

    /// Sets an entry; entries outside the band stay zero.
    #[inline]
    pub fn set(&mut self, i: usize, j: usize, value: T) {
        if let Some(place) = self.place(i, j) {
            self.entries[place] = value;
        }
    }

    /// Adds to an entry; entries outside the band stay zero.
    #[inline]
    pub fn add(&mut self, i: usize, j: usize, value: T) {
        if let Some(place) = self.place(i, j) {
            self.entries[place] += value;
        }
    }

    /// The columns of the band in a row.
    pub fn columns(&self, i: usize) -> core::ops::Range<usize> {
        i.saturating_sub(self.half_bandwidth)..(i + self.half_bandwidth + 1).min(self.size)
    }

    /// Writes the product with a vector.
    pub fn multiply(&self, vector: &[T], product: &mut [T]) {
        for (i, out) in product.iter_mut().enumerate().take(self.size) {
            let columns = self.columns(i);
            let Some(place) = self.place(i, columns.start) else {
                continue;
            };
            let row = self.entries[place..].iter().zip(&vector[columns.clone()]);
            let row = row.take(columns.len());
            *out = row.fold(T::zero(), |sum, (&entry, &x)| sum + entry * x);
        }
    }

    /// Sets all entries to zero.
    pub fn clear(&mut self) {
        self.entries.fill(T::zero());
    }

    fn is_finite(&self) -> bool {
        self.entries.iter().all(|entry| entry.is_finite())
    }
}

/// The derivatives of the velocity and the force of a system, at one time, position and momentum.
///
/// For a Hamiltonian ∂force/∂p is −(∂velocity/∂q)ᵀ, because both are second derivatives of H. Only the contribution of an applied force is
/// stored.
#[derive(Clone, Debug)]
pub struct Jacobian<T> {
    /// ∂velocity_i/∂q_j = ∂²H/∂p_i∂q_j; zero for a separable system.
    pub velocity_by_position: BandMatrix<T>,
    /// ∂velocity_i/∂p_j = ∂²H/∂p_i∂p_j
    pub velocity_by_momentum: BandMatrix<T>,
    /// ∂force_i/∂q_j = −∂²H/∂q_i∂q_j
    pub force_by_position: BandMatrix<T>,
    /// ∂f_i/∂p_j of the [applied force](crate::Hamiltonian::applied_force) f; zero for every other system.
    pub applied_force_by_momentum: BandMatrix<T>,
}

impl<T: Scalar> Jacobian<T> {
    /// Zero, for systems of this dimension.
    pub fn new(dimension: usize, half_bandwidth: usize) -> Self {
        let zero = BandMatrix::new(dimension, half_bandwidth);
        Self {
            velocity_by_position: zero.clone(),
            velocity_by_momentum: zero.clone(),
            force_by_position: zero.clone(),
            applied_force_by_momentum: zero,
        }
    }

    /// Sets all entries to zero.
    pub fn clear(&mut self) {
        for matrix in self.each_mut() {
            matrix.clear();
        }
    }

    #[doc(hidden)]
    pub fn each_mut(&mut self) -> [&mut BandMatrix<T>; 4] {
        [
            &mut self.velocity_by_position,
            &mut self.velocity_by_momentum,
            &mut self.force_by_position,
            &mut self.applied_force_by_momentum,
        ]
    }

    /// Whether all entries are finite.
    pub fn is_finite(&self) -> bool {
        self.velocity_by_position.is_finite()
            && self.velocity_by_momentum.is_finite()
            && self.force_by_position.is_finite()
            && self.applied_force_by_momentum.is_finite()
    }

    /// ∂force_i/∂p_j
    #[cfg_attr(not(debug_assertions), inline(always))]
    #[doc(hidden)]
    pub fn force_by_momentum(&self, i: usize, j: usize) -> T {
        self.applied_force_by_momentum.get(i, j) - self.velocity_by_position.get(j, i)
    }
}
