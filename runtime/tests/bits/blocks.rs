//! Many steps at once are the steps one by one.

use crate::common::methods::{
    AdjointEuler, Midpoint, PositionJump, StoermerVerlet, SymplecticEuler, TripleJump,
};
use symplectic::nalgebra::{DVector, SVector, Vector1, Vector2};
use symplectic::solver::FixedPoint;
use symplectic::system::Masses;
use symplectic::{
    Error, Integrator, Method, Quantity, Retry, Separable, State, Summation, System, Vector,
    acceleration, separable,
};

/// A driven oscillator in each component.
struct Driven;

impl<V: Vector<Scalar = f64>> System<V> for Driven {
    type Class = Separable;
    type Solver = FixedPoint;

    fn velocity(&self, _time: f64, _q: &V, p: &V, velocity: &mut V) {
        velocity.as_mut_slice().copy_from_slice(p.as_slice());
    }

    fn force(&self, time: f64, q: &V, _p: &V, force: &mut V) {
        for (k, (force, q)) in force
            .as_mut_slice()
            .iter_mut()
            .zip(q.as_slice())
            .enumerate()
        {
            *force = time.cos() - (k + 1) as f64 * q;
        }
    }
}

/// The same, which says that its masses are one; its velocity is the momentum so many times.
struct Unit<const VELOCITY: i32>;

impl<V: Vector<Scalar = f64>, const VELOCITY: i32> System<V> for Unit<VELOCITY> {
    type Class = Separable;
    type Solver = FixedPoint;

    const MASSES: Masses = Masses::Unit;

    fn velocity(&self, _time: f64, _q: &V, p: &V, velocity: &mut V) {
        for (velocity, p) in velocity.as_mut_slice().iter_mut().zip(p.as_slice()) {
            *velocity = f64::from(VELOCITY) * p;
        }
    }

    fn force(&self, time: f64, q: &V, _p: &V, force: &mut V) {
        System::force(&Driven, time, q, q, force);
    }
}

/// The same with masses 1, 2, 3, 1, ….
struct Heavy;

impl<V: Vector<Scalar = f64>> System<V> for Heavy {
    type Class = Separable;
    type Solver = FixedPoint;

    fn velocity(&self, _time: f64, _q: &V, p: &V, velocity: &mut V) {
        let components = velocity.as_mut_slice().iter_mut().zip(p.as_slice());
        for (k, (velocity, p)) in components.enumerate() {
            *velocity = p / (k % 3 + 1) as f64;
        }
    }

    fn force(&self, time: f64, q: &V, _p: &V, force: &mut V) {
        System::force(&Driven, time, q, q, force);
    }
}

fn same_bits<M: Method + Copy, V: Vector<Scalar = f64>, R: Summation>(
    method: M,
    start: &State<V>,
) -> Result<(), Error> {
    same_bits_of::<M, _, V, R>(method, || Driven, start)?;
    same_bits_of::<M, _, V, R>(method, || Heavy, start)?;
    same_bits_of::<M, _, V, R>(method, || Unit::<1>, start)
}

fn same_bits_of<M, S, V, R>(
    method: M,
    system: impl Fn() -> S,
    start: &State<V>,
) -> Result<(), Error>
where
    M: Method + Copy,
    S: System<V, Class = Separable>,
    V: Vector<Scalar = f64>,
    R: Summation,
{
    let integrator =
        || Integrator::<M, S, V, R>::with_summation(method, system(), start.clone(), 0.01);
    for count in [0, 1, 2, 256, 257, 258, 1000] {
        let (mut at_once, mut one_by_one) = (integrator()?, integrator()?);
        for _ in 0..count {
            one_by_one.step()?;
        }
        at_once.take_steps(count)?;
        // What comes after does not differ either.
        for _ in 0..3 {
            assert_eq!(at_once.state(), one_by_one.state(), "{} {count}", M::NAME);
            assert_eq!(at_once.remainder(), one_by_one.remainder());
            assert_eq!(at_once.statistics(), one_by_one.statistics());
            at_once.step()?;
            one_by_one.step()?;
        }
    }
    // To a time that is no multiple of the step size, with and without somebody who looks.
    let (mut at_once, mut one_by_one) = (integrator()?, integrator()?);
    one_by_one.integrate_with(7.777, |_| {})?;
    assert_eq!(at_once.integrate_to(7.777)?, one_by_one.state());
    assert_eq!(at_once.statistics(), one_by_one.statistics());
    Ok(())
}

