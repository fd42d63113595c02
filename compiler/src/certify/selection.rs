//! Which coefficients are solved for, and which are fixed as exact numbers.

use super::structure::{Reading, Unknown};
use super::system::System;
use crate::arithmetic::interval::Interval;
use crate::arithmetic::rounding::to_f64;

/// Pivots below this share of the largest entry of their row count as zero.
const RANK_THRESHOLD: f64 = 1e-12;

/// The unknowns to solve for, as many as there are conditions.
///
/// The derivatives of the conditions at the printed point are eliminated with full pivoting. Columns whose
/// digits look exact come after all others, and those that are printed exactly come last, so that `0.28` and `6/11` stay
/// what they are where that leaves enough unknowns. Only what is proved later depends on floating-point numbers here, not whether it is true.
///
/// # Errors
/// The numerical rank, if it is smaller than the number of conditions.
pub fn free_unknowns(system: &System, reading: &Reading) -> Result<Vec<usize>, usize> {
    let all: Vec<usize> = (0..reading.unknowns.len()).collect();
    let at = |unknown: &Unknown| Interval::enclosing(&unknown.start, 192);
    let start: Vec<Interval> = reading.unknowns.iter().map(at).collect();
    let mut rows: Vec<Vec<f64>> = system
        .derivatives(&start, &all)
        .iter()
        .map(|row| normalised(row))
        .collect();
    let class_of = |column: usize| {
        let unknown = &reading.unknowns[column];
        u8::from(unknown.simple.is_some()) + u8::from(unknown.exact)
    };
    let mut free = Vec::new();
    let mut done = 0;
    for class in 0..=2 {
        while done < rows.len() {
            let columns = all
                .iter()
                .filter(|&&c| class_of(c) == class && !free.contains(&c));
            let candidates = columns.flat_map(|&c| (done..rows.len()).map(move |r| (r, c)));
            // The first of the largest, so that the choice does not depend on anything else.
            let best = candidates.fold(None, |best: Option<(usize, usize)>, (r, c)| match best {
                Some((i, j)) if rows[i][j].abs() >= rows[r][c].abs() => best,
                _ => Some((r, c)),
            });
            let Some((row, column)) = best.filter(|&(r, c)| rows[r][c].abs() > RANK_THRESHOLD)
            else {
                break;
            };
            rows.swap(done, row);
            let reference = rows[done].clone();
            for row in rows.iter_mut().skip(done + 1) {
                let factor = row[column] / reference[column];
                for (entry, r) in row.iter_mut().zip(&reference) {
                    *entry -= factor * r;
                }
            }
            free.push(column);
            done += 1;
        }
    }
    if done < rows.len() {
        return Err(done);
    }
    free.sort_unstable();
    Ok(free)
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
