//! Several events in one search, with output times between them.

use std::ops::ControlFlow;

use crate::common::methods::{Gauss4, StoermerVerlet};
use symplectic::nalgebra::{DVector, Vector1, Vector2};
use symplectic::output::{Events, Moment};
use symplectic::{Error, Event, Integrator, Retry, State, acceleration};

type Point = State<Vector1<f64>>;

/// What is shown: the number of the event, or none for output, and the time.
type Shown = (Option<usize>, f64);

fn rest() -> Point {
    State::from_arrays(0.0, [0.0], [0.0])
}

/// A point at rest, so that events are functions of time alone.
fn shown(
    end: f64,
    step_size: f64,
    times: &[f64],
    events: &(impl Events<Vector1<f64>> + ?Sized),
) -> Result<Vec<Shown>, Error> {
    let at_rest = acceleration::<Vector1<f64>, _>(|_, _, acceleration| acceleration[0] = 0.0);
    let mut integrator = Integrator::new(StoermerVerlet, at_rest, rest(), step_size)?;
    let mut shown = Vec::new();
    let ended = integrator.integrate_through(end, times, events, |moment| {
        shown.push(match moment {
            Moment::Output(state) => (None, state.time),
            Moment::Event { index, state } => (Some(index), state.time),
        });
        ControlFlow::<()>::Continue(())
    })?;
    assert_eq!((ended, integrator.state().time), (None, end));
    Ok(shown)
}

fn at(time: f64) -> impl Fn(&Point) -> f64 + Copy {
    move |state: &Point| state.time - time
}

#[test]
fn output_and_events_come_in_the_order_of_time() -> Result<(), Error> {
    let events = (
        Event::crossing(at(0.75)),
        Event::rising(|state: &Point| (state.time - 0.25) * (state.time - 0.5)),
        Event::falling(|state: &Point| (state.time - 0.25) * (state.time - 0.5)),
        Event::falling(at(0.6)),
        Event::rising(at(0.6)).by_steps(),
    );
    // Doubles and ends of steps too; at the same time output comes first, then events by their number.
    let times = [0.0, 0.1, 0.25, 0.25, 0.7, 0.75, 1.0];
    let expected = [
        (None, 0.0),
        (None, 0.1),
        (None, 0.25),
        (None, 0.25),
        (Some(2), 0.25),
        (Some(1), 0.5),
        (Some(4), 0.6),
        (None, 0.7),
        (None, 0.75),
        (Some(0), 0.75),
        (None, 1.0),
    ];
    for step_size in [1.0, 0.3, 0.125, 0.01] {
        let found = shown(1.0, step_size, &times, &events)?;
        assert_eq!(found.len(), expected.len(), "{found:?}");
        for (found, expected) in found.iter().zip(expected) {
            assert!(
                found.0 == expected.0 && (found.1 - expected.1).abs() < 1e-15,
                "{found:?}"
            );
        }
        // Backward it rises where it falls, and the way round.
        let times: Vec<f64> = times.iter().map(|time| -time).collect();
        let mirrored = (
            Event::rising(|state: &Point| state.time + 0.75),
            Event::falling(|state: &Point| state.time + 0.75),
        );
        let found = shown(-1.0, step_size, &times, &mirrored)?;
        assert_eq!(found.len(), 8);
        assert_eq!(found[6].0, Some(1));
        assert!((found[6].1 + 0.75).abs() < 1e-15);
    }
    Ok(())
}

#[test]
fn events_are_given_as_arrays_slices_vectors_and_tuples() -> Result<(), Error> {
    let array = [0.2, 0.8, 0.4].map(|time| Event::crossing(at(time)));
    let order = |shown: Vec<Shown>| shown.iter().filter_map(|shown| shown.0).collect::<Vec<_>>();
    assert_eq!(order(shown(1.0, 0.5, &[], &array)?), [0, 2, 1]);
    assert_eq!(order(shown(1.0, 0.5, &[], &array[1..])?), [1, 0]);
    assert_eq!(order(shown(1.0, 0.5, &[], &array.to_vec())?), [0, 2, 1]);
    assert_eq!(order(shown(1.0, 0.5, &[], &array[0])?), [0]);
    assert_eq!(order(shown(1.0, 0.5, &[], &(array[0],))?), [0]);
    assert_eq!(shown(1.0, 0.5, &[0.5], &())?, [(None, 0.5)]);
    // All at the same time, in the order of the list.
    let same = [0.3; 5].map(|time| Event::rising(at(time)));
    assert_eq!(order(shown(1.0, 0.5, &[], &same)?), [0, 1, 2, 3, 4]);
    Ok(())
}

