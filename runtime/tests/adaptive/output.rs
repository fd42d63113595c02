//! What is seen of a run does not change its steps.

use std::f64::consts::{PI, TAU};
use std::ops::ControlFlow;

use symplectic::adaptive::{Adaptive, AdaptiveSteps, DistancePower, Error};
use symplectic::nalgebra::{Vector1, Vector2};
use symplectic::output::Moment;
use symplectic::{Event, State, acceleration};

use super::kepler::{Gauss5, Kepler, VelocityVerlet, pericentre, position};

type Orbit = State<Vector2<f64>>;
type Run = Adaptive<Gauss5, Kepler, DistancePower, Vector2<f64>>;

/// Of order 10.
fn gauss() -> Result<Run, Error> {
    AdaptiveSteps::run(Gauss5, Kepler, DistancePower(1.5), pericentre(0.9), 0.1)
}

#[test]
fn output_times_do_not_change_the_steps() -> Result<(), Error> {
    let (mut seen, mut unseen) = (gauss()?, gauss()?);
    let times: Vec<f64> = (0..=40).map(|k| f64::from(k) * TAU / 20.0).collect();
    let mut found = Vec::new();
    seen.integrate_at(&times, |state| found.push(state.clone()))?;
    assert_eq!(found.len(), times.len());
    for (state, &time) in found.iter().zip(&times) {
        assert_eq!(state.time, time);
        let error = (state.q - position(0.9, time % TAU)).norm();
        assert!(error < 1e-6, "{time}: {error:e}");
    }
    while unseen.state().time < seen.state().time {
        unseen.step()?;
    }
    assert_eq!(unseen.state(), seen.state());
    assert_eq!(unseen.step_size(), seen.step_size());
    // The last time may lie in the last step.
    seen.integrate_at(&[seen.state().time - 1e-3], |state| {
        found.push(state.clone())
    })?;
    assert_eq!(unseen.state(), seen.state());
    Ok(())
}

#[test]
fn the_state_at_the_end_has_the_order_of_the_method() -> Result<(), Error> {
    let mut run = gauss()?;
    for end in [1.0, 2.5, 2.5, 5.0] {
        let state = run.integrate_to(end)?;
        assert_eq!(state.time, end);
        let error = (state.q - position(0.9, end)).norm();
        assert!(error < 1e-10, "{end}: {error:e}");
        assert!(run.state().time >= end);
    }
    let (steps, present) = (run.steps(), run.state().clone());
    // In the last step already.
    run.integrate_to(5.0)?;
    assert_eq!((run.steps(), run.state()), (steps, &present));
    // In steps of one after another, and backward.
    run.stepper_mut().reverse();
    let state = run.integrate_to(1.0)?;
    assert!((state.q - position(0.9, 1.0)).norm() < 1e-10);
    assert!(run.state().time <= 1.0);
    Ok(())
}

#[test]
fn events_are_found_and_change_nothing() -> Result<(), Error> {
    let (mut seen, mut unseen) = (gauss()?, gauss()?);
    let turning = Event::crossing(|state: &Orbit| state.q.dot(&state.p)).by_steps();
    let mut times = Vec::new();
    seen.integrate_with_events(10.0 * TAU, &turning, |state| {
        times.push(state.time);
        ControlFlow::<()>::Continue(())
    })?;
    assert!(times.len() >= 19, "{times:?}");
    for (number, time) in times.iter().enumerate() {
        let expected = PI * (number as f64 + 1.0);
        assert!((time - expected).abs() < 1e-8, "{number}: {time}");
    }
    while unseen.state().time < seen.state().time {
        unseen.step()?;
    }
    assert_eq!(unseen.state(), seen.state());
    Ok(())
}

/// At each apocentre the orbit exceeds a distance by a little, for less than a step: both crossings are found.
#[test]
fn shallow_crossings_within_steps_are_found() -> Result<(), Error> {
    for depth in [1e-3, 1e-5, 1e-7] {
        let mut run = gauss()?;
        let event = Event::crossing(|state: &Orbit| state.q.norm() - 1.9 * (1.0 - depth));
        let mut times = Vec::new();
        run.integrate_with_events(10.0 * TAU, &event, |state| {
            times.push(state.time);
            ControlFlow::<()>::Continue(())
        })?;
        assert_eq!(times.len(), 20, "{depth}: {times:?}");
        for (number, pair) in (0..).zip(times.chunks(2)) {
            // In the middle of them is the apocentre; the orbit has an error of 1e-8.
            let apocentre = PI + TAU * f64::from(number);
            assert!((0.5 * (pair[0] + pair[1]) - apocentre).abs() < 1e-6);
        }
    }
    Ok(())
}

#[test]
fn a_run_in_pieces_misses_no_events() -> Result<(), Error> {
    let mut run = gauss()?;
    let apocentre = Event::falling(|state: &Orbit| state.q.dot(&state.p));
    let mut count = 0;
    for end in 1..=200 {
        run.integrate_with_events(f64::from(end) * 0.1 * PI, &apocentre, |_| {
            count += 1;
            ControlFlow::<()>::Continue(())
        })?;
    }
    assert_eq!(count, 10);
    Ok(())
}

