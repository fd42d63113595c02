//! What a step of a tableau at run time takes beside one of the emitted method of the same coefficients.
//!
//! `cargo run --release -p symplectic-tests --example run_time_cost`. Medians of runs that all forms take in turn; plain and compensated
//! sums. "default" is the solver that an integrator has from the start, "one by one" is `FixedPoint`, the iteration of the tableau at run time.
#![allow(clippy::print_stdout, reason = "the table is what this program is for")]

use std::error::Error;
use std::time::Instant;

use nalgebra::DVector;
use symplectic::solver::{FixedPoint, Solver};
use symplectic::system::Conservative;
use symplectic::{
    Integrator, Method, ProvedFor, RunTimeTableau, State, Summation, System, Vector, separable,
};
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
    M: Method + ProvedFor<S::Class>,
    S: System<V, Class: Conservative> + Clone,
    V: Vector,
    R: Summation,
    Integrator<symplectic::AtRunTime, S, V, R>: Made<S, V>,
{
    let exact = Definition::parse(M::DEFINITION)?.derive(&Limits::default())?;
    let tableau = tableau(M::NAME, &exact)?;
    let emitted = || {
        Integrator::<M, S, V, R>::with_summation(method, system.clone(), start.clone(), step_size)
    };
    let mut default = emitted()?;
    let mut one_by_one = emitted()?.with_solver(FixedPoint);
    let mut at_run_time = Integrator::<symplectic::AtRunTime, S, V, R>::made(
        &tableau,
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
    let ratio = at_run_time / default;
    println!(
        "| {problem} | {} | {} | {default:.0} ns | {:.2} | {ratio:.2} |",
        M::NAME,
        if R::COMPENSATED {
            "compensated"
        } else {
            "plain"
        },
        one_by_one / default,
    );
    Ok(ratio)
}

/// The constructor for either sums.
trait Made<S, V: Vector>: Sized {
    fn made(
        tableau: &RunTimeTableau,
        system: S,
        state: State<V>,
        step_size: f64,
    ) -> Result<Self, symplectic::Error>;
}

macro_rules! made {
    ($($sums:ident $constructor:ident),+) => {$(
        impl<S: System<V, Class: Conservative>, V: Vector> Made<S, V> for Integrator<symplectic::AtRunTime, S, V, symplectic::$sums> {
            fn made(
                tableau: &RunTimeTableau,
                system: S,
                state: State<V>,
                step_size: f64,
            ) -> Result<Self, symplectic::Error> {
                Self::$constructor(tableau, system, state, step_size)
            }
        }
    )+};
}
made!(Plain plain_at_run_time, Compensated at_run_time);

fn main() -> Result<(), Box<dyn Error>> {
    println!(
        "| problem | method | sums | emitted, a step | emitted, one by one | at run time |\n|---|---|---|---:|---:|---:|"
    );
    let mut ratios = Vec::new();
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
    let mean = ratios.iter().map(|ratio| ratio.ln()).sum::<f64>() / ratios.len() as f64;
    println!("\nGeometric mean of the last column: {:.2}", mean.exp());
    Ok(())
}
