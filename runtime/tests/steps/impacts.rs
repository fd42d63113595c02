//! Impacts on walls: balls that bounce, accumulate and rest.

use std::ops::ControlFlow;

use crate::common::methods::{Gauss2, Gauss4, Gauss5, StoermerVerlet};
use symplectic::nalgebra::{Vector1, Vector2};
use symplectic::output::Moment;
use symplectic::{
    Error, Event, Integrator, Method, ProvedFor, Separable, State, System, acceleration,
};

type Ball = State<Vector1<f64>>;
type Point = State<Vector2<f64>>;
type Floor = fn(&Point) -> f64;

const GRAVITY: f64 = 9.8;

fn falling_ball() -> impl System<Vector1<f64>, Class = Separable> {
    acceleration::<Vector1<f64>, _>(|_, _, acceleration| acceleration[0] = -GRAVITY)
}

fn ball(height: f64, velocity: f64) -> Ball {
    State::from_arrays(0.0, [height], [velocity])
}

fn height(ball: &Ball) -> f64 {
    ball.q[0]
}

/// The times of impacts, how they ended, and the last state.
type Bounces = (Vec<f64>, Result<(), Error>, Ball);

/// The impacts of a ball that falls from a height and keeps a part of its speed, until there are no more.
fn bounces(
    event: &Event<fn(&Ball) -> f64>,
    start: Ball,
    kept: f64,
    step_size: f64,
) -> Result<Bounces, Error> {
    let mut integrator = Integrator::new(StoermerVerlet, falling_ball(), start, step_size)?;
    let mut times = Vec::new();
    let ended = loop {
        assert!(times.len() < 2000, "no end");
        match integrator.find_event(40.0, event) {
            Ok(Some(mut state)) => {
                assert!(height(&state) >= 0.0, "below the floor");
                times.push(state.time);
                state.p *= -kept;
                integrator.set_state(state)?;
            }
            Ok(None) => break Ok(()),
            Err(error) => break Err(error),
        }
    };
    Ok((times, ended, integrator.into_state()))
}

/// The times are a geometric series, which ends at 18.1015; the ball is never below the floor. From a start at −18.1015 it ends at
/// zero, near which times have many more digits than states between the steps.
#[test]
fn accumulating_impacts_end_at_the_limit_of_their_times() -> Result<(), Error> {
    let fall = (2.0 * 50.0 / GRAVITY).sqrt();
    let end = fall * 1.7 / 0.3;
    let floor: fn(&Ball) -> f64 = height;
    for event in [Event::falling(floor), Event::wall(floor)] {
        for event in [event, event.by_steps(), event.samples(1), event.samples(3)] {
            for (step_size, begin) in [
                (0.05, 0.0),
                (0.5, 0.0),
                (7.0, 0.0),
                (0.05, -end),
                (0.5, -end),
            ] {
                let start = State {
                    time: begin,
                    ..ball(50.0, 0.0)
                };
                let (times, ended, last) = bounces(&event, start, 0.7, step_size)?;
                let mut expected = begin + fall;
                for (number, time) in (1..).zip(&times) {
                    // Rounding of the speed and of the times, of all impacts before.
                    assert!((time - expected).abs() < 1e-12, "{number}: {time}");
                    expected += 2.0 * fall * 0.7_f64.powi(number);
                }
                // Flights are seen down to about the last place of the time.
                assert!(
                    (80..400).contains(&times.len()),
                    "{step_size} {begin} {event:?} {}",
                    times.len()
                );
                let Err(Error::EventsAccumulate { time, index: 0, .. }) = ended else {
                    panic!("{ended:?}");
                };
                assert!((time - (begin + end)).abs() < 1e-12);
                assert!(last.time == time && height(&last) >= 0.0);
            }
        }
    }
    Ok(())
}

