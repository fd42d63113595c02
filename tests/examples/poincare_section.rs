//! A Poincaré section of the Hénon–Heiles system: where orbits of energy 1/8 go up through the plane q_1 = 0.
//!
//! `cargo run --release -p symplectic-tests --example poincare_section`
//!
//! Points of a regular orbit lie on a curve, those of a chaotic one fill an area.

#![allow(clippy::print_stdout, reason = "an example prints")]

use std::ops::ControlFlow;

use symplectic::nalgebra::SVector;
use symplectic::{Error, Event, Integrator, State};
use symplectic_tests::methods::Gauss8;
use symplectic_tests::scenes::henon_heiles::{HenonHeiles, on_section};

const ENERGY: f64 = 0.125;

/// Orbits by their places (q_2, p_2) at the start, and the letters that they are plotted with.
const ORBITS: [(char, f64, f64); 5] = [
    ('a', 0.30, 0.00),
    ('b', 0.20, 0.00),
    ('c', 0.00, 0.25),
    ('d', 0.10, 0.00),
    ('.', -0.25, 0.00),
];

const POINTS: usize = 400;
const STEP_SIZE: f64 = 0.25;

const COLUMNS: usize = 76;
const ROWS: usize = 34;

fn main() -> Result<(), Error> {
    let mut plot = vec![vec![' '; COLUMNS]; ROWS];
    println!(
        "orbit      q_2      p_2   points        time   largest error of the energy on the section"
    );
    for (letter, q2, p2) in ORBITS {
        let points = section(q2, p2)?;
        for state in &points {
            // q_2 from -0.45 to 0.75 upward, p_2 from -0.5 to 0.5 to the right.
            let row = (0.75 - state.q[1]) / 1.2 * ROWS as f64;
            let column = (state.p[1] + 0.5) * COLUMNS as f64;
            plot[(row as usize).min(ROWS - 1)][(column as usize).min(COLUMNS - 1)] = letter;
        }
        let error = points.iter().map(energy_error).fold(0.0, f64::max);
        let end = points.last().map_or(f64::NAN, |state| state.time);
        let count = points.len();
        println!("{letter:>5} {q2:8.3} {p2:8.3} {count:8} {end:11.3}   {error:.1e}");
    }
    println!("\nq_2 from -0.45 to 0.75 upward, p_2 from -0.5 to 0.5 to the right:\n");
    for row in plot {
        println!("{}", row.into_iter().collect::<String>().trim_end());
    }
    Ok(())
}

/// The first points of an orbit on the section.
fn section(q2: f64, p2: f64) -> Result<Vec<State<SVector<f64, 2>>>, Error> {
    let start = on_section(ENERGY, q2, p2);
    let mut integrator = Integrator::new(Gauss8, HenonHeiles, start, STEP_SIZE)?;
    let mut points = Vec::new();
    // By steps, so that the points are as good as the states between the steps.
    let event = Event::rising(|state: &State<SVector<f64, 2>>| state.q[0]).by_steps();
    integrator.integrate_with_events(1e5, &event, |state| {
        points.push(state.clone());
        if points.len() == POINTS {
            ControlFlow::Break(())
        } else {
            ControlFlow::Continue(())
        }
    })?;
    Ok(points)
}

/// The relative error of the energy.
fn energy_error(state: &State<SVector<f64, 2>>) -> f64 {
    let energy =
        symplectic::SeparableHamiltonian::energy(&HenonHeiles, state.time, &state.q, &state.p);
    energy.map_or(f64::NAN, |energy| ((energy - ENERGY) / ENERGY).abs())
}
