//! A step allocates nothing, whatever the method: counted at the allocator.
//!
//! A program without the test harness, whose own thread allocates while a test runs.
#![allow(
    clippy::print_stdout,
    reason = "without the harness this says what ran"
)]

use std::alloc::System as SystemAllocator;
use std::ops::ControlFlow;
use std::sync::Arc;

use nalgebra::{DVector, SVector};
use stats_alloc::{INSTRUMENTED_SYSTEM, Region, StatsAlloc};
use symplectic::constraints::Gradients;
use symplectic::ensemble::Ensemble;
use symplectic::simd::{F64x8, Lanes};
use symplectic::solver::{
    Automatic, Banded, Dense, Differences, FixedPoint, FixedPointThenNewton, Newton, Solver,
};
use symplectic::system::{Conservative, Lagrangian};
use symplectic::variational::{DiracRule, DiracSteps, DiracSystem, LagrangianSteps};
use symplectic::{
    Compensated, Error, Integrator, Method, ProvedFor, Scalar, Separable, State, hamiltonian,
    separable,
};
use symplectic_formula::{Form, Structure, System};
use symplectic_tape::{Formula, Parameters, Tapes, Values};
use symplectic_tests::at_run_time::tableau;
use symplectic_tests::formulas::Kepler;
use symplectic_tests::methods::{Gauss4, Lobatto3, StoermerVerlet};

symplectic::composition! {
    /// Three steps of an implicit method.
    TripleJump { base: gauss-2, weights: triple_jump(6) }
}

symplectic::composition! {
    /// Constrained steps of three sizes.
    TripleRattle { base: lobatto-2, weights: triple_jump(4) }
}

symplectic::hamiltonian! {
    /// A hanging chain of links.
    Links { rods: pairs }
    q: [..; 2], p: [..; 2];
    H = sum(i: |p[i]|^2/2 + q[i][1])
    constraints: { anchor = |q[0]|^2 - 1, rod(s = (i, j) in rods) = |q[i] - q[j]|^2 - 1 }
}

#[global_allocator]
static ALLOCATOR: &StatsAlloc<SystemAllocator> = &INSTRUMENTED_SYSTEM;

/// Allocations in a hundred steps and one run to an end.
fn allocations<
    M: Method + Copy + ProvedFor<S::Class>,
    S: symplectic::System<DVector<f64>>,
    N: Solver<DVector<f64>, S>,
>(
    method: M,
    system: S,
    solver: N,
) -> Result<usize, Error> {
    let q = DVector::from_fn(40, |i, _| (i as f64).sin());
    let start = State::new(0.0, q.clone(), -q);
    let integrator = Integrator::new(method, system, start, 0.01)?;
    counted(integrator.with_solver(solver))
}

/// [`allocations`] of a method that is derived here, by fixed points and by Newton's iteration.
fn at_run_time<S: symplectic::System<DVector<f64>, Class: Conservative>>(
    [basis, nodes]: [&str; 2],
    system: impl Fn() -> S,
) -> Result<usize, Box<dyn std::error::Error>> {
    let q = DVector::from_fn(40, |i, _| (i as f64).sin());
    let start = State::new(0.0, q.clone(), -q);
    let tableau = tableau(nodes, &symplectic_compiler::derive(basis, nodes)?)?;
    let made = || Integrator::new(tableau.clone(), system(), start.clone(), 0.01);
    let newton = Newton::<Dense<Differences>>::new();
    Ok(counted(made()?)? + counted(made()?.with_solver(newton))?)
}

/// Forty particles and their springs, on a tape with more registers than are on the stack.
fn springs() -> Result<Formula<Separable>, Box<dyn std::error::Error>> {
    let text = "Springs q: [..], p: [..]; bonds: walls; H = sum(i: p[i]^2/2 - cos(q[i])) + sum(bonds d: d^2/2 + d^4/4)";
    let mut system = System::read_as(Form::Hamiltonian, "springs", text)?;
    let structure = Structure::of(&mut system);
    let tapes = Tapes::new(&mut system, &structure, &Values::of_bodies(40), 0.0)?;
    Ok(Formula::new(Arc::new(tapes), Parameters::none()))
}

