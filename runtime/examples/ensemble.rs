//! How many starts of Hénon and Heiles escape, and how often the others cross their section:
//! `cargo run --release --features parallel --example ensemble`

#![allow(clippy::print_stdout, reason = "an example prints")]

use std::ops::ControlFlow;

use symplectic::ensemble::{Ensemble, EnsembleError, Histogram};
use symplectic::nalgebra::Vector2;
use symplectic::{Event, State};

symplectic::tableau! { ForestRuth { base: forest-ruth-1990 } }

symplectic::hamiltonian! {
    HenonHeiles
    q: [x, y], p: [px, py];
    H = (px^2 + py^2)/2 + (x^2 + y^2)/2 + x^2 y - y^3/3
}

/// A start on the section x = 0, of an energy.
fn start(energy: f64, y: f64) -> State<Vector2<f64>> {
    let kinetic = energy - y * y / 2.0 + y * y * y / 3.0;
    State::from_arrays(0.0, [0.0, y], [(2.0 * kinetic).max(0.0).sqrt(), 0.0])
}

fn main() -> Result<(), EnsembleError> {
    let section = Event::rising(|state: &State<Vector2<f64>>| state.q[0]);
    println!("energy  escaped  crossings of those that stay, in bins of four");
    for energy in [0.1, 0.16, 0.17, 0.2] {
        let starts = (0..256).map(|k| start(energy, f64::from(k) / 640.0));
        let ensemble = Ensemble::new(ForestRuth, HenonHeiles, starts.collect(), 0.05)?;
        let mut crossings = Histogram::new(24.0, 44.0, 5)?;
        let mut escaped = 0;
        ensemble.each(
            |_trajectory| 0,
            |count, integrator| {
                integrator.integrate_with_events(200.0, &section, |_| {
                    *count += 1;
                    ControlFlow::<()>::Continue(())
                })?;
                Ok(())
            },
            |row| {
                match row.outcome {
                    Ok(()) => crossings.add(f64::from(row.output)),
                    Err(_) => escaped += 1,
                }
                ControlFlow::Continue(())
            },
        );
        println!("{energy:6}  {escaped:7}  {:?}", crossings.counts());
    }
    Ok(())
}
