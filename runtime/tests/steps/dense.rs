//! States inside a step.

use crate::common::methods::{
    Gauss2, Gauss3, Gauss6, Gauss8, Lobatto3, Lobatto4, Midpoint, Radau2, RadauIA, RadauIIA,
    StoermerVerlet, Tang, Waves, Yoshida6,
};
use crate::common::systems::{Kepler, Pendulum, Product, perihelion, point};
use symplectic::nalgebra::{DVector, SVector};
use symplectic::output::Interpolation;
use symplectic::solver::{FixedPoint, SimdFixedPoint, Solver};
use symplectic::system::Unconstrained;
use symplectic::{Error, Integrator, Method, ProvedFor, State, Summation, System, Vector};

/// The state after a step of the size `fraction size`, in a hundred steps of Gauss 8.
fn exact<S, V>(system: S, start: &State<V>, time: f64) -> Result<State<V>, Error>
where
    S: System<V, Class: Unconstrained>,
    V: Vector,
{
    let mut fine = Integrator::new(Gauss8, system, start.clone(), time / 8.0)?;
    Ok(fine.integrate_to(start.time + time)?.clone())
}

fn difference<V: Vector<Scalar = f64>>(a: &V, b: &V) -> f64 {
    let pairs = a.as_slice().iter().zip(b.as_slice());
    pairs.map(|(a, b)| (a - b).abs()).fold(0.0, f64::max)
}

/// The largest errors of position and momentum inside the first step.
fn errors<M, S, V>(
    method: M,
    system: impl Fn() -> S,
    start: &State<V>,
    size: f64,
) -> Result<[f64; 2], Error>
where
    M: Method + ProvedFor<S::Class>,
    S: System<V, Class: Unconstrained>,
    V: Vector<Scalar = f64>,
{
    let mut integrator = Integrator::new(method, system(), start.clone(), size)?;
    integrator.step()?;
    let dense = integrator.dense()?;
    let mut largest = [0.0_f64; 2];
    for number in 1..16 {
        let time = size * f64::from(number) / 16.0;
        let (found, wanted) = (dense.state(time)?, exact(system(), start, time)?);
        let found = [
            difference(&found.q, &wanted.q),
            difference(&found.p, &wanted.p),
        ];
        largest = [largest[0].max(found[0]), largest[1].max(found[1])];
    }
    Ok(largest)
}

/// The orders of position and momentum inside a step are the `expected` ones, and not more.
///
/// The steps have their middle at `start`, so that the derivatives are those there.
fn shows<M, S, V>(
    method: M,
    system: impl Fn() -> S + Copy,
    start: &State<V>,
    size: f64,
    expected: [u32; 2],
) -> Result<(), Error>
where
    M: Method + Copy + ProvedFor<S::Class>,
    S: System<V, Class: Unconstrained>,
    V: Vector<Scalar = f64>,
{
    let runs = [size, size / 2.0].map(|size| {
        let before = exact(system(), start, -0.5 * size)?;
        let before = State {
            time: 0.0,
            ..before
        };
        errors(method, system, &before, size)
    });
    let [coarse, fine] = runs;
    let (coarse, fine) = (coarse?, fine?);
    for half in 0..2 {
        let slope = (coarse[half] / fine[half]).log2();
        let expected = f64::from(expected[half]);
        assert!(
            (slope - expected).abs() < 0.3,
            "{}: half {half} has order {slope} instead of {expected}: {coarse:?}, {fine:?}",
            M::NAME
        );
    }
    Ok(())
}

fn interpolation<M, S, V>(_method: M, _system: impl Fn() -> S, _start: &State<V>) -> Interpolation
where
    M: Method + ProvedFor<S::Class>,
    S: System<V, Class: Unconstrained>,
    V: Vector,
{
    Integrator::<M, S, V>::INTERPOLATION
}

