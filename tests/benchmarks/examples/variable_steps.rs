//! An orbit of eccentricity 0.999: variable steps against DOP853, run time for a position error of 1e-9 after 100
//! periods.
//!
//! `cargo run --release -p symplectic-benchmarks --example variable_steps`

#![allow(clippy::print_stdout, reason = "an example prints")]

use std::f64::consts::TAU;
use std::hint::black_box;
use std::time::Instant;

use symplectic::adaptive::{AdaptiveSteps, DistancePower, Error, Logarithmic};
use symplectic::nalgebra::{Vector2, Vector3};
use symplectic::proved::SymmetricFor;
use symplectic::{Event, Integrator, Method, ProvedFor, Separable, State};
use symplectic_tests::methods::{BlanesMoanS10, Gauss8, KahanLi8, KahanLi8Drift};
use symplectic_tests::peers::{Equations, dop853};

symplectic::hamiltonian! {
    /// Kepler's problem.
    Kepler
    q: [x, y], p: [px, py];
    H = (px^2 + py^2)/2 - 1/sqrt(x^2 + y^2)
}

const ECCENTRICITY: f64 = 0.999;
const END: f64 = 100.0 * TAU;
const WANTED: f64 = 1e-9;
/// Number of runs of each, of which the median counts.
const ROUNDS: usize = 9;
/// The step parameter is divided by this until the position is accurate.
const RATIO: f64 = 1.25;

/// The start at the apocentre.
fn start() -> State<Vector2<f64>> {
    let speed = ((1.0 - ECCENTRICITY) / (1.0 + ECCENTRICITY)).sqrt();
    State::from_arrays(0.0, [-1.0 - ECCENTRICITY, 0.0], [0.0, -speed])
}

/// Number of orbits of the long runs, and of runs.
const MANY: f64 = 1e5;
const RUNS: u32 = 16;

/// The error of the energy, whose exact value is −1/2.
fn energy_error(state: &State<Vector2<f64>>) -> f64 {
    state.p.norm_squared() / 2.0 - state.q.norm().recip() + 0.5
}

/// The outcome of a run: last position, number of steps and, on request, the energy errors after the steps.
struct Outcome {
    position: Vector2<f64>,
    steps: u64,
    energies: Vec<f64>,
}

fn logarithmic<M: Method + ProvedFor<Separable> + Copy>(
    method: M,
    epsilon: f64,
    energies: bool,
) -> Result<Outcome, Error> {
    let system = Logarithmic::new(Kepler);
    let extended: State<Vector3<f64>> = system.extend(&start())?;
    let mut run = Integrator::new(method, system, extended, epsilon)?;
    let mut found = Vec::new();
    // Several steps at once, and single steps near the end.
    while run.state().q[2] < END - 1.0 {
        match energies {
            false => drop(run.take_steps(16)?),
            true => {
                run.step()?;
                found.push(energy_error(&run.system().reduce(run.state())?));
            }
        }
    }
    let direction = if run.state().q[2] < END { 1.0 } else { -1.0 };
    run.set_step_size(direction * epsilon)?;
    let at_the_end = Event::crossing(|state: &State<Vector3<f64>>| state.q[2] - END).by_steps();
    let last = run.state().time + direction * 1e4;
    let end = run.find_event(last, &at_the_end)?;
    let end = end.map(|end| run.system().reduce(&end)).transpose()?;
    Ok(Outcome {
        position: end.map_or_else(|| Vector2::repeat(f64::NAN), |end| end.q),
        steps: run.steps(),
        energies: found,
    })
}

fn reversible<M: Copy + ProvedFor<Separable> + SymmetricFor<Separable>>(
    method: M,
    epsilon: f64,
    energies: bool,
) -> Result<Outcome, Error> {
    let mut run = AdaptiveSteps::run(method, Kepler, DistancePower(1.5), start(), epsilon)?;
    let mut found = Vec::new();
    let end = match energies {
        false => run.integrate_to(END)?,
        true => run.integrate_with(END, |state| found.push(energy_error(state)))?,
    };
    let position = end.q;
    Ok(Outcome {
        position,
        steps: run.steps(),
        energies: found,
    })
}