#[test]
fn a_ball_bounces_off_a_wall_in_variable_steps() -> Result<(), Error> {
    // A ball that falls and bounces, with steps that are short near the floor.
    let ball = acceleration(|_, _: &Vector1<f64>, acceleration| acceleration[0] = -1.0)
        .with_energy(|_, q, p| p[0] * p[0] / 2.0 + q[0]);
    let start = State::from_arrays(0.0, [1.0], [0.0]);
    let monitor = super::errors::Shifted(0.1);
    let mut run = AdaptiveSteps::run(VelocityVerlet, ball, monitor, start, 0.05)?;
    let mut impacts = Vec::new();
    let mut heights = Vec::new();
    let floor = Event::wall(|state: &State<Vector1<f64>>| state.q[0]);
    run.integrate_through(20.0, &[2.0_f64.sqrt() * 2.0, 12.0], &floor, |moment| {
        match moment {
            Moment::Event { state, .. } => {
                impacts.push(state.time);
                state.p[0] = -state.p[0];
            }
            Moment::Output(state) => heights.push(state.q[0]),
        }
        ControlFlow::<()>::Continue(())
    })?;
    // The flight is a parabola, which Störmer–Verlet has exactly.
    for (number, time) in impacts.iter().enumerate() {
        let expected = 2.0_f64.sqrt() * (2 * number + 1) as f64;
        assert!((time - expected).abs() < 1e-12, "{time} {expected}");
    }
    assert_eq!(impacts.len(), 7);
    assert!((heights[0] - 1.0).abs() < 1e-12);
    assert!((run.stepper().energy().expect("an energy") - 1.0).abs() < 1e-12);
    Ok(())
}

#[test]
fn times_before_the_last_step_are_refused() -> Result<(), Error> {
    let mut run = gauss()?;
    run.integrate_to(3.0)?;
    let present = run.state().clone();
    for end in [1.0, f64::NAN, f64::INFINITY] {
        assert!(matches!(
            run.integrate_to(end),
            Err(Error::Core(symplectic::Error::OutputTime { .. }))
        ));
    }
    let outside = run.integrate_at(&[1.0], |_| ());
    assert!(matches!(
        outside,
        Err(Error::Core(symplectic::Error::OutputTime { time: 1.0, .. }))
    ));
    let infinite =
        run.integrate_through(f64::INFINITY, &[], &(), |_| ControlFlow::<()>::Continue(()));
    assert!(matches!(
        infinite,
        Err(Error::Core(symplectic::Error::EndTime { .. }))
    ));
    assert_eq!(*run.state(), present);
    Ok(())
}

#[test]
fn a_run_in_pieces_shows_all_output_times() -> Result<(), Error> {
    for sign in [1.0, -1.0] {
        let monitor = DistancePower(1.5);
        let mut run = AdaptiveSteps::run(Gauss5, Kepler, monitor, pericentre(0.9), sign * 0.1)?;
        let mut found = Vec::new();
        for piece in 0..20 {
            // Steps are longer than 0.1 near the apocentre: a time lies in the last step of the piece before.
            let times = [0.02, 0.1, 0.2].map(|time| sign * (0.2 * f64::from(piece) + time));
            run.integrate_through(times[2], &times, &(), |moment| {
                if let Moment::Output(state) = moment {
                    let expected = position(0.9, state.time.abs());
                    let expected = Vector2::new(expected[0], sign * expected[1]);
                    assert!((state.q - expected).norm() < 1e-6);
                    found.push(state.time);
                }
                ControlFlow::<()>::Continue(())
            })?;
        }
        assert_eq!(found.len(), 60);
    }
    Ok(())
}

#[test]
fn an_end_behind_the_steps_is_refused() -> Result<(), Error> {
    let mut run = gauss()?;
    let apocentre = Event::falling(|state: &Orbit| state.q.dot(&state.p));
    let refused = Err(Error::Core(symplectic::Error::OutputTime {
        time: -5.0,
        before: 0.0,
    }));
    assert_eq!(run.find_event(-5.0, &apocentre), refused);
    let through = run.integrate_through(-5.0, &[-1.0], &(), |_| {
        ControlFlow::<Option<Orbit>>::Continue(())
    });
    assert_eq!(through.map(Option::flatten), refused);
    // In the last step there is nothing left to do.
    run.integrate_to(3.0)?;
    let present = run.state().clone();
    assert_eq!(run.find_event(3.0, &apocentre)?, None);
    assert_eq!(*run.state(), present);
    Ok(())
}

#[test]
fn a_search_goes_on_from_a_kick_where_steps_are_short() -> Result<(), Error> {
    // Steps are shorter by a factor of a million at 0 than at the start, and the zeros of the function lie close together there.
    const W: f64 = 1e-6;
    let free = acceleration(|_, _: &Vector1<f64>, acceleration| acceleration[0] = 0.0);
    let start = State::from_arrays(0.0, [-1.0], [1.0]);
    let monitor = super::errors::Parabola(W);
    let mut run = AdaptiveSteps::run(VelocityVerlet, free, monitor, start, 0.02)?;
    let cubic = Event::crossing(|state: &State<Vector1<f64>>| {
        let x = state.q[0] / W;
        x - x.powi(3)
    });
    let mut found = Vec::new();
    run.integrate_through(1.0 + 3.0 * W, &[], &cubic, |moment| {
        if let Moment::Event { state, .. } = moment {
            found.push(state.q[0] / W);
            state.p[0] *= 1.0001;
        }
        ControlFlow::<()>::Continue(())
    })?;
    assert_eq!(found.len(), 3, "{found:?}");
    for (found, expected) in found.into_iter().zip([-1.0, 0.0, 1.0]) {
        assert!((found - expected).abs() < 1e-6, "{found}");
    }
    Ok(())
}