#[test]
#[ignore = "thorough"]
fn many_steps_are_the_steps_one_by_one() -> Result<(), Error> {
    fn check<M: Method + Copy>(method: M) -> Result<(), Error> {
        let fixed = State::new(0.5, Vector2::new(0.3, -0.2), Vector2::new(0.1, 1.0));
        same_bits::<_, _, symplectic::Compensated>(method, &fixed)?;
        same_bits::<_, _, symplectic::Plain>(method, &fixed)?;
        let vector = |n: usize| DVector::from_fn(n, |i, _| (i as f64).sin());
        same_bits::<_, _, symplectic::Compensated>(method, &State::new(0.0, vector(5), vector(5)))?;
        // Long vectors, to the momenta of which kicks are given by drifts.
        let long = State::new(0.25, vector(70), vector(70));
        same_bits::<_, _, symplectic::Plain>(method, &long)?;
        same_bits::<_, _, symplectic::Compensated>(method, &long)?;
        let fixed = |x: &DVector<f64>| SVector::<f64, 70>::from_column_slice(x.as_slice());
        let long = State::new(0.25, fixed(&long.q), fixed(&long.p));
        same_bits::<_, _, symplectic::Plain>(method, &long)
    }
    check(StoermerVerlet)?;
    check(SymplecticEuler)?;
    check(AdjointEuler)?;
    check(PositionJump)?;
    check(TripleJump)?;
    check(Midpoint)?;
    // So long that a thousand steps are several blocks.
    let vector = |n: usize| DVector::from_fn(n, |i, _| (i as f64).sin());
    let long = State::new(0.0, vector(1030), vector(1030));
    same_bits_of::<_, _, _, symplectic::Plain>(StoermerVerlet, || Unit::<1>, &long)?;
    same_bits_of::<_, _, _, symplectic::Plain>(PositionJump, || Unit::<1>, &long)
}

/// Kicks that wait where a block fails are made by the steps one by one.
#[test]
fn a_step_of_a_long_vector_that_fails_among_many_is_found() -> Result<(), Error> {
    fn check<M: Method + Copy>(method: M) -> Result<(), Error> {
        let well = || {
            acceleration(|_time, q: &DVector<f64>, force: &mut DVector<f64>| {
                force.copy_from(&q.map(|q| q.sqrt() - 1.0));
            })
        };
        for size in [0.001, -0.001] {
            let start = State::new(
                0.0,
                DVector::from_fn(70, |i, _| 0.5 + 0.01 * i as f64),
                DVector::from_element(70, -1.0_f64.copysign(size)),
            );
            let made = || Integrator::plain(method, well(), start.clone(), size);
            let (mut at_once, mut one_by_one) = (made()?, made()?);
            let expected = loop {
                if let Err(error) = one_by_one.step() {
                    break error;
                }
            };
            let error = at_once.take_steps(10_000).expect_err("below zero");
            assert_eq!(error, expected);
            assert_eq!(at_once.state(), one_by_one.state());
            // Not all statistics: the force before the block is evaluated again.
            assert_eq!(at_once.steps(), one_by_one.steps());
            assert!(at_once.steps() > 300);
            // No smaller step helps.
            at_once.set_retry(Retry::Split { halvings: 2 });
            assert!(at_once.take_steps(3).is_err());
            assert_eq!(at_once.state(), one_by_one.state());
        }
        Ok(())
    }
    check(StoermerVerlet)?;
    check(SymplecticEuler)?;
    check(PositionJump)
}

/// The error, the state and the counts are those of the step that fails.
#[test]
fn a_step_that_fails_among_many_is_found() -> Result<(), Error> {
    // Free fall towards a force that is not finite below 0.
    let well = || {
        separable::<Vector1<f64>, _, _>(
            |_, p, velocity| *velocity = *p,
            |_, q, force| force[0] = q[0].sqrt() - 1.0,
        )
    };
    fn check<M: Method + Copy, S: System<Vector1<f64>, Class = Separable>>(
        method: M,
        well: impl Fn() -> S,
    ) -> Result<(), Error> {
        let start = State::new(0.0, Vector1::new(0.5), Vector1::new(-1.0));
        let mut at_once = Integrator::new(method, well(), start.clone(), 0.001)?;
        let mut one_by_one = Integrator::new(method, well(), start, 0.001)?;
        let mut steps = 0;
        let expected = loop {
            match one_by_one.step() {
                Ok(_) => steps += 1,
                Err(error) => break error,
            }
        };
        assert!(steps > 300);
        let error = at_once.take_steps(10_000).expect_err("below zero");
        assert_eq!(error, expected);
        assert!(
            matches!(error, Error::NonFinite { what: Quantity::Force, step, .. } if step == steps + 1)
        );
        assert_eq!(at_once.state(), one_by_one.state());
        assert_eq!(at_once.steps(), one_by_one.steps());
        assert_eq!(at_once.iterations(), one_by_one.iterations());

        // Halved steps do not help below zero, and are tried.
        at_once.set_retry(Retry::Split { halvings: 2 });
        assert_eq!(
            at_once.take_steps(10_000).expect_err("still below"),
            expected
        );
        Ok(())
    }
    check(StoermerVerlet, well)?;
    check(Midpoint, well)
}

