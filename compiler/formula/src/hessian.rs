//! Whether `∂²H/∂p²` is regular. Methods whose momenta have more stages than their positions have functions need this.

use num_traits::One;

use super::derivative::{Scatter, gradient};
use super::evaluate::{Evaluator, Point, Real};
use super::graph::{Coordinate, Graph, Half, Number, integer};
use super::modular::Points;
use super::syntax::Length;
use super::system::System;

/// The largest number of momenta for which second derivatives are examined.
const MAX_MOMENTA: usize = 60;

/// A pivot below this, relative to its row and column, counts as zero.
const ROUNDING: f64 = 1e-11;

/// What is known about `∂²H/∂p²`.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum MomentumHessian {
    /// Zero: H is linear in the momenta.
    Zero,
    /// Singular at random points, of this rank and size.
    Singular {
        /// The rank.
        rank: usize,
        /// The number of momenta.
        size: usize,
    },
    /// Regular at a random point.
    Regular,
    /// Unknown: there are too many momenta to examine.
    Unknown,
}

impl MomentumHessian {
    /// The result for a system.
    pub fn of(system: &System) -> Self {
        if system.lagrangian.is_some() {
            return MomentumHessian::Regular;
        }
        let components = system.layout.components();
        if let Length::Fixed(count) = system.layout.length()
            && count * components > MAX_MOMENTA
        {
            return MomentumHessian::Unknown;
        }
        let mut graph = system.graph.clone();
        let mut parts = Vec::new();
        for first in gradient(&mut graph, system.energy, &[], Number::one(), Half::P) {
            let second = gradient(
                &mut graph,
                first.value,
                &first.loops,
                Number::one(),
                Half::P,
            );
            parts.extend(
                second
                    .into_iter()
                    .map(|second| (first.target.clone(), second)),
            );
        }
        if parts.is_empty() {
            return MomentumHessian::Zero;
        }
        let points = Points::of(system);
        let exact = largest_rank(&graph, points.exact(), &parts, |x| x.size());
        // Doubles also detect identities that the exact numbers do not satisfy.
        let doubles = largest_rank(&graph, points.doubles(), &parts, |x| Some(x.abs()));
        match exact.into_iter().chain(doubles).min() {
            Some((rank, size)) if rank == size => MomentumHessian::Regular,
            Some((rank, size)) => MomentumHessian::Singular { rank, size },
            None => MomentumHessian::Unknown,
        }
    }
}

/// The largest rank of a matrix of second derivatives at some points, and its size.
fn largest_rank<R: Real>(
    graph: &Graph,
    points: &[Point<R>],
    parts: &[(Coordinate, Scatter)],
    size: impl Fn(&R) -> Option<f64>,
) -> Option<(usize, usize)> {
    let found = points.iter().filter_map(|point| {
        let matrix = Evaluator::new(graph, point).matrix(parts)?;
        let count = matrix.len();
        Some((rank(matrix, &size)?, count))
    });
    found.max()
}

/// The rank of a matrix; `None` if an entry is not known. Sizes are relative to rows and columns, so that units do not matter.
fn rank<R: Real>(mut matrix: Vec<Vec<R>>, size: impl Fn(&R) -> Option<f64>) -> Option<usize> {
    let count = matrix.len();
    let mut sizes = Vec::with_capacity(count);
    for row in &matrix {
        let row: Option<Vec<f64>> = row.iter().map(&size).collect();
        sizes.push(row?);
    }
    let largest = |found: &mut dyn Iterator<Item = f64>| found.fold(0.0, f64::max);
    let or_one = |size: f64| if size > 0.0 { size } else { 1.0 };
    let mut rows: Vec<f64> = sizes
        .iter()
        .map(|row| or_one(largest(&mut row.iter().copied())))
        .collect();
    let column = |k: usize| {
        let mut relative = sizes.iter().zip(&rows).map(|(row, scale)| row[k] / scale);
        or_one(largest(&mut relative))
    };
    let mut columns: Vec<f64> = (0..count).map(column).collect();
    for rank in 0..count {
        let mut pivot = (ROUNDING, None);
        for (row, entries) in matrix.iter().enumerate().skip(rank) {
            for (column, entry) in entries.iter().enumerate().skip(rank) {
                let entry = size(entry)? / (rows[row] * columns[column]);
                if !entry.is_finite() {
                    return None;
                }
                if entry > pivot.0 {
                    pivot = (entry, Some((row, column)));
                }
            }
        }
        let Some((row, column)) = pivot.1 else {
            return Some(rank);
        };
        matrix.swap(rank, row);
        rows.swap(rank, row);
        matrix.iter_mut().for_each(|row| row.swap(rank, column));
        columns.swap(rank, column);
        let (above, below) = matrix.split_at_mut(rank + 1);
        let pivot = &above[rank];
        let inverse = pivot[rank].power(&integer(-1));
        for row in below {
            let factor = row[rank]
                .multiply(&inverse)
                .multiply(&R::number(&integer(-1)));
            for (entry, above) in row.iter_mut().zip(pivot) {
                *entry = entry.add(&factor.multiply(above));
            }
        }
    }
    Some(count)
}
