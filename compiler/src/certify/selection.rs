//! Which coefficients are solved for, and which are fixed at exact values.

use super::newton::Equations;
use super::structure::{Reading, Unknown};
use super::system::System;
use crate::arithmetic::interval::Interval;
use crate::arithmetic::rounding::to_f64;

/// Pivots below this fraction of the largest entry of their row count as zero.
const RANK_THRESHOLD: f64 = 1e-12;

/// The unknowns to solve for, as many as there are conditions.
///
/// The derivatives of the conditions at the printed point are eliminated with full pivoting. Columns whose
/// digits look exact come after all others, and those printed exactly come last, so that `0.28` and `6/11` stay
/// as they are if enough other unknowns remain. Floating-point numbers here only affect which claims can be proved later, not whether
/// a proof is valid.
///
/// # Errors
/// The numerical rank, if it is smaller than the number of conditions.
pub fn free_unknowns(system: &System, reading: &Reading) -> Result<Vec<usize>, usize> {
    let pivots = pivots(system, &reading.unknowns, RANK_THRESHOLD);
    if pivots.len() < system.all().count() {
        return Err(pivots.len());
    }
    let mut free: Vec<usize> = pivots.into_iter().map(|(_, column)| column).collect();
    free.sort_unstable();
    Ok(free)
}

/// Independent equations with the unknowns to solve them for: pivots of the derivatives at the printed point, none below
/// the threshold.
pub fn pivots<S: Equations>(
    system: &S,
    unknowns: &[Unknown],
    threshold: f64,
) -> Vec<(usize, usize)> {
    let all: Vec<usize> = (0..unknowns.len()).collect();
    let at = |unknown: &Unknown| Interval::enclosing(&unknown.start, 192);
    let start: Vec<Interval> = unknowns.iter().map(at).collect();
    let mut rows: Vec<(usize, Vec<f64>)> = {
        let rows = system.derivatives(&start, &all).into_iter();
        rows.map(|row| normalised(&row)).enumerate().collect()
    };
    let class_of = |column: usize| {
        let unknown = &unknowns[column];
        u8::from(unknown.simple.is_some()) + u8::from(unknown.exact)
    };
    let mut pivots: Vec<(usize, usize)> = Vec::new();
    for class in 0..=2 {
        while pivots.len() < rows.len() {
            let done = pivots.len();
            let taken = |column: usize| pivots.iter().any(|(_, known)| *known == column);
            let columns = all.iter().filter(|&&c| class_of(c) == class && !taken(c));
            let candidates = columns.flat_map(|&c| (done..rows.len()).map(move |r| (r, c)));
            // The first of the largest entries, so that the choice is deterministic.
            let best = candidates.fold(None, |best: Option<(usize, usize)>, (r, c)| match best {
                Some((i, j)) if rows[i].1[j].abs() >= rows[r].1[c].abs() => best,
                _ => Some((r, c)),
            });
            let Some((row, column)) = best.filter(|&(r, c)| rows[r].1[c].abs() > threshold) else {
                break;
            };
            rows.swap(done, row);
            let (index, reference) = rows[done].clone();
            for (_, row) in rows.iter_mut().skip(done + 1) {
                let factor = row[column] / reference[column];
                for (entry, r) in row.iter_mut().zip(&reference) {
                    *entry -= factor * r;
                }
            }
            pivots.push((index, column));
        }
    }
    pivots
}

fn normalised(row: &[Interval]) -> Vec<f64> {
    let values: Vec<f64> = row.iter().map(|entry| to_f64(&entry.middle())).collect();
    let largest = values.iter().fold(0.0f64, |m, x| m.max(x.abs()));
    if largest > 0.0 {
        values.iter().map(|x| x / largest).collect()
    } else {
        values
    }
}
