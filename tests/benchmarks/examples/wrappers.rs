//! Systems of every kind in ensembles: CPU time beside that of single runs, one after another.
//!
//! `cargo run --release -p symplectic-benchmarks --example wrappers`, also with `RUSTFLAGS="-C target-cpu=native"`. A gain of less than 1
//! is a fault.

#![allow(clippy::print_stdout, reason = "an example prints")]

use std::hint::black_box;
use std::ops::ControlFlow;

use cpu_time::ThreadTime;
use rayon::{ThreadPool, ThreadPoolBuilder};
use symplectic::adaptive::{Adaptive, AdaptiveSteps, DistancePower, Logarithmic, Poincare};
use symplectic::ensemble::Ensemble;
use symplectic::nalgebra::{DVector, SVector, Vector3};
use symplectic::tangent::Tangent;
use symplectic::variational::Newmark;
use symplectic::{Integrator, Method, ProvedFor, State, System, Vector, acceleration};
use symplectic_tests::formulas::{DoublePendulum, FputChain, HenonHeiles, Kepler};
use symplectic_tests::methods::{
    BlanesMoanS10, Gauss2, Gauss4, Lobatto3, Midpoint, VelocityVerlet,
};

symplectic::hamiltonian! { Resisted q: [x, y], p: [px, py]; H = (px^2 + py^2 + x^2 + y^2)/2 + x^2 y - y^3/3 friction: 0.1 }
symplectic::hamiltonian! { Pushed q: [x, y], p: [px, py]; H = (px^2 + py^2 + x^2 + y^2)/2 + x^2 y - y^3/3 force: { x = -0.1 px } }
symplectic::hamiltonian! {
    Sum
    q: [20], p: [20];
    H = sum(i: p[i]^2/2) + sum(i in 0..19: (q[i+1] - q[i])^2/2 + (q[i+1] - q[i])^4/4)
}
symplectic::hamiltonian! { Rod q: [x, y], p: [px, py]; H = (px^2 + py^2)/2 + y constraints: { rod = x^2 + y^2 - 1 } }
symplectic::hamiltonian! {
    Skate q: [x, y, a], p: [px, py, pa]; v: [vx, vy, va];
    H = (px^2 + py^2 + pa^2)/2 + x/10
    nonholonomic: { edge = vx sin(a) - vy cos(a) }
}

/// Number of rounds, of which the fastest counts.
const ROUNDS: usize = 7;
/// Number of trajectories.
const COUNT: usize = 512;

/// CPU nanoseconds per step of a trajectory: the least of all rounds, of two runs that take turns.
fn times(steps: u64, runs: [&dyn Fn(); 2]) -> [f64; 2] {
    let mut least = [f64::INFINITY; 2];
    for _ in 0..ROUNDS {
        for (least, run) in least.iter_mut().zip(runs) {
            let began = ThreadTime::now();
            run();
            *least = least.min(began.elapsed().as_secs_f64());
        }
    }
    least.map(|time| 1e9 * time / (COUNT as u64 * steps) as f64)
}

fn print(name: &str, method: &str, [together, alone]: [f64; 2]) {
    println!(
        "| {name} | {method} | {together:.0} | {alone:.0} | {:.2} |",
        alone / together
    );
}

/// Prints the row of a system.
fn row<M, S, V>(
    alone: &ThreadPool,
    name: &str,
    method: M,
    system: S,
    start: impl Fn(f64) -> State<V>,
    (size, steps): (f64, u64),
) where
    M: Method + ProvedFor<S::Class> + Copy + Send,
    S: System<V> + Clone + Send,
    V: Vector + Send + Sync,
{
    let starts: Vec<State<V>> = (0..COUNT).map(|k| start(k as f64 / COUNT as f64)).collect();
    let ensemble = Ensemble::new(method, system.clone(), starts.clone(), size).expect("starts");
    let found = alone.install(move || {
        let together = || {
            ensemble.take_steps(steps, |row| {
                black_box(&row);
                ControlFlow::Continue(())
            });
        };
        let one_by_one = || {
            for start in &starts {
                let run = Integrator::new(method, system.clone(), start.clone(), size);
                black_box(run.expect("a start").take_steps(steps).expect("steps"));
            }
        };
        times(steps, [&together, &one_by_one])
    });
    print(name, M::NAME, found);
}

/// The pericentre of an orbit of eccentricity 0.9 x.
fn pericentre(x: f64) -> State<SVector<f64, 2>> {
    let e = 0.9 * x;
    State::from_arrays(0.0, [1.0 - e, 0.0], [0.0, ((1.0 + e) / (1.0 - e)).sqrt()])
}