/// In singles, the rounding of which is far coarser than that of the time.
#[test]
fn accumulating_impacts_end_in_single_precision() -> Result<(), Error> {
    type Single = State<Vector1<f32>>;
    for (floor, kept) in [(0.0_f32, 0.3_f32), (0.0, 0.7), (0.0, 0.9), (10.0, 0.7)] {
        let height = move |ball: &Single| f64::from(ball.q[0] - floor);
        for event in [
            Event::falling(height),
            Event::wall(height),
            Event::wall(height).by_steps(),
        ] {
            let ball = acceleration::<Vector1<f32>, _>(|_, _, acceleration| acceleration[0] = -9.8);
            let start = State::from_arrays(0.0, [floor + 5.0], [0.0]);
            let mut integrator = Integrator::new(StoermerVerlet, ball, start, 0.05)?;
            let mut count = 0;
            let ended = loop {
                count += 1;
                assert!(count < 1000, "no end");
                match integrator.find_event(40.0, &event) {
                    Ok(Some(mut state)) => {
                        assert!(height(&state) >= 0.0);
                        state.p *= -kept;
                        integrator.set_state(state)?;
                    }
                    other => break other,
                }
            };
            assert!(
                matches!(ended, Err(Error::EventsAccumulate { .. })),
                "{ended:?}"
            );
            assert!(height(integrator.state()) >= 0.0);
            let expected = (10.0 / 9.8_f64).sqrt() * f64::from((1.0 + kept) / (1.0 - kept));
            // The last flight that is seen is a thousandth, in height that of a rounding.
            assert!((integrator.state().time / expected - 1.0).abs() < 2e-3);
        }
    }
    Ok(())
}

/// Thrown up from the floor, back in 2 v/g, within the first step.
#[test]
fn a_flight_within_one_step_is_an_event() -> Result<(), Error> {
    let floor: fn(&Ball) -> f64 = height;
    for event in [
        Event::falling(floor),
        Event::wall(floor),
        Event::crossing(floor),
    ] {
        for event in [event, event.by_steps(), event.samples(1)] {
            for speed in [2.0, 0.1, 1e-3, 1e-9] {
                let start = ball(0.0, speed);
                let mut integrator = Integrator::new(StoermerVerlet, falling_ball(), start, 0.5)?;
                let found = integrator.find_event(2.0, &event)?.expect("it comes down");
                let expected = 2.0 * speed / GRAVITY;
                // The rounding of dense output is that of the fall in a whole step.
                let fall = GRAVITY * 0.5 / (2.0 * speed);
                let rounding = 8.0 * f64::EPSILON * (1.0 + fall);
                assert!((found.time - expected).abs() < rounding * expected);
                assert!((found.p[0] + speed).abs() < 1e-14 && height(&found) >= 0.0);
            }
        }
    }
    Ok(())
}

/// The same upside down, backward in time, and from a start that is below the floor by rounding.
#[test]
fn flights_are_seen_in_all_directions() -> Result<(), Error> {
    let flight = 2.0 * 0.1 / GRAVITY;
    let near = |found: Option<Ball>, time: f64| {
        let found = found.expect("an event");
        assert!((found.time - time).abs() < 1e-15, "{}", found.time);
    };
    let thrown = |step_size: f64, speed: f64, height: f64| {
        Integrator::new(
            StoermerVerlet,
            falling_ball(),
            ball(height, speed),
            step_size,
        )
    };
    near(
        thrown(-0.5, -0.1, 0.0)?.find_event(-2.0, &Event::wall(height))?,
        -flight,
    );
    near(
        thrown(-0.5, -0.1, 0.0)?.find_event(-2.0, &Event::falling(height))?,
        -flight,
    );
    near(
        thrown(0.5, 0.1, 0.0)?.find_event(2.0, &Event::rising(|ball: &Ball| -ball.q[0]))?,
        flight,
    );
    near(
        thrown(0.5, 0.1, -1e-18)?.find_event(2.0, &Event::wall(height))?,
        flight,
    );
    // The sign of the step size is that of the way to the end, whatever was given.
    near(
        thrown(0.5, -0.1, 0.0)?.find_event(-2.0, &Event::wall(height))?,
        -flight,
    );
    Ok(())
}

/// A start is no event, except of a wall that the state goes into.
#[test]
fn a_start_on_zero_is_an_event_only_of_a_wall_that_it_enters() -> Result<(), Error> {
    let floor: fn(&Ball) -> f64 = height;
    let find = |event: Event<fn(&Ball) -> f64>, velocity: f64| {
        let start = ball(0.0, velocity);
        Integrator::new(StoermerVerlet, falling_ball(), start, 0.5)?.find_event(2.0, &event)
    };
    assert_eq!(find(Event::falling(floor), -1.0)?, None);
    assert_eq!(find(Event::rising(floor), 1.0)?, None);
    assert_eq!(find(Event::wall(floor), -1.0)?, Some(ball(0.0, -1.0)));
    assert_eq!(
        find(Event::wall(floor).by_steps(), -1.0)?,
        Some(ball(0.0, -1.0))
    );
    // At rest on it.
    let rest = Error::EventsAccumulate {
        time: 0.0,
        index: 0,
        count: 0,
    };
    assert_eq!(find(Event::wall(floor), 0.0), Err(rest));
    assert_eq!(find(Event::falling(floor), 0.0)?, None);
    // From below there is no way through a wall but up.
    let mut below = Integrator::new(StoermerVerlet, falling_ball(), ball(-1.0, 1.0), 0.5)?;
    assert_eq!(
        below.find_event(2.0, &Event::wall(height))?,
        Some(ball(-1.0, 1.0))
    );
    assert_eq!(below.state(), &ball(-1.0, 1.0));
    // Without a force it rests on the wall as long as it likes.
    let free = acceleration::<Vector1<f64>, _>(|_, _, acceleration| acceleration[0] = 0.0);
    let mut free = Integrator::new(StoermerVerlet, free, ball(0.0, 0.0), 0.5)?;
    assert_eq!(free.find_event(2.0, &Event::wall(height))?, None);
    Ok(())
}

