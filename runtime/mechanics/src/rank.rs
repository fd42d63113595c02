//! Gaussian elimination that stops at the rank.

use alloc::vec;
use alloc::vec::Vec;
use core::ops::Range;

use num_traits::Float;

/// A sum and the size of its terms.
#[derive(Clone, Copy, Debug, Default)]
struct Sum {
    value: f64,
    size: f64,
}

/// A system of linear equations, of any shape and rank, eliminated with complete pivoting.
///
/// Each coefficient carries the size of the terms of its sum. A coefficient that is not larger than their rounding errors counts as zero.
/// So the rank is independent of the units of the unknowns and of the equations.
#[derive(Clone, Debug)]
pub(crate) struct RankElimination {
    columns: usize,
    /// By rows; the last column is the right-hand side.
    entries: Vec<Sum>,
    /// The pivots in the order of their elimination.
    pivots: Vec<(usize, usize)>,
    row_has_pivot: Vec<bool>,
    column_has_pivot: Vec<bool>,
    /// The largest coefficients of rows and columns, used to choose pivots.
    row_scales: Vec<f64>,
    column_scales: Vec<f64>,
    solution: Vec<f64>,
}

/// The residual of an equation that depends on others.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(crate) struct Rest {
    pub(crate) row: usize,
    pub(crate) value: f64,
    /// The size of the terms of the residual.
    pub(crate) size: f64,
}

impl RankElimination {
    /// Memory for `rows` equations with `columns` unknowns.
    pub(crate) fn new(rows: usize, columns: usize) -> Self {
        Self {
            columns,
            entries: vec![Sum::default(); rows * (columns + 1)],
            pivots: Vec::with_capacity(rows.min(columns)),
            row_has_pivot: vec![false; rows],
            column_has_pivot: vec![false; columns],
            row_scales: vec![0.0; rows],
            column_scales: vec![0.0; columns],
            solution: vec![0.0; columns],
        }
    }

    /// Sets all coefficients to zero and forgets the pivots.
    pub(crate) fn clear(&mut self) {
        self.entries.fill(Sum::default());
        self.pivots.clear();
        self.row_has_pivot.fill(false);
        self.column_has_pivot.fill(false);
    }

    /// Adds a term to a coefficient.
    #[inline]
    pub(crate) fn add(&mut self, row: usize, column: usize, term: f64) {
        let place = self.place(row, column);
        let entry = &mut self.entries[place];
        entry.value += term;
        entry.size += Float::abs(term);
    }

    /// Adds a term to the right-hand side, where the term is itself a sum with terms of this size.
    #[inline]
    pub(crate) fn add_right(&mut self, row: usize, term: f64, size: f64) {
        let place = self.place(row, self.columns);
        let entry = &mut self.entries[place];
        entry.value += term;
        entry.size += size;
    }

    #[inline]
    fn place(&self, row: usize, column: usize) -> usize {
        row * (self.columns + 1) + column
    }

    /// Whether all coefficients and the right-hand side are finite.
    pub(crate) fn is_finite(&self) -> bool {
        self.entries.iter().all(|entry| entry.value.is_finite())
    }

    /// Eliminates unknowns of `columns` by equations of `rows`, until the remaining coefficients are zero up to rounding.
    pub(crate) fn eliminate(&mut self, rows: Range<usize>, columns: Range<usize>) {
        self.scale(rows.clone(), columns.clone());
        while let Some((row, column)) = self.pivot(rows.clone(), columns.clone()) {
            self.row_has_pivot[row] = true;
            self.column_has_pivot[column] = true;
            self.pivots.push((row, column));
            for other in 0..self.row_has_pivot.len() {
                if !self.row_has_pivot[other] {
                    self.subtract(row, column, other);
                }
            }
        }
    }

    /// Whether the unknown has been eliminated.
    pub(crate) fn has_pivot(&self, column: usize) -> bool {
        self.column_has_pivot[column]
    }

    /// The residuals of the equations without a pivot.
    pub(crate) fn rests(&self) -> impl Iterator<Item = Rest> {
        let rows = self.row_has_pivot.iter().enumerate();
        rows.filter(|&(_, &has_pivot)| !has_pivot).map(|(row, _)| {
            let Sum { value, size } = self.entries[self.place(row, self.columns)];
            Rest { row, value, size }
        })
    }

    /// The solution in which all unknowns without a pivot are zero.
    pub(crate) fn solve(&mut self) -> &[f64] {
        self.solution.fill(0.0);
        self.substitute(1.0)
    }

    /// The solution of the homogeneous equations in which the unknown `free` is 1 and all other unknowns without a pivot are zero.
    pub(crate) fn null_vector(&mut self, free: usize) -> &[f64] {
        self.solution.fill(0.0);
        self.solution[free] = 1.0;
        self.substitute(0.0)
    }

    fn substitute(&mut self, right: f64) -> &[f64] {
        for &(row, column) in self.pivots.iter().rev() {
            let start = self.place(row, 0);
            let row = &self.entries[start..=start + self.columns];
            let known = row.iter().zip(&self.solution);
            let sum = known.fold(right * row[self.columns].value, |sum, (entry, known)| {
                sum - entry.value * known
            });
            self.solution[column] = sum / row[column].value;
        }
        &self.solution
    }

