//! Output at given times, events, progress, observers.

use std::cell::Cell;
use std::f64::consts::TAU;
use std::ops::ControlFlow;

use crate::common::distance;
use crate::common::methods::{Gauss2, Gauss4, Gauss8, StoermerVerlet};
use crate::common::systems::{Kepler, perihelion};
use symplectic::nalgebra::{DVector, Vector1, Vector2, Vector4};
use symplectic::output::unit_of;
use symplectic::{
    Error, Event, Integrator, Invariant, Method, Retry, SeparableHamiltonian, State, acceleration,
};

type Point = State<Vector2<f64>>;

/// Positive on the way out.
fn outward(state: &Point) -> f64 {
    state.q.dot(&state.p)
}

fn go_on(_state: &Point) -> ControlFlow<()> {
    ControlFlow::Continue(())
}

#[test]
fn output_leaves_the_steps_as_they_are() -> Result<(), Error> {
    let mut by_steps = Integrator::new(Gauss8, Kepler, perihelion(), 0.125)?;
    let mut at_times = Integrator::new(Gauss8, Kepler, perihelion(), 0.125)?;
    let mut output = Vec::new();
    let times = [0.0, 0.0, 0.06, 0.125, 0.2, 0.21, 1.0, 1.3];
    at_times.integrate_at(&times, |state| output.push(state.clone()))?;
    let found: Vec<f64> = output.iter().map(|state| state.time).collect();
    assert_eq!(found, times);
    assert_eq!((&output[0], &output[1]), (&perihelion(), &perihelion()));
    assert_eq!(&output[3], by_steps.step()?);
    let after_eight = by_steps.states().every(7).next().expect("endless")?;
    assert_eq!(output[6], after_eight);
    by_steps.states().every(3).next().expect("endless")?;
    assert_eq!(at_times.state(), by_steps.state());
    assert_eq!((at_times.steps(), at_times.state().time), (11, 1.375));
    for state in &output {
        // Order 9 in steps of 1/8, near the perihelion.
        let mut fine = Integrator::new(Gauss8, Kepler, perihelion(), 0.02)?;
        assert!(distance(state, fine.integrate_to(state.time)?) < 2e-8);
    }
    // The last step is still there for the next times, also those that have been asked for already.
    at_times.integrate_at(&[1.3, 1.4], |state| output.push(state.clone()))?;
    assert_eq!(output[8], output[7]);
    assert_eq!((at_times.steps(), output.len()), (12, 10));
    Ok(())
}

#[test]
fn output_goes_backward() -> Result<(), Error> {
    let mut integrator = Integrator::new(Gauss2, Kepler, perihelion(), -0.01)?;
    let mut output = Vec::new();
    integrator.integrate_at(&[-0.005, -0.1, -0.105], |state| output.push(state.clone()))?;
    let mirrored = |state: &Point| State::new(-state.time, state.q, -state.p);
    let mut forward = Integrator::new(Gauss2, Kepler, mirrored(&perihelion()), 0.01)?;
    let mut number = 0;
    forward.integrate_at(&[0.005, 0.1, 0.105], |state| {
        assert!(distance(&mirrored(state), &output[number]) < 1e-13);
        number += 1;
    })?;
    assert_eq!(number, 3);
    Ok(())
}

/// Steps between output times far apart are taken in blocks, with the same bits.
#[test]
fn output_far_apart_has_the_bits_of_output_in_every_step() -> Result<(), Error> {
    fn check<M: Method + Copy>(method: M, size: f64) -> Result<(), Error> {
        let run = || {
            let kepler = acceleration::<DVector<f64>, _>(|_, q: &DVector<f64>, acceleration| {
                acceleration.copy_from(&(q * -q.norm().powi(-3)));
            });
            let start = State::new(
                0.0,
                DVector::from_vec(vec![0.4, 0.0]),
                DVector::from_vec(vec![0.0, 2.0]),
            );
            Integrator::new(method, kepler, start, size)
        };
        let rare: Vec<f64> = (1..8)
            .map(|k| 3.333 * f64::from(k) * size.signum())
            .collect();
        let mut all: Vec<f64> = (1..560).map(|k| size * (f64::from(k) - 0.25)).collect();
        all.extend(&rare);
        all.sort_by(|a, b| (a * size).total_cmp(&(b * size)));
        let (mut a_few, mut each) = (run()?, run()?);
        let (mut few, mut many) = (Vec::new(), Vec::new());
        a_few.integrate_at(&rare, |state| few.push(state.clone()))?;
        each.integrate_at(&all, |state| {
            if rare.contains(&state.time) {
                many.push(state.clone());
            }
        })?;
        assert_eq!(few, many);
        assert_eq!(a_few.steps() as f64, (rare[6] / size).ceil());
        Ok(())
    }
    check(StoermerVerlet, 0.05)?;
    check(Gauss4, -0.05)
}

