//! A first program, the pendulum `H = p²/2 − cos q`: `cargo run --release --example my_hamiltonian`

#![allow(clippy::print_stdout, reason = "an example prints")]

use symplectic::nalgebra::Vector1;
use symplectic::{Error, Integrator, State};

symplectic::tableau! {
    /// Lobatto IIIA–IIIB with three stages, order 4.
    Lobatto3 { basis: polynomial(3), nodes: lobatto(3), require: [symplectic, symmetric] }
}

symplectic::hamiltonian! { Pendulum q: [a], p: [pa]; H = pa^2/2 - cos(a) }

fn main() -> Result<(), Error> {
    let start = State::new(0.0, Vector1::new(2.0), Vector1::new(0.0));
    let mut integrator = Integrator::new(Lobatto3, Pendulum, start, 0.1)?;
    println!("  time      angle    momentum     energy");
    for end in [0.0, 1.0, 10.0, 100.0, 1000.0, 10_000.0] {
        let State { time, q, p } = integrator.integrate_to(end)?.clone();
        let energy = integrator.energy().unwrap_or(f64::NAN);
        println!("{time:6}  {:9.6}  {:10.6}  {energy:9.7}", q[0], p[0]);
    }
    Ok(())
}