/// At the end, at the start, and where there is nothing to be integrated.
#[test]
fn output_and_events_at_the_ends_of_a_run_are_shown_in_order() -> Result<(), Error> {
    let event = Event::crossing(at(1.0));
    assert_eq!(
        shown(1.0, 0.3, &[1.0], &event)?,
        [(None, 1.0), (Some(0), 1.0)]
    );
    assert_eq!(
        shown(0.0, 0.3, &[0.0, 0.0], &event)?,
        [(None, 0.0), (None, 0.0)]
    );
    assert_eq!(shown(0.5, 0.3, &[], &Event::crossing(at(0.0)))?, []);
    for (times, error) in [
        (
            &[0.5, 0.25][..],
            Error::OutputTime {
                time: 0.25,
                before: 0.5,
            },
        ),
        (
            &[-0.5],
            Error::OutputTime {
                time: -0.5,
                before: 0.0,
            },
        ),
        (
            &[f64::INFINITY],
            Error::OutputTime {
                time: f64::INFINITY,
                before: 0.0,
            },
        ),
        (
            &[0.5, 1.5],
            Error::OutputAfterEnd {
                time: 1.5,
                end: 1.0,
            },
        ),
    ] {
        assert_eq!(shown(1.0, 0.3, times, &event), Err(error));
    }
    assert_eq!(
        shown(0.0, 0.3, &[1.0], &()),
        Err(Error::OutputAfterEnd {
            time: 1.0,
            end: 0.0
        })
    );
    let undefined = (
        event,
        Event::crossing(|state: &Point| (0.5 - state.time).sqrt()),
    );
    let error = shown(1.0, 0.3, &[], &undefined);
    assert!(matches!(error, Err(Error::EventValue { time }) if time > 0.5 && time < 0.7));
    Ok(())
}

/// A ball that bounces, with output between: heights by the closed form, and the number of impacts before each.
#[test]
fn output_of_a_bouncing_ball_agrees_with_the_closed_form() -> Result<(), Error> {
    const KEPT: f64 = 0.7;
    let fall = (2.0 * 50.0 / 9.8_f64).sqrt();
    let height = |time: f64| {
        let (mut start, mut speed) = (-fall, 9.8 * fall);
        while time > start + 2.0 * speed / 9.8 {
            start += 2.0 * speed / 9.8;
            speed *= KEPT;
        }
        (time - start) * (speed - 4.9 * (time - start))
    };
    let floor = Event::wall(|ball: &Point| ball.q[0]);
    for event in [floor, floor.by_steps()] {
        let ball = acceleration::<Vector1<f64>, _>(|_, _, acceleration| acceleration[0] = -9.8);
        let start = State::from_arrays(0.0, [50.0], [0.0]);
        let mut integrator = Integrator::new(StoermerVerlet, ball, start, 0.05)?;
        let times: Vec<f64> = (0..=400).map(|k| f64::from(k) * 0.1).collect();
        let (mut outputs, mut impacts, mut last) = (0, 0, 0.0);
        let ended = integrator.integrate_through(40.0, &times, &event, |moment| {
            let time = match &moment {
                Moment::Output(state) => state.time,
                Moment::Event { state, .. } => state.time,
            };
            assert!(last <= time, "{last} {time}");
            last = time;
            match moment {
                Moment::Output(state) => {
                    assert_eq!(state.time, times[outputs]);
                    assert!((state.q[0] - height(time)).abs() < 1e-11 && state.q[0] >= 0.0);
                    outputs += 1;
                }
                Moment::Event { state, .. } => {
                    assert!(state.q[0] >= 0.0);
                    state.p *= -KEPT;
                    impacts += 1;
                }
            }
            ControlFlow::<()>::Continue(())
        });
        // Up to 18.1015, where impacts accumulate.
        let accumulated = fall * (1.0 + KEPT) / (1.0 - KEPT);
        let Err(Error::EventsAccumulate { time, .. }) = ended else {
            panic!("{ended:?}");
        };
        assert!((time - accumulated).abs() < 1e-12);
        assert_eq!((outputs, integrator.state().time), (182, time));
        assert!((80..200).contains(&impacts) && integrator.state().q[0] >= 0.0);
    }
    Ok(())
}

