//! Where an orbit of Hénon and Heiles crosses the plane x = 0 upward, and its energy there: `cargo run --release --example events`

#![allow(clippy::print_stdout, reason = "an example prints")]

use std::ops::ControlFlow;

use symplectic::nalgebra::Vector2;
use symplectic::{Error, Event, Integrator, Invariant, State};

symplectic::tableau! {
    /// Gauss with four stages, order 8.
    Gauss4 { basis: polynomial(4), nodes: gauss(4), require: [symplectic, symmetric] }
}

symplectic::hamiltonian! {
    HenonHeiles
    q: [x, y], p: [px, py];
    H = (px^2 + py^2)/2 + (x^2 + y^2)/2 + x^2 y - y^3/3
}

const ENERGY: f64 = 0.125;
const POINTS: u32 = 20;

fn main() -> Result<(), Error> {
    // On the plane, with the momentum px that gives the energy.
    let (y, py) = (0.2_f64, 0.0_f64);
    let px = (2.0 * ENERGY - py * py - y * y + 2.0 / 3.0 * y.powi(3)).sqrt();
    let start = State::from_arrays(0.0, [0.0, y], [px, py]);

    let mut integrator = Integrator::new(Gauss4, HenonHeiles, start, 0.1)?;
    let mut energy = Invariant::energy(HenonHeiles, integrator.state());

    // From x < 0 to x > 0, located by steps of the method, with its order.
    let section = Event::rising(|state: &State<Vector2<f64>>| state.q[0]).by_steps();
    let mut points = 0;
    println!("      time          y         py           x");
    integrator.integrate_with_events(1000.0, &section, |state| {
        let State { time, q, p } = state;
        println!("{time:10.5}  {:9.6}  {:9.6}  {:10.1e}", q[1], p[1], q[0]);
        energy.observe(state);
        points += 1;
        match points {
            POINTS => ControlFlow::Break(()),
            _ => ControlFlow::Continue(()),
        }
    })?;
    println!(
        "largest relative error of the energy there: {:.1e}",
        energy.relative_deviation()
    );
    Ok(())
}
