//! Ensembles with other steppers, such as reversible steps of variable size: every trajectory has the bits that it has alone.

use symplectic::adaptive::{Adaptive, AdaptiveSteps, DistancePower, Error};
use symplectic::ensemble::Ensemble;
use symplectic::flow::{Drift, FlowSteps, Kick, Splitting};
use symplectic::nalgebra::Vector2;
use symplectic::proved::SymmetricFor;
use symplectic::{CheckpointError, Event, Integrator, Method, ProvedFor, Separable, State};

use crate::common::methods::{Gauss2, StoermerVerlet};
use crate::systems::{Bits, bits, keep, on_threads, words};

symplectic::hamiltonian! {
    Kepler
    q: [x, y], p: [px, py];
    H = (px^2 + py^2)/2 - 1/sqrt(x^2 + y^2)
}

const MONITOR: DistancePower = DistancePower(1.5);
/// More than the periods of some orbits, and no end of a step.
const END: f64 = 7.0;
const TIMES: [f64; 4] = [0.0, 0.1, 3.0, END];

type Vector = Vector2<f64>;
type Kept = (Vec<Vec<u64>>, Bits<Error>);

/// Orbits of eccentricity 0 to 0.95. The ninth falls into the centre: its steps do not get there. The last is so far away that its
/// step size overflows.
fn starts() -> Vec<State<Vector>> {
    let start = |k: u32| {
        let e = 0.05 * f64::from(k);
        let speed = match k {
            9 => 0.0,
            _ => ((1.0 + e) / (1.0 - e)).sqrt(),
        };
        State::from_arrays(0.0, [1.0 - e, 0.0], [0.0, speed])
    };
    let mut starts: Vec<_> = (0..20).map(start).collect();
    starts.push(State::from_arrays(0.0, [1e210, 0.0], [0.0, 0.1]));
    starts
}

/// What a trajectory does: states at times, the state at the end, and crossings of the x-axis after it.
fn work<M: Method>(
    seen: &mut Vec<Vec<u64>>,
    run: &mut Adaptive<M, Kepler, DistancePower, Vector>,
) -> Result<(), Error> {
    run.integrate_at(&TIMES, |state| seen.push(words(state)))?;
    seen.push(words(&run.integrate_to(END)?));
    let crossing = Event::rising(|state: &State<Vector>| state.q[1]);
    run.integrate_with_events(2.0 * END, &crossing, |state| {
        seen.push(words(state));
        std::ops::ControlFlow::<()>::Continue(())
    })?;
    Ok(())
}

/// The rows of the trajectories alone.
fn alone<M: Copy + ProvedFor<Separable> + SymmetricFor<Separable>>(
    method: M,
    epsilon: f64,
) -> Vec<Kept> {
    let one = |start: State<Vector>| {
        let mut seen = Vec::new();
        match AdaptiveSteps::run(method, Kepler, MONITOR, start.clone(), epsilon) {
            Ok(mut run) => {
                let outcome = work(&mut seen, &mut run);
                let row = bits(outcome, run.state(), run.statistics());
                (seen, row)
            }
            Err(error) => (seen, bits(Err(error), &start, &Default::default())),
        }
    };
    starts().into_iter().map(one).collect()
}

type Runs<M> = Ensemble<M, Kepler, Vector>;

fn ensemble<M: Method + ProvedFor<Separable>>(method: M, epsilon: f64) -> Runs<M> {
    Ensemble::new(method, Kepler, starts(), epsilon).expect("starts")
}

/// The rows of an ensemble on a number of threads, with the power of its monitor.
fn rows<M: SymmetricFor<Separable> + Sync>(
    runs: &Runs<M>,
    threads: usize,
    power: f64,
) -> Vec<Kept> {
    let mut rows = Vec::new();
    let first = runs.trajectories().start;
    let next = on_threads(threads, || {
        let make = |integrator: Integrator<M, Kepler, Vector>| {
            let epsilon = integrator.step_size();
            AdaptiveSteps::of(integrator, DistancePower(power), epsilon)
        };
        runs.each_as(make, |_| Vec::new(), work, keep(&mut rows, first))
    });
    assert_eq!(next, runs.trajectories().end);
    rows.into_iter().map(|(row, seen)| (seen, row)).collect()
}

fn check<M: Copy + ProvedFor<Separable> + SymmetricFor<Separable> + Sync>(method: M, epsilon: f64) {
    let expected = alone(method, epsilon);
    for threads in [1, 4] {
        let found = rows(&ensemble(method, epsilon), threads, MONITOR.0);
        assert_eq!(found, expected, "{} on {threads}", M::NAME);
    }
    let other = rows(&ensemble(method, epsilon), 1, 1.4);
    assert!(other[3] != expected[3], "{}", M::NAME);
    let failed = |(k, row): (usize, &Kept)| row.1.outcome.is_err().then_some(k);
    let failed: Vec<usize> = expected.iter().enumerate().filter_map(failed).collect();
    assert_eq!(failed, [9, 20], "{}", M::NAME);
    // What was seen before the failure is there; where there is no run, nothing.
    let seen: Vec<usize> = expected.iter().map(|row| row.0.len()).collect();
    assert!(seen[9] == 2 && seen[20] == 0 && seen[3] > 5, "{seen:?}");
    let outcome = &expected[20].1.outcome;
    assert!(
        matches!(outcome, Err(Error::Core(symplectic::Error::Monitor { .. }))),
        "{outcome:?}"
    );
}

#[test]
fn adaptive_trajectories_have_the_bits_of_single_runs() {
    check(StoermerVerlet, 0.02);
    check(Gauss2, 0.05);
}

#[test]
fn a_resumed_ensemble_has_the_same_rows() {
    let whole = rows(&ensemble(StoermerVerlet, 0.02), 1, MONITOR.0);
    for stop in [0, 1, 9, 10, 21] {
        let checkpoint = ensemble(StoermerVerlet, 0.02).checkpoint(stop);
        let checkpoint = checkpoint.expect("doubles");
        let mut resumed = ensemble(StoermerVerlet, 0.02);
        resumed.restore(&checkpoint).expect("the same run");
        assert_eq!(rows(&resumed, 2, MONITOR.0), whole[stop..], "{stop}");
        // The step size of the ensemble is ε.
        let other = ensemble(StoermerVerlet, 0.03).restore(&checkpoint);
        let is_refused = matches!(
            other,
            Err(CheckpointError::OtherRun {
                what: "step size",
                ..
            })
        );
        assert!(is_refused, "{other:?}");
    }
    let part = ensemble(StoermerVerlet, 0.02).shard(1, 3).expect("a part");
    assert_eq!(rows(&part, 1, MONITOR.0), whole[7..14]);
}

#[test]
fn flows_in_an_ensemble_have_the_bits_of_single_runs() {
    let made = |start: &State<Vector>| {
        let step = Splitting::new(StoermerVerlet, Drift::new(Kepler), Kick::new(Kepler));
        FlowSteps::run(step, start.clone(), 0.01)
    };
    let starts = starts();
    let end = ensemble(StoermerVerlet, 0.01).each_as(
        |integrator| made(integrator.state()),
        |_| (),
        |(), run| run.integrate_to(1.0).map(|_| ()),
        |row| {
            let mut alone = made(&starts[row.trajectory]).expect("a run");
            assert_eq!(row.outcome, alone.integrate_to(1.0).map(|_| ()));
            assert_eq!(
                (&row.state, &row.statistics),
                (alone.state(), alone.statistics())
            );
            std::ops::ControlFlow::Continue(())
        },
    );
    assert_eq!(end, starts.len());
}
