//! Rounding errors of long runs: a random walk of the energy with compensated sums, a larger one with plain ones.
//!
//! `cargo run --release -p symplectic-tests --example drift` does the same over 2048 times as many steps.

use symplectic::nalgebra::Vector2;
use symplectic::{Error, Integrator, State};
use symplectic_tests::drift::ensemble;
use symplectic_tests::methods::{Gauss6, Lobatto5};
use symplectic_tests::scenes::double_pendulum::{OnRods, neighbours};
use symplectic_tests::scenes::henon_heiles::{HenonHeiles, start};

const STEP_SIZE: f64 = 1.0 / 16.0;
const STEPS: [u64; 1] = [1 << 11];

fn starts() -> Vec<State<Vector2<f64>>> {
    let orbit = |k: u32| {
        let mut start = start();
        start.q[0] += 1e-3 * f64::from(k);
        start
    };
    (0..16).map(orbit).collect()
}

#[test]
fn compensated_sums_leave_a_small_random_walk() -> Result<(), Error> {
    let starts = starts();
    let compensated = ensemble(
        |start| Integrator::new(Gauss6, HenonHeiles, start, STEP_SIZE),
        &starts,
        &STEPS,
    )?[0];
    let plain = ensemble(
        |start| Integrator::plain(Gauss6, HenonHeiles, start, STEP_SIZE),
        &starts,
        &STEPS,
    )?[0];
    // The energy 1/8 is itself computed with an error of some units of 2⁻⁵³: 8e-16 relative to it.
    assert!(compensated.spread < 1e-15, "{compensated:?}");
    // Plain sums err by half a unit of the state in each of 2¹¹ steps: 45 · 8e-16/√12 if independent.
    assert!(plain.spread > 4.0 * compensated.spread, "{plain:?}");
    assert!(plain.spread < 5e-14, "{plain:?}");
    // Student's t with 15 degrees of freedom is beyond 4.07 once in a thousand.
    assert!(compensated.significance.abs() < 4.07, "{compensated:?}");
    Ok(())
}

/// Other coefficients, and as exact: the same bounds.
#[test]
fn second_order_steps_leave_the_same_small_random_walk() -> Result<(), Error> {
    let second_order = ensemble(
        |start| Integrator::new(Gauss6, HenonHeiles, start, STEP_SIZE),
        &starts(),
        &STEPS,
    )?[0];
    assert!(second_order.spread < 1e-15, "{second_order:?}");
    assert!(second_order.significance.abs() < 4.07, "{second_order:?}");
    Ok(())
}

/// The iteration for the multipliers leaves a residual. If it had the same sign in every step, the mean would be 5 standard errors.
#[test]
fn constrained_steps_leave_a_small_random_walk() -> Result<(), Error> {
    let orbits = neighbours([1.0, 0.5], 16);
    let step_size = 1.0 / 128.0;
    let on_rods = ensemble(
        |start| Integrator::new(Lobatto5, OnRods::new(), start, step_size),
        &orbits,
        &[1 << 13],
    )?[0];
    assert!(on_rods.spread < 1e-15, "{on_rods:?}");
    assert!(on_rods.significance.abs() < 4.07, "{on_rods:?}");
    Ok(())
}
