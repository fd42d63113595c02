//! Short excursions beyond zero: found for certain, found at a low price, and none where there is none.

use std::cell::Cell;
use std::f64::consts::TAU;
use std::ops::ControlFlow;

use crate::common::methods::{
    ForestRuth, Gauss2, Gauss4, Gauss6, Gauss8, Lobatto4, StoermerVerlet, Yoshida6,
};
use crate::common::systems::{Kepler, perihelion};
use symplectic::nalgebra::{Vector1, Vector2};
use symplectic::solver::ByNewton;
use symplectic::{Error, Event, Integrator, Method, State, acceleration};

type Point = State<Vector1<f64>>;

/// The levels that `cos t` exceeds by 1e-2, …, 1e-5: for 0.28, …, 0.009 of time.
const LEVELS: [f64; 4] = [0.99, 0.999, 0.9999, 0.99999];

/// The times up to 200 at which `cos t` is at a level: 2πk ± acos(level).
fn expected(level: f64) -> Vec<f64> {
    let half = level.acos();
    let times = (0..32).flat_map(|k| [-half, half].map(|by| TAU * f64::from(k) + by));
    times.filter(|time| (0.0..200.0).contains(time)).collect()
}

/// The times up to 200 at which the oscillation from 1 is at a level.
fn found<M: Method>(method: M, step_size: f64, level: f64, by_steps: bool) -> Vec<f64> {
    let oscillator = acceleration::<Vector1<f64>, _>(|_, q, acceleration| *acceleration = -q);
    let start = State::from_arrays(0.0, [1.0], [0.0]);
    let mut run = Integrator::new(method, oscillator, start, step_size).expect("a good start");
    let mut event = Event::crossing(|state: &Point| state.q[0] - level);
    if by_steps {
        event = event.by_steps();
    }
    let mut times = Vec::new();
    let ended = run.integrate_with_events(200.0, &event, |state| {
        times.push(state.time);
        ControlFlow::<()>::Continue(())
    });
    ended.expect("good steps");
    times
}

/// Checks that all crossings are found, up to an error of the phase; those of every other level by steps.
fn finds_all<M: Method + Copy>(method: M, sizes: &[f64], levels: &[f64], phase: f64) {
    for &size in sizes {
        for (&level, by_steps) in levels.iter().zip([false, true].into_iter().cycle()) {
            let (found, expected) = (found(method, size, level, by_steps), expected(level));
            let what = format!("{} {size} {level} {by_steps}", M::NAME);
            assert_eq!(found.len(), expected.len(), "{what}");
            // The interpolation is less accurate than the method.
            let bound = if by_steps { phase } else { phase + 1e-2 };
            for (found, expected) in found.iter().zip(&expected) {
                assert!(
                    (found - expected).abs() < bound,
                    "{what} {found} {expected}"
                );
            }
        }
    }
}

/// Gauss methods keep q² + p², so their orbits reach every level; the error of their phase at 200 is the bound.
#[test]
#[ignore = "thorough"]
fn gauss_finds_all_shallow_crossings_in_large_steps() {
    assert_eq!(expected(0.999).len(), 63);
    finds_all(Gauss4, &[1.0, 0.5, 0.25], &LEVELS, 1e-4);
    finds_all(Gauss8, &[3.0, 1.0], &LEVELS, 1e-4);
    finds_all(Gauss2, &[0.25], &LEVELS, 0.1);
}

/// The number of sweeps of Newton's iteration does not tell that a step is long. From 0.467 of the period on, such steps can be passed over:
/// 1 − sin h > 4 sin h.
#[test]
#[ignore = "thorough"]
fn newton_steps_of_almost_half_a_period_find_all_shallow_crossings() -> Result<(), Error> {
    for size in [2.0, 2.5, 0.45 * TAU] {
        for level in LEVELS {
            let oscillator =
                acceleration::<Vector1<f64>, _>(|_, q, acceleration| *acceleration = -q);
            let start = State::from_arrays(0.0, [1.0], [0.0]);
            let mut run = Integrator::new(Gauss8, oscillator, start, size)?.by_newton();
            let event = Event::crossing(|state: &Point| state.q[0] - level);
            let mut count = 0;
            run.integrate_with_events(200.0, &event, |_| {
                count += 1;
                ControlFlow::<()>::Continue(())
            })?;
            assert_eq!(count, expected(level).len(), "{size} {level}");
        }
    }
    Ok(())
}

