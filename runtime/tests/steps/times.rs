//! Times: exact ends, equal steps, no accumulated rounding.

use core::ops::ControlFlow;

use crate::common::methods::{Gauss4, Midpoint, StoermerVerlet};
use crate::common::systems::{Pendulum, point};
use crate::common::{distance, tableau};
use symplectic::nalgebra::Vector1;
use symplectic::output::Moment;
use symplectic::{Error, Event, Integrator, State, acceleration};

type Verlet = Integrator<StoermerVerlet, Pendulum, Vector1<f64>>;

fn verlet(time: f64, step_size: f64) -> Result<Verlet, Error> {
    let start = State {
        time,
        ..point(1.0, 0.0)
    };
    Integrator::new(StoermerVerlet, Pendulum::default(), start, step_size)
}

#[test]
fn the_end_is_exact_and_the_count_smallest() -> Result<(), Error> {
    for (start, end, step_size, steps) in [
        (0.0, 1.0, 0.1, 10),
        (0.0, 0.1 + 0.2, 0.1, 3),
        (0.0, 1.2, 0.4, 3),
        (0.0, 0.7, 0.1, 7),
        (0.0, 1.0, 0.3, 4),
        (0.0, 1.0, 0.3334, 3),
        (0.0, 1.0, 0.3333, 4),
        (0.0, 1.0, 5.0, 1),
        // 49 · (1/49) < 1 in f64.
        (0.0, 1.0, 1.0 / 49.0, 49),
        (0.0, 100.0, 0.001, 100_000),
        (1000.1, 1000.4, 0.1, 3),
        (0.0, -1.0, 0.1, 10),
        (0.0, -1.0, -0.1, 10),
        (0.0, 1.0, -0.1, 10),
        (2.0, 2.0, 0.1, 0),
    ] {
        let mut integrator = verlet(start, step_size)?;
        assert_eq!(integrator.integrate_to(end)?.time, end);
        assert_eq!(
            integrator.steps(),
            steps,
            "from {start} to {end} by {step_size}"
        );
        assert_eq!(integrator.step_size(), step_size);
    }
    Ok(())
}

#[test]
fn steps_to_the_end_are_uniform() -> Result<(), Error> {
    let mut to_end = verlet(0.0, 0.3)?;
    to_end.integrate_to(1.0)?;
    let mut by_step = verlet(0.0, 0.25)?;
    for _ in 0..4 {
        by_step.step()?;
    }
    assert_eq!(to_end.state(), by_step.state());
    Ok(())
}

#[test]
fn times_are_not_summed_up() -> Result<(), Error> {
    let mut integrator = verlet(0.0, 0.1)?;
    let mut sum = 0.0;
    for k in 1..=10_000 {
        sum += 0.1;
        assert_eq!(integrator.step()?.time, f64::from(k) * 0.1);
    }
    assert_ne!(sum, integrator.state().time);

    integrator.set_step_size(0.25)?;
    assert_eq!(integrator.step()?.time, 1000.25);
    integrator.set_state(point(0.0, 1.0))?;
    assert_eq!(integrator.step()?.time, 0.25);
    integrator.integrate_to(0.4)?;
    assert_eq!(integrator.step()?.time, 0.4 + 0.25);
    Ok(())
}

#[test]
fn integration_backward_returns_to_the_start() -> Result<(), Error> {
    let mut integrator = Integrator::new(Midpoint, Pendulum::default(), point(1.0, 0.5), 0.1)?;
    integrator.integrate_to(3.0)?;
    integrator.integrate_to(0.0)?;
    assert!(distance(integrator.state(), &point(1.0, 0.5)) < 1e-13);
    Ok(())
}

#[test]
fn observers_see_every_step_but_not_the_start() -> Result<(), Error> {
    let mut seen = Vec::new();
    let mut integrator = verlet(0.0, 0.25)?;
    integrator.integrate_with(1.0, |state| seen.push(state.clone()))?;

    let mut other = verlet(0.0, 0.25)?;
    let states = other.states().take(4).collect::<Result<Vec<_>, _>>()?;
    assert_eq!(seen, states);
    assert_eq!(
        states.iter().map(|state| state.time).collect::<Vec<_>>(),
        [0.25, 0.5, 0.75, 1.0]
    );
    Ok(())
}

#[test]
fn unreachable_end_times_and_step_counts_are_refused() -> Result<(), Error> {
    let mut integrator = verlet(1.0, 0.1)?;
    for end in [f64::NAN, f64::INFINITY, f64::NEG_INFINITY] {
        let error = integrator.integrate_to(end).expect_err("no such time");
        assert!(matches!(error, Error::EndTime { value } if value.to_bits() == end.to_bits()));
    }
    let uncounted = integrator.take_steps(u64::MAX);
    assert!(matches!(uncounted, Err(Error::StepCount { .. })));
    assert_eq!(integrator.steps(), 0);
    let mut far = verlet(-f64::MAX, 1e300)?;
    let end = f64::MAX;
    assert_eq!(far.integrate_to(end), Err(Error::EndTime { value: end }));

    integrator.set_step_size(1e-17)?;
    let too_many = Error::StepCount {
        time: 1.0,
        end: 2.0,
        step_size: 1e-17,
    };
    assert_eq!(integrator.integrate_to(2.0), Err(too_many));
    assert_eq!(
        integrator.step(),
        Err(Error::TimeResolution {
            time: 1.0,
            step_size: 1e-17
        })
    );
    assert_eq!((integrator.state().time, integrator.steps()), (1.0, 0));
    Ok(())
}

/// The largest error of output at 1/7, 2/7, … for the oscillator, alone and beside a search of events, with steps of this size.
fn output_error(step_size: f64, by_steps: bool) -> Result<f64, Error> {
    let oscillator = acceleration(|_, q: &Vector1<f64>, acceleration| *acceleration = -q);
    let start = State::new(0.0, Vector1::new(1.0), Vector1::new(0.0));
    let times: Vec<f64> = (1..21).map(|k| f64::from(k) / 7.0).collect();
    let error = |state: &State<Vector1<f64>>| (state.q[0] - state.time.cos()).abs();
    let mut alone = Integrator::new(tableau(Gauss4), oscillator, start.clone(), step_size)?;
    alone.set_output_by_steps(by_steps);
    let mut largest: f64 = 0.0;
    alone.integrate_at(&times, |state| largest = largest.max(error(state)))?;
    let mut with_events = Integrator::new(tableau(Gauss4), oscillator, start, step_size)?;
    with_events.set_output_by_steps(by_steps);
    let zero = Event::falling(|state: &State<Vector1<f64>>| state.q[0]);
    let mut beside: f64 = 0.0;
    with_events.integrate_through(3.0, &times, &zero, |moment| {
        if let Moment::Output(state) = moment {
            beside = beside.max(error(state));
        }
        ControlFlow::<()>::Continue(())
    })?;
    // The steps to an end are as long, or shorter.
    assert!(beside <= 2.0 * largest, "{beside:e} {largest:e}");
    Ok(largest)
}

#[test]
fn output_by_steps_has_the_order_of_the_method() -> Result<(), Error> {
    let [coarse, fine] = [0.5, 0.25].map(|size| output_error(size, true));
    let order = (coarse? / fine?).log2();
    assert!((7.5..9.0).contains(&order), "{order}");
    let [coarse, fine] = [0.5, 0.25].map(|size| output_error(size, false));
    let order = (coarse? / fine?).log2();
    assert!((3.5..4.5).contains(&order), "{order}");
    Ok(())
}
