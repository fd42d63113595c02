//! The same formula with Newton's iteration and its energy. A test finds the derivatives in the binary.

#![allow(clippy::print_stdout, reason = "a program prints")]

use symplectic::solver::ByNewton;
use symplectic::{Error, Integrator};
use symplectic_tests::formulas::HenonHeiles;
use symplectic_tests::methods::Gauss2;
use symplectic_tests::scenes::henon_heiles::start;

fn main() -> Result<(), Error> {
    let integrator = Integrator::new(Gauss2, HenonHeiles, start::<f64>(), 0.125)?;
    let mut integrator = integrator.by_newton();
    println!("{:?}", integrator.integrate_to(100.0)?);
    println!("{:?}", integrator.energy());
    Ok(())
}