#[test]
fn the_order_is_the_one_that_is_stated() -> Result<(), Error> {
    /// From a place off the axes, so that no derivative vanishes by symmetry.
    fn check<M: Method + Copy>(method: M, size: f64, expected: [u32; 2]) -> Result<(), Error> {
        let start = exact(Kepler, &perihelion(), 0.7)?;
        let start = State { time: 0.0, ..start };
        let [positions, momenta] = expected;
        assert_eq!(
            interpolation(method, || Kepler, &start),
            Interpolation::Stages { positions, momenta },
            "{}",
            M::NAME
        );
        shows(method, || Kepler, &start, size, expected)
    }
    check(Midpoint, 0.01, [2, 2])?;
    check(Gauss2, 0.02, [3, 3])?;
    check(Gauss3, 0.05, [4, 4])?;
    check(Gauss8, 0.4, [9, 9])?;
    check(Lobatto3, 0.02, [3, 4])?;
    check(Lobatto4, 0.05, [4, 5])?;
    check(Radau2, 0.02, [3, 3])?;
    check(RadauIA, 0.02, [3, 3])?;
    check(RadauIIA, 0.02, [3, 3])
}

#[test]
fn the_order_for_general_systems_is_the_lower_one() -> Result<(), Error> {
    let start = point(0.5, 1.0);
    for (found, order) in [
        (interpolation(Gauss3, || Product, &start), 4),
        (interpolation(Lobatto4, || Product, &start), 4),
        (interpolation(Lobatto3, || Product, &start), 3),
    ] {
        assert_eq!(found.order(), order);
    }
    shows(Gauss3, || Product, &start, 0.1, [4, 4])?;
    shows(Lobatto4, || Product, &start, 0.05, [4, 4])
}

#[test]
fn dense_output_without_a_stage_polynomial_is_cubic_hermite() -> Result<(), Error> {
    fn check<M: Method + Copy>(method: M, order: u32) -> Result<(), Error> {
        let start = exact(Kepler, &perihelion(), 0.7)?;
        let start = State { time: 0.0, ..start };
        let found = interpolation(method, || Kepler, &start);
        assert_eq!(found, Interpolation::Hermite, "{}", M::NAME);
        // The error of the step itself, of order p + 1, is larger for methods of low order.
        shows(method, || Kepler, &start, 0.02, [order; 2])
    }
    check(Yoshida6, 4)?;
    check(Gauss6, 4)?;
    check(StoermerVerlet, 3)?;
    check(Waves, 3)
}

/// Nodes of more stages than the basis has polynomials carry a polynomial of their own.
#[test]
fn dense_output_exists_with_more_nodes_than_functions() -> Result<(), Error> {
    let start = exact(Kepler, &perihelion(), 0.7)?;
    let found = interpolation(Tang, || Kepler, &start);
    assert!(matches!(found, Interpolation::Stages { .. }), "{found:?}");
    let start = State { time: 0.0, ..start };
    let Interpolation::Stages { positions, momenta } = found else {
        return Ok(());
    };
    shows(Tang, || Kepler, &start, 0.02, [positions, momenta])
}

/// At the ends of a step, forward and backward, by stages and in lanes, the polynomial has the states to the last bit.
#[test]
fn ends_are_exact() -> Result<(), Error> {
    fn check<M, V, R, N>(mut integrator: Integrator<M, Kepler, V, R, N>) -> Result<(), Error>
    where
        M: Method,
        Kepler: System<V>,
        V: Vector<Scalar = f64>,
        R: Summation,
        N: Solver<V, Kepler>,
    {
        for number in 0..40 {
            let before = integrator.state().clone();
            if number == 20 {
                integrator.set_step_size(-0.031)?;
            }
            let after = integrator.step()?.clone();
            let dense = integrator.dense()?;
            assert_eq!(dense.span(), (before.time, after.time));
            assert_eq!(dense.state(before.time)?, before, "{}", M::NAME);
            assert_eq!(dense.state(after.time)?, after, "{}", M::NAME);
        }
        Ok(())
    }
    fn all<M: Method + Copy>(method: M) -> Result<(), Error> {
        check(Integrator::new(method, Kepler, perihelion(), 0.03)?)?;
        check(Integrator::plain(method, Kepler, perihelion(), 0.03)?)?;
        check(Integrator::new(method, Kepler, perihelion(), 0.03)?.with_solver(SimdFixedPoint))
    }
    all(Gauss8)?;
    all(Lobatto3)?;
    all(Gauss6)?;
    all(StoermerVerlet)
}

