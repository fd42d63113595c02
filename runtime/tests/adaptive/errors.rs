//! Bad input, and steps that cannot be taken.

use symplectic::adaptive::{AdaptiveSteps, DistancePower, Error, Monitor};
use symplectic::nalgebra::Vector1;
use symplectic::{Scalar, State, acceleration};

use super::kepler::{Kepler, VelocityVerlet, pericentre};

/// σ = q + shift
#[derive(Clone, Copy)]
pub struct Shifted(pub f64);

impl Monitor for Shifted {
    fn value<T: Scalar>(&self, q: &[T]) -> T {
        q[0] + T::from_f64(self.0)
    }
}

/// σ = q² + least
#[derive(Clone, Copy)]
pub struct Parabola(pub f64);

impl Monitor for Parabola {
    fn value<T: Scalar>(&self, q: &[T]) -> T {
        q[0] * q[0] + T::from_f64(self.0)
    }
}

#[test]
fn an_epsilon_that_is_zero_or_not_finite_is_refused() {
    for epsilon in [0.0, f64::NAN, f64::INFINITY, f64::NEG_INFINITY] {
        let monitor = DistancePower(1.5);
        let made = AdaptiveSteps::run(VelocityVerlet, Kepler, monitor, pericentre(0.9), epsilon);
        let error = made.expect_err("a bad ε");
        assert!(
            matches!(error, Error::Core(symplectic::Error::StepSize { value }) if value.to_bits() == epsilon.to_bits())
        );
    }
}

#[test]
fn a_monitor_must_be_positive_at_the_start() {
    for shift in [-1.0, -3.0, f64::NAN, f64::INFINITY] {
        let falling = acceleration(|_, _: &Vector1<f64>, acceleration| acceleration[0] = -1.0);
        let start = State::from_arrays(2.0, [1.0], [0.0]);
        let made = AdaptiveSteps::run(VelocityVerlet, falling, Shifted(shift), start, 0.1);
        let Err(Error::Core(symplectic::Error::Monitor { time, value })) = made else {
            panic!("{shift}")
        };
        assert_eq!((time, value.to_bits()), (2.0, (1.0 + shift).to_bits()));
    }
}

/// Constant, and then not positive beyond q = 1.
struct Cliff;

impl Monitor for Cliff {
    fn value<T: Scalar>(&self, q: &[T]) -> T {
        // √ of a negative number is NaN.
        (T::one() - q[0]).sqrt() * T::from_f64(0.0) + T::one()
    }
}

#[test]
fn a_monitor_that_fails_in_a_run_leaves_the_state_unchanged() -> Result<(), Error> {
    let free = acceleration(|_, _: &Vector1<f64>, acceleration| acceleration[0] = 0.0);
    let start = State::from_arrays(0.0, [0.0], [1.0]);
    let mut run = AdaptiveSteps::run(VelocityVerlet, free, Cliff, start, 0.3)?;
    run.take_steps(4)?;
    let (state, size) = (run.state().clone(), run.step_size());
    assert!(state.q[0] > 1.0);
    for _ in 0..2 {
        let Err(Error::Core(symplectic::Error::Monitor { time, value })) = run.step() else {
            panic!("a step")
        };
        assert!(time == state.time && value.is_nan());
        assert_eq!((run.state(), run.step_size()), (&state, size));
    }
    assert_eq!(run.steps(), 4);
    // From a better state it goes on.
    run.set_state(State::from_arrays(0.0, [0.5], [-1.0]))?;
    run.step()?;
    let present = run.state().clone();
    assert!(matches!(
        run.set_state(State::from_arrays(0.0, [1.5], [1.0])),
        Err(Error::Core(symplectic::Error::Monitor { .. }))
    ));
    assert_eq!(*run.state(), present);
    Ok(())
}

/// Steps become shorter and shorter until they do not change the time; the cause is the monitor.
#[test]
fn a_monitor_that_vanishes_is_named() -> Result<(), Error> {
    let spring = acceleration(|_, q: &Vector1<f64>, acceleration| *acceleration = -q);
    let start = State::from_arrays(1e9, [1.0], [0.0]);
    let mut run = AdaptiveSteps::run(VelocityVerlet, spring, DistancePower(1.5), start, 0.05)?;
    let error = run.take_steps(1_000_000).err();
    assert!(
        matches!(error, Some(Error::Core(symplectic::Error::Monitor { value, .. })) if value < 1e-4),
        "{error:?}"
    );
    Ok(())
}

#[test]
fn a_density_that_is_not_positive_leaves_the_state_unchanged() -> Result<(), Error> {
    // σ grows so fast that z = 1/σ − ε σ'/(2σ) is negative.
    let free = acceleration(|_, _: &Vector1<f64>, acceleration| acceleration[0] = 0.0);
    let start = State::from_arrays(0.0, [1.0], [3.0]);
    let mut run = AdaptiveSteps::run(VelocityVerlet, free, Shifted(0.0), start.clone(), 1.0)?;
    let Err(Error::StepDensity {
        time,
        step,
        density,
    }) = run.step()
    else {
        panic!("a step")
    };
    assert_eq!((time, step, density), (0.0, 1, 1.0 - 0.5 * 3.0));
    assert_eq!((run.state(), run.steps()), (&start, 0));
    Ok(())
}

#[test]
fn a_failed_step_leaves_the_step_density_unchanged() -> Result<(), Error> {
    // The force is NaN beyond 1.
    let edge = acceleration(|_, q: &Vector1<f64>, acceleration| {
        acceleration[0] = 0.0 * (1.0 - q[0]).sqrt();
    });
    let start = State::from_arrays(0.0, [0.0], [1.0]);
    let mut run = AdaptiveSteps::run(VelocityVerlet, edge, Shifted(1.0), start, 0.2)?;
    let failed = loop {
        let (state, size) = (run.state().clone(), run.step_size());
        if let Err(error) = run.step() {
            assert_eq!((run.state(), run.step_size()), (&state, size));
            break error;
        }
    };
    assert!(
        matches!(failed, Error::Core(symplectic::Error::NonFinite { .. })),
        "{failed}"
    );
    Ok(())
}

#[test]
fn messages_name_the_cause_the_time_and_a_remedy() {
    let monitor = Error::Core(symplectic::Error::Monitor {
        time: 2.0,
        value: -1.0,
    });
    assert!(
        monitor
            .to_string()
            .starts_with("the monitor of the step sizes is -1 at time 2;")
    );
    let density = Error::StepDensity {
        time: 2.0,
        step: 7,
        density: -0.5,
    };
    assert!(
        density
            .to_string()
            .starts_with("step 7 at time 2: the step density z is -0.5,")
    );
    assert!(density.to_string().contains("take a smaller ε"));
}