fn counted<M: Method, S: symplectic::System<DVector<f64>>, N: Solver<DVector<f64>, S>>(
    mut integrator: Integrator<M, S, DVector<f64>, Compensated, N>,
) -> Result<usize, Error> {
    counted_in(|| {
        for _ in 0..100 {
            integrator.step()?;
        }
        integrator.integrate_to(2.0).map(|_| ())
    })
}

fn counted_in<E>(action: impl FnOnce() -> Result<(), E>) -> Result<usize, E> {
    let region = Region::new(ALLOCATOR);
    action()?;
    let change = region.change();
    Ok(change.allocations + change.reallocations)
}

/// Allocations in an ensemble of short runs, for each of the last 8192 of 9216 trajectories.
fn of_a_trajectory<M: Method + Copy + ProvedFor<Separable>, L: Lanes>(
    method: M,
    lanes: impl Fn(
        Ensemble<M, Kepler, SVector<f64, 2>>,
    ) -> Ensemble<M, Kepler, SVector<f64, 2>, Compensated, Automatic, L>,
) -> Result<f64, Error> {
    let count = |trajectories: u32| {
        let start = |k| State::from_arrays(0.0, [1.0, 0.0], [0.0, 1.0 + 1e-5 * f64::from(k)]);
        let starts = (0..trajectories).map(start).collect();
        let ensemble = lanes(Ensemble::new(method, Kepler, starts, 0.1).expect("starts"));
        counted_in(|| {
            ensemble.take_steps(5, |_| ControlFlow::Continue(()));
            Ok(())
        })
    };
    let [few, many] = [count(1024)?, count(9216)?];
    Ok((many as f64 - few as f64) / 8192.0)
}

symplectic::lagrangian! {
    /// Particles whose kinetic energy is not quadratic.
    Particles q: [..], v: [..];
    L = sum(i: v[i]^2/2 + v[i]^4/4 - q[i]^2/2)
}

/// The last of them stays where it is.
struct Stopped;

impl Lagrangian for Stopped {
    type Vector<T: Scalar> = DVector<T>;

    fn lagrangian<T: Scalar>(&self, time: T, q: &DVector<T>, v: &DVector<T>) -> T {
        Particles.lagrangian(time, q, v)
    }
}

impl DiracSystem for Stopped {
    fn nonholonomic_constraints(&self) -> usize {
        1
    }

    fn nonholonomic_rows<T: Scalar>(&self, q: &DVector<T>, rows: &mut Gradients<T>) {
        rows.set(0, q.len() - 1, T::from_f64(1.0));
    }
}