/// The polynomial has the stages of a collocation method as its values at the nodes: with eight stages it loses nothing,
/// and lanes give what single stages give.
#[test]
fn eight_stages_lose_no_digits() -> Result<(), Error> {
    // Free fall: velocity and force are polynomials of low degree, so every value is that of a parabola up to rounding.
    let fall = || {
        symplectic::acceleration::<SVector<f64, 1>, _>(|_, _, acceleration| acceleration[0] = -1.0)
    };
    let start = State::new(0.0, SVector::from([1.0]), SVector::from([0.75]));
    let mut integrator = Integrator::new(Gauss8, fall(), start, 1.0)?;
    integrator.step()?;
    let dense = integrator.dense()?;
    for number in 0..=1000 {
        let t = f64::from(number) / 1000.0;
        let state = dense.state(t)?;
        let (q, p) = (1.0 + 0.75 * t - 0.5 * t * t, 0.75 - t);
        // Two units in the last place of the largest number in the sum.
        assert!((state.q[0] - q).abs() < 4.5e-16, "{t}: {} {q}", state.q[0]);
        assert!((state.p[0] - p).abs() < 4.5e-16, "{t}: {} {p}", state.p[0]);
    }
    let mut one_by_one =
        Integrator::new(Gauss8, Kepler, perihelion(), 0.2)?.with_solver(FixedPoint);
    let mut in_lanes =
        Integrator::new(Gauss8, Kepler, perihelion(), 0.2)?.with_solver(SimdFixedPoint);
    one_by_one.step()?;
    in_lanes.step()?;
    for number in 0..=10 {
        let time = 0.02 * f64::from(number);
        assert_eq!(
            one_by_one.dense()?.state(time)?,
            in_lanes.dense()?.state(time)?
        );
    }
    Ok(())
}

/// In single precision too.
#[test]
fn dense_output_works_in_single_precision_and_dynamic_vectors() -> Result<(), Error> {
    let start = State::new(
        0.0,
        SVector::<f32, 2>::new(0.4, 0.0),
        SVector::<f32, 2>::new(0.0, 2.0),
    );
    let mut single = Integrator::new(Gauss8, Kepler, start, 0.05)?;
    single.step()?;
    let wanted = exact(Kepler, &perihelion(), 0.02)?;
    let found = single.dense()?.state(0.02)?;
    for k in 0..2 {
        assert!((f64::from(found.q[k]) - wanted.q[k]).abs() < 2e-7);
    }
    let start = State::new(0.0, DVector::from_vec(vec![1.0; 3]), DVector::zeros(3));
    let mut dynamic = Integrator::new(StoermerVerlet, Pendulum::default(), start, 0.05)?;
    dynamic.step()?;
    let dense = dynamic.dense()?;
    let (mut q, mut p) = (DVector::zeros(3), DVector::zeros(3));
    dense.write(0.025, &mut q, &mut p)?;
    assert!((p[2] + 0.025 * 1.0_f64.sin()).abs() < 1e-5);
    let mut short = DVector::zeros(2);
    assert_eq!(
        dense.write(0.025, &mut q, &mut short),
        Err(Error::Dimension {
            position: 3,
            momentum: 2
        })
    );
    Ok(())
}

#[test]
fn dense_output_is_refused_before_a_step_and_outside_it() -> Result<(), Error> {
    let mut integrator = Integrator::new(Gauss3, Kepler, perihelion(), 0.1)?;
    assert_eq!(integrator.dense().err(), Some(Error::NoStep));
    integrator.step()?;
    for time in [-0.1, 0.1 + 1e-16 + 1e-16, f64::NAN, f64::INFINITY] {
        let error = integrator.dense()?.state(time).expect_err("outside");
        assert!(
            matches!(error, Error::OutsideStep { start, end, .. } if (start, end) == (0.0, 0.1))
        );
    }
    integrator.set_state(perihelion())?;
    assert_eq!(integrator.dense().err(), Some(Error::NoStep));
    integrator.step()?;
    let lanes = integrator.with_solver(SimdFixedPoint);
    assert_eq!(lanes.dense().err(), Some(Error::NoStep));
    Ok(())
}
