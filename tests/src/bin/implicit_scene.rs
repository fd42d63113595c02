//! Like `explicit_scene`, but with an implicit method. A test finds the solver in the binary.

#![allow(clippy::print_stdout, reason = "a program prints")]

use symplectic::{Error, Integrator};
use symplectic_tests::methods::Gauss2;
use symplectic_tests::scenes::henon_heiles::{HenonHeiles, start};

fn main() -> Result<(), Error> {
    let mut integrator = Integrator::new(Gauss2, HenonHeiles, start::<f64>(), 0.125)?;
    println!("{:?}", integrator.integrate_to(100.0)?);
    Ok(())
}