/// A perfectly inelastic impact leaves the ball at rest.
#[test]
fn a_ball_that_stays_down_rests() -> Result<(), Error> {
    let floor: fn(&Ball) -> f64 = height;
    // By steps, flights of 1e-9 are resolved: they end by their number.
    for (event, most) in [(Event::falling(floor), 20), (Event::wall(floor), 1001)] {
        let (times, ended, last) = bounces(&event, ball(1.0, 0.0), 0.0, 0.1)?;
        let fall = (2.0 / GRAVITY).sqrt();
        assert!((times[0] - fall).abs() < 1e-15, "{}", times[0] - fall);
        assert!(times.len() < most, "{} impacts", times.len());
        assert!(
            matches!(ended, Err(Error::EventsAccumulate { .. })),
            "{ended:?}"
        );
        assert!(height(&last) >= 0.0 && (last.time - fall).abs() < 1e-7);
    }
    Ok(())
}

/// A handler that does not turn the state at a wall is stopped, and the state is not behind it.
#[test]
fn a_handler_that_does_not_reflect_at_a_wall_ends_the_run() -> Result<(), Error> {
    let mut integrator = Integrator::new(StoermerVerlet, falling_ball(), ball(1.0, 0.0), 0.1)?;
    let mut count = 0;
    let event = Event::wall(height);
    let ended = integrator.integrate_with_events(2.0, &event, |_| {
        count += 1;
        ControlFlow::<()>::Continue(())
    });
    assert!(
        matches!(ended, Err(Error::EventsAccumulate { count: 1000, .. })),
        "{ended:?}"
    );
    assert_eq!(count, 1000);
    assert!(height(integrator.state()) >= 0.0);
    // Broken at a wall it is at the event, at others after the step.
    for (event, at_event) in [
        (Event::wall(floor_of(0.0)), true),
        (Event::falling(floor_of(0.0)), false),
    ] {
        integrator.set_state(ball(1.0, 0.0))?;
        let found = integrator.find_event(2.0, &event)?.expect("an impact");
        assert_eq!(integrator.state() == &found, at_event);
    }
    Ok(())
}

fn floor_of(level: f64) -> impl Fn(&Ball) -> f64 + Copy {
    move |ball: &Ball| ball.q[0] - level
}

/// On through the event after a kick: it is not found again.
#[test]
fn events_that_go_on_are_not_found_again() -> Result<(), Error> {
    fn check<M: Method>(method: M, offset: f64) -> Result<(), Error> {
        let oscillator = acceleration::<Vector1<f64>, _>(move |_, q, acceleration| {
            acceleration[0] = offset - q[0];
        });
        let start = ball(offset + 1.0, 0.0);
        let mut integrator = Integrator::new(method, oscillator, start, 0.1)?;
        for event in [
            Event::falling(floor_of(offset)),
            Event::falling(floor_of(offset)).by_steps(),
        ] {
            let mut times = Vec::new();
            for _ in 0..4 {
                let mut state = integrator.find_event(1e3, &event)?.expect("an event");
                times.push(state.time);
                state.p *= 1.25;
                integrator.set_state(state)?;
            }
            // A period apart, as the method has it.
            for pair in times.windows(2) {
                assert!(
                    (pair[1] - pair[0] - std::f64::consts::TAU).abs() < 0.01,
                    "{times:?}"
                );
            }
        }
        Ok(())
    }
    check(StoermerVerlet, 0.0)?;
    check(StoermerVerlet, 1000.0)?;
    check(Gauss2, 1000.0)
}

