//! Where steps are extreme: every run ends with the outcome that is written here, a good result or an error, and never
//! with a silent one.

use symplectic::nalgebra::{SVector, Vector1, Vector2};
use symplectic::{
    Error, Integrator, Method, ProvedFor, Quantity, Separable, State, System, Vector, separable,
};
use symplectic_tests::methods::{Gauss4, Lobatto3, StoermerVerlet};
use symplectic_tests::scenes::kepler::{Kepler, start};

symplectic::tableau! {
    /// Order 2.
    Midpoint { basis: polynomial(1), nodes: gauss(1) }
}

/// H = (p² + ω² q²)/2
fn oscillator(omega: f64) -> impl System<Vector1<f64>, Class = Separable> {
    separable::<Vector1<f64>, _, _>(
        |_, p, velocity| *velocity = *p,
        move |_, q, force| *force = q * (-omega * omega),
    )
    .with_energy(move |_, q, p| (p[0] * p[0] + omega * omega * q[0] * q[0]) / 2.0)
}

/// What became of a run.
#[derive(Debug, PartialEq)]
enum Outcome {
    /// The largest relative error of the energy.
    Done(f64),
    /// The stages were not found, and the state is the one before the step.
    NoConvergence,
    /// Something became infinite, after so many steps.
    NonFinite(u64),
}

/// Steps until the end or an error. After every step, and after an error, the state has to be finite.
fn run<M: Method + Copy + ProvedFor<S::Class>, S: System<V>, V: Vector<Scalar = f64>>(
    method: M,
    system: S,
    start: State<V>,
    step_size: f64,
    steps: u64,
) -> Result<Outcome, Error> {
    let finite = |state: &State<V>| {
        let mut components = state.q.as_slice().iter().chain(state.p.as_slice());
        components.all(|x| x.is_finite())
    };
    let mut integrator = Integrator::new(method, system, start, step_size)?;
    let initial = integrator.energy().expect("the system has an energy");
    let mut error = 0.0_f64;
    for _ in 0..steps {
        let before = integrator.state().clone();
        let statistics = *integrator.statistics();
        match integrator.step() {
            Ok(state) => assert!(finite(state)),
            Err(failure) => {
                // Nothing has happened.
                assert_eq!(integrator.state(), &before);
                assert_eq!(integrator.statistics(), &statistics);
                return match failure {
                    Error::NoConvergence { residual, .. } => {
                        assert!(residual > 0.0 && !residual.is_nan());
                        Ok(Outcome::NoConvergence)
                    }
                    Error::NonFinite { .. } => Ok(Outcome::NonFinite(statistics.steps)),
                    other => Err(other),
                };
            }
        }
        let energy = integrator.energy().expect("the system has an energy");
        error = error.max((energy / initial - 1.0).abs());
    }
    Ok(Outcome::Done(error))
}

#[test]
fn an_oscillator_has_its_known_outcome_from_slow_to_stiff() -> Result<(), Error> {
    for exponent in -8..=8 {
        let omega = 10f64.powi(exponent);
        let begin = || State::new(0.0, Vector1::new(1.0), Vector1::new(omega));
        let go = |outcome: Result<Outcome, Error>, known: &dyn Fn(&Outcome) -> bool| {
            let outcome = outcome.expect("a known outcome");
            assert!(known(&outcome), "hω = 1e{exponent}: {outcome:?}");
        };
        // Implicit methods conserve the quadratic energy, as long as the fixed-point iteration contracts.
        let exact = |outcome: &Outcome| match outcome {
            Outcome::Done(error) => exponent <= 0 && *error < 1e-13,
            Outcome::NoConvergence => exponent > 0,
            Outcome::NonFinite(_) => false,
        };
        go(run(Gauss4, oscillator(omega), begin(), 1.0, 200), &exact);
        go(run(Midpoint, oscillator(omega), begin(), 1.0, 200), &exact);
        // Störmer–Verlet is stable for hω < 2, and beyond it grows until it overflows.
        let bounded = |outcome: &Outcome| match outcome {
            Outcome::Done(error) => exponent <= 0 && *error <= omega * omega + 1e-14,
            Outcome::NonFinite(steps) => exponent > 0 && *steps > 1,
            Outcome::NoConvergence => false,
        };
        go(
            run(StoermerVerlet, oscillator(omega), begin(), 1.0, 400),
            &bounded,
        );
    }
    Ok(())
}