fn main() -> Result<(), Box<dyn std::error::Error>> {
    let chain = || {
        separable::<DVector<f64>, _, _>(
            |_, p, velocity| velocity.copy_from(p),
            |_, q, force| {
                for i in 0..q.len() {
                    let left = if i > 0 { q[i - 1] } else { 0.0 };
                    let right = q.get(i + 1).copied().unwrap_or(0.0);
                    force[i] = left - 2.0 * q[i] + right;
                }
            },
        )
    };
    let coupled = || {
        hamiltonian::<DVector<f64>, _, _>(
            |_, q, p, velocity| velocity.zip_zip_apply(q, p, |v, q, p| *v = p * (q * q + 1.0)),
            |_, q, p, force| force.zip_zip_apply(q, p, |f, q, p| *f = -q * (p * p + 1.0)),
        )
    };
    assert_eq!(allocations(StoermerVerlet, chain(), FixedPoint)?, 0);
    assert_eq!(allocations(Lobatto3, chain(), FixedPoint)?, 0);
    assert_eq!(allocations(Gauss4, chain(), FixedPoint)?, 0);
    assert_eq!(allocations(StoermerVerlet, coupled(), FixedPoint)?, 0);
    assert_eq!(allocations(Gauss4, coupled(), FixedPoint)?, 0);
    assert_eq!(allocations(TripleJump, chain(), FixedPoint)?, 0);
    assert_eq!(allocations(TripleJump, coupled(), FixedPoint)?, 0);
    let dense = Newton::<Dense<Differences>>::new();
    let banded = Newton::<Banded<1, Differences>>::new();
    assert_eq!(allocations(Gauss4, chain(), dense)?, 0);
    assert_eq!(allocations(Gauss4, chain(), banded)?, 0);
    assert_eq!(allocations(Gauss4, coupled(), dense)?, 0);
    assert_eq!(allocations(Lobatto3, coupled(), banded)?, 0);
    assert_eq!(allocations(TripleJump, chain(), dense)?, 0);
    let both = FixedPointThenNewton::<Dense<Differences>>::new();
    assert_eq!(allocations(Gauss4, chain(), both)?, 0);
    let gauss = ["polynomial(4)", "gauss(4)"];
    assert_eq!(at_run_time(["polynomial(2)", "lobatto(2)"], chain)?, 0);
    assert_eq!(at_run_time(gauss, chain)?, 0);
    assert_eq!(at_run_time(gauss, coupled)?, 0);
    // The first evaluation of a formula makes the registers of its tape.
    for expected in [None, Some(0)] {
        for found in [
            allocations(StoermerVerlet, springs()?, Automatic)?,
            allocations(Gauss4, springs()?, Automatic)?,
            at_run_time(gauss, || springs().expect("a formula"))?,
        ] {
            assert_eq!(found, expected.unwrap_or(found));
        }
    }
    let links = || Links::new((1..20).map(|k| (k - 1, k)).collect());
    let sideways = DVector::from_fn(40, |k, _| ((k / 2 + 1) * (1 - k % 2)) as f64);
    let start = || State::new(0.0, sideways.clone(), DVector::zeros(40));
    assert_eq!(
        counted(Integrator::new(StoermerVerlet, links(), start(), 0.01)?)?,
        0
    );
    assert_eq!(
        counted(Integrator::new(Lobatto3, links(), start(), 0.01)?)?,
        0
    );
    assert_eq!(
        counted(Integrator::new(TripleRattle, links(), start(), 0.01)?)?,
        0
    );
    // One constraint.
    let pendulum = State::new(0.0, DVector::from_vec(vec![1.0, 0.0]), DVector::zeros(2));
    let one = Integrator::new(Lobatto3, Links::new(Vec::new()), pendulum, 0.01)?;
    assert_eq!(counted(one)?, 0);

    let start = || {
        State::new(
            0.0,
            DVector::from_vec(vec![0.5, 1.0, 0.2]),
            DVector::zeros(3),
        )
    };
    let mut run = LagrangianSteps::run(Gauss4, Particles, start(), 0.1)?;
    assert_eq!(counted_in(|| run.integrate_to(2.0).map(|_| ()))?, 0);
    let mut run = DiracSteps::run(DiracRule::Trapezoid, Stopped, start(), 0.1)?;
    assert_eq!(counted_in(|| run.integrate_to(2.0).map(|_| ()))?, 0);

    // Of a trajectory there is none: one list for a group of eight, and lanes for each share of 256 with about thirty vectors of stages.
    assert!(of_a_trajectory(StoermerVerlet, Ensemble::in_lanes::<F64x8>)? < 0.5);
    assert!(of_a_trajectory(StoermerVerlet, Ensemble::one_by_one)? < 0.5);
    assert!(of_a_trajectory(Gauss4, Ensemble::in_lanes::<F64x8>)? < 0.5);
    assert!(of_a_trajectory(Gauss4, Ensemble::one_by_one)? < 0.5);

    // The count sees what a system allocates itself.
    let wasteful = separable::<DVector<f64>, _, _>(
        |_, p, velocity| *velocity = p.clone(),
        |_, q, force| force.copy_from(&(-q)),
    );
    assert!(allocations(StoermerVerlet, wasteful, FixedPoint)? >= 400);
    println!("steps allocate nothing ... ok");
    Ok(())
}