#[test]
fn bad_output_times_take_no_step() -> Result<(), Error> {
    let mut integrator = Integrator::new(Gauss2, Kepler, perihelion(), 0.1)?;
    for (times, time, before) in [
        (&[0.1, 0.05][..], 0.05, 0.1),
        (&[-0.1], -0.1, 0.0),
        (&[0.1, f64::INFINITY], f64::INFINITY, 0.1),
    ] {
        let outcome = integrator.integrate_at(times, |_| panic!("no output"));
        assert_eq!(outcome, Err(Error::OutputTime { time, before }));
    }
    let outcome = integrator.integrate_at(&[f64::NAN], |_| {});
    assert!(matches!(outcome, Err(Error::OutputTime { time, .. }) if time.is_nan()));
    let outcome = integrator.integrate_at(&[1e300], |_| {});
    assert!(matches!(outcome, Err(Error::StepCount { .. })));
    assert_eq!(integrator.steps(), 0);
    Ok(())
}

/// The perihelia are at the times 2πk.
#[test]
fn events_have_the_order_of_the_step_or_of_the_dense_output() -> Result<(), Error> {
    let mut errors = Vec::new();
    for event in [Event::rising(outward), Event::rising(outward).by_steps()] {
        let mut integrator = Integrator::new(Gauss8, Kepler, perihelion(), 0.1)?;
        let (mut count, mut largest) = (0, 0.0_f64);
        integrator.integrate_with_events(20.0, &event, |state| {
            count += 1;
            largest = largest.max((state.time - f64::from(count) * TAU).abs());
            largest = largest.max(distance(state, &perihelion()));
            go_on(state)
        })?;
        assert_eq!((count, integrator.state().time), (3, 20.0));
        errors.push(largest);
    }
    // Order 9 between the steps, 16 of the steps.
    assert!(errors[0] < 1e-6 && errors[0] > 1e-11, "{errors:?}");
    assert!(errors[1] < 1e-11, "{errors:?}");
    Ok(())
}

#[test]
fn events_of_each_direction_are_found_forward_and_backward() -> Result<(), Error> {
    let times = |event: Event<fn(&Point) -> f64>, step_size: f64| {
        let mut integrator = Integrator::new(Gauss8, Kepler, perihelion(), step_size)?;
        let mut times = Vec::new();
        let end = 14.0_f64.copysign(step_size);
        integrator.integrate_with_events(end, &event, |state| {
            times.push((state.time / (TAU / 2.0)).round());
            go_on(state)
        })?;
        Ok::<_, Error>(times)
    };
    assert_eq!(times(Event::rising(outward), 0.1)?, [2.0, 4.0]);
    assert_eq!(times(Event::falling(outward), 0.1)?, [1.0, 3.0]);
    assert_eq!(times(Event::crossing(outward), 0.1)?, [1.0, 2.0, 3.0, 4.0]);
    // Backward it falls at the perihelion.
    assert_eq!(times(Event::falling(outward), -0.1)?, [-2.0, -4.0]);
    Ok(())
}

