//! Rounding errors of constrained steps on a double pendulum with rods: `cargo run --release -p symplectic-tests --example constrained_runs`, some minutes;
//! `-- --quick` for fewer steps, some seconds.
//!
//! The largest error of the constraints and of their rates over 10⁷ steps, and the mean energy error of 32 orbits over 2²² steps. Fails if
//! an error exceeds [`CONSTRAINTS`], or a mean with compensated sums [`SIGNIFICANCE`].

#![allow(clippy::print_stdout, reason = "an example prints")]

use symplectic::constraints::Constrained;
use symplectic::nalgebra::SVector;
use symplectic::{Integrator, Method, ProvedFor, Separable, State};
use symplectic_tests::drift::ensemble;
use symplectic_tests::methods::{Lobatto3, Lobatto5, StoermerVerlet};
use symplectic_tests::scenes::double_pendulum::{OnRods, neighbours, on_rods, start};

/// Bound on |φ| and |G v|, whose terms have a size of at least 1: 45 units of rounding.
const CONSTRAINTS: f64 = 1e-14;
/// Bound on the mean energy error in standard errors. Without drift it is exceeded by one ensemble in 370.
const SIGNIFICANCE: f64 = 3.0;

type Outcome = Result<(), Box<dyn std::error::Error>>;
type Rods = State<SVector<f64, 4>>;

const ORBITS: u32 = 32;
/// So small that the energy error of Lobatto 5 is below that of rounding.
const STEP_SIZE: f64 = 1.0 / 128.0;

/// The largest |φ| and |G v|, where v = p.
fn errors(state: &Rods) -> [f64; 2] {
    let State { q, p, .. } = state;
    let between = |x: &SVector<f64, 4>| [x[2] - x[0], x[3] - x[1]];
    let rods = [([q[0], q[1]], [p[0], p[1]]), (between(q), between(p))];
    let dot = |a: [f64; 2], b: [f64; 2]| a[0] * b[0] + a[1] * b[1];
    rods.iter().fold([0.0; 2], |[length, rate], &(rod, v)| {
        let off = (dot(rod, rod) - 1.0).abs();
        [length.max(off), rate.max(2.0 * dot(rod, v).abs())]
    })
}

/// The largest errors over a run.
fn constraints<M>(method: M, steps: u64) -> Outcome
where
    M: Method + Copy + ProvedFor<Constrained<Separable>>,
{
    let mut run = Integrator::new(method, OnRods::new(), on_rods(&start()), STEP_SIZE)?;
    let mut largest = [0.0_f64; 2];
    for _ in 0..steps {
        let found = errors(run.step()?);
        largest = [0, 1].map(|k| largest[k].max(found[k]));
    }
    println!(
        "| {} | {steps} | {:.1e} | {:.1e} |",
        M::NAME,
        largest[0],
        largest[1]
    );
    check(largest[0].max(largest[1]), CONSTRAINTS, M::NAME)
}

/// An error if a figure is above its bound, or NaN.
fn check(figure: f64, bound: f64, of: &str) -> Outcome {
    if figure.abs() <= bound {
        return Ok(());
    }
    Err(format!("{of}: {figure:e} is more than {bound:e}").into())
}

fn main() -> Outcome {
    let quick = std::env::args().any(|argument| argument == "--quick");
    let (steps, most) = if quick {
        (100_000, 14)
    } else {
        (10_000_000, 22)
    };
    println!("| method | steps | largest |φ| | largest |G v| |\n|---|---:|---:|---:|");
    constraints(StoermerVerlet, steps)?;
    constraints(Lobatto3, steps)?;

    println!("\nRelative energy errors of {ORBITS} orbits after 2^{most} steps of Lobatto 5.\n");
    println!("| orbits | sums | mean | spread | mean in standard errors |");
    println!("|---|---|---:|---:|---:|");
    let regular = neighbours([1.0, 0.5], ORBITS);
    let chaotic = neighbours([2.0, 2.5], ORBITS);
    let steps = [1 << most];
    let compensated = |start| Integrator::new(Lobatto5, OnRods::new(), start, STEP_SIZE);
    let plain = |start| Integrator::plain(Lobatto5, OnRods::new(), start, STEP_SIZE);
    for (orbits, sums, samples) in [
        (
            "chaotic",
            "compensated",
            ensemble(compensated, &chaotic, &steps)?,
        ),
        (
            "regular",
            "compensated",
            ensemble(compensated, &regular, &steps)?,
        ),
        ("regular", "plain", ensemble(plain, &regular, &steps)?),
    ] {
        for sample in samples {
            println!(
                "| {orbits} | {sums} | {:.1e} | {:.1e} | {:.1} |",
                sample.mean, sample.spread, sample.significance
            );
            if sums == "compensated" {
                check(sample.significance, SIGNIFICANCE, orbits)?;
            }
        }
    }
    Ok(())
}
