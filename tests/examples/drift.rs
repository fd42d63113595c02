//! Whether rounding errors make the energy drift: ensembles of 32 orbits over 4 194 304 steps.
//!
//! `cargo run --release --example drift`, some minutes; `-- --quick` for 65 536 steps.

#![allow(clippy::print_stdout, reason = "an example prints")]

use symplectic::nalgebra::Vector2;
use symplectic::{Error, HamiltonianInLanes, Integrator, Method};
use symplectic_tests::drift::{Sample, Start, ensemble, exponent};
use symplectic_tests::methods::{Gauss6, Gauss8};
use symplectic_tests::scenes::henon_heiles::{self, HenonHeiles};
use symplectic_tests::scenes::kepler::{self, Kepler};

const ORBITS: u32 = 32;

fn main() -> Result<(), Error> {
    let quick = std::env::args().any(|argument| argument == "--quick");
    let most = if quick { 16 } else { 22 };
    let steps: Vec<u64> = (most - 8..=most).step_by(2).map(|k| 1 << k).collect();
    println!("Relative energy errors of {ORBITS} orbits after 2^{most} steps.");
    println!(
        "ratio: the mean in units of its standard error; growth: exponents of the number of steps.\n"
    );
    println!(
        "| problem | method | sums | mean | spread | ratio | growth of the mean | of the spread |"
    );
    println!("|---|---|---|---:|---:|---:|---:|---:|");
    let orbits = |start: fn(f64) -> Start| -> Vec<Start> {
        (0..ORBITS).map(|k| start(f64::from(k))).collect()
    };
    // Neighbouring orbits: their rounding errors are independent.
    let ellipses = orbits(|k| kepler::start(0.6 - 1e-3 * k));
    let stars = orbits(|k| {
        let mut start = henon_heiles::start();
        start.q[0] += 1e-3 * k;
        start
    });
    // The step sizes are such that the errors of the methods themselves are below those of rounding.
    let kepler = Ensemble {
        problem: "Kepler, e ≈ 0.6",
        system: Kepler,
        starts: &ellipses,
    };
    kepler.rows(Gauss6, 1.0 / 32.0, &steps)?;
    kepler.rows(Gauss8, 1.0 / 16.0, &steps)?;
    let galaxy = Ensemble {
        problem: "Hénon–Heiles",
        system: HenonHeiles,
        starts: &stars,
    };
    galaxy.rows(Gauss6, 1.0 / 16.0, &steps)?;
    galaxy.rows(Gauss8, 1.0 / 8.0, &steps)
}

/// Orbits of one system.
struct Ensemble<'a, S> {
    problem: &'a str,
    system: S,
    starts: &'a [Start],
}

impl<S: HamiltonianInLanes<Vector2<f64>> + Copy> Ensemble<'_, S> {
    /// A row for each kind of sums, and one for the step without momentum stages.
    fn rows<M: Method>(&self, method: M, step_size: f64, steps: &[u64]) -> Result<(), Error> {
        let system = self.system;
        let row = |sums, samples: Vec<Sample>| self.row::<M>(sums, &samples);
        // In lanes they are the same to the last bit, and faster.
        let compensated = |start| Ok(Integrator::new(method, system, start, step_size)?.in_lanes());
        row("compensated", ensemble(compensated, self.starts, steps)?);
        let second_order =
            |start| Integrator::new(method, system, start, step_size)?.in_second_order_lanes();
        row(
            "compensated, second order",
            ensemble(second_order, self.starts, steps)?,
        );
        let plain = |start| Ok(Integrator::plain(method, system, start, step_size)?.in_lanes());
        row("plain", ensemble(plain, self.starts, steps)?);
        Ok(())
    }

    fn row<M: Method>(&self, sums: &str, samples: &[Sample]) {
        let Some(last) = samples.last() else {
            return;
        };
        println!(
            "| {} | {} | {sums} | {:.1e} | {:.1e} | {:.1} | {:.2} | {:.2} |",
            self.problem,
            M::NAME,
            last.mean,
            last.spread,
            last.significance,
            exponent(samples, |sample| sample.mean),
            exponent(samples, |sample| sample.spread),
        );
    }
}