/// sin 20t has three zeros in a step of 1/2.
#[test]
fn several_events_in_a_step() -> Result<(), Error> {
    let count = |samples: u32| {
        let mut integrator = Integrator::new(StoermerVerlet, Kepler, perihelion(), 0.5)?;
        let event = Event::crossing(|state: &Point| (20.0 * state.time).sin()).samples(samples);
        let mut times = Vec::new();
        integrator.integrate_with_events(1.0, &event, |state| {
            times.push(state.time);
            go_on(state)
        })?;
        assert!(times.windows(2).all(|pair| pair[0] < pair[1]));
        for time in &times {
            let zero = (time * 20.0 / (TAU / 2.0)).round() * (TAU / 2.0) / 20.0;
            assert!((time - zero).abs() < 1e-15, "{time}");
        }
        Ok::<_, Error>(times.len())
    };
    // Zeros at kπ/20: 6 in (0, 1].
    assert_eq!((count(8)?, count(4)?), (6, 6));
    // What is documented to be missed.
    assert!(count(1)? < 6);
    Ok(())
}

#[test]
fn a_zero_at_a_sample_is_a_single_event() -> Result<(), Error> {
    let mut integrator = Integrator::new(Gauss2, Kepler, perihelion(), 0.25)?;
    let mut times = Vec::new();
    let event = Event::crossing(|state: &Point| state.time - 0.5);
    integrator.integrate_with_events(1.0, &event, |state| {
        times.push(state.time);
        go_on(state)
    })?;
    assert_eq!(times, [0.5]);
    // The start is no event, a zero for a while is one.
    let event = Event::crossing(|state: &Point| if state.time < 1.25 { 0.0 } else { -1.0 });
    assert_eq!(integrator.find_event(2.0, &event)?, None);
    let event = Event::falling(|state: &Point| (2.5 - state.time).max(0.0));
    let found = integrator.find_event(3.0, &event)?.expect("an event");
    assert_eq!((found.time, integrator.state().time), (2.5, 2.5));
    Ok(())
}

#[test]
fn a_nan_event_is_an_error_and_a_search_can_be_stopped() -> Result<(), Error> {
    let mut integrator = Integrator::new(Gauss2, Kepler, perihelion(), 0.25)?;
    let event = Event::crossing(|state: &Point| (0.6 - state.time).sqrt());
    let error = integrator
        .find_event(1.0, &event)
        .expect_err("not a number");
    assert!(matches!(error, Error::EventValue { time } if time > 0.6 && time <= 0.75));
    integrator.set_state(perihelion())?;
    let seen = Cell::new(0);
    let event = Event::crossing(|state: &Point| (20.0 * state.time).sin()).samples(8);
    let stopped = integrator.integrate_with_events(1.0, &event, |state| {
        seen.set(seen.get() + 1);
        ControlFlow::Break(state.time)
    })?;
    assert!(stopped.is_some_and(|time| (time - TAU / 40.0).abs() < 1e-15));
    assert_eq!((seen.get(), integrator.state().time), (1, 0.25));
    // On from there in steps of the same clock.
    assert_eq!(integrator.step()?.time, 0.5);
    Ok(())
}

/// Steps that are taken in parts are looked at in parts: before the last one of them is no time of the last step.
#[test]
fn parts_of_steps_have_an_inside_too() -> Result<(), Error> {
    let run = || {
        // Near the perihelion more sweeps are needed.
        let mut integrator = Integrator::new(Gauss8, Kepler, perihelion(), 0.8)?;
        integrator.set_max_iterations(12);
        integrator.set_retry(Retry::Split { halvings: 5 });
        Ok::<_, Error>(integrator)
    };
    let (mut plain, mut at_times) = (run()?, run()?);
    for _ in 0..10 {
        plain.step()?;
    }
    assert!(plain.statistics().rejected > 0);
    let times: Vec<f64> = (0..=400).map(|k| f64::from(k) * 0.02).collect();
    let mut fine = Integrator::new(Gauss8, Kepler, perihelion(), 0.02)?;
    let (mut count, mut largest) = (0, 0.0_f64);
    at_times.integrate_at(&times, |state| {
        count += 1;
        let reference = fine.integrate_to(state.time).expect("a good step");
        largest = largest.max(distance(state, reference));
    })?;
    assert_eq!((count, at_times.state()), (401, plain.state()));
    assert_eq!(at_times.statistics(), plain.statistics());
    assert!(largest < 1e-3, "{largest:e}");
    let found = run()?.find_event(7.0, &Event::rising(outward))?;
    assert!(found.is_some_and(|state| (state.time - TAU).abs() < 1e-4));
    Ok(())
}

