//! What a step of a tableau at run time takes beside one of the emitted method of the same coefficients.
//!
//! `cargo run --release -p symplectic-tests --example run_time_cost`. Medians of runs that all forms take in turn; plain and compensated
//! sums. "a step" is with the solver that an integrator has from the start, "one by one" with `FixedPoint`, the iteration of the tableau at
//! run time. Stiff springs are stepped by Newton's iteration in both forms.
#![allow(clippy::print_stdout, reason = "the table is what this program is for")]

use std::error::Error;
use std::time::Instant;

use nalgebra::DVector;
use symplectic::at_run_time::RunTimeTableau;
use symplectic::solver::{ByNewton, FixedPoint, Solver};
use symplectic::system::Conservative;
use symplectic::{Integrator, Method, ProvedFor, State, Summation, System, Vector, separable};
use symplectic_compiler::{Definition, Limits};
use symplectic_tests::at_run_time::tableau;
use symplectic_tests::methods::{ForestRuth, Gauss2, Gauss4, Gauss8, Lobatto3, StoermerVerlet};

symplectic::hamiltonian! {
    Kepler
    q: [2], p: [2];
    H = |p|^2/2 - 1/|q|
}

symplectic::hamiltonian! {
    Product
    q: [x], p: [px];
    H = (x^2 + 1) (px^2 + 1)/2
}

symplectic::hamiltonian! {
    /// Stiff springs between masses in quartic potentials.
    StiffSprings { k }
    q: [..], p: [..]; bonds: free;
    H = sum(i: p[i]^2/2 + q[i]^4/4) + sum(bonds d: k d^2/2)
}

/// Springs between 1024 masses, by closures.
fn chain() -> impl System<DVector<f64>, Class = symplectic::Separable> + Clone {
    separable::<DVector<f64>, _, _>(
        |_, p, velocity| velocity.copy_from(p),
        |_, q, force| {
            let n = q.len();
            for i in 0..n {
                let left = if i > 0 { q[i - 1] } else { 0.0 };
                let right = if i + 1 < n { q[i + 1] } else { 0.0 };
                force[i] = left - 2.0 * q[i] + right;
            }
        },
    )
}

/// How often every form is timed.
const ROUNDS: usize = 15;

/// Nanoseconds for a step.
fn time<M: Method, S: System<V>, V: Vector, R: Summation, N: Solver<V, S>>(
    integrator: &mut Integrator<M, S, V, R, N>,
    steps: u64,
) -> Result<f64, symplectic::Error> {
    let start = Instant::now();
    integrator.take_steps(steps)?;
    Ok(start.elapsed().as_secs_f64() * 1e9 / steps as f64)
}

fn median(mut values: Vec<f64>) -> f64 {
    values.sort_by(f64::total_cmp);
    values[values.len() / 2]
}

fn row<M, S, V, R>(
    (problem, method): (&str, M),
    system: &S,
    (start, step_size, steps): (&State<V>, f64, u64),
) -> Result<f64, Box<dyn Error>>
where
    M: Method + Copy + ProvedFor<S::Class>,
    S: System<V, Class: Conservative> + Clone,
    V: Vector,
    R: Summation,
{
    let tableau = derived(method)?;
    let emitted = || {
        Integrator::<M, S, V, R>::with_summation(method, system.clone(), start.clone(), step_size)
    };
    let mut default = emitted()?;
    let mut one_by_one = emitted()?.with_solver(FixedPoint);
    let mut at_run_time = Integrator::<RunTimeTableau, S, V, R>::with_summation(
        tableau,
        system.clone(),
        start.clone(),
        step_size,
    )?;
    let mut times = [const { Vec::new() }; 3];
    for _ in 0..ROUNDS {
        times[0].push(time(&mut default, steps)?);
        times[1].push(time(&mut one_by_one, steps)?);
        times[2].push(time(&mut at_run_time, steps)?);
    }
    let [default, one_by_one, at_run_time] = times.map(median);
    let one_by_one = format!("{:.2}", one_by_one / default);
    Ok(print::<M, R>(problem, default, &one_by_one, at_run_time))
}

