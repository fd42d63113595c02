//! Steps of stiff systems with Newton's iteration, compared with full Newton iterations in doubles and in 71 digits.
//!
//! A result is compared with the solution of the same discrete equations, with rounded coefficients, that is nearest to
//! its stages. The unit of its error is a first-order bound on the effect of rounding: errors of EPSILON/2, relative to
//! the terms of each force, to the largest position that it depends on and to the largest momentum, are propagated in
//! absolute values through the linearised equations of all steps.

mod full_newton;
mod systems;

use std::rc::Rc;

use symplectic::nalgebra::SVector;
use symplectic::solver::{AnalyticOrDifferences, Dense, Differences, LinearSolver, Newton};
use symplectic::{Compensated, Error, Integrator, Method, Plain, Scalar, State, Summation};

use crate::methods::{Gauss2, Gauss3, Gauss4, Lobatto3, Midpoint, RadauRight2};
use crate::references::Wide;
use full_newton::{FullNewton, Watched};
use systems::{Fput, HangingChain, Steps, Stiff};

/// Number of consecutive steps.
const STEPS: u32 = 3;

/// Maximum number of full Newton iterations.
const MAX_ITERATIONS: u32 = 60;

/// Positions beyond this indicate an unstable method: hω is outside its stability interval and states grow by powers of
/// it. The start is of order one.
const GROWN: f64 = 100.0;

/// The outcome of a run.
#[derive(Clone, Debug)]
pub struct Outcome {
    /// System, method, derivatives, summation, k and h.
    pub name: String,
    /// The largest number of sweeps of a step, or the error of a failed step.
    pub sweeps: Result<u32, Error>,
    /// The largest number of full Newton iterations of a step in doubles, if it converges.
    pub in_full: Option<u32>,
    /// The error in units of the bound on rounding; `None` if full Newton in 71 digits did not converge.
    pub error: Option<f64>,
    /// Whether the method is unstable.
    pub grows: bool,
}

/// A system with its start.
#[derive(Clone, Copy)]
struct Problem<S, const N: usize> {
    name: &'static str,
    k: f64,
    system: S,
    q: [f64; N],
    p: [f64; N],
}

/// Makes all runs with these powers of ten for `k` and `h`, and passes each outcome to `see`.
pub fn grid(stiffnesses: &[i32], step_sizes: &[i32], mut see: impl FnMut(Outcome)) {
    for &power in stiffnesses {
        let k = 10f64.powi(power);
        let pendulum = |name, p| Problem {
            name,
            k,
            system: HangingChain { k },
            q: [1.0, 0.0],
            p,
        };
        let chain = [
            1.0,
            0.0,
            1.75,
            -0.6614378277661477,
            2.75,
            -0.6614378277661477,
        ];
        let fput = [1.0, 0.0, 0.0, k.sqrt().recip(), 0.0, 0.0];
        for &power in step_sizes {
            let h = 10f64.powi(power);
            methods(&pendulum("spring pendulum", [0.0, 1.0]), h, &mut see);
            methods(&pendulum("spring pendulum at rest", [0.0; 2]), h, &mut see);
            let problem = Problem {
                name: "FPUT springs",
                k,
                system: Fput { k },
                q: fput,
                p: [1.0, 0.0, 0.0, 1.0, 0.0, 0.0],
            };
            methods(&problem, h, &mut see);
            let problem = Problem {
                name: "hanging chain",
                k,
                system: HangingChain { k },
                q: chain,
                p: [0.0; 6],
            };
            methods(&problem, h, &mut see);
        }
    }
}

fn methods<S: Stiff<N> + 'static, const N: usize>(
    problem: &Problem<S, N>,
    h: f64,
    see: &mut impl FnMut(Outcome),
) {
    macro_rules! run {
        ($($method:ident)*) => { $(solvers($method, &$method::C, problem, h, see);)* };
    }
    run!(Midpoint Gauss2 Gauss3 Gauss4 Lobatto3 RadauRight2);
}

