//! Scenes with constraints, friction and a discrete Lagrangian. A test finds the code for each of them in the binary, and nothing of it in
//! that of a scene without.

#![allow(clippy::print_stdout, reason = "a program prints")]

use symplectic::Integrator;
use symplectic::variational::{DiracRule, DiracSteps, Error};
use symplectic_tests::methods::{Midpoint, StoermerVerlet, VelocityVerlet};
use symplectic_tests::scenes::{circuit, double_pendulum, henon_heiles, skate};

symplectic::hamiltonian! {
    /// The system of Hénon and Heiles with friction.
    Damped { gamma: 0.1 }
    q: [x, y], p: [px, py];
    H = (px^2 + py^2 + x^2 + y^2)/2 + x^2 y - y^3/3
    friction: gamma
}

fn main() -> Result<(), Error> {
    let start = double_pendulum::on_rods(&double_pendulum::start());
    let mut rods = Integrator::new(StoermerVerlet, double_pendulum::OnRods::new(), start, 0.01)?;
    println!("{:?}", rods.integrate_to(1.0)?);
    let mut skate = Integrator::new(Midpoint, skate::Skate::new(), skate::start(), 0.01)?;
    println!("{:?}", skate.integrate_to(1.0)?);
    let start = henon_heiles::start::<f64>();
    let mut damped = Integrator::new(VelocityVerlet, Damped::new(), start, 0.01)?;
    println!("{:?}", damped.integrate_to(1.0)?);
    let (rule, start) = (DiracRule::Trapezoid, circuit::start());
    let mut circuit = DiracSteps::run(rule, circuit::Circuit::default(), start, 0.01)?;
    println!("{:?}", circuit.integrate_to(1.0)?);
    Ok(())
}
