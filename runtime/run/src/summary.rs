//! What a run says at its end.

use crate::counted;
use crate::output::{Results, Seen, points};
use crate::progress::duration;
use crate::trajectory::Trajectory;
use symplectic_terminal::aligned;

/// The energy errors of a run.
#[derive(Debug, Default, PartialEq)]
struct Energy<'a> {
    /// The largest magnitude, NaN above all, with its trajectory and its time.
    largest: Option<(f64, &'a Trajectory, f64)>,
    /// The number of trajectories with an error above the bound.
    above: usize,
}

/// The largest |energy error| of all trajectories that did not fail.
fn energy<'a>(results: &'a Results<'_>, bound: f64) -> Energy<'a> {
    let mut energy = Energy::default();
    let mut all: Vec<_> = results.rows.iter().zip(results.energy_errors()).collect();
    if let Seen::Section = results.seen {
        // The section may have no states.
        let ends = results.at_end().energy_errors();
        for ((_, errors), end) in all.iter_mut().zip(ends) {
            errors.extend(end);
        }
    }
    for (row, errors) in all {
        if row.failure.is_some() {
            continue;
        }
        let seen = points(row).map(|point| point.time);
        let times = seen.chain([row.state.time]);
        let mut is_above = false;
        for (error, time) in errors.into_iter().map(f64::abs).zip(times) {
            is_above |= error > bound || error.is_nan();
            let is_larger = |largest: f64| error > largest || error.is_nan() && !largest.is_nan();
            if energy
                .largest
                .is_none_or(|(largest, ..)| is_larger(largest))
            {
                energy.largest = Some((error, row, time));
            }
        }
        energy.above += usize::from(is_above);
    }
    energy
}

/// The lines of the summary after the first, and a warning if energy errors are above a bound.
pub(super) fn summary(
    results: &Results<'_>,
    bound: f64,
    seconds: f64,
    [before, skipped]: [usize; 2],
) -> (String, Option<String>) {
    let rows = results.rows;
    let mut lines: Vec<[String; 2]> = Vec::new();
    if skipped > 0 {
        lines.push([
            "impossible starts".to_owned(),
            format!("{skipped}, left out"),
        ]);
    }
    let mut kinds: Vec<(&str, usize, &Trajectory, &str)> = Vec::new();
    for row in rows {
        let Some(failure) = &row.failure else {
            continue;
        };
        match kinds.iter_mut().find(|(kind, ..)| *kind == failure.kind) {
            Some((_, count, ..)) => *count += 1,
            None => kinds.push((&failure.kind, 1, row, &failure.message)),
        }
    }
    for (kind, count, first, message) in kinds {
        let first = format!("{count}: trajectory {}: {message}", first.number);
        lines.push([format!("failed, {kind}"), first]);
    }
    let is_conserved = results.tapes.energy_is_conserved();
    let energy = energy(results, bound);
    let whose = energy
        .largest
        .map(|(error, row, time)| (error, format!("trajectory {}, time {time}", row.number)));
    if let Some((error, whose)) = &whose {
        let label = match is_conserved {
            true => "largest energy error",
            false => "largest change of energy",
        };
        lines.push([label.to_owned(), format!("{error:.1e} ({whose})")]);
    }
    let constraints = results.constraint_errors().concat().into_iter();
    let larger = |a: f64, b: f64| if a.is_nan() || a > b { a } else { b };
    if let Some(error) = constraints.reduce(larger) {
        let label = "largest constraint error".to_owned();
        lines.push([label, format!("{error:.1e}")]);
    }
    let total = |of: fn(&Trajectory) -> u64| rows.iter().map(of).sum::<u64>();
    let steps = total(|row| row.statistics.steps);
    lines.push(["steps".to_owned(), steps.to_string()]);
    let sweeps = total(|row| row.statistics.iterations);
    if sweeps > 0 {
        let mean = sweeps as f64 / steps.max(1) as f64;
        lines.push([
            "sweeps".to_owned(),
            format!("{sweeps}, {mean:.1} for each step"),
        ]);
    }
    let resumed = match before {
        0 => String::new(),
        _ => format!(
            ", without {} of the interrupted run",
            counted(before, "trajectory", "trajectories")
        ),
    };
    lines.push(["time".to_owned(), duration(seconds) + &resumed]);
    let warning = whose.filter(|_| energy.above > 0 && is_conserved);
    let warning = warning.map(|(error, whose)| {
        format!(
            "the energy error is above {bound} in {} of {}; the largest is {error:.1e} ({whose}): take a smaller step or another method, \
             or set another bound with `warn_energy_error`",
            energy.above,
            counted(rows.len(), "trajectory", "trajectories")
        )
    });
    (aligned(&lines), warning)
}
