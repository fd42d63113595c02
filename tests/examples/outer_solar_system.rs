//! The outer solar system over 548 years: what accuracy costs with three methods.
//!
//! `cargo run --release -p symplectic-tests --example outer_solar_system`

#![allow(clippy::print_stdout, reason = "an example prints")]

use symplectic::{Error, Method};
use symplectic_tests::measure::{measure, position_error};
use symplectic_tests::methods::{Gauss4, Lobatto4, StoermerVerlet};
use symplectic_tests::scenes::outer_solar_system::{OuterSolarSystem, reference, start};
use symplectic_tests::table::Table;

const DAYS: f64 = 200_000.0;

fn main() -> Result<(), Error> {
    println!("The Sun and Jupiter to Pluto from 5 September 1994 over {DAYS} days, in AU.");
    println!("Position errors are taken against Gauss with eight stages, good to 5e-11 AU.\n");
    let mut table = Table::default();
    run(
        &mut table,
        "Störmer–Verlet",
        StoermerVerlet,
        &[40.0, 20.0, 10.0, 5.0],
    )?;
    run(
        &mut table,
        "Lobatto 4",
        Lobatto4,
        &[400.0, 200.0, 100.0, 50.0],
    )?;
    run(&mut table, "Gauss 4", Gauss4, &[800.0, 400.0, 200.0, 100.0])?;
    print!("{table}");
    Ok(())
}

/// Adds the runs of one method with the `step_sizes`, in days.
fn run<M: Method + Copy>(
    table: &mut Table,
    name: &str,
    method: M,
    step_sizes: &[f64],
) -> Result<(), Error> {
    let reference = reference(DAYS)?;
    let mut runs = Vec::new();
    for &step_size in step_sizes {
        let measured = measure(method, &OuterSolarSystem, &start(), DAYS, step_size)?;
        let error = position_error(&measured.end, &reference);
        runs.push((step_size, measured, error));
    }
    table.add(name, &runs);
    Ok(())
}
