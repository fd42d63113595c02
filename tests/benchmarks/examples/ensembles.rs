//! Ensembles against a loop of single runs: nanoseconds per step of a trajectory.
//!
//! `cargo run --release -p symplectic-benchmarks --example ensembles`

#![allow(clippy::print_stdout, reason = "an example prints")]

use std::hint::black_box;
use std::ops::ControlFlow;
use std::time::Instant;

use cpu_time::ThreadTime;
use rayon::{ThreadPool, ThreadPoolBuilder};
use symplectic::ensemble::Ensemble;
use symplectic::nalgebra::Vector2;
use symplectic::solver::FixedPoint;
use symplectic::{
    Compensated, Integrator, Method, Plain, ProvedFor, Separable, State, Summation, System,
};
use symplectic_tests::formulas::{HenonHeiles, Kepler};
use symplectic_tests::methods::{BlanesMoanS10, Gauss4};

symplectic::hamiltonian! {
    /// A Kepler orbit with a mass in the centre.
    Attraction { mu }
    q: [x, y], p: [px, py];
    H = (px^2 + py^2)/2 - mu/sqrt(x^2 + y^2)
}

/// Number of rounds; in each round all variants run once, in turn.
const ROUNDS: usize = 9;

type Start = State<Vector2<f64>>;

/// Prints a row: medians of a loop of single runs without lanes, of the same loop with the default solver, of an ensemble
/// on one thread, and of an ensemble on all threads.
fn row<M, S, R>(
    name: &str,
    method: M,
    families: &[(S, Vec<Start>)],
    (step_size, steps): (f64, u64),
    alone: &ThreadPool,
) where
    M: Method + ProvedFor<Separable> + Copy,
    S: System<Vector2<f64>, Class = Separable> + Copy + Send + Sync,
    R: Summation,
{
    let ensemble = Ensemble::<M, S, Vector2<f64>, R>::with_summation(
        method,
        families.iter().cloned(),
        step_size,
    )
    .expect("starts");
    let integrator = |system: S, start: &Start| {
        Integrator::<M, S, Vector2<f64>, R>::with_summation(
            method,
            system,
            start.clone(),
            step_size,
        )
        .expect("a start")
    };
    let trajectories = || {
        let families = families.iter();
        families.flat_map(|(system, starts)| starts.iter().map(|start| (*system, start)))
    };
    let without_lanes = || {
        for (system, start) in trajectories() {
            let mut run = integrator(system, start).with_solver(FixedPoint);
            black_box(run.take_steps(steps).expect("steps"));
        }
    };
    let single = || {
        for (system, start) in trajectories() {
            black_box(integrator(system, start).take_steps(steps).expect("steps"));
        }
    };
    let many = || {
        ensemble.take_steps(steps, |row| {
            black_box(row);
            ControlFlow::Continue(())
        });
    };
    let mut times = [(); 4].map(|()| Vec::new());
    for _ in 0..ROUNDS {
        times[0].push(seconds_of_thread(without_lanes));
        times[1].push(seconds_of_thread(single));
        times[2].push(alone.install(|| seconds_of_thread(many)));
        // As a program calls it: from outside, on the threads of rayon.
        times[3].push(seconds(many));
    }
    let per_step = 1e9 / (trajectories().count() as f64 * steps as f64);
    let [without, single, one, all] = times.map(|mut times| {
        times.sort_by(f64::total_cmp);
        times[ROUNDS / 2] * per_step
    });
    println!(
        "| {name} | {without:.1} | {single:.1} | {one:.1} | {:.1} × | {all:.1} | {:.1} × |",
        without / one,
        without / all
    );
}

/// CPU time of this thread: other programs do not add to it.
fn seconds_of_thread(run: impl Fn()) -> f64 {
    let began = ThreadTime::now();
    run();
    began.elapsed().as_secs_f64()
}

fn seconds(run: impl Fn()) -> f64 {
    let began = Instant::now();
    run();
    began.elapsed().as_secs_f64()
}

fn main() {
    let cores = std::thread::available_parallelism().map_or(1, usize::from);
    let alone = ThreadPoolBuilder::new().num_threads(1).build();
    let alone = alone.expect("a thread");
    let orbits: Vec<Start> = (0..4096)
        .map(|k| {
            let e = 0.6 * f64::from(k) / 4096.0;
            State::from_arrays(0.0, [1.0 - e, 0.0], [0.0, ((1.0 + e) / (1.0 - e)).sqrt()])
        })
        .collect();
    let galaxies: Vec<Start> = (0..1024)
        .map(|k| State::from_arrays(0.0, [0.0, 0.3 * f64::from(k) / 1024.0], [0.3, 0.1]))
        .collect();
    println!(
        "Nanoseconds a step of one trajectory, medians of {ROUNDS} rounds: CPU time of one thread, elapsed time of all.\n"
    );
    println!("| | single runs without lanes | single runs | 1 thread | | {cores} threads | |");
    println!("|---|---:|---:|---:|---:|---:|---:|");
    macro_rules! problem {
        ($name:literal, $problem:expr, $h:literal, $steps:literal) => {
            let families = $problem;
            row::<_, _, Plain>(
                concat!($name, ", Blanes–Moan S10, plain sums"),
                BlanesMoanS10,
                families,
                ($h, 32 * $steps),
                &alone,
            );
            row::<_, _, Compensated>(
                concat!($name, ", Blanes–Moan S10"),
                BlanesMoanS10,
                families,
                ($h, 32 * $steps),
                &alone,
            );
            row::<_, _, Plain>(
                concat!($name, ", Gauss 4, plain sums"),
                Gauss4,
                families,
                ($h, 8 * $steps),
                &alone,
            );
            row::<_, _, Compensated>(
                concat!($name, ", Gauss 4"),
                Gauss4,
                families,
                ($h, 8 * $steps),
                &alone,
            );
        };
    }
    let masses = orbits.iter().enumerate().map(|(k, start)| {
        let mu = 1.0 + k as f64 / 4096.0;
        (Attraction { mu }, vec![start.clone()])
    });
    let masses: Vec<_> = masses.collect();
    problem!(
        "4096 Kepler orbits with different masses",
        &masses,
        0.01,
        25
    );
    problem!("4096 Kepler orbits", &[(Kepler, orbits)], 0.01, 25);
    problem!(
        "1024 Hénon–Heiles orbits",
        &[(HenonHeiles, galaxies)],
        0.05,
        100
    );
}