/// H = p²/2 + k(|q| − 1)²/2 + q₂, a pendulum on a spring with ω = √k.
fn spring_pendulum(omega: f64) -> impl System<Vector2<f64>, Class = Separable> {
    let stiffness = omega * omega;
    separable::<Vector2<f64>, _, _>(
        |_, p, velocity| *velocity = *p,
        move |_, q, force| {
            let length = q.norm();
            *force = q * (-stiffness * (length - 1.0) / length) - Vector2::new(0.0, 1.0);
        },
    )
    .with_energy(move |_, q, p| {
        p.norm_squared() / 2.0 + stiffness * (q.norm() - 1.0).powi(2) / 2.0 + q[1]
    })
}

#[test]
fn a_stiff_spring_pendulum_has_its_known_outcomes() -> Result<(), Error> {
    for omega in [1e4, 1e6] {
        let begin = || State::new(0.0, Vector2::new(1.0, 0.0), Vector2::new(0.0, 1.0));
        // Resolved, all is well: the energy of the spring is as small as the rounding of its length allows.
        let fine = 0.25 / omega;
        for outcome in [
            run(Gauss4, spring_pendulum(omega), begin(), fine, 1000)?,
            run(StoermerVerlet, spring_pendulum(omega), begin(), fine, 1000)?,
        ] {
            assert!(
                matches!(outcome, Outcome::Done(error) if error < 1e-6),
                "{outcome:?}"
            );
        }
        // A hundred times too long: the iteration says so, the explicit method overflows.
        let coarse = 25.0 / omega;
        let outcome = run(Gauss4, spring_pendulum(omega), begin(), coarse, 1000)?;
        assert_eq!(outcome, Outcome::NoConvergence);
        let outcome = run(
            StoermerVerlet,
            spring_pendulum(omega),
            begin(),
            coarse,
            100_000,
        )?;
        assert!(
            !matches!(outcome, Outcome::Done(error) if error < 1.0),
            "{outcome:?}"
        );
    }
    Ok(())
}

#[test]
fn near_collisions_keep_the_energy_only_in_steps_that_resolve_them() -> Result<(), Error> {
    // e = 0.999: with steps that resolve the pericentre, the energy returns after it.
    let outcome = run(Gauss4, Kepler, start(0.999), 2.5e-6, 8_000)?;
    assert!(
        matches!(outcome, Outcome::Done(error) if error < 1e-10),
        "{outcome:?}"
    );
    // e = 1 − 1e-9: from the pericentre, at a distance of 1e-9 with a speed of 4e4, by steps of 1e-3.
    // The stages find themselves far from the centre, where there is no force: no step of a fixed size knows that the body
    // is thrown out of its orbit, but the energy does.
    for outcome in [
        run(Gauss4, Kepler, start(1.0 - 1e-9), 1e-3, 100)?,
        run(Lobatto3, Kepler, start(1.0 - 1e-9), 1e-3, 100)?,
    ] {
        assert!(
            matches!(outcome, Outcome::Done(error) if error > 1e6),
            "{outcome:?}"
        );
    }
    // Resolved, the energy −1/2 is the difference of two numbers of 1e9, which are rounded to 1e-7.
    let outcome = run(Gauss4, Kepler, start(1.0 - 1e-9), 1e-16, 1_000)?;
    assert!(
        matches!(outcome, Outcome::Done(error) if error < 1e-6),
        "{outcome:?}"
    );
    Ok(())
}

#[test]
fn a_head_on_collision_ends_in_an_error() -> Result<(), Error> {
    // From rest: no angular momentum, and a collision at t = π/√8 ≈ 1.11.
    let begin = || State::new(0.0, Vector2::new(1.0, 0.0), Vector2::new(0.0, 0.0));
    for outcome in [
        run(Gauss4, Kepler, begin(), 1e-2, 1_000)?,
        run(Midpoint, Kepler, begin(), 1e-2, 1_000)?,
    ] {
        assert_eq!(outcome, Outcome::NoConvergence);
    }
    // A step that hits the centre exactly evaluates 1/0.
    let onto = State::new(0.0, Vector2::new(0.5, 0.0), Vector2::new(-1.0, 0.0));
    let unit = separable::<Vector2<f64>, _, _>(
        |_, p, velocity| *velocity = *p,
        |_, q, force| {
            *force = if q.norm() > 0.4 {
                q * 0.0
            } else {
                -q / q.norm().powi(3)
            }
        },
    );
    let mut integrator = Integrator::new(StoermerVerlet, unit, onto.clone(), 0.5)?;
    let error = integrator.step().map(|_| ()).expect_err("1/0");
    let Error::NonFinite {
        what, step, time, ..
    } = error
    else {
        panic!("{error}");
    };
    assert_eq!((what, step, time), (Quantity::Force, 1, 0.0));
    assert_eq!(integrator.state(), &onto);
    Ok(())
}

