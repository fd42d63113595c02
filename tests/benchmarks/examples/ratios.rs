//! The library against hand-written integrators: times per step and their ratio.
//!
//! `RUSTFLAGS="-C target-cpu=native" cargo run --release -p symplectic-benchmarks --example ratios`; arguments select rows that contain them.
//! Runs of both take turns, so that changes in the speed of the machine affect both alike. A run has the number of
//! steps of Gauss 8 to the end of the problem, at most 50 milliseconds.

#![allow(clippy::print_stdout, reason = "an example prints")]

use std::hint::black_box;
use std::time::Instant;

use symplectic::Error;
use symplectic_benchmarks::{Run, pairs};

/// Number of runs of each.
const ROUNDS: usize = 101;

fn main() -> Result<(), Error> {
    let wanted: Vec<String> = std::env::args().skip(1).collect();
    println!(
        "Nanoseconds a step, medians of {ROUNDS} runs that take turns; ratio: the median of the ratios of neighbouring runs."
    );
    println!(
        "difference: of the states, relative, after a part of the run where rounding errors grow fast.\n"
    );
    println!(
        "| problem | method | sums | step size | by hand | library | ratio | of the least | difference |"
    );
    println!("|---|---|---|---:|---:|---:|---:|---:|---:|");
    for pair in pairs() {
        let label = pair.label();
        if !wanted.iter().all(|part| label.contains(part)) {
            continue;
        }
        let difference = pair.difference()?;
        let (mut baseline, mut library, mut ratio) = (Vec::new(), Vec::new(), Vec::new());
        for _ in 0..ROUNDS {
            let (by_hand, by_library) = (
                time(&pair.baseline, pair.steps)?,
                time(&pair.library, pair.steps)?,
            );
            baseline.push(by_hand);
            library.push(by_library);
            ratio.push(by_library / by_hand);
        }
        let of_the_least = least(&library) / least(&baseline);
        let per_step = 1e9 / pair.steps as f64;
        println!(
            "| {label} | {:.3} | {:.1} | {:.1} | {:.2} | {:.2} | {difference:.0e} |",
            pair.step_size,
            per_step * median(baseline),
            per_step * median(library),
            median(ratio),
            of_the_least,
        );
    }
    Ok(())
}

/// Seconds of one run.
fn time(run: &Run, steps: u64) -> Result<f64, Error> {
    let begin = Instant::now();
    black_box(run(steps)?);
    Ok(begin.elapsed().as_secs_f64())
}

/// The smallest value, which is least disturbed by other processes.
fn least(values: &[f64]) -> f64 {
    values.iter().copied().fold(f64::INFINITY, f64::min)
}

fn median(mut values: Vec<f64>) -> f64 {
    values.sort_by(f64::total_cmp);
    values[values.len() / 2]
}
