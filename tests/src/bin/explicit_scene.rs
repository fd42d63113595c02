//! A separable scene with an explicit method. A test checks that the binary contains no code it does not need.

#![allow(clippy::print_stdout, reason = "a program prints")]

use symplectic::{Error, Integrator};
use symplectic_tests::methods::VelocityVerlet;
use symplectic_tests::scenes::henon_heiles::{HenonHeiles, start};

fn main() -> Result<(), Error> {
    let mut integrator = Integrator::new(VelocityVerlet, HenonHeiles, start::<f64>(), 0.125)?;
    println!("{:?}", integrator.integrate_to(100.0)?);
    Ok(())
}