fn solvers<M: Method + Copy, S: Stiff<N> + 'static, const N: usize>(
    method: M,
    nodes: &[f64],
    problem: &Problem<S, N>,
    h: f64,
    see: &mut impl FnMut(Outcome),
) {
    let in_full = in_full(method, problem, h);
    macro_rules! run {
        ($($derivatives:ident $sums:ident)*) => {
            $({
                let mut outcome = run::<M, S, Dense<$derivatives>, $sums, N>(method, nodes, problem, h);
                let name = (stringify!($derivatives), stringify!($sums));
                outcome.name =
                    format!("{}, {}, {} {}, k = {:e}, h = {h:e}", problem.name, M::NAME, name.0, name.1, problem.k);
                outcome.in_full = in_full;
                see(outcome);
            })*
        };
    }
    run!(Differences Plain Differences Compensated AnalyticOrDifferences Plain AnalyticOrDifferences Compensated);
}

/// The largest number of full Newton iterations in doubles.
fn in_full<M: Method, S: Stiff<N> + 'static, const N: usize>(
    method: M,
    problem: &Problem<S, N>,
    h: f64,
) -> Option<u32> {
    let start = State::from_arrays(0.0, problem.q, problem.p);
    let system = Watched::new(problem.system);
    let integrator = Integrator::plain(method, system, start, h).ok()?;
    let mut integrator = integrator.with_solver(FullNewton);
    integrator.set_max_iterations(MAX_ITERATIONS);
    for _ in 0..STEPS {
        integrator.step().ok()?;
    }
    Some(integrator.statistics().most_iterations)
}

fn run<M: Method + Copy, S: Stiff<N> + 'static, L, R: Summation, const N: usize>(
    method: M,
    nodes: &[f64],
    problem: &Problem<S, N>,
    h: f64,
) -> Outcome
where
    L: LinearSolver<SVector<f64, N>, Steps<S>>,
{
    let mut outcome = Outcome {
        name: String::new(),
        sweeps: Ok(0),
        in_full: None,
        error: Some(0.0),
        grows: false,
    };
    if let Err(error) = follow::<M, S, L, R, N>(method, nodes, problem, h, &mut outcome) {
        outcome.sweeps = Err(error);
    }
    outcome
}

/// Takes the steps and records the outcome; errors are those of the library.
fn follow<M: Method + Copy, S: Stiff<N> + 'static, L, R: Summation, const N: usize>(
    method: M,
    nodes: &[f64],
    problem: &Problem<S, N>,
    h: f64,
    outcome: &mut Outcome,
) -> Result<(), Error>
where
    L: LinearSolver<SVector<f64, N>, Steps<S>>,
{
    let start = State::from_arrays(0.0, problem.q, problem.p);
    let integrator: Integrator<M, _, _, R> =
        Integrator::with_summation(method, Steps(problem.system), start, h)?;
    let mut integrator = integrator.with_solver(Newton::<L>::new());
    let wide = |values: [f64; N]| values.map(Wide::from_f64);
    let start = State::from_arrays(0.0, wide(problem.q), wide(problem.p));
    let mut watched = Watched::new(problem.system);
    let (guess, notes) = (Rc::clone(&watched.guess), Rc::clone(&watched.notes));
    watched.is_reference = true;
    let mut reference = Integrator::plain(method, watched, start, h)?.with_solver(FullNewton);
    reference.set_max_iterations(MAX_ITERATIONS);
    let mut bound = vec![0.0; 2 * N];
    for _ in 0..STEPS {
        let state = integrator.step()?.clone();
        outcome.sweeps = Ok(integrator.statistics().most_iterations);
        outcome.grows |= state.q.iter().any(|q| q.abs() > GROWN);
        let dense = integrator.dense()?;
        let (begin, end) = dense.span();
        let stage = |&node: &f64| {
            let inside = dense.state((begin + node * (end - begin)).min(end))?;
            Ok((node, inside.q.as_slice().to_vec()))
        };
        let stages = nodes.iter().map(stage).collect::<Result<_, Error>>()?;
        guess.replace(stages);
        let Ok(exact) = reference.step() else {
            outcome.error = None;
            return Ok(());
        };
        bound = notes.borrow().carry(&bound);
        let components = state
            .q
            .iter()
            .chain(&state.p)
            .zip(exact.q.iter().chain(&exact.p));
        for ((&found, &exact), bound) in components.zip(&bound) {
            let error = (Wide::from_f64(found) - exact).magnitude();
            outcome.error = outcome.error.map(|largest| largest.max(error / bound));
        }
    }
    Ok(())
}
