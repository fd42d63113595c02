//! The zeros that are found, against the closed form.

use std::f64::consts::TAU;
use std::ops::ControlFlow;

use crate::common::methods::Gauss4;
use proptest::prelude::*;
use symplectic::nalgebra::Vector1;
use symplectic::output::Moment;
use symplectic::{Error, Event, Integrator, State, acceleration};

type Point = State<Vector1<f64>>;

/// The motion `q(t) = k (t − r1)(t − r2)(t − r3)`.
#[derive(Clone, Copy, Debug)]
struct Cubic {
    factor: f64,
    roots: [f64; 3],
}

impl Cubic {
    /// By powers of the time.
    fn coefficients(self) -> [f64; 4] {
        let Self {
            factor,
            roots: [a, b, c],
        } = self;
        [-a * b * c, a * b + b * c + c * a, -(a + b + c), 1.0].map(|value| factor * value)
    }

    fn at(self, time: f64) -> Point {
        let [c0, c1, c2, c3] = self.coefficients();
        let q = c0 + time * (c1 + time * (c2 + time * c3));
        let p = c1 + time * (2.0 * c2 + 3.0 * c3 * time);
        State::from_arrays(time, [q], [p])
    }

    /// The times of the extrema.
    fn extrema(self) -> [f64; 2] {
        let [_, c1, c2, c3] = self.coefficients();
        let root = (c2 * c2 - 3.0 * c1 * c3).max(0.0).sqrt();
        [-1.0, 1.0].map(|sign| (-c2 + sign * root) / (3.0 * c3))
    }

    /// Its events from one time to another, with the direction.
    fn events(self, from: f64, to: f64, step_size: f64, by_steps: bool) -> Vec<(usize, f64)> {
        let [_, _, c2, c3] = self.coefficients();
        let motion = acceleration::<Vector1<f64>, _>(move |time, _, acceleration| {
            acceleration[0] = 2.0 * c2 + 6.0 * c3 * time;
        });
        let mut integrator =
            Integrator::new(Gauss4, motion, self.at(from), step_size).expect("a good start");
        let mut events = [Event::falling(position), Event::rising(position)];
        if by_steps {
            events = events.map(Event::by_steps);
        }
        let mut found = Vec::new();
        let ended = integrator.integrate_through(to, &[], &events, |moment| {
            if let Moment::Event { index, state } = moment {
                found.push((index, state.time));
            }
            ControlFlow::<()>::Continue(())
        });
        ended.expect("good steps");
        found
    }
}

fn position(point: &Point) -> f64 {
    point.q[0]
}

fn cubic() -> impl Strategy<Value = Cubic> {
    // Gaps down to 0.001, far below the distance of places.
    let gap = || (-3.0..0.0_f64).prop_map(|power| 10.0_f64.powf(power));
    (
        prop_oneof![Just(-1.0), Just(2.0)],
        0.01..1.0_f64,
        gap(),
        gap(),
    )
        .prop_map(|(factor, first, gap, next)| Cubic {
            factor,
            roots: [first, first + gap, first + gap + next],
        })
}

proptest! {
    #![proptest_config(ProptestConfig::with_cases(1000))]

    /// All three zeros are found, in their order and with their directions, if no panel holds both extrema.
    #[test]
    fn all_zeros_of_cubic_motions_are_found_in_order(
        cubic in cubic(), steps in 1..30_u32, backward: bool, by_steps: bool,
    ) {
        let (from, to) = if backward { (3.2, 0.0) } else { (0.0, 3.2) };
        // Four panels a step.
        let panel = 3.2 / f64::from(4 * steps);
        let [first, second] = cubic.extrema().map(|time| (time / panel).floor());
        prop_assume!(first != second);
        // A zero beside a place is beside it by rounding, too.
        let size = 3.2 / f64::from(steps);
        let found = cubic.events(from, to, size, by_steps);
        let mut expected = cubic.roots;
        let mut rising = cubic.factor > 0.0;
        if backward {
            expected.reverse();
            rising = !rising;
        }
        prop_assert_eq!(found.len(), 3, "{:?}", found);
        for (found, root) in found.iter().zip(expected) {
            prop_assert_eq!(found.0, usize::from(rising), "{:?}", found);
            rising = !rising;
            // Rounding of the coefficients, over the slope at the root.
            let slope = cubic.at(root).p[0].abs();
            prop_assert!((found.1 - root).abs() < 1e-12 / slope, "{found:?} {root}");
        }
    }

    /// A flight from zero and back: the zero after the start is found, however near it is.
    #[test]
    fn the_next_zero_after_a_start_on_zero_is_found(
        power in -9.0..0.0_f64, height in -1.0..1.0_f64, step_size in 0.01..4.0_f64, by_steps: bool,
    ) {
        let back = 10.0_f64.powf(power);
        let factor = if height < 0.0 { -1.0 } else { 1.0 };
        let cubic = Cubic { factor, roots: [0.0, back, 10.0] };
        let found = cubic.events(0.0, 4.0, step_size, by_steps);
        prop_assert_eq!(found.len(), 1, "{:?}", found);
        prop_assert!(found[0].0 == usize::from(factor < 0.0));
        // Rounding of the motion in a whole step.
        let rounding = 1e-14 * (back + step_size);
        prop_assert!((found[0].1 - back).abs() < rounding, "{found:?} {back}");
    }
}

/// Dips between the places that are looked at.
#[test]
fn two_zeros_between_samples_are_found() -> Result<(), Error> {
    let at_rest = || acceleration::<Vector1<f64>, _>(|_, _, acceleration| acceleration[0] = 0.0);
    let start = State::from_arrays(0.0, [0.0], [0.0]);
    for width in [1e-1, 1e-2, 1e-4] {
        for k in 1..100 {
            let bottom = 0.01 * f64::from(k) / 1.0101;
            let dip = |state: &Point| (state.time - bottom).powi(2) - 0.25 * width * width;
            let mut integrator = Integrator::new(Gauss4, at_rest(), start.clone(), 1.0)?;
            let mut times = Vec::new();
            integrator.integrate_with_events(1.0, &Event::crossing(dip), |state| {
                times.push(state.time);
                ControlFlow::<()>::Continue(())
            })?;
            let expected = [bottom - 0.5 * width, bottom + 0.5 * width];
            let expected: Vec<f64> = expected
                .into_iter()
                .filter(|t| 0.0 < *t && *t < 1.0)
                .collect();
            assert_eq!(times.len(), expected.len(), "{width} {bottom} {times:?}");
            for (found, expected) in times.iter().zip(expected) {
                assert!((found - expected).abs() < 1e-15 / width);
            }
        }
    }
    // What is documented to be missed: many extrema in a panel; places at the zeros of another wave see none of them.
    let mut integrator = Integrator::new(Gauss4, at_rest(), start, 1.0)?;
    let wave = |state: &Point| 1.5 + (TAU * 8.0 * state.time).cos() * 2.0;
    assert_eq!(integrator.find_event(1.0, &Event::crossing(wave))?, None);
    let more = Event::crossing(wave).samples(32);
    integrator.set_state(State::from_arrays(0.0, [0.0], [0.0]))?;
    assert!(integrator.find_event(1.0, &more)?.is_some());
    Ok(())
}
