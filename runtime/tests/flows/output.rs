//! What is seen of a run between its steps, and that it changes no step.

use symplectic::State;
use symplectic::flow::{
    Drift, Error, Flow, FlowError, FlowIntegrator, FlowSteps, Kick, OrnsteinUhlenbeck, Palindrome,
    Span, Splitting,
};
use symplectic::nalgebra::Vector1;

use crate::common::methods::{ForestRuth, Gauss8};
use crate::common::systems::point;
use crate::common::{distance, run};

type V = Vector1<f64>;

symplectic::hamiltonian! {
    /// A pendulum.
    pub Well q: [x], p: [y]; H = y^2/2 - cos(x)
}

fn pendulum(size: f64) -> Result<FlowIntegrator<V, impl Flow<V> + Clone>, Error> {
    let (drift, kick) = (Drift::new(Well), Kick::new(Well));
    FlowSteps::run(
        Splitting::new(ForestRuth, drift, kick),
        point(1.2, 0.3),
        size,
    )
}

/// Kick, drift, bath, drift, kick.
pub type Baoab = Palindrome<Kick<Well, V>, Palindrome<Drift<Well, V>, Bath>>;
type Bath = OrnsteinUhlenbeck<[f64; 1]>;

pub fn heated(seed: u64) -> Result<FlowIntegrator<V, Baoab>, Error> {
    let bath = OrnsteinUhlenbeck::new(0.5, 1.0, [1.0], seed)?;
    let (drift, kick) = (Drift::new(Well), Kick::new(Well));
    let step = Palindrome::new(kick, Palindrome::new(drift, bath));
    FlowSteps::run(step, point(1.2, 0.3), 0.1)
}

#[test]
fn states_inside_steps_have_the_error_of_a_step() -> Result<(), Error> {
    let times = [0.0, 0.05, 0.61, 0.62, 0.7, 1.9999, 2.0];
    for direction in [1.0, -1.0] {
        let errors = [0.1, 0.05].map(|size| -> Result<f64, Error> {
            let mut run_of_flows = pendulum(size * direction)?;
            let (mut worst, mut seen) = (0.0_f64, Vec::new());
            let times = times.map(|time| time * direction);
            run_of_flows.integrate_at(&times, |state| seen.push(state.clone()))?;
            assert_eq!(seen.len(), times.len());
            for (state, time) in seen.iter().zip(times) {
                assert_eq!(state.time, time);
                if time != 0.0 {
                    let exact = run(Gauss8, Well, point(1.2, 0.3), time, 40)?;
                    worst = worst.max(distance(state, &exact));
                }
            }
            assert_eq!(seen[0], point(1.2, 0.3));
            Ok(worst)
        });
        let [coarse, fine] = errors;
        let slope = (coarse? / fine?).log2();
        assert!((slope - 4.0).abs() < 0.2, "{slope}");
    }
    Ok(())
}

/// The ends of a step are its states to the bit, and nearby states are near.
#[test]
fn states_inside_the_last_step_join_its_ends() -> Result<(), Error> {
    let mut run = heated(7)?;
    assert_eq!(
        run.state_at(0.0),
        Err(Error::Core(symplectic::Error::NoStep))
    );
    let start = run.step()?.clone();
    let end = run.step()?.clone();
    assert_eq!(run.state_at(0.1)?, start);
    assert_eq!(run.state_at(0.2)?, end);
    // The noise is that of the step: it grows as the square root of the time, and is all there at the end.
    assert!(distance(&run.state_at(0.2 - 1e-12)?, &end) < 1e-11);
    let middle = run.state_at(0.15)?;
    assert!(distance(&middle, &start) > 1e-3 && distance(&middle, &end) > 1e-3);
    assert_eq!(run.state_at(0.15)?, middle);
    let outside = |time| {
        Error::Core(symplectic::Error::OutsideStep {
            time,
            start: 0.1,
            end: 0.2,
        })
    };
    assert_eq!(run.state_at(0.09), Err(outside(0.09)));
    assert_eq!(run.state_at(0.21), Err(outside(0.21)));
    run.set_state(point(0.0, 1.0))?;
    assert_eq!(
        run.state_at(0.0),
        Err(Error::Core(symplectic::Error::NoStep))
    );
    assert_eq!(run.step()?.time, 0.1);
    Ok(())
}

/// A bath that does not say how many draws it has taken.
struct Forgetful(Bath);

impl Flow<V> for Forgetful {
    fn flow(&mut self, span: Span, q: &mut V, p: &mut V) -> Result<(), FlowError> {
        self.0.flow(span, q, p)
    }
}

