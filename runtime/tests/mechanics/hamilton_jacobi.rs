//! Generating functions of whole runs: what a step adds, and their derivatives over families of orbits.

use crate::methods::{Gauss3, Lobatto3};
use symplectic::nalgebra::{Matrix2, SVector, Vector2};
use symplectic::variational::{
    DiscreteHamiltonJacobi, DiscreteLagrangian, Error, VariationalSteps,
    step_with_generating_function,
};
use symplectic::{Integrator, Scalar, State};

use super::symmetry::Twisted;

/// L = |v|²/2 − |q|⁴/4 + q0 q1/2 in the middle of the step.
struct Middle;

impl DiscreteLagrangian for Middle {
    type Vector<T: Scalar> = SVector<T, 2>;

    fn value<T: Scalar>(&self, _: T, h: T, q0: &SVector<T, 2>, q1: &SVector<T, 2>) -> T {
        let half = T::from_f64(0.5);
        let (q, v) = ((q0 + q1) * half, (q1 - q0) * h.recip());
        h * (v.dot(&v) * half - q.dot(&q).powi(2) * half * half + q[0] * q[1] * half)
    }
}

const STEPS: u32 = 12;
const H: f64 = 0.15;

fn start(q: Vector2<f64>, p: Vector2<f64>) -> State<Vector2<f64>> {
    let (q0, p0) = (Vector2::new(0.8, -0.3), Vector2::new(0.2, 0.7));
    State::new(0.0, q0 + q, p0 + p)
}

/// The end of a run, with S_I, S_II and S_III.
type End = (State<Vector2<f64>>, [f64; 3]);

fn by_gauss(start: State<Vector2<f64>>) -> Result<End, Error> {
    let mut solution = DiscreteHamiltonJacobi::new(&start);
    let mut run = Integrator::new(Gauss3, Twisted, start, H)?;
    for _ in 0..STEPS {
        let generating = step_with_generating_function(&mut run)?;
        solution.add(generating.discrete_lagrangian(&run.state().p));
    }
    let two = solution.type_two(run.state());
    let values = [solution.type_one(), two, solution.type_three()];
    Ok((run.into_state(), values))
}

fn by_lagrangian(start: State<Vector2<f64>>) -> Result<End, Error> {
    let mut solution = DiscreteHamiltonJacobi::new(&start);
    let mut run = VariationalSteps::run(Middle, start, H)?;
    for _ in 0..STEPS {
        run.step()?;
        solution.add(run.stepper().action().expect("a step was taken"));
    }
    let two = solution.type_two(run.state());
    Ok((
        run.state().clone(),
        [solution.type_one(), two, solution.type_three()],
    ))
}

#[test]
fn a_step_adds_its_generating_function_to_the_solution() -> Result<(), Error> {
    let start = start(Vector2::zeros(), Vector2::zeros());
    let mut solution = DiscreteHamiltonJacobi::new(&start);
    let mut run = Integrator::new(Lobatto3, Twisted, start, H)?;
    for _ in 0..STEPS {
        let (before, old) = (run.state().clone(), solution);
        let generating = step_with_generating_function(&mut run)?;
        let after = run.state();
        solution.add(generating.discrete_lagrangian(&after.p));
        let pairing = before.p.dot(&before.q);
        let two = solution.type_two(after) - old.type_two(&before);
        assert!((two - (generating.value - pairing)).abs() < 1e-14);
        let three = solution.type_three() - old.type_three();
        let type_three = generating.type_three(&before.q, &after.p);
        assert!((three - (type_three + pairing)).abs() < 1e-14);
        assert!(two.abs() > 1e-3 && three.abs() > 1e-3);
    }
    Ok(())
}

/// The gradients of S by the end of the run, from orbits whose `family(a)` of starts has the position, or the momentum, in common.
fn gradient(
    run: impl Fn(State<Vector2<f64>>) -> Result<End, Error>,
    family: impl Fn(Vector2<f64>) -> State<Vector2<f64>>,
    kind: usize,
    end: impl Fn(&State<Vector2<f64>>) -> Vector2<f64>,
) -> Result<Vector2<f64>, Error> {
    const STEP: f64 = 1e-3;
    let (mut slopes, mut ends) = (Vector2::zeros(), Matrix2::zeros());
    for k in 0..2 {
        for (place, weight) in [(-2.0, 1.0), (-1.0, -8.0), (1.0, 8.0), (2.0, -1.0)] {
            let (state, values) = run(family(Vector2::ith(k, place * STEP)))?;
            let weight = weight / (12.0 * STEP);
            slopes[k] += values[kind] * weight;
            let mut column = ends.column_mut(k);
            column += end(&state) * weight;
        }
    }
    // dS/da = (d end/da)ᵀ ∂S/∂end
    Ok(ends.transpose().lu().solve(&slopes).expect("no caustic"))
}

fn check(run: impl Fn(State<Vector2<f64>>) -> Result<End, Error> + Copy) -> Result<(), Error> {
    let zero = Vector2::zeros();
    let (end, _) = run(start(zero, zero))?;
    let from_a_point = |a| start(zero, a);
    let with_a_momentum = |a| start(a, zero);
    let one = gradient(run, from_a_point, 0, |end| end.q)?;
    let two = gradient(run, from_a_point, 1, |end| end.p)?;
    let three = gradient(run, with_a_momentum, 2, |end| end.q)?;
    for (found, expected) in [(one, end.p), (two, end.q), (three, -end.p)] {
        let error = (found - expected).norm();
        assert!(error < 1e-8, "{error:e}: {found} {expected}");
    }
    // Another family, of orbits with neither in common, gives another gradient.
    let neither = |a: Vector2<f64>| start(a, a);
    let other = gradient(run, neither, 1, |end| end.p)?;
    assert!((other - end.q).norm() > 1e-2);
    Ok(())
}

#[test]
fn hamilton_jacobi_gradients_of_a_gauss_run_are_its_end() -> Result<(), Error> {
    check(by_gauss)
}

#[test]
fn hamilton_jacobi_gradients_of_a_lagrangian_run_are_its_end() -> Result<(), Error> {
    check(by_lagrangian)
}
