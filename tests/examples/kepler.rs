//! Kepler's problem with eccentricity 0.6 over twenty periods: what accuracy costs with three methods.
//!
//! `cargo run --release -p symplectic-tests --example kepler`

#![allow(clippy::print_stdout, reason = "an example prints")]

use symplectic::{Error, Method};
use symplectic_tests::measure::{measure, position_error};
use symplectic_tests::methods::{Gauss4, Lobatto3, StoermerVerlet};
use symplectic_tests::scenes::kepler::{Kepler, exact, start};
use symplectic_tests::table::Table;

const ECCENTRICITY: f64 = 0.6;

const END: f64 = 125.0;

fn main() -> Result<(), Error> {
    println!("Kepler's problem, eccentricity {ECCENTRICITY}, to time {END}: 19.9 periods.");
    println!("Position errors are taken against the closed form; the semi-major axis is 1.\n");
    let mut table = Table::default();
    run(
        &mut table,
        "Störmer–Verlet",
        StoermerVerlet,
        &[0.01, 0.005, 0.0025, 0.001],
    )?;
    run(
        &mut table,
        "Lobatto 3",
        Lobatto3,
        &[0.05, 0.025, 0.0125, 0.00625],
    )?;
    run(&mut table, "Gauss 4", Gauss4, &[0.1, 0.05, 0.04, 0.025])?;
    print!("{table}");
    Ok(())
}

/// Adds the runs of one method with the `step_sizes`.
fn run<M: Method + Copy>(
    table: &mut Table,
    name: &str,
    method: M,
    step_sizes: &[f64],
) -> Result<(), Error> {
    let reference = exact(ECCENTRICITY, END);
    let mut runs = Vec::new();
    for &step_size in step_sizes {
        let measured = measure(method, &Kepler, &start(ECCENTRICITY), END, step_size)?;
        let error = position_error(&measured.end, &reference);
        runs.push((step_size, measured, error));
    }
    table.add(name, &runs);
    Ok(())
}