/// A row of Newton's iteration in both forms.
fn stiff_row<M, R: Summation>(
    method: M,
    (start, step_size, steps): (&State<DVector<f64>>, f64, u64),
) -> Result<f64, Box<dyn Error>>
where
    M: Method + Copy + ProvedFor<symplectic::Separable>,
{
    let tableau = derived(method)?;
    let (system, start) = (StiffSprings::new(1e6), || start.clone());
    let emitted =
        Integrator::<M, StiffSprings, _, R>::with_summation(method, system, start(), step_size)?;
    let mut emitted = emitted.by_newton();
    let mut at_run_time =
        Integrator::<RunTimeTableau, StiffSprings, DVector<f64>, R>::with_summation(
            tableau,
            system,
            start(),
            step_size,
        )?
        .by_newton();
    let mut times = [const { Vec::new() }; 2];
    for _ in 0..ROUNDS {
        times[0].push(time(&mut emitted, steps)?);
        times[1].push(time(&mut at_run_time, steps)?);
    }
    let [emitted, at_run_time] = times.map(median);
    Ok(print::<M, R>(
        "64 stiff springs, Newton",
        emitted,
        "–",
        at_run_time,
    ))
}

/// The tableau of a method, derived again.
fn derived<M: Method>(_method: M) -> Result<RunTimeTableau, Box<dyn Error>> {
    let exact = Definition::parse(M::DEFINITION)?.derive(&Limits::default())?;
    Ok(tableau(M::NAME, &exact)?)
}

/// Prints a row; returns its ratio.
fn print<M: Method, R: Summation>(
    problem: &str,
    emitted: f64,
    one_by_one: &str,
    at_run_time: f64,
) -> f64 {
    let ratio = at_run_time / emitted;
    println!(
        "| {problem} | {} | {} | {emitted:.0} ns | {one_by_one} | {ratio:.2} |",
        M::NAME,
        if R::COMPENSATED {
            "compensated"
        } else {
            "plain"
        },
    );
    ratio
}

fn main() -> Result<(), Box<dyn Error>> {
    println!(
        "| problem | method | sums | emitted, a step | emitted, one by one | at run time |\n|---|---|---|---:|---:|---:|"
    );
    let (mut ratios, mut by_newton) = (Vec::new(), Vec::new());
    macro_rules! rows {
        ($problem:literal, $system:expr, $start:expr, $step_size:literal, $steps:literal: $($method:ident),+) => {
            let (system, start) = ($system, $start);
            $(
                let what = ($problem, $method);
                ratios.push(row::<_, _, _, symplectic::Plain>(what, &system, (&start, $step_size, $steps))?);
                ratios.push(row::<_, _, _, symplectic::Compensated>(what, &system, (&start, $step_size, $steps))?);
            )+
        };
    }
    let ellipse = State::from_arrays(0.0, [0.4, 0.0], [0.0, 2.0]);
    rows!("Kepler", Kepler, ellipse, 0.01, 10_000: StoermerVerlet, ForestRuth, Lobatto3, Gauss2, Gauss4, Gauss8);
    let start = State::from_arrays(0.0, [0.3], [0.7]);
    rows!("(q² + 1)(p² + 1)/2", Product, start, 0.05, 10_000: StoermerVerlet, Lobatto3, Gauss2, Gauss4, Gauss8);
    let q = DVector::from_fn(1024, |i, _| (i as f64 / 100.0).sin());
    let start = State::new(0.0, q.clone(), -q);
    rows!("1024 springs, closures", chain(), start, 0.1, 50: StoermerVerlet, ForestRuth, Lobatto3, Gauss2, Gauss4, Gauss8);
    let q = DVector::from_fn(64, |i, _| (i as f64).sin() * 1e-3);
    let start = State::new(0.0, q.clone(), q);
    macro_rules! stiff_rows {
        ($($method:ident),+) => {$(
            by_newton.push(stiff_row::<_, symplectic::Plain>($method, (&start, 0.1, 100))?);
            by_newton.push(stiff_row::<_, symplectic::Compensated>($method, (&start, 0.1, 100))?);
        )+};
    }
    stiff_rows!(Gauss2, Gauss4, Gauss8);
    let mean = |ratios: &[f64]| {
        let logarithms = ratios.iter().map(|ratio| ratio.ln());
        (logarithms.sum::<f64>() / ratios.len() as f64).exp()
    };
    println!(
        "\nGeometric mean of the last column: {:.2}; by Newton's iteration {:.2}",
        mean(&ratios),
        mean(&by_newton)
    );
    Ok(())
}