#[test]
fn output_takes_no_random_numbers() -> Result<(), Error> {
    let times: Vec<f64> = (0..300).map(|k| 0.033 * f64::from(k)).collect();
    let mut plain = heated(7)?;
    let mut seen = heated(7)?;
    seen.integrate_at(&times, |_| {})?;
    plain.take_steps(seen.steps())?;
    assert_eq!(seen.state(), plain.state());
    assert_eq!(seen.stepper().flow().inner.inner.draws(), seen.steps());

    // One that hides its draws has other numbers after an output.
    let forgetful = || {
        let bath = OrnsteinUhlenbeck::new(0.5, 1.0, [1.0], 7)?;
        FlowSteps::run(Forgetful(bath), point(1.2, 0.3), 0.1)
    };
    let (mut plain, mut seen) = (forgetful()?, forgetful()?);
    seen.integrate_at(&times, |_| {})?;
    plain.take_steps(seen.steps())?;
    assert_ne!(seen.state(), plain.state());
    Ok(())
}

#[test]
fn output_times_are_in_order() -> Result<(), Error> {
    let mut run = pendulum(0.1)?;
    run.take_steps(2)?;
    let before = run.state().clone();
    for (times, found) in [
        (&[0.15, 0.12][..], (0.12, 0.15)),
        (&[0.09][..], (0.09, 0.1)),
        (&[0.3, f64::INFINITY][..], (f64::INFINITY, 0.3)),
    ] {
        let (time, before) = found;
        let refused = run.integrate_at(times, |_| panic!("no output")).err();
        assert_eq!(
            refused,
            Some(Error::Core(symplectic::Error::OutputTime { time, before }))
        );
    }
    assert!(matches!(
        run.integrate_at(&[1e300], |_| {}),
        Err(Error::Core(symplectic::Error::StepCount { .. }))
    ));
    assert_eq!((run.state(), run.steps()), (&before, 2));
    // In the last step, again and again; back, only from the present time on.
    let mut count = 0;
    run.integrate_at(&[0.1, 0.15, 0.15, 0.2], |_| count += 1)?;
    assert_eq!((count, run.steps()), (4, 2));
    run.set_step_size(-0.1)?;
    assert!(run.integrate_at(&[0.25], |_| {}).is_err());
    run.integrate_at(&[0.15, 0.1], |_| {})?;
    assert_eq!(run.steps(), 3);
    Ok(())
}

/// The loops that take steps take the same ones.
#[test]
fn loops_take_the_same_steps() -> Result<(), Error> {
    let mut one_by_one = pendulum(0.125)?;
    let states: Vec<State<V>> = (0..8)
        .map(|_| one_by_one.step().cloned())
        .collect::<Result<_, _>>()?;
    let mut run = pendulum(0.125)?;
    assert_eq!(run.states().take(8).collect::<Result<Vec<_>, _>>()?, states);
    assert_eq!(pendulum(0.125)?.take_steps(8)?, &states[7]);
    let mut seen = Vec::new();
    pendulum(0.125)?.integrate_with(1.0, |state| seen.push(state.clone()))?;
    assert_eq!(seen, states);
    let wrong = State::from_arrays(0.0, [f64::NAN], [0.0]);
    assert!(run.set_state(wrong).is_err());
    assert_eq!(run.state(), &states[7]);
    Ok(())
}

/// A drift that ends at q = 1.5.
struct Walled(Drift<Well, V>);

impl Flow<V> for Walled {
    fn flow(&mut self, span: Span, q: &mut V, p: &mut V) -> Result<(), FlowError> {
        self.0.flow(span, q, p)?;
        let reason = "it is a wall";
        (q[0] < 1.5)
            .then_some(())
            .ok_or(FlowError::Other { reason })
    }
}

#[test]
fn a_failed_step_uses_no_random_numbers() -> Result<(), Error> {
    let bath = OrnsteinUhlenbeck::new(0.0, 1.0, [1.0], 1)?;
    let step = Palindrome::new(bath, Walled(Drift::new(Well)));
    let mut run = FlowSteps::run(step, point(1.0, 1.0), 0.2)?;
    run.step()?;
    run.step()?;
    assert!(matches!(run.step(), Err(Error::Flow { step: 3, .. })));
    assert_eq!((run.stepper().flow().outer.draws(), run.steps()), (4, 2));
    assert_eq!(run.states().take(3).count(), 1);
    assert_eq!(
        run.state_at(0.3),
        Err(Error::Core(symplectic::Error::NoStep))
    );
    Ok(())
}