/// Prints the row of steps of variable size.
fn adaptive(alone: &ThreadPool) {
    let starts: Vec<_> = (0..COUNT)
        .map(|k| pericentre(k as f64 / COUNT as f64))
        .collect();
    let ensemble = Ensemble::new(VelocityVerlet, Kepler, starts.clone(), 0.02).expect("starts");
    let make = |run: Integrator<VelocityVerlet, Kepler, SVector<f64, 2>>| {
        AdaptiveSteps::of(run, DistancePower(1.5), 0.02)
    };
    let together = || {
        let to_end =
            |(): &mut (), run: &mut Adaptive<_, _, _, _>| run.integrate_to(3.0).map(|_| ());
        ensemble.each_as(
            make,
            |_| (),
            to_end,
            |row| {
                black_box(&row);
                ControlFlow::Continue(())
            },
        );
    };
    let one_by_one = || {
        for start in &starts {
            let run = Integrator::new(VelocityVerlet, Kepler, start.clone(), 0.02);
            let mut run = make(run.expect("a start")).expect("a monitor");
            black_box(run.integrate_to(3.0).expect("steps"));
        }
    };
    let found = alone.install(|| times(150, [&together, &one_by_one]));
    print("steps of variable size", VelocityVerlet::NAME, found);
}

fn main() {
    let alone = ThreadPoolBuilder::new().num_threads(1).build();
    let alone = &alone.expect("a thread");
    let four = |q: [f64; 2], p: [f64; 2]| {
        State::from_arrays(0.0, [q[0], q[1], 1.0, 0.0], [0.0, 0.5, p[0], p[1]])
    };
    let orbit = |x: f64| State::from_arrays(0.0, [0.0, 0.1 * x], [0.3, 0.0]);
    let beside = |x: f64| four([0.0, 0.1 * x], [0.3, 0.0]);
    let swing = |x: f64| State::from_arrays(0.0, [0.3, 0.1 * x], [0.3, 0.0]);
    println!(
        "CPU nanoseconds per step of a trajectory, {COUNT} trajectories on one thread, the least of {ROUNDS} rounds.\n"
    );
    println!("| system | method | ensemble | one by one | gain |");
    println!("|---|---|---:|---:|---:|");
    macro_rules! rows {
        ($($name:literal, $method:expr, $system:expr, $start:expr, $size:literal, $steps:literal;)+) => {$(
            row(alone, $name, $method, $system, $start, ($size, $steps));
        )+};
    }
    let chain_of = |length: usize| {
        move |x: f64| {
            let q = DVector::from_fn(length, |i, _| 0.1 * (x + i as f64).sin());
            State::new(0.0, q, DVector::zeros(length))
        }
    };
    let row_of_20 = |x: f64| {
        let q = SVector::<f64, 20>::from_fn(|i, _| 0.1 * (x + i as f64).sin());
        State::new(0.0, q, SVector::zeros())
    };
    let hanging = |x: f64| State::from_arrays(0.0, [x.sin(), -x.cos()], [0.0, 0.0]);
    let gliding = |x: f64| State::from_arrays(0.0, [0.0, 0.0, x], [x.cos(), x.sin(), 0.3]);
    let closure = || acceleration(|_, q: &SVector<f64, 2>, a: &mut SVector<f64, 2>| *a = -q);
    let newmark = Newmark::new(HenonHeiles, 0.25, 0.1).expect("a shift");
    let logarithmic = Logarithmic::new(Kepler);
    let poincare = Poincare::new(Kepler, DistancePower(1.5));
    let (to_logarithmic, to_poincare) = (logarithmic.clone(), poincare.clone());
    let in_logarithmic =
        |x: f64| -> State<Vector3<f64>> { to_logarithmic.extend(&pericentre(x)).expect("a start") };
    let in_poincare =
        |x: f64| -> State<Vector3<f64>> { to_poincare.extend(&pericentre(x)).expect("a start") };
    rows! {
        "Hénon–Heiles", BlanesMoanS10, HenonHeiles, orbit, 0.05, 200;
        "the same with its tangent", BlanesMoanS10, Tangent::new(HenonHeiles), beside, 0.05, 200;
        "Hénon–Heiles", Gauss4, HenonHeiles, orbit, 0.05, 100;
        "the same with its tangent", Gauss4, Tangent::new(HenonHeiles), beside, 0.05, 100;
        "double pendulum", Gauss4, DoublePendulum::default(), swing, 0.05, 50;
        "the same with its tangent", Gauss4, Tangent::new(DoublePendulum::default()), |x| four([0.3, 0.1 * x], [0.3, 0.0]), 0.05, 50;
        "friction", BlanesMoanS10, Resisted, orbit, 0.05, 200;
        "an applied force", Gauss4, Pushed, orbit, 0.05, 100;
        "a constraint", Lobatto3, Rod, hanging, 0.02, 50;
        "a non-holonomic constraint", Midpoint, Skate, gliding, 0.02, 50;
        "a chain of 20", VelocityVerlet, FputChain, chain_of(20), 0.05, 200;
        "a chain of 20", Gauss2, FputChain, chain_of(20), 0.05, 50;
        "20 particles by a sum", VelocityVerlet, Sum, row_of_20, 0.05, 200;
        "20 particles by a sum", Gauss2, Sum, row_of_20, 0.05, 50;
        "a chain of 32", VelocityVerlet, FputChain, chain_of(32), 0.05, 100;
        "Newmark", VelocityVerlet, newmark, orbit, 0.1, 100;
        "a logarithmic Hamiltonian", BlanesMoanS10, logarithmic, in_logarithmic, 0.05, 100;
        "Poincaré's transformation", Gauss2, poincare, in_poincare, 0.05, 50;
        "a closure", BlanesMoanS10, closure(), orbit, 0.05, 200;
    }
    adaptive(alone);
}
