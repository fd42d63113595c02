//! The recurrence of Fermi, Pasta, Ulam and Tsingou: the energy of the lowest mode of a chain spreads and comes back.
//! `cargo run --release --example chain`

#![allow(clippy::print_stdout, reason = "an example prints")]

use std::f64::consts::PI;

use symplectic::nalgebra::DVector;
use symplectic::{Error, Integrator, State};

symplectic::tableau! {
    /// Blanes & Moan, explicit, order 6 for H = |p|²/2 + U(q).
    BlanesMoan { base: blanes-moan-2002-srkn14a }
}

symplectic::hamiltonian! {
    /// Masses 1 between walls; `d` is the stretch of a bond.
    Fput { alpha: 0.25 }
    q: [..], p: [..]; bonds: walls;
    H = sum(i: p[i]^2/2) + sum(bonds d: d^2/2 + alpha d^3/3)
}

const MASSES: usize = 32;

/// The shape of a mode at a mass, both counted from one.
fn shape(mode: usize, mass: usize) -> f64 {
    (PI * (mode * mass) as f64 / (MASSES + 1) as f64).sin()
}

/// The energy of a mode without the cubic terms.
fn mode_energy(state: &State<DVector<f64>>, mode: usize) -> f64 {
    let amplitude = |x: &DVector<f64>| -> f64 {
        let terms = x.iter().enumerate().map(|(i, x)| x * shape(mode, i + 1));
        terms.sum::<f64>() * (2.0 / (MASSES + 1) as f64).sqrt()
    };
    let frequency = 2.0 * (PI * mode as f64 / (2 * (MASSES + 1)) as f64).sin();
    (amplitude(&state.p).powi(2) + (frequency * amplitude(&state.q)).powi(2)) / 2.0
}

fn main() -> Result<(), Error> {
    let q = DVector::from_fn(MASSES, |i, _| shape(1, i + 1));
    let start = State::new(0.0, q, DVector::zeros(MASSES));
    let total = mode_energy(&start, 1);
    let mut integrator = Integrator::plain(BlanesMoan, Fput::default(), start, 0.5)?;

    println!("  time   energy of the modes 1 to 4, in percent of that at the start");
    let times: Vec<f64> = (0..=11).map(|k| f64::from(k) * 1000.0).collect();
    integrator.integrate_at(&times, |state| {
        let percent = [1, 2, 3, 4].map(|mode| 100.0 * mode_energy(state, mode) / total);
        println!("{:6}   {percent:6.1?}", state.time);
    })?;
    Ok(())
}
