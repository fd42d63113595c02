//! The hand-written integrators alone: nanoseconds per step, sweeps, nanoseconds per evaluation.
//!
//! `RUSTFLAGS="-C target-cpu=native" cargo run --release -p symplectic-benchmarks --example baseline`. A baseline must be fast: compare these
//! numbers with other hand-written loops.

#![allow(clippy::print_stdout, reason = "an example prints")]

use std::hint::black_box;
use std::time::Instant;

use symplectic_benchmarks::baseline::explicit::{self, BlanesMoan, Verlet};
use symplectic_benchmarks::baseline::gauss::{FirstOrder, Rule, SecondOrder};
use symplectic_benchmarks::baseline::no_drift::{Double, NoDrift, NoDriftGeneral};
use symplectic_benchmarks::baseline::{chain, systems};
use symplectic_tests::methods::Gauss8;
use symplectic_tests::scenes::{fput_chain, outer_solar_system};
use wide::f64x8;

const GAUSS: Rule<8> = Rule {
    a: Gauss8::A,
    a_tilde: Gauss8::A_TILDE,
    b: Gauss8::B,
    c: Gauss8::C,
};

/// Number of steps of a run, few enough that most runs are not interrupted.
const STEPS: u64 = 640;

fn main() {
    println!("Best of 200 runs; a sweep evaluates the force in eight lanes.\n");
    println!("| problem | form | step size | ns/step | sweeps/step | ns/evaluation |");
    println!("|---|---|---:|---:|---:|---:|");
    let kepler = ([0.4, 0.0], [0.0, 2.0]);
    separable("Kepler, e = 0.6", &systems::Kepler, kepler, 0.195, 1e-11);
    separable(
        "Kepler, e = 0.6",
        &systems::Kepler,
        kepler,
        3.0 / 32.0,
        1e-13,
    );
    let galaxy = ([0.0, 0.0], [0.3, 0.4]);
    separable("Hénon–Heiles", &systems::HenonHeiles, galaxy, 0.39, 1e-12);
    let start = outer_solar_system::start::<f64>();
    let planets = (start.q.data.0[0], start.p.data.0[0]);
    separable(
        "outer solar system",
        &systems::OuterSolarSystem,
        planets,
        488.0,
        1e-10,
    );
    let springs = (
        [1.0, 0.0, 0.0, 0.02, 0.0, 0.0],
        [1.0, 0.0, 0.0, 1.0, 0.0, 0.0],
    );
    let system = systems::FputSprings { omega: 50.0 };
    separable("FPUT springs, ω = 50", &system, springs, 0.04, 1e-12);
    let pendulum = ([1.0, 0.5], [0.0, 0.0]);
    general(
        "double pendulum",
        &systems::DoublePendulum,
        pendulum,
        0.1,
        1e-11,
    );
    general(
        "(q² + 1)(p² + 1)/2",
        &systems::Nonseparable,
        ([0.0], [-3.0]),
        0.1,
        1e-11,
    );
    let time = best(|| {
        let (mut q, mut p) = black_box(kepler);
        explicit::run::<Verlet, _, 2>(&systems::Kepler, (&mut q, &mut p), 0.01, STEPS);
        black_box((q, p));
    });
    row(
        "Kepler, e = 0.6",
        "Verlet",
        0.01,
        time / STEPS as f64,
        0,
        time / STEPS as f64,
    );
    let start = fput_chain::start(fput_chain::PARTICLES);
    let mut at = (
        chain::Blocks::new(start.q.as_slice()),
        chain::Blocks::new(start.p.as_slice()),
    );
    let time = best(|| chain::explicit::<BlanesMoan>(&mut at.0, &mut at.1, 0.2, STEPS / 10))
        / (STEPS / 10) as f64;
    row(
        "FPUT chain, N = 1024",
        "Blanes–Moan",
        0.2,
        time,
        0,
        time / 14.0,
    );
    let mut by_hand = chain::SecondOrder::<8>::new(&GAUSS, fput_chain::PARTICLES, 0.8);
    let mut sweeps = 0;
    let time = best(|| sweeps = by_hand.run(&mut at.0, &mut at.1, 1e-12, STEPS / 40));
    row(
        "FPUT chain, N = 1024",
        "Gauss 8, plain",
        0.8,
        time / (STEPS / 40) as f64,
        40 * sweeps,
        time / (8 * sweeps) as f64,
    );
}

/// Gauss with eight stages on a separable problem.
fn separable<T: systems::Separable<N>, const N: usize>(
    problem: &str,
    system: &T,
    start: ([f64; N], [f64; N]),
    step_size: f64,
    tolerance: f64,
) {
    let (plain, no_drift) = (
        SecondOrder::<f64x8, 8>::new(&GAUSS, step_size),
        NoDrift::<f64x8, 8>::new(&GAUSS, step_size),
    );
    gauss(problem, "Gauss 8, plain", step_size, || {
        let (mut q, mut p) = black_box(start);
        let sweeps = plain.run(system, (&mut q, &mut p), tolerance, STEPS);
        black_box((q, p));
        sweeps
    });
    gauss(problem, "Gauss 8, no drift", step_size, || {
        let (q, p) = black_box(start);
        let (mut q, mut p) = (Double::new(q), Double::new(p));
        let sweeps = no_drift.run(system, (&mut q, &mut p), 1e-10, STEPS);
        black_box((q, p));
        sweeps
    });
}

/// Gauss with eight stages on a problem that is not separable.
fn general<T: systems::General<N>, const N: usize>(
    problem: &str,
    system: &T,
    start: ([f64; N], [f64; N]),
    step_size: f64,
    tolerance: f64,
) {
    let (plain, no_drift) = (
        FirstOrder::<f64x8, 8>::new(&GAUSS, step_size),
        NoDriftGeneral::<f64x8, 8>::new(&GAUSS, step_size),
    );
    gauss(problem, "Gauss 8, plain", step_size, || {
        let (mut q, mut p) = black_box(start);
        let sweeps = plain.run(system, (&mut q, &mut p), tolerance, STEPS);
        black_box((q, p));
        sweeps
    });
    gauss(problem, "Gauss 8, no drift", step_size, || {
        let (q, p) = black_box(start);
        let (mut q, mut p) = (Double::new(q), Double::new(p));
        let sweeps = no_drift.run(system, (&mut q, &mut p), STEPS);
        black_box((q, p));
        sweeps
    });
}

fn gauss(problem: &str, form: &str, step_size: f64, mut run: impl FnMut() -> u64) {
    let mut sweeps = 0;
    let time = best(|| sweeps = run());
    row(
        problem,
        form,
        step_size,
        time / STEPS as f64,
        sweeps,
        time / (8 * sweeps) as f64,
    );
}

/// A row of the table, from times in seconds and the sweeps in [`STEPS`] steps.
fn row(problem: &str, form: &str, step_size: f64, step: f64, sweeps: u64, evaluation: f64) {
    println!(
        "| {problem} | {form} | {step_size} | {:.1} | {:.2} | {:.2} |",
        1e9 * step,
        sweeps as f64 / STEPS as f64,
        1e9 * evaluation
    );
}

/// The shortest time of a run, in seconds.
fn best(mut run: impl FnMut()) -> f64 {
    let mut best = f64::INFINITY;
    for _ in 0..200 {
        let begin = Instant::now();
        run();
        best = best.min(begin.elapsed().as_secs_f64());
    }
    best
}
