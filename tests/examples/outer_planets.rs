//! The outer planets over a million years, and how well energy and angular momentum are conserved.
//!
//! `cargo run --release -p symplectic-tests --example outer_planets`

#![allow(clippy::print_stdout, reason = "an example prints")]

use symplectic::nalgebra::SVector;
use symplectic::{Error, Integrator, Invariant, State};
use symplectic_tests::methods::Gauss8;
use symplectic_tests::scenes::outer_solar_system::{
    COORDINATES, OuterSolarSystem, angular_momentum, start, to_barycentre,
};

/// Days.
const YEAR: f64 = 365.25;
/// Days: a tenth of a revolution of Jupiter.
const STEP_SIZE: f64 = 400.0;
const YEARS: u32 = 1_000_000;
const LINES: u32 = 20;

fn main() -> Result<(), Error> {
    println!(
        "The Sun and Jupiter to Pluto over {YEARS} years, Gauss with eight stages in steps of {STEP_SIZE} days.\n"
    );
    println!("                       relative error of the energy      angular momentum   sweeps");
    println!("     years       steps   now         largest so far     largest so far     per step");
    // The Sun would carry the system away, and with it the digits of the distances.
    let start = to_barycentre(&start());
    let mut energy = Invariant::energy(OuterSolarSystem, &start);
    let mut momentum = Invariant::new(length, &start);
    let mut integrator = Integrator::new(Gauss8, OuterSolarSystem, start, STEP_SIZE)?;
    for line in 1..=LINES {
        let years = YEARS / LINES * line;
        integrator.integrate_with(f64::from(years) * YEAR, |state| {
            energy.observe(state);
            momentum.observe(state);
        })?;
        println!(
            "{years:10} {:11} {:+10.2e}   {:14.2e}     {:14.2e}     {:8.2}",
            integrator.steps(),
            energy.relative_error(),
            energy.relative_deviation(),
            momentum.relative_deviation(),
            integrator.iterations() as f64 / integrator.steps() as f64,
        );
    }
    Ok(())
}

/// The length of the angular momentum.
fn length(state: &State<SVector<f64, COORDINATES>>) -> f64 {
    SVector::from(angular_momentum(state)).norm()
}
