//! What becomes of each method where problems are stiff or extreme, as a table.
//!
//! `cargo run --release --example stiff_and_extreme`; with `-- --long` the last problem has 10⁷ steps, some minutes.

#![allow(clippy::print_stdout, reason = "an example prints")]

use std::error::Error;

use symplectic_tests::linear_stability::catalogue;
use symplectic_tests::outcomes::{METHODS, extremes, oscillators, oscillators_at_the_limit};

fn main() -> Result<(), Box<dyn Error>> {
    let long = std::env::args().any(|argument| argument == "--long");
    let catalogue = catalogue()?;
    let entries = METHODS.map(|(_, name)| &catalogue[name]);
    let mut rows = oscillators();
    rows.extend([0.99, 1.01].map(|fraction| oscillators_at_the_limit(fraction, entries)));
    rows.extend(extremes(if long { 10_000_000 } else { 10_000 }));
    for row in rows {
        println!("{}", row.problem);
        for ((name, _), outcome) in METHODS.iter().zip(&row.outcomes) {
            if let Some(outcome) = outcome {
                println!("    {name:22} {} {outcome}", outcome.letter());
            }
        }
    }
    Ok(())
}