#[test]
fn steps_do_not_depend_on_the_scale_of_the_state() -> Result<(), Error> {
    // Scaling H by s² and the state by s leaves the orbit as it is.
    for scale in [1e-300, 1e-150, 1e150, 1e300] {
        let begin = State::new(0.0, Vector1::new(scale), Vector1::new(0.0));
        let system = separable::<Vector1<f64>, _, _>(
            |_, p, velocity| *velocity = *p,
            |_, q, force| *force = -q,
        );
        let mut integrator = Integrator::new(Gauss4, system, begin, 0.1)?;
        let state = integrator.integrate_to(10.0)?;
        assert!((state.q[0] / scale - 10f64.cos()).abs() < 1e-12);
        assert!((state.p[0] / scale + 10f64.sin()).abs() < 1e-12);
    }
    // The smallest numbers have few digits, and are not lost: the error is a few of their units.
    let unit = 5e-324;
    let begin = State::new(0.0, Vector1::new(1e6 * unit), Vector1::new(0.0));
    let system =
        separable::<Vector1<f64>, _, _>(|_, p, velocity| *velocity = *p, |_, q, force| *force = -q);
    let mut integrator = Integrator::new(Gauss4, system, begin, 0.1)?;
    let state = integrator.integrate_to(1.0)?;
    assert!((state.q[0] / unit - 1e6 * 1f64.cos()).abs() < 1e3);
    // What overflows is an error.
    let begin = State::new(0.0, Vector1::new(1e300), Vector1::new(1e300));
    let system = separable::<Vector1<f64>, _, _>(
        |_, p, velocity| *velocity = *p,
        |_, q, force| *force = q * 1e10,
    );
    let mut integrator = Integrator::new(StoermerVerlet, system, begin.clone(), 1.0)?;
    assert!(matches!(integrator.step(), Err(Error::NonFinite { .. })));
    assert_eq!(integrator.state(), &begin);
    Ok(())
}

#[test]
fn symmetric_methods_return_to_the_start() -> Result<(), Error> {
    fn returns<M: Method + Copy>(method: M) -> Result<f64, Error> {
        let begin = start::<f64>(0.6);
        let mut integrator = Integrator::new(method, Kepler, begin.clone(), 0.01)?;
        integrator.integrate_to(20.0)?;
        integrator.set_step_size(-0.01)?;
        let end = integrator.integrate_to(0.0)?;
        Ok((end.q - begin.q).norm() + (end.p - begin.p).norm())
    }
    for distance in [
        returns(Gauss4)?,
        returns(Lobatto3)?,
        returns(StoermerVerlet)?,
    ] {
        assert!(distance < 1e-11, "{distance:e}");
    }
    Ok(())
}

/// In singles the energy error is that of singles.
#[test]
fn the_energy_error_in_single_precision_is_small() -> Result<(), Error> {
    let mut integrator = Integrator::new(Gauss4, Kepler, start::<f32>(0.6), 0.05)?;
    let before = integrator.energy().expect("known");
    integrator.integrate_to(50.0)?;
    let after = integrator.energy().expect("known");
    assert!((after / before - 1.0).abs() < 1e-5);
    Ok(())
}

#[test]
fn step_sizes_that_are_zero_or_not_finite_are_refused() -> Result<(), Error> {
    let integrator = |step_size: f64| {
        let begin = State::new(0.0, SVector::<f64, 1>::zeros(), SVector::zeros());
        Integrator::new(Gauss4, oscillator(1.0), begin, step_size).map(|_| ())
    };
    for step_size in [0.0, -0.0, f64::NAN, f64::INFINITY, f64::NEG_INFINITY] {
        assert!(matches!(integrator(step_size), Err(Error::StepSize { .. })));
    }
    integrator(f64::MIN_POSITIVE)?;
    integrator(-1e300)
}