    /// Computes scales such that the largest coefficient of each row is 1, and then that of each column.
    fn scale(&mut self, rows: Range<usize>, columns: Range<usize>) {
        self.column_scales.fill(0.0);
        for row in rows.clone() {
            let start = self.place(row, 0);
            let entries = &self.entries[start + columns.start..start + columns.end];
            let largest = entries.iter().fold(0.0_f64, |largest, entry| {
                largest.max(Float::abs(entry.value))
            });
            self.row_scales[row] = largest;
            if self.row_has_pivot[row] || largest == 0.0 {
                continue;
            }
            for (scale, entry) in self.column_scales[columns.clone()].iter_mut().zip(entries) {
                *scale = scale.max(Float::abs(entry.value) / largest);
            }
        }
    }

    /// The largest scaled coefficient that exceeds the rounding errors.
    fn pivot(&self, rows: Range<usize>, columns: Range<usize>) -> Option<(usize, usize)> {
        let noise = 16.0 * f64::EPSILON * self.row_has_pivot.len() as f64;
        let (mut best, mut largest) = (None, 0.0);
        for row in rows.filter(|&row| !self.row_has_pivot[row]) {
            for column in columns.clone() {
                let Sum { value, size } = self.entries[self.place(row, column)];
                let value = Float::abs(value);
                if value <= noise * size || !value.is_finite() {
                    continue;
                }
                let scaled = value / self.row_scales[row] / self.column_scales[column];
                if scaled > largest {
                    (best, largest) = (Some((row, column)), scaled);
                }
            }
        }
        best
    }

    /// Subtracts a multiple of a row from another row, so that the other row has no coefficient in the column.
    fn subtract(&mut self, row: usize, column: usize, other: usize) {
        let width = self.columns + 1;
        let factor = self.entries[self.place(other, column)].value
            / self.entries[self.place(row, column)].value;
        if factor == 0.0 {
            return;
        }
        for k in 0..width {
            let Sum { value, size } = self.entries[row * width + k];
            let entry = &mut self.entries[other * width + k];
            entry.value -= factor * value;
            entry.size += Float::abs(factor) * size;
        }
        let place = self.place(other, column);
        self.entries[place] = Sum::default();
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    /// The equations with these coefficients and right-hand sides.
    fn equations(rows: &[&[f64]], right: &[f64]) -> RankElimination {
        let mut system = RankElimination::new(rows.len(), rows[0].len());
        for (i, (row, &right)) in rows.iter().zip(right).enumerate() {
            for (j, &entry) in row.iter().enumerate() {
                system.add(i, j, entry);
            }
            system.add_right(i, right, right.abs());
        }
        system
    }

    #[test]
    fn regular_equations_are_solved() {
        let rows: [&[f64]; 3] = [&[0.0, 2.0, 1.0], &[1.0, -1.0, 0.5], &[3.0, 0.0, 0.25]];
        let x = [0.5, -2.0, 3.0];
        let right = rows.map(|row| row.iter().zip(&x).map(|(a, x)| a * x).sum());
        let mut system = equations(&rows, &right);
        system.eliminate(0..3, 0..3);
        let solution = system.solve();
        assert!(solution.iter().zip(&x).all(|(a, b)| (a - b).abs() < 1e-14));
        assert_eq!(system.rests().count(), 0);
    }

    /// Units of 10¹² and 10⁻¹² change neither the rank nor the residuals.
    #[test]
    fn the_rank_does_not_depend_on_units() {
        let base = [[0.1, 0.7, 0.3], [0.2, 0.5, 0.9], [0.3, 1.2, 1.2]];
        let right = [1.0, 2.0, 3.0];
        for (unit, other) in [(1.0, 1.0), (1e12, 1e-12), (1e-9, 1e9)] {
            let rows = base.map(|[a, b, c]| [a * unit, b, c * other]);
            let rows: Vec<Vec<f64>> = rows
                .iter()
                .zip([other, 1.0, 1.0])
                .map(|(row, scale)| row.iter().map(|a| a * scale).collect())
                .collect();
            let rows: Vec<&[f64]> = rows.iter().map(Vec::as_slice).collect();
            for (off, consistent) in [(0.0, true), (1e-9, false)] {
                let right = [right[0] * other, right[1], right[2] + off];
                let mut system = equations(&rows, &right);
                system.eliminate(0..3, 0..3);
                let rests: Vec<Rest> = system.rests().collect();
                assert_eq!(rests.len(), 1, "{unit}");
                let relative = rests[0].value.abs() / rests[0].size;
                assert_eq!(relative < 1e-14, consistent, "{relative:e}");
                let free = (0..3).find(|&column| !system.has_pivot(column));
                let null = system.null_vector(free.expect("rank 2")).to_vec();
                for row in &rows {
                    let terms = row.iter().zip(&null).map(|(a, x)| a * x);
                    let size: f64 = terms.clone().map(f64::abs).sum();
                    assert!(terms.sum::<f64>().abs() < 1e-15 * size);
                }
            }
        }
    }

    /// An unknown that the second block of equations determines after the first has eliminated the others.
    #[test]
    fn blocks_are_eliminated_in_turn() {
        let rows: [&[f64]; 2] = [&[2.0, 1.0, 1.0], &[1.0, 1.0, 1.0]];
        let mut system = equations(&rows, &[4.0, 3.0]);
        system.eliminate(0..2, 1..3);
        system.eliminate(0..2, 0..1);
        assert!(system.has_pivot(0) && system.has_pivot(1) != system.has_pivot(2));
        assert_eq!(system.solve()[0], 1.0);
        // In the other order the first unknown is found, but not that it is unique.
        let mut system = equations(&[&[1.0, 1.0]], &[3.0]);
        system.eliminate(0..1, 1..2);
        system.eliminate(0..1, 0..1);
        assert!(!system.has_pivot(0));
    }
}