/// Steps that are taken in parts are so among many, too.
#[test]
fn steps_are_split_among_many() -> Result<(), Error> {
    let kepler = || {
        separable(
            |_, p: &Vector2<f64>, velocity| *velocity = *p,
            |_, q, force| *force = -q / q.norm().powi(3),
        )
    };
    // From the apocentre; at the pericentre steps of 1/16 do not converge.
    let momentum = (0.01_f64 / 1.99).sqrt();
    let start = State::new(0.0, Vector2::new(1.99, 0.0), Vector2::new(0.0, momentum));
    let integrator = || {
        let mut integrator = Integrator::new(Midpoint, kepler(), start.clone(), 0.0625)?;
        integrator.set_retry(Retry::Split { halvings: 8 });
        Ok(integrator)
    };
    let (mut at_once, mut one_by_one) = (integrator()?, integrator()?);
    at_once.take_steps(300)?;
    for _ in 0..300 {
        one_by_one.step()?;
    }
    assert!(at_once.statistics().rejected > 0);
    assert_eq!(at_once.statistics(), one_by_one.statistics());
    assert_eq!(at_once.state(), one_by_one.state());
    Ok(())
}

/// The velocity of a system with unit masses is not asked for, and the steps are the same.
#[test]
fn declared_unit_masses_give_the_same_steps() -> Result<(), Error> {
    fn check<M: Method + Copy>(method: M) -> Result<(), Error> {
        let start = State::new(0.5, Vector2::new(0.3, -0.2), Vector2::new(0.1, 1.0));
        let mut known = Integrator::new(method, Unit::<1>, start.clone(), 0.01)?;
        let mut asked = Integrator::new(method, Driven, start.clone(), 0.01)?;
        assert_eq!(known.take_steps(1000)?, asked.take_steps(1000)?);
        assert_eq!(known.statistics(), asked.statistics());

        // Also at rest, where any linear velocity is right.
        let at_rest = State::new(0.5, start.q, Vector2::zeros());
        for (start, velocity, momentum) in [(start, 0.2, 0.1), (at_rest, 1.4, 0.7)] {
            let wrong = Integrator::new(method, Unit::<2>, start, 0.01).map(|_| ());
            let expected = Error::NotUnitMasses {
                component: 0,
                velocity,
                momentum,
            };
            assert_eq!(wrong, Err(expected));
        }
        Ok(())
    }
    check(StoermerVerlet)?;
    check(SymplecticEuler)?;
    check(TripleJump)?;
    check(Midpoint)
}

#[test]
fn a_result_resized_in_the_middle_is_an_error() -> Result<(), Error> {
    let resizing = separable::<DVector<f64>, _, _>(
        |_, p, velocity| velocity.copy_from(p),
        |time, q, force| *force = if time > 3.0 { DVector::zeros(1) } else { -q },
    );
    let start = State::new(0.0, DVector::from_element(2, 1.0), DVector::zeros(2));
    let mut integrator = Integrator::new(StoermerVerlet, resizing, start, 0.01)?;
    let error = integrator.take_steps(1000).expect_err("another dimension");
    assert!(
        matches!(
            error,
            Error::EvaluationDimension {
                found: 1,
                expected: 2,
                step: 301,
                ..
            }
        ),
        "{error:?}"
    );
    assert_eq!(integrator.steps(), 300);
    Ok(())
}

/// Time stands still where steps are below its resolution: from the first step on, or on the way.
#[test]
fn steps_too_small_for_the_time_are_refused() -> Result<(), Error> {
    for time in [1e16, 2_f64.powi(53) - 5.0] {
        let start = State::new(time, Vector1::new(1.0), Vector1::new(0.0));
        let mut explicit = Integrator::new(StoermerVerlet, Driven, start.clone(), 0.5)?;
        let mut coupled = Integrator::new(Midpoint, Driven, start, 0.5)?;
        for error in [
            explicit.take_steps(1000).map(|_| ()),
            coupled.take_steps(1000).map(|_| ()),
        ] {
            assert!(
                matches!(error, Err(Error::TimeResolution { .. })),
                "{error:?}"
            );
        }
    }
    Ok(())
}