/// Curved floors, functions with rounding of their own: every run ends, and never below the floor.
#[test]
fn accumulating_impacts_end_on_any_floor() -> Result<(), Error> {
    let floors: [(Floor, [f64; 2]); 4] = [
        (|point| point.q[1] - 100.0, [0.0, 120.0]),
        (|point| 10.0 - point.q.norm(), [1.0, 0.0]),
        (|point| point.q[1] - 0.3 * point.q[0].sin(), [0.3, 3.0]),
        (|point| point.q.norm_squared() - 1e4, [0.0, 110.0]),
    ];
    for (floor, start) in floors {
        for kept in [0.3, 0.7] {
            for event in [
                Event::wall(floor),
                Event::wall(floor).by_steps(),
                Event::falling(floor),
            ] {
                let ball = acceleration::<Vector2<f64>, _>(|_, _, acceleration| {
                    *acceleration = Vector2::new(0.0, -GRAVITY);
                });
                let start = State::from_arrays(0.0, start, [0.0, 0.0]);
                let mut integrator = Integrator::new(Gauss2, ball, start, 0.05)?;
                let mut count = 0;
                let ended = loop {
                    count += 1;
                    assert!(count < 1000, "no end");
                    match integrator.find_event(100.0, &event) {
                        Ok(Some(mut state)) => {
                            assert!(floor(&state) >= 0.0);
                            let normal = gradient(floor, &state);
                            state.p -= normal * ((1.0 + kept) * state.p.dot(&normal));
                            integrator.set_state(state)?;
                        }
                        other => break other,
                    }
                };
                assert!(
                    matches!(ended, Err(Error::EventsAccumulate { .. })),
                    "{ended:?}"
                );
                assert!(floor(integrator.state()) >= 0.0 && count > 10);
            }
        }
    }
    Ok(())
}

fn gradient(function: Floor, state: &Point) -> Vector2<f64> {
    let slope = |way: Vector2<f64>| {
        let at = |q| function(&State { q, ..state.clone() });
        at(state.q + way) - at(state.q - way)
    };
    Vector2::new(slope(Vector2::x() * 1e-5), slope(Vector2::y() * 1e-5)).normalize()
}

/// Two balls in a box, without gravity: every wall and every impact of the two, in their order.
#[test]
fn impacts_on_several_walls_come_in_order() -> Result<(), Error> {
    let free =
        acceleration::<Vector2<f64>, _>(|_, _, acceleration| *acceleration = Vector2::zeros());
    // At the walls −1 and 1 both at the time 2/3, in the middle both at 5/3, and so on.
    let start: Point = State::from_arrays(0.0, [-1.0 / 3.0, 1.0 / 3.0], [-1.0, 1.0]);
    let mut integrator = Integrator::new(StoermerVerlet, free, start, 10.0)?;
    let walls: [Event<Floor>; 3] = [
        Event::wall(|point| point.q[0] + 1.0),
        Event::wall(|point| 1.0 - point.q[1]),
        Event::wall(|point| point.q[1] - point.q[0]),
    ];
    let mut found = Vec::new();
    integrator.integrate_through(6.0, &[], &walls, |moment| {
        if let Moment::Event { index, state } = moment {
            found.push((index, state.time));
            match index {
                2 => state.p.swap_rows(0, 1),
                _ => state.p[index] = -state.p[index],
            }
        }
        ControlFlow::<()>::Continue(())
    })?;
    let indices: Vec<usize> = found.iter().map(|event| event.0).collect();
    assert_eq!(indices, [0, 1, 2, 0, 1, 2, 0, 1, 2]);
    for (event, expected) in found.iter().zip([2, 2, 5, 8, 8, 11, 14, 14, 17]) {
        assert!((event.1 - f64::from(expected) / 3.0).abs() < 1e-14);
    }
    let end = State::from_arrays(6.0, [-1.0 / 3.0, 1.0 / 3.0], [-1.0, 1.0]);
    assert!((integrator.state().q - end.q).norm() < 1e-13 && integrator.state().p == end.p);
    Ok(())
}