/// The turning points of other methods vary from period to period by their error, which is smaller than these excursions.
#[test]
fn other_methods_find_all_shallow_crossings_that_they_resolve() {
    finds_all(Lobatto4, &[1.0, 0.25], &LEVELS[..3], 1e-2);
    finds_all(ForestRuth, &[0.25], &LEVELS, 0.1);
    finds_all(Yoshida6, &[0.25], &LEVELS, 0.1);
    finds_all(Gauss6, &[1.0, 0.5], &LEVELS[..3], 0.1);
    finds_all(StoermerVerlet, &[0.03125], &LEVELS, 0.1);
}

/// The orbit of a Gauss method stays within the unit circle, and the interpolation does not.
#[test]
fn excursions_of_the_interpolation_alone_are_not_events() {
    for size in [2.0, 1.0, 0.5] {
        for level in [1.0 + 1e-9, 1.00001] {
            assert!(found(Gauss4, size, level, false).is_empty());
            assert!(found(Gauss2, size, level, true).is_empty());
            assert!(found(Gauss8, size, level, false).is_empty());
        }
    }
}

/// A conserved quantity beside zero: the interpolation varies by more than its value.
#[test]
fn a_conserved_quantity_does_not_cross_zero() -> Result<(), Error> {
    for offset in [1e-4, -1e-6, 1e-9] {
        let oscillator = acceleration::<Vector1<f64>, _>(|_, q, acceleration| *acceleration = -q);
        let start = State::from_arrays(0.0, [1.0], [0.0]);
        let mut run = Integrator::new(Gauss4, oscillator, start, 1.0)?;
        let radius = move |state: &Point| state.q[0].hypot(state.p[0]) - 1.0 + offset;
        assert_eq!(run.find_event(20.0, &Event::crossing(radius))?, None);
    }
    Ok(())
}

/// At the highest point of an excursion the wall is reached, whatever the interpolation.
#[test]
fn a_wall_stops_a_shallow_excursion() -> Result<(), Error> {
    for (level, size) in [(0.999, 1.0), (0.9999, 0.5), (0.99999, 0.25)] {
        let oscillator = acceleration::<Vector1<f64>, _>(|_, q, acceleration| *acceleration = -q);
        let start = State::from_arrays(0.0, [-1.0], [0.0]);
        let mut run = Integrator::new(Gauss4, oscillator, start, size)?;
        let wall = Event::wall(|state: &Point| level - state.q[0]);
        let state = run
            .find_event(20.0, &wall)?
            .expect("the first turning point");
        assert!(state.q[0] <= level && (state.time - (TAU / 2.0 - level.acos())).abs() < 1e-5);
    }
    Ok(())
}

/// A function far from zero is evaluated once in a step, and the steps have the bits of a run without it.
#[test]
fn an_event_far_away_is_evaluated_once_in_a_step() -> Result<(), Error> {
    fn check<M: Method + Copy>(method: M) -> Result<(), Error> {
        let (mut seen, mut unseen) = (
            Integrator::new(method, Kepler, perihelion(), 0.05)?,
            Integrator::new(method, Kepler, perihelion(), 0.05)?,
        );
        let calls = Cell::new(0_u64);
        let event = Event::rising(|state: &State<Vector2<f64>>| {
            calls.set(calls.get() + 1);
            state.q[1] - 100.0
        });
        assert_eq!(seen.find_event(100.0, &event)?, None);
        assert_eq!(unseen.integrate_to(100.0)?, seen.state());
        assert_eq!(unseen.statistics(), seen.statistics());
        // The first step is sampled.
        assert!(calls.get() <= seen.steps() + 20, "{}", calls.get());
        Ok(())
    }
    check(StoermerVerlet)?;
    check(Gauss4)?;
    check(Gauss8)?;
    check(ForestRuth)
}
