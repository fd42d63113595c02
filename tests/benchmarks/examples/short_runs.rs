//! Ensembles of short runs: what a trajectory costs beside its steps, by length and threads.
//!
//! `cargo run --release -p symplectic-benchmarks --example short_runs`

#![allow(clippy::print_stdout, reason = "an example prints")]

use std::hint::black_box;
use std::ops::ControlFlow;
use std::time::Instant;

use rayon::{ThreadPool, ThreadPoolBuilder};
use symplectic::ensemble::Ensemble;
use symplectic::nalgebra::Vector2;
use symplectic::{Method, Plain, ProvedFor, Separable, State};
use symplectic_tests::formulas::HenonHeiles;
use symplectic_tests::methods::{BlanesMoanS10, Gauss4, StoermerVerlet};

/// Number of rounds, of which the fastest counts.
const ROUNDS: usize = 7;
/// Numbers of steps, the largest first: its time per step is the least.
const LENGTHS: [u64; 6] = [20_000, 2000, 200, 20, 10, 2];
/// Number of steps of all trajectories together.
const STEPS: u64 = 1 << 23;

fn orbits(count: u64) -> Vec<State<Vector2<f64>>> {
    let start = |k| 0.1 * k as f64 / count as f64;
    let starts = (0..count).map(|k| State::from_arrays(0.0, [0.0, start(k)], [0.3, 0.0]));
    starts.collect()
}

/// Elapsed nanoseconds per trajectory of an ensemble.
fn nanoseconds(threads: &ThreadPool, count: u64, run: impl Fn() + Send + Sync) -> f64 {
    let elapsed = (0..ROUNDS).map(|_| {
        threads.install(|| {
            let began = Instant::now();
            run();
            began.elapsed().as_secs_f64()
        })
    });
    1e9 * elapsed.fold(f64::INFINITY, f64::min) / count as f64
}

/// Prints the rows of a method.
fn rows<M: Method + ProvedFor<Separable> + Copy>(name: &str, method: M, pools: &[ThreadPool]) {
    let mut per_step = vec![0.0; pools.len()];
    for steps in LENGTHS {
        let count = (STEPS / steps).clamp(512, 1 << 18);
        let ensemble = Ensemble::<_, _, _, Plain>::plain(method, HenonHeiles, orbits(count), 0.1);
        let ensemble = ensemble.expect("starts");
        print!("| {name} | {steps} |");
        for (threads, per_step) in pools.iter().zip(&mut per_step) {
            let time = nanoseconds(threads, count, || {
                ensemble.take_steps(steps, |row| {
                    black_box(&row);
                    ControlFlow::Continue(())
                });
            });
            if steps == LENGTHS[0] {
                *per_step = time / steps as f64;
            }
            let beside = time - *per_step * steps as f64;
            print!(" {time:.0} | {:.1} | {beside:.0} |", time / steps as f64);
        }
        println!();
    }
}

fn main() {
    let cores = std::thread::available_parallelism().map_or(1, usize::from);
    let mut counts = vec![1, 2, cores];
    counts.sort_unstable();
    counts.dedup();
    let pool = |&count: &usize| {
        let pool = ThreadPoolBuilder::new().num_threads(count).build();
        pool.expect("threads")
    };
    let pools: Vec<_> = counts.iter().map(pool).collect();
    println!(
        "Hénon–Heiles, plain sums. Nanoseconds, the least of {ROUNDS} rounds, for each number of threads:"
    );
    println!("of a trajectory, of one of its steps, and of a trajectory beside its steps.\n");
    print!("| method | steps |");
    for count in &counts {
        print!(" {count} threads | a step | beside |");
    }
    println!("\n|---|---:|{}", "---:|---:|---:|".repeat(counts.len()));
    rows("velocity Verlet", StoermerVerlet, &pools);
    rows("Blanes–Moan S10", BlanesMoanS10, &pools);
    rows("Gauss 4", Gauss4, &pools);
}