/// A body that rests on the floor, whose handler reflects it: its flights are rounding errors, and the search ends soon.
#[test]
fn a_reflected_body_at_rest_ends_the_search() -> Result<(), Error> {
    fn rest<M: Method + Copy + ProvedFor<Separable>>(
        method: M,
        step_size: f64,
        gravity: f64,
    ) -> Result<(), Error> {
        let falling = || {
            acceleration::<Vector1<f64>, _>(move |_, _, acceleration| acceleration[0] = -gravity)
        };
        for event in [
            Event::wall(height as fn(&Ball) -> f64),
            Event::wall(height as fn(&Ball) -> f64).by_steps(),
        ] {
            let mut integrator = Integrator::new(method, falling(), ball(0.0, 0.0), step_size)?;
            let mut count = 0;
            let ended = integrator.integrate_through(10.0, &[], &event, |moment| {
                if let Moment::Event { state, .. } = moment {
                    state.p[0] = -state.p[0];
                    count += 1;
                }
                ControlFlow::<()>::Continue(())
            });
            assert!(
                matches!(ended, Err(Error::EventsAccumulate { .. })) && count <= 1000,
                "{step_size} {gravity} {count} {ended:?}"
            );
        }
        Ok(())
    }
    for step_size in [1e-3, 5e-3, 0.1] {
        for gravity in [1.0, 9.81] {
            rest(StoermerVerlet, step_size, gravity)?;
            rest(Gauss5, step_size, gravity)?;
        }
    }
    Ok(())
}

/// A thousand impacts in every step, and crossings that are even closer, are no rest.
#[test]
fn many_events_in_a_step_are_found() -> Result<(), Error> {
    let free = || acceleration::<Vector1<f64>, _>(|_, _, acceleration| acceleration[0] = 0.0);
    let mut integrator = Integrator::new(StoermerVerlet, free(), ball(5e-4, 1.0), 1.0)?;
    type Wall = Event<fn(&Ball) -> f64>;
    let walls: [Wall; 2] = [
        Event::wall(height),
        Event::wall(|ball: &Ball| 1e-3 - ball.q[0]),
    ];
    let mut count = 0;
    integrator.integrate_through(3.0, &[], &walls, |moment| {
        if let Moment::Event { state, .. } = moment {
            state.p[0] = -state.p[0];
            count += 1;
        }
        ControlFlow::<()>::Continue(())
    })?;
    assert_eq!(count, 3000);
    let often = Event::crossing(|ball: &Ball| (ball.time * 2e4 * std::f64::consts::PI + 0.5).sin());
    let mut crossings = 0;
    let mut integrator = Integrator::new(StoermerVerlet, free(), ball(0.0, 1.0), 1.0)?;
    integrator.integrate_with_events(1.0, &often.samples(100_000), |_| {
        crossings += 1;
        ControlFlow::<()>::Continue(())
    })?;
    assert_eq!(crossings, 20_000);
    Ok(())
}

/// A start behind a wall is named so if the handler does not move it out.
#[test]
fn a_start_behind_a_wall_is_named() -> Result<(), Error> {
    for velocity in [-1.0, 0.0, 1.0] {
        let start = ball(-0.5, velocity);
        let mut integrator = Integrator::new(StoermerVerlet, falling_ball(), start.clone(), 0.1)?;
        let ended = integrator.integrate_through(2.0, &[], &Event::wall(height), |moment| {
            if let Moment::Event { state, .. } = moment {
                state.p[0] = -state.p[0];
            }
            ControlFlow::<()>::Continue(())
        });
        let (time, index, value) = (0.0, 0, -0.5);
        assert_eq!(ended, Err(Error::BehindWall { time, index, value }));
        // A handler that moves the state out goes on.
        let mut integrator = Integrator::new(StoermerVerlet, falling_ball(), start, 0.1)?;
        let mut count = 0;
        integrator.integrate_through(0.1, &[], &Event::wall(height), |moment| {
            if let Moment::Event { state, .. } = moment {
                state.q[0] = 0.5;
                count += 1;
            }
            ControlFlow::<()>::Continue(())
        })?;
        assert_eq!(count, 1);
    }
    Ok(())
}

/// A bounce changes the energy by no more than the error of a step: H = p²/2 + x²/2 + x⁴/4 between a wall and the potential.
#[test]
fn bounces_keep_the_energy() -> Result<(), Error> {
    let quartic = acceleration::<Vector1<f64>, _>(|_, q, force| force[0] = -q[0] - q[0].powi(3));
    let energy = |state: &Ball| {
        let (q, p) = (state.q[0], state.p[0]);
        p * p / 2.0 + q * q / 2.0 + q.powi(4) / 4.0
    };
    let mut run = Integrator::new(Gauss4, quartic, ball(1.0, 0.0), 0.1)?;
    let before = energy(run.state());
    let wall = Event::wall(|state: &Ball| state.q[0] + 0.5);
    for _ in 0..300 {
        let mut state = run.find_event(1e9, &wall)?.expect("an impact");
        state.p = -state.p;
        run.set_state(state)?;
    }
    let change = (energy(run.state()) - before).abs();
    assert!(change < 1e-11, "{change:e}");
    Ok(())
}