/// Prints the row of the largest steps that are accurate enough.
fn row(
    name: &str,
    first: f64,
    least: f64,
    integrate: impl Fn(f64, bool) -> Result<Outcome, Error>,
) {
    let error = |epsilon: f64| {
        let outcome = integrate(epsilon, false);
        outcome.map_or(f64::INFINITY, |outcome| {
            (outcome.position - start().q).norm()
        })
    };
    let sizes = std::iter::successors(Some(first), |size| Some(size / RATIO));
    let Some(epsilon) = sizes
        .take_while(|&size| size > least)
        .find(|&epsilon| error(epsilon) < WANTED)
    else {
        println!("| {name} | not reached | | | |");
        return;
    };
    let mut times: Vec<f64> = (0..ROUNDS)
        .map(|_| {
            let began = Instant::now();
            black_box(integrate(epsilon, false).ok());
            began.elapsed().as_secs_f64() * 1e3
        })
        .collect();
    times.sort_by(f64::total_cmp);
    let Ok(outcome) = integrate(epsilon, true) else {
        return;
    };
    println!(
        "| {name} | {:.1} | {} | {:.0e} | {} |",
        times[ROUNDS / 2],
        outcome.steps,
        error(epsilon),
        mean(&outcome.energies)
    );
}

/// The mean and its standard error.
fn mean(values: &[f64]) -> String {
    if values.is_empty() {
        return String::new();
    }
    let count = values.len() as f64;
    let mean = values.iter().sum::<f64>() / count;
    let variance = values
        .iter()
        .map(|value| (value - mean).powi(2))
        .sum::<f64>()
        / count;
    format!("{mean:.0e} ± {:.0e}", (variance / (count - 1.0)).sqrt())
}

/// Prints the mean energy error near the apocentre after many orbits in different directions.
fn long_runs(epsilon: f64) -> Result<(), Error> {
    let errors = (0..RUNS).map(|number| {
        let (sin, cos) = f64::from(number).sin_cos();
        let turned =
            |v: Vector2<f64>| Vector2::new(cos * v[0] - sin * v[1], sin * v[0] + cos * v[1]);
        let State { q, p, .. } = start();
        let start = State::new(0.0, turned(q), turned(p));
        let system = Logarithmic::new(Kepler);
        let before = energy_error(&start);
        let extended: State<Vector3<f64>> = system.extend(&start)?;
        let mut run = Integrator::new(KahanLi8Drift, system, extended, epsilon)?;
        while run.state().q[2] < MANY * TAU {
            run.take_steps(16)?;
        }
        while run.state().q.xy().norm() < 1.9 {
            run.step()?;
        }
        Ok(energy_error(&run.system().reduce(run.state())?) - before)
    });
    let errors: Vec<f64> = errors.collect::<Result<_, Error>>()?;
    println!(
        "\nMean energy error of {RUNS} logarithmic runs of Kahan–Li 8 (ε = {epsilon}) after {MANY:e} orbits: {}",
        mean(&errors)
    );
    Ok(())
}

fn main() -> Result<(), Error> {
    println!("Kepler, e = {ECCENTRICITY}, 100 orbits from the apocentre to {WANTED:e}.\n");
    println!("| | ms | steps | error | mean energy error ± standard error |");
    println!("|---|---:|---:|---:|---:|");
    row("logarithmic, Kahan–Li 8", 2.0, 1e-3, |size, energies| {
        logarithmic(KahanLi8Drift, size, energies)
    });
    row(
        "logarithmic, Blanes–Moan S10",
        2.0,
        1e-3,
        |size, energies| logarithmic(BlanesMoanS10, size, energies),
    );
    row("reversible, Kahan–Li 8", 1.0, 1e-3, |size, energies| {
        reversible(KahanLi8, size, energies)
    });
    row("reversible, Gauss 8", 1.0, 1e-3, |size, energies| {
        reversible(Gauss8, size, energies)
    });
    row(
        "DOP853 (`ode_solvers`), its tolerance",
        1e-6,
        1e-16,
        |tolerance, _| {
            let equations = Equations(Kepler);
            let State { q, p, .. } = start();
            let mut run = dop853(
                &equations,
                [q[0], q[1], p[0], p[1]],
                END,
                tolerance,
                10_000_000,
            );
            let steps = run.integrate().map_or(0, |statistics| {
                u64::from(statistics.accepted_steps) + u64::from(statistics.rejected_steps)
            });
            let last = run.y_out().last().copied();
            Ok(Outcome {
                position: last
                    .map_or_else(|| Vector2::repeat(f64::NAN), |y| Vector2::new(y[0], y[1])),
                steps,
                energies: Vec::new(),
            })
        },
    );
    long_runs(0.5)
}
