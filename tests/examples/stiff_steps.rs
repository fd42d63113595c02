//! Newton's iteration on stiff systems, k = 10² … 10¹² and h = 10⁻⁴ … 1: how many sweeps, and how far from the exact discrete solution.
//!
//! `cargo run -p symplectic-tests --example stiff_steps`; with an argument, every run that is not right in 30 sweeps is shown.

#![allow(clippy::print_stdout, reason = "an example prints")]

use symplectic_tests::stiff_steps::grid;

fn main() {
    let shows = std::env::args().len() > 1;
    let (mut runs, mut failed, mut grown, mut unknown) = (0, 0, 0, 0);
    let (mut easy, mut easily_failed, mut slow, mut most) = (0, 0, 0, 0);
    let mut largest = 0.0_f64;
    let powers: Vec<i32> = (2..=12).collect();
    grid(&powers, &[-4, -3, -2, -1, 0], |outcome| {
        runs += 1;
        let is_easy = !outcome.grows && outcome.in_full.is_some_and(|iterations| iterations <= 5);
        easy += u32::from(is_easy);
        grown += u32::from(outcome.grows);
        unknown += u32::from(outcome.error.is_none());
        let is_good = match &outcome.sweeps {
            Ok(sweeps) => {
                if is_easy {
                    most = most.max(*sweeps);
                }
                slow += u32::from(is_easy && *sweeps > 30);
                let error = outcome.error.filter(|_| !outcome.grows).unwrap_or(0.0);
                largest = largest.max(error);
                *sweeps <= 30 && error < 4.0
            }
            Err(_) => {
                failed += 1;
                easily_failed += u32::from(is_easy);
                false
            }
        };
        if shows && !is_good {
            println!("{outcome:?}");
        }
    });
    println!(
        "{runs} runs: {failed} failed; in {grown} the state grows; {unknown} without an exact solution."
    );
    println!(
        "Full Newton in doubles needs at most 5 iterations in {easy}: of these {easily_failed} failed,"
    );
    println!("{slow} took more than 30 sweeps, the most is {most}.");
    println!(
        "Largest error, of states that do not grow: {largest:.2} times the bound of rounding."
    );
}
