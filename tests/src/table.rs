//! Tables for a terminal.

use std::fmt;
use std::time::Duration;

use crate::measure::Measurement;
use crate::order::ObservedOrder;

/// Runs of several methods, printed as an aligned table.
#[derive(Clone, Debug, Default)]
pub struct Table {
    blocks: Vec<Vec<[String; COLUMNS]>>,
}

const COLUMNS: usize = 9;

const HEADER: [&str; COLUMNS] = [
    "method",
    "step size",
    "steps",
    "forces",
    "sweeps/step",
    "energy error",
    "position error",
    "order",
    "time",
];

impl Table {
    /// Adds the runs of a method, as `(step size, measurement, position error)` with decreasing step size.
    pub fn add<V>(&mut self, method: &str, runs: &[(f64, Measurement<V>, f64)]) {
        let mut rows = Vec::new();
        for (index, (step_size, run, error)) in runs.iter().enumerate() {
            let order = index.checked_sub(1).map(|previous| {
                let (previous_size, _, previous_error) = &runs[previous];
                ObservedOrder::of(&[(*previous_size, *previous_error), (*step_size, *error)]).slope
            });
            let sweeps = run.sweeps as f64 / run.steps as f64;
            rows.push([
                if index == 0 {
                    method.to_owned()
                } else {
                    String::new()
                },
                step_size.to_string(),
                grouped(run.steps),
                grouped(run.forces),
                if run.sweeps == 0 {
                    "explicit".to_owned()
                } else {
                    format!("{sweeps:.1}")
                },
                format!("{:.1e}", run.energy_error()),
                format!("{error:.1e}"),
                order.map_or_else(String::new, |order| format!("{order:.2}")),
                duration(run.time),
            ]);
        }
        self.blocks.push(rows);
    }
}

impl fmt::Display for Table {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        let header = HEADER.map(str::to_owned);
        let mut widths = [0; COLUMNS];
        for row in self.blocks.iter().flatten().chain([&header]) {
            for (width, cell) in widths.iter_mut().zip(row) {
                *width = (*width).max(cell.chars().count());
            }
        }
        line(f, &widths, &header)?;
        for rows in &self.blocks {
            writeln!(f, "{}", widths.map(|width| "─".repeat(width)).join("──"))?;
            for row in rows {
                line(f, &widths, row)?;
            }
        }
        Ok(())
    }
}

/// Names are left-aligned, numbers right-aligned.
fn line(
    f: &mut fmt::Formatter<'_>,
    widths: &[usize; COLUMNS],
    row: &[String; COLUMNS],
) -> fmt::Result {
    write!(f, "{:<width$}", row[0], width = widths[0])?;
    for (cell, width) in row.iter().zip(widths).skip(1) {
        write!(f, "  {cell:>width$}")?;
    }
    writeln!(f)
}

/// Grouped digits: 12 345.
fn grouped(number: u64) -> String {
    let digits = number.to_string();
    let mut text = String::new();
    for (index, digit) in digits.chars().enumerate() {
        if index > 0 && (digits.len() - index).is_multiple_of(3) {
            text.push(' ');
        }
        text.push(digit);
    }
    text
}

fn duration(duration: Duration) -> String {
    let milliseconds = 1e3 * duration.as_secs_f64();
    let decimals = if milliseconds < 10.0 { 2 } else { 0 };
    format!("{milliseconds:.decimals$} ms")
}
