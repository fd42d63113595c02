//! How the time of a derivation grows with the number of stages.
//!
//! `cargo run --release --example cost`; other numbers of stages as arguments. One thread; the median of
//! several runs.
#![allow(clippy::print_stdout, reason = "the table is what this program is for")]

use std::time::{Duration, Instant};

use symplectic_compiler::export::{DEFAULT_DIGITS, json};
use symplectic_compiler::{Error, Limits, derive_within};

/// Everything that `derive --format json` does.
fn compile(family: &str, stages: usize) -> Result<Duration, Error> {
    let start = Instant::now();
    let limits = Limits { stages };
    let tableau = derive_within(
        &format!("polynomial({stages})"),
        &format!("{family}({stages})"),
        &limits,
    )?;
    let text = json::write(&tableau, DEFAULT_DIGITS);
    let time = start.elapsed();
    assert!(!text.is_empty());
    Ok(time)
}

fn median(family: &str, stages: usize) -> Result<f64, Error> {
    let runs = if stages > 16 { 3 } else { 9 };
    let mut times = (0..runs)
        .map(|_| compile(family, stages))
        .collect::<Result<Vec<_>, _>>()?;
    times.sort();
    Ok(times[runs / 2].as_secs_f64() * 1e3)
}

fn main() -> Result<(), Error> {
    let arguments: Vec<usize> = std::env::args()
        .skip(1)
        .filter_map(|argument| argument.parse().ok())
        .collect();
    let stages = if arguments.is_empty() {
        vec![2, 4, 8, 12, 16, 20, 24, 32]
    } else {
        arguments
    };
    println!(
        "derivation, all properties, closed forms, {DEFAULT_DIGITS} digits and doubles, in milliseconds\n"
    );
    println!("| stages | gauss | lobatto | chebyshev or clenshaw-curtis |");
    println!("|---:|---:|---:|---:|");
    for s in stages {
        let third = if s <= 7 || s == 9 {
            "chebyshev"
        } else {
            "clenshaw-curtis"
        };
        let [gauss, lobatto, third] = [
            median("gauss", s)?,
            median("lobatto", s)?,
            median(third, s)?,
        ];
        println!("| {s} | {gauss:.1} | {lobatto:.1} | {third:.1} |");
    }
    Ok(())
}
