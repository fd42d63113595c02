//! Rounding errors of long runs: a random walk of the energy with compensated sums, a larger one with plain ones.
//!
//! `cargo run --release --example drift` does the same over 2048 times as many steps.

use symplectic::nalgebra::SVector;
use symplectic::{Compensated, Error, Plain, State, Summation};
use symplectic_tests::drift::{Sample, ensemble};
use symplectic_tests::methods::Gauss6;
use symplectic_tests::scenes::henon_heiles::{HenonHeiles, start};

fn sample<R: Summation>() -> Result<Sample, Error> {
    let starts: Vec<State<SVector<f64, 2>>> = (0..16)
        .map(|k| {
            let mut start = start();
            start.q[0] += 1e-3 * f64::from(k);
            start
        })
        .collect();
    let samples = ensemble::<_, _, R>(Gauss6, HenonHeiles, &starts, 1.0 / 16.0, &[1 << 11])?;
    Ok(samples[0])
}

#[test]
fn compensated_sums_leave_a_small_random_walk() -> Result<(), Error> {
    let compensated = sample::<Compensated>()?;
    let plain = sample::<Plain>()?;
    // The energy 1/8 is itself computed with an error of some units of 2⁻⁵³: 8e-16 relative to it.
    assert!(compensated.spread < 1e-15, "{compensated:?}");
    // Plain sums err by half a unit of the state in each of 2¹¹ steps: 45 · 8e-16/√12 if independent.
    assert!(plain.spread > 4.0 * compensated.spread, "{plain:?}");
    assert!(plain.spread < 5e-14, "{plain:?}");
    // Student's t with 15 degrees of freedom is beyond 4.07 once in a thousand.
    assert!(compensated.significance.abs() < 4.07, "{compensated:?}");
    Ok(())
}