#[test]
fn progress_is_reported_and_can_be_stopped() -> Result<(), Error> {
    let mut integrator = Integrator::new(Gauss2, Kepler, perihelion(), 0.1)?;
    let mut fractions = Vec::new();
    let ended = integrator.integrate_while(0.5, |progress| {
        assert_eq!(progress.statistics.steps, progress.step);
        fractions.push(progress.fraction());
        ControlFlow::<()>::Continue(())
    })?;
    assert_eq!(ended, None);
    assert_eq!(fractions, [0.2, 0.4, 0.6, 0.8, 1.0]);
    let stopped = integrator.integrate_while(1.0, |progress| {
        if progress.step == 2 {
            ControlFlow::Break("enough")
        } else {
            ControlFlow::Continue(())
        }
    })?;
    assert_eq!(stopped, Some("enough"));
    assert_eq!(integrator.state().time, 0.7);
    Ok(())
}

#[test]
fn observers_keep_the_largest_deviation() -> Result<(), Error> {
    let start = perihelion();
    let mut energy = Invariant::energy(Kepler, &start);
    let mut angular_momentum = Invariant::new(|state: &Point| state.q.perp(&state.p), &start);
    let mut integrator = Integrator::new(StoermerVerlet, Kepler, start, 0.01)?;
    let mut largest = 0.0_f64;
    integrator.integrate_with(10.0, |state| {
        energy.observe(state);
        angular_momentum.observe(state);
        let now = Kepler.energy(0.0, &state.q, &state.p).expect("an energy");
        largest = largest.max((now + 0.5).abs());
    })?;
    assert_eq!((energy.initial(), energy.deviation()), (-0.5, largest));
    assert_eq!(energy.relative_deviation(), 2.0 * largest);
    assert_eq!(Some(energy.last()), integrator.energy());
    assert!(angular_momentum.relative_deviation() < 1e-14);
    // From 0 the deviation itself.
    let mut angle = Invariant::new(|state: &Point| state.q.y, &perihelion());
    angle.observe(&perihelion());
    assert_eq!(
        (angle.relative_deviation(), angle.relative_error()),
        (0.0, 0.0)
    );
    angle.observe(&State {
        q: Vector2::new(0.0, -0.5),
        ..perihelion()
    });
    assert_eq!(
        (angle.relative_deviation(), angle.relative_error()),
        (0.5, -0.5)
    );
    // A light ray along any axis: H is 0, and its terms are not.
    type Ray = State<Vector4<f64>>;
    let ray = |axis: usize| {
        let (mut p, x) = ([1e10, 0.0, 0.0, 0.0], [1.0, 2.0, 3.0, 4.0]);
        p[axis] = 1e10;
        State::from_arrays(0.0, x, p)
    };
    for axis in 1..4 {
        let metric = |ray: &Ray| ray.p.norm_squared() / 2.0 - ray.p[0] * ray.p[0];
        assert!(unit_of(metric, &ray(axis)) > 1e18, "{axis}");
    }
    // A parabola of singles: H is the rounding of the velocity.
    let energy = |state: &State<Vector1<f32>>| {
        f64::from(state.p[0]).powi(2) / 2.0 - f64::from(state.q[0]).recip()
    };
    let escape = State::from_arrays(0.0, [7.0], [(2.0_f32 / 7.0).sqrt()]);
    assert!(energy(&escape) != 0.0 && unit_of(energy, &escape) > 0.01);
    // Not a number once is not a number.
    let mut broken = Invariant::new(|state: &Point| (0.5 - state.time).sqrt(), &perihelion());
    for time in [0.0, 1.0, 0.0] {
        broken.observe(&State {
            time,
            ..perihelion()
        });
    }
    assert!(broken.deviation().is_nan() && broken.last() > 0.0);
    Ok(())
}

#[test]
fn slices_of_different_length_are_refused_as_a_state() {
    let wrong = State::<Vector1<f64>>::from_slices(0.0, &[1.0], &[]);
    assert_eq!(
        wrong,
        Err(Error::Dimension {
            position: 1,
            momentum: 0
        })
    );
}
