//! The ensembles that `tests/benchmarks/beside_heyoka.py` integrates with heyoka: the time of the fastest method for an error, on one thread,
//! in plain sums as heyoka.
//!
//! `cargo run --release -p symplectic-benchmarks --example beside_heyoka`

#![allow(clippy::print_stdout, reason = "an example prints")]

use std::f64::consts::TAU;
use std::ops::ControlFlow;
use std::time::Instant;

use rayon::ThreadPoolBuilder;
use symplectic::ensemble::Ensemble;
use symplectic::nalgebra::Vector2;
use symplectic::{Method, ProvedFor, Separable, State, System};
use symplectic_tests::formulas::{HenonHeiles, Kepler};
use symplectic_tests::methods::{
    BlanesMoanS10, BlanesMoanSrkn14a, Gauss4, Gauss6, Gauss8, KahanLi8, SofroniouSpaletta10,
};

type Starts = Vec<State<Vector2<f64>>>;

/// The largest errors for which the fastest run is printed.
const TARGETS: [f64; 4] = [1e-4, 1e-6, 1e-8, 1e-10];
/// Each step size is smaller than the one before by this factor.
const RATIO: f64 = 1.2;
/// Runs of one method and step size, of which the fastest counts, as for heyoka.
const ROUNDS: usize = 3;

/// An ensemble with the positions at its end.
struct Problem<S> {
    name: &'static str,
    system: S,
    starts: Starts,
    end: f64,
    exact: Vec<Vector2<f64>>,
}

/// A run: method, step size, seconds, error.
type Run = (&'static str, f64, f64, f64);

impl<S: System<Vector2<f64>, Class = Separable> + Copy + Send + Sync> Problem<S> {
    /// The positions at the end, in the order of the starts, and the time of the run in seconds.
    fn run<M>(&self, method: M, steps: u64) -> (Vec<Vector2<f64>>, f64)
    where
        M: Method + ProvedFor<Separable> + Copy,
    {
        let size = self.end / steps as f64;
        let ensemble = Ensemble::plain(method, self.system, self.starts.clone(), size);
        let ensemble = ensemble.expect("starts");
        let mut ends = vec![Vector2::repeat(f64::NAN); self.starts.len()];
        let began = Instant::now();
        ensemble.take_steps(steps, |row| {
            if row.outcome.is_ok() {
                ends[row.trajectory] = row.state.q;
            }
            ControlFlow::Continue(())
        });
        (ends, began.elapsed().as_secs_f64())
    }

    /// Runs of a method from a first step size until the smallest target is reached.
    fn method<M>(&self, runs: &mut Vec<Run>, method: M, first: f64)
    where
        M: Method + ProvedFor<Separable> + Copy,
    {
        let mut size = first;
        for _ in 0..40 {
            let steps = (self.end / size).ceil() as u64;
            let (ends, mut seconds) = self.run(method, steps);
            let pairs = ends.iter().zip(&self.exact);
            let error = pairs.fold(0.0_f64, |error, (end, exact)| {
                let found = (end - exact).norm();
                if found.is_nan() {
                    f64::INFINITY
                } else {
                    error.max(found)
                }
            });
            if error < TARGETS[0] {
                for _ in 1..ROUNDS {
                    seconds = seconds.min(self.run(method, steps).1);
                }
                runs.push((M::NAME, self.end / steps as f64, seconds, error));
            }
            if error < TARGETS[TARGETS.len() - 1] {
                break;
            }
            size /= RATIO;
        }
    }

    /// Prints the fastest run for every target.
    fn print(&self, sizes: [f64; 2]) {
        let mut runs = Vec::new();
        let [explicit, implicit] = sizes;
        self.method(&mut runs, BlanesMoanS10, explicit);
        self.method(&mut runs, BlanesMoanSrkn14a, explicit);
        self.method(&mut runs, KahanLi8, explicit);
        self.method(&mut runs, SofroniouSpaletta10, explicit);
        self.method(&mut runs, Gauss4, implicit);
        self.method(&mut runs, Gauss6, implicit);
        self.method(&mut runs, Gauss8, implicit);
        for target in TARGETS {
            let good = runs.iter().filter(|run| run.3 < target);
            if let Some((name, size, seconds, error)) = good.min_by(|a, b| a.2.total_cmp(&b.2)) {
                println!(
                    "| {} | {target:.0e} | {name} | {size:.3} | {error:.0e} | {seconds:.4} |",
                    self.name
                );
            }
        }
    }
}

fn main() {
    let orbits: Starts = (0..4096)
        .map(|k| {
            let e = 0.3 * f64::from(k) / 4096.0;
            State::from_arrays(0.0, [1.0 - e, 0.0], [0.0, ((1.0 + e) / (1.0 - e)).sqrt()])
        })
        .collect();
    let stars: Starts = (0..1024)
        .map(|k| State::from_arrays(0.0, [0.0, -0.1 + 0.2 * f64::from(k) / 1024.0], [0.3, 0.0]))
        .collect();
    let kepler = Problem {
        name: "4096 Kepler orbits, e < 0.3, 32 periods",
        system: Kepler,
        exact: orbits.iter().map(|start| start.q).collect(),
        starts: orbits,
        end: 32.0 * TAU,
    };
    let mut stars = Problem {
        name: "1024 Hénon–Heiles orbits to t = 128",
        system: HenonHeiles,
        exact: Vec::new(),
        starts: stars,
        end: 128.0,
    };
    let pool = ThreadPoolBuilder::new().num_threads(1).build();
    pool.expect("a thread").install(|| {
        stars.exact = stars.run(Gauss8, 1024).0;
        println!("| ensemble | error below | method | step size | error | seconds |");
        println!("|---|---:|---|---:|---:|---:|");
        kepler.print([0.6, 2.0]);
        stars.print([0.8, 2.0]);
    });
}
