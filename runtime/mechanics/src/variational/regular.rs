//! Tests whether a step has a unique end.

use alloc::vec;
use alloc::vec::Vec;

use num_traits::Float;

use symplectic_core::solver::{Visit, Words};
use symplectic_linearisation::Elimination;

/// If an iterate changes by less than this, relative to the distance from the start, the next iterate is exact up to rounding: the
/// iteration converges quadratically.
const LAST_CHANGE: f64 = 1e-9;

/// The factors of the matrix of a Newton iteration.
#[derive(Clone)]
pub(super) struct Factors {
    elimination: Elimination<f64>,
    /// The largest entries of the columns.
    largest: Vec<f64>,
}

/// A pivot that is zero up to rounding.
#[derive(Clone, Copy, Debug)]
pub(super) struct Singular {
    /// The component of q1 that is not determined.
    pub(super) component: usize,
    /// The pivot, relative to the largest entry of its column.
    pub(super) pivot: f64,
}

/// The effect of a correction on an iterate.
pub(super) struct Correction {
    /// Whether the iterate is now exact up to rounding.
    pub(super) is_last: bool,
    /// The change relative to the iterate.
    pub(super) residual: f64,
}

/// The largest magnitude of some numbers.
pub(super) fn largest(numbers: &[f64]) -> f64 {
    let sizes = numbers.iter().map(|&number| Float::abs(number));
    sizes.fold(0.0, f64::max)
}

/// The largest entries are computed with the factors.
impl Words for Factors {
    fn words(&mut self, visit: &mut Visit<'_>) {
        self.elimination.words(visit);
    }
}

/// Whether `p + slope = 0` holds up to the rounding of p: a step that returns to its start has no length to which the last change of an
/// iterate could be compared.
pub(super) fn is_solved(p: &[f64], slope: &[f64]) -> bool {
    let rounding = 16.0 * f64::EPSILON * largest(p);
    let mut rows = p.iter().zip(slope);
    rows.all(|(p, slope)| Float::abs(p + slope) <= rounding)
}

impl Factors {
    pub(super) fn new(size: usize) -> Self {
        Self {
            elimination: Elimination::new(size, size),
            largest: vec![0.0; size],
        }
    }

    /// Factors the matrix with these rows.
    pub(super) fn factor(&mut self, rows: &[f64]) -> Result<(), Singular> {
        self.factor_above(rows, 0.0)
    }

    /// [`factor`](Self::factor) where entries up to `floor` are zero.
    pub(super) fn factor_above(&mut self, rows: &[f64], floor: f64) -> Result<(), Singular> {
        let n = self.largest.len();
        for (column, largest) in self.largest.iter_mut().enumerate() {
            let entries = rows.iter().skip(column).step_by(n.max(1));
            *largest = entries.fold(0.0, |largest, &entry| largest.max(Float::abs(entry)));
        }
        if let Some(component) = self.elimination.first_without_pivot(|i, j| rows[i * n + j]) {
            let pivot = 0.0;
            return Err(Singular { component, pivot });
        }
        for (component, largest) in self.largest.iter().enumerate() {
            let size = Float::abs(self.elimination.pivot(component));
            let pivot = size / largest;
            if size <= floor || pivot < 8.0 * n as f64 * f64::EPSILON {
                return Err(Singular { component, pivot });
            }
        }
        Ok(())
    }

    /// Solves for this right-hand side.
    pub(super) fn solve(&mut self, right: impl Iterator<Item = f64>) -> &[f64] {
        for (place, right) in self.elimination.right.iter_mut().zip(right) {
            *place = right;
        }
        self.elimination.solve();
        &self.elimination.right
    }

    /// Adds the solution for this right-hand side to the iterate `end`; the iteration began at `start`.
    pub(super) fn correct(
        &mut self,
        right: impl Iterator<Item = f64>,
        start: &[f64],
        end: &mut [f64],
    ) -> Correction {
        let changes = self.solve(right);
        let (mut changed, mut way, mut largest) = (0.0_f64, 0.0_f64, 0.0_f64);
        let mut finite = true;
        let ends = end.iter_mut().zip(start);
        for (&change, (end, start)) in changes.iter().zip(ends) {
            *end += change;
            finite &= end.is_finite();
            changed = changed.max(Float::abs(change));
            way = way.max(Float::abs(*end - start));
            largest = largest.max(Float::abs(*end));
        }
        Correction {
            is_last: finite && changed <= LAST_CHANGE * way + 16.0 * f64::EPSILON * largest,
            residual: changed / largest,
        }
    }
}
