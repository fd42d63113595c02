//! Tolerances of the iteration for coupled stages.

use crate::common::methods::{Gauss2, Gauss8, Lobatto4};
use symplectic::nalgebra::{SVector, Vector1, Vector2};
use symplectic::solver::{
    Dense, Differences, FixedPoint, Newton, SimdFixedPoint, SimdJacobi, Solver,
};
use symplectic::system::{SystemInLanes, Unconstrained};
use symplectic::{
    Error, Integrator, Method, Plain, Quantity, Scalar, SeparableHamiltonian, State, System,
};

use crate::common::systems::{Kepler, Pendulum, Product, perihelion};

type Made<M, N> = Integrator<M, Kepler, Vector2<f64>, Plain, N>;

/// Ten steps to a tolerance are near to those to rounding, in fewer sweeps; to a tolerance of zero they are these.
fn check<M: Method, N: Solver<Vector2<f64>, Kepler>>(
    made: impl Fn() -> Result<Made<M, N>, Error>,
) -> Result<(), Error> {
    let mut exact = made()?;
    exact.take_steps(10)?;
    let mut before = exact.iterations();
    for tolerance in [1e-12, 1e-9, 1e-6] {
        let mut near = made()?;
        near.set_tolerance(tolerance)?;
        near.take_steps(10)?;
        assert!(near.iterations() < before, "{} {tolerance:e}", M::NAME);
        before = near.iterations();
        // The last change is within it, the error smaller by the factor of the iteration, and ten steps add up.
        let error = (near.state().q - exact.state().q).amax();
        assert!(error < 10.0 * tolerance, "{} {error:e}", M::NAME);
        near.set_tolerance(0.0)?;
        near.set_state(perihelion())?;
        near.take_steps(10)?;
        assert_eq!(near.state(), exact.state(), "{}", M::NAME);
        // One below rounding is not waited for.
        let mut fine = made()?;
        fine.set_tolerance(1e-40)?;
        fine.take_steps(10)?;
        let difference = (fine.state().q - exact.state().q).amax();
        assert!(difference < 1e-13, "{} {difference:e}", M::NAME);
    }
    Ok(())
}

#[test]
fn a_tolerance_saves_sweeps_and_bounds_the_change() -> Result<(), Error> {
    fn all<M: Method + Copy>(method: M) -> Result<(), Error> {
        let made = || Integrator::plain(method, Kepler, perihelion(), 0.05);
        check(made)?;
        check(|| Ok(made()?.with_solver(SimdFixedPoint)))?;
        check(|| Ok(made()?.with_solver(FixedPoint)))?;
        check(|| Ok(made()?.with_solver(Newton::<Dense<Differences>>::new())))
    }
    all(Gauss2)?;
    all(Gauss8)?;
    all(Lobatto4)
}

#[test]
fn lanes_end_where_single_stages_do() -> Result<(), Error> {
    fn check<S: SystemInLanes<V>, V: symplectic::Vector<Scalar = f64>>(
        system: impl Fn() -> S,
        start: &State<V>,
    ) -> Result<(), Error>
    where
        <S as System<V>>::Class: Unconstrained,
    {
        for tolerance in [1e-3, 1e-8, 1e-13] {
            let made = || Integrator::plain(Gauss8, system(), start.clone(), 0.1);
            let mut alone = made()?.with_solver(FixedPoint);
            let mut in_lanes = made()?.with_solver(SimdFixedPoint);
            alone.set_tolerance(tolerance)?;
            in_lanes.set_tolerance(tolerance)?;
            assert_eq!(alone.take_steps(50)?, in_lanes.take_steps(50)?);
            assert_eq!(alone.iterations(), in_lanes.iterations());
        }
        Ok(())
    }
    check(|| Kepler, &perihelion())?;
    let start = State::new(0.0, Vector1::new(0.5), Vector1::new(1.0));
    check(|| Product, &start)
}

#[test]
fn both_halves_of_a_general_system_are_within_it() -> Result<(), Error> {
    let start = State::new(0.0, Vector1::new(0.5), Vector1::new(1.0));
    let made = || Integrator::plain(Gauss8, Product, start.clone(), 0.1);
    let mut exact = made()?;
    let exact = exact.step()?;
    let mut at_once = made()?.with_solver(SimdJacobi);
    at_once.set_tolerance(1e-9)?;
    let found = at_once.step()?;
    assert!((found.q - exact.q).amax() < 1e-9 && (found.p - exact.p).amax() < 1e-9);
    assert!(found != exact);
    Ok(())
}

#[test]
fn a_tolerance_that_is_negative_or_not_finite_is_refused() -> Result<(), Error> {
    let start = State::new(0.0, Vector1::new(1.0), Vector1::new(0.0));
    let mut integrator = Integrator::plain(Gauss2, Pendulum::default(), start.clone(), 0.1)?;
    integrator.set_tolerance(1e-3)?;
    for value in [-1e-3, f64::NAN, f64::INFINITY] {
        let error = integrator.set_tolerance(value).expect_err("no tolerance");
        let text = format!("the tolerance is {value}; it must be finite and not negative");
        assert_eq!(error.to_string(), text);
    }
    // The one before holds, with another solver too.
    integrator.take_steps(20)?;
    let loose = integrator.iterations();
    let mut again = Integrator::plain(Gauss2, Pendulum::default(), start, 0.1)?;
    again.set_tolerance(1e-3)?;
    let mut again = again.with_solver(SimdFixedPoint);
    again.take_steps(20)?;
    assert_eq!(again.iterations(), loose);
    Ok(())
}

/// A force that is not a number beyond q = 1.
struct Wall;

impl SeparableHamiltonian for Wall {
    type Vector<T: Scalar> = SVector<T, 1>;

    fn velocity<T: Scalar>(&self, _time: T, p: &SVector<T, 1>, velocity: &mut SVector<T, 1>) {
        *velocity = *p;
    }

    fn force<T: Scalar>(&self, _time: T, q: &SVector<T, 1>, force: &mut SVector<T, 1>) {
        force[0] = -q[0] + T::from_f64(0.0) * (T::one() - q[0]).ln();
    }
}

#[test]
fn a_nonfinite_stage_is_not_within_a_tolerance() -> Result<(), Error> {
    fn check<N: Solver<Vector1<f64>, Wall>>(
        mut integrator: Integrator<Gauss2, Wall, Vector1<f64>, Plain, N>,
    ) -> Result<(), Error> {
        integrator.set_tolerance(1e-2)?;
        let error = integrator.integrate_to(10.0).map(|_| ()).expect_err("wall");
        let what = Quantity::Force;
        assert!(
            matches!(error, Error::NonFinite { what: found, stage: Some(_), .. } if found == what),
            "{error:?}"
        );
        assert!(integrator.steps() > 5 && integrator.state().q[0] < 1.0);
        Ok(())
    }
    let start = State::new(0.0, Vector1::new(0.0), Vector1::new(1.5));
    let made = || Integrator::plain(Gauss2, Wall, start.clone(), 0.1);
    check(made()?)?;
    check(made()?.with_solver(SimdFixedPoint))?;
    check(made()?)
}