/// Handlers that break, with and without a changed state, and that make a bad state.
#[test]
fn a_handler_that_breaks_leaves_a_valid_state() -> Result<(), Error> {
    let run = |change: f64, stop: bool| {
        let at_rest = acceleration::<Vector1<f64>, _>(|_, _, acceleration| acceleration[0] = 0.0);
        let mut integrator = Integrator::new(Gauss4, at_rest, rest(), 0.5)?;
        let ended = integrator.integrate_through(2.0, &[], &Event::crossing(at(0.7)), |moment| {
            if let Moment::Event { state, .. } = moment {
                state.p[0] += change;
                // The time is kept whatever is made of it.
                state.time = 100.0;
            }
            if stop {
                ControlFlow::Break(7)
            } else {
                ControlFlow::Continue(())
            }
        });
        Ok::<_, Error>((ended, integrator.into_state()))
    };
    let (ended, state) = run(0.0, true)?;
    assert_eq!((ended, state.time), (Ok(Some(7)), 1.0));
    let (ended, state) = run(1.0, true)?;
    assert_eq!((ended, state.p[0]), (Ok(Some(7)), 1.0));
    assert!((state.time - 0.7).abs() < 1e-15);
    let (ended, state) = run(1.0, false)?;
    assert_eq!((ended, state.time), (Ok(None), 2.0));
    assert!((state.q[0] - 1.3).abs() < 1e-14);
    let (ended, state) = run(f64::NAN, false)?;
    assert!(
        matches!(ended, Err(Error::NonFiniteState { .. })),
        "{ended:?}"
    );
    assert!((state.time - 0.7).abs() < 1e-15 && state.p[0] == 0.0);
    Ok(())
}

/// Kicks at a section, of dynamic vectors, in steps that are taken in parts.
#[test]
fn resets_at_events_work_in_split_steps() -> Result<(), Error> {
    let kepler = acceleration::<DVector<f64>, _>(|_, q: &DVector<f64>, acceleration| {
        acceleration.copy_from(&(q * -q.norm().powi(-3)));
    });
    let start = State::new(
        0.0,
        DVector::from_vec(vec![0.4, 0.0]),
        DVector::from_vec(vec![0.0, 2.0]),
    );
    let mut integrator = Integrator::new(Gauss4, kepler, start, 0.7)?;
    integrator.set_max_iterations(14);
    integrator.set_retry(Retry::Split { halvings: 8 });
    let aphelion = Event::falling(|state: &State<DVector<f64>>| state.q.dot(&state.p)).by_steps();
    let mut found = Vec::new();
    integrator.integrate_through(20.0, &[], &[aphelion], |moment| {
        if let Moment::Event { state, .. } = moment {
            found.push(state.time);
            state.p *= 1.05;
        }
        ControlFlow::<()>::Continue(())
    })?;
    assert!(integrator.statistics().rejected > 0);
    // Half a period, then periods of orbits with more and more energy.
    assert_eq!(found.len(), 3, "{found:?}");
    assert!((found[0] - std::f64::consts::PI).abs() < 0.1);
    assert!(found[1] - found[0] > 6.0 && found[2] - found[1] > found[1] - found[0]);
    Ok(())
}

/// Two functions of one type, one by steps: their states have the order of what finds them.
#[test]
fn events_by_steps_and_by_dense_output_have_their_orders() -> Result<(), Error> {
    type Plane = State<Vector2<f64>>;
    let circle = acceleration::<Vector2<f64>, _>(|_, q, acceleration| *acceleration = -q);
    let start = State::from_arrays(0.0, [1.0, 0.0], [0.0, 1.0]);
    let mut integrator = Integrator::new(Gauss4, circle, start, 0.25)?;
    let first = Event::falling(|state: &Plane| state.q[0]);
    let mut errors = [0.0; 2];
    integrator.integrate_through(2.0, &[], &[first, first.by_steps()], |moment| {
        if let Moment::Event { index, state } = moment {
            errors[index] = (state.time - std::f64::consts::FRAC_PI_2).abs();
        }
        ControlFlow::<()>::Continue(())
    })?;
    assert!(
        errors[1] < 1e-10 && errors[0] > errors[1] && errors[0] < 1e-5,
        "{errors:?}"
    );
    Ok(())
}

/// A function that has no value below the floor is looked at there before the floor is found.
#[test]
fn a_function_without_a_value_behind_a_wall_leaves_the_state_above_it() {
    let fall = acceleration::<Vector1<f64>, _>(|_, _, acceleration| acceleration[0] = -10.0);
    let start = State::from_arrays(0.0, [1.0], [0.0]);
    let mut integrator = Integrator::new(StoermerVerlet, fall, start, 0.3).expect("an integrator");
    let events = (
        Event::wall(|ball: &State<Vector1<f64>>| ball.q[0]),
        Event::falling(|ball: &State<Vector1<f64>>| ball.q[0].sqrt() - 0.25),
    );
    let error = integrator.integrate_through(1.0, &[], &events, |moment| {
        if let Moment::Event { index: 0, state } = moment {
            state.p *= -1.0;
        }
        ControlFlow::<()>::Continue(())
    });
    assert!(matches!(error, Err(Error::EventValue { .. })), "{error:?}");
    assert!(integrator.state().q[0] > 0.0);
    // Four equal steps to 1, and the floor is in the second.
    assert_eq!(integrator.state().time, 0.25);
}
