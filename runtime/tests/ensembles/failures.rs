//! Trajectories that fail, and their neighbours, which go on to the bit.

use std::ops::ControlFlow;
use std::sync::Arc;
use std::sync::atomic::{AtomicUsize, Ordering};

use symplectic::ensemble::Ensemble;
use symplectic::nalgebra::Vector2;
use symplectic::{Error, Event, Integrator, Method, ProvedFor, Retry, Separable, State};

use crate::common::methods::{ForestRuth, Gauss4, StoermerVerlet, SymplecticEuler, Yoshida6};
use crate::systems::{Bits, HenonHeiles, alone, keep, starts};

/// It depends on time: what a step leaves behind for the next one is then not what the next one would compute.
const SYSTEM: HenonHeiles = HenonHeiles { amplitude: 0.02 };

fn failed<A>(rows: &[(Bits, A)]) -> Vec<usize> {
    let failed = rows
        .iter()
        .enumerate()
        .filter(|(_, row)| row.0.outcome.is_err());
    failed.map(|(number, _)| number).collect()
}

/// The rows of the trajectories alone and of the ensemble, to the end.
fn check<M: Method + Copy + ProvedFor<Separable>>(
    method: M,
    escape: usize,
    size: f64,
    retry: Retry,
) {
    let starts = starts(23, escape);
    let make = |start| {
        let mut integrator = Integrator::new(method, SYSTEM, start, size)?;
        integrator.set_retry(retry);
        Ok(integrator)
    };
    let mut ensemble = Ensemble::new(method, SYSTEM, starts.clone(), size).expect("starts");
    ensemble.set_retry(retry);

    let expected = alone(&starts, make, |run| {
        (run.integrate_to(60.0).map(|_| ()), ())
    });
    let leaving = failed(&expected);
    let escapes: Vec<usize> = (0..23).filter(|k| k % escape == escape - 1).collect();
    assert_eq!(leaving, escapes, "{}", M::NAME);
    let mut rows = Vec::new();
    assert_eq!(ensemble.integrate_to(60.0, keep(&mut rows, 0)), 23);
    assert_eq!(rows, expected, "{}", M::NAME);

    let times: Vec<f64> = (1..80).map(|k| 0.5 + 0.77 * f64::from(k)).collect();
    let expected = alone(&starts, make, |run| {
        let mut seen = Vec::new();
        let outcome = run.integrate_at(&times, |state| seen.push(crate::systems::words(state)));
        (outcome.map(|_| ()), seen)
    });
    let see = |seen: &mut Vec<_>, state: &State<_>| seen.push(crate::systems::words(state));
    let mut rows = Vec::new();
    ensemble.integrate_at(&times, |_| Vec::new(), see, keep(&mut rows, 0));
    assert_eq!(rows, expected, "{}", M::NAME);
    // What was seen of those that failed is there.
    assert!(failed(&rows).iter().all(|&k| !rows[k].1.is_empty()));
}

#[test]
#[ignore = "thorough"]
fn neighbours_of_failed_trajectories_keep_their_bits() {
    for escape in [2, 5] {
        check(StoermerVerlet, escape, 0.1, Retry::Never);
        check(ForestRuth, escape, 0.1, Retry::Never);
    }
    check(SymplecticEuler, 3, 0.05, Retry::Never);
    check(Gauss4, 3, 0.1, Retry::Never);
    check(Yoshida6, 4, 0.1, Retry::Never);
    check(ForestRuth, 4, 0.1, Retry::Split { halvings: 3 });
}

/// The steps before the failure are fewer than those after which a group is saved.
#[test]
fn neighbours_of_early_failures_keep_their_bits() {
    let mut starts = starts(23, 100);
    for start in starts.iter_mut().skip(3).step_by(7) {
        start.p *= 12.0;
    }
    let make = |start| Integrator::new(ForestRuth, SYSTEM, start, 0.1);
    let ensemble = Ensemble::new(ForestRuth, SYSTEM, starts.clone(), 0.1).expect("starts");
    for steps in [2, 30, 100, 700] {
        let expected = alone(&starts, make, |run| (run.take_steps(steps).map(|_| ()), ()));
        assert_eq!(failed(&expected).len(), if steps > 2 { 3 } else { 0 });
        let mut rows = Vec::new();
        ensemble.take_steps(steps, keep(&mut rows, 0));
        assert_eq!(rows, expected, "{steps} steps");
    }
}

#[test]
fn the_error_of_a_trajectory_has_its_time_and_step() {
    let ensemble = Ensemble::new(StoermerVerlet, SYSTEM, starts(8, 4), 0.1).expect("starts");
    let mut errors = Vec::new();
    ensemble.integrate_to(60.0, |row| {
        if let Err(error) = row.outcome {
            let Error::NonFinite { time, step, .. } = error else {
                panic!("{error}");
            };
            assert_eq!((time, step), (row.state.time, row.statistics.steps + 1));
            errors.push(row.trajectory);
        }
        ControlFlow::Continue(())
    });
    assert_eq!(errors, [3, 7]);
}

#[test]
fn an_error_of_the_whole_run_is_in_every_row() {
    let ensemble = Ensemble::new(ForestRuth, SYSTEM, starts(6, 100), 0.1).expect("starts");
    let mut rows = Vec::new();
    ensemble.integrate_to(f64::NAN, keep(&mut rows, 0));
    let end = |row: &(Bits, ())| matches!(row.0.outcome, Err(Error::EndTime { .. }));
    assert!(rows.len() == 6 && rows.iter().all(end));
    let mut rows = Vec::new();
    ensemble.integrate_at(&[2.0, 1.0], |_| (), |(), _| (), keep(&mut rows, 0));
    let time = |row: &(Bits, ())| matches!(row.0.outcome, Err(Error::OutputTime { .. }));
    assert!(rows.len() == 6 && rows.iter().all(time));
}

#[test]
fn a_run_ends_where_it_is_stopped() {
    let mut ensemble = Ensemble::new(ForestRuth, SYSTEM, starts(50, 100), 0.1).expect("starts");
    let shown = |rows: &mut usize, most: usize| {
        *rows += 1;
        match *rows < most {
            true => ControlFlow::Continue(()),
            false => ControlFlow::Break(()),
        }
    };
    let mut rows = 0;
    assert_eq!(ensemble.take_steps(10, |_| shown(&mut rows, 7)), 7);
    assert_eq!(rows, 7);
    // From the twentieth question on.
    let asked = Arc::new(AtomicUsize::new(0));
    let questions = Arc::clone(&asked);
    ensemble.stop_if(move || questions.fetch_add(1, Ordering::Relaxed) >= 20);
    let mut rows = Vec::new();
    let next = ensemble.take_steps(20, keep(&mut rows, 0));
    assert_eq!(next, rows.len());
    assert!(next < 50 && asked.load(Ordering::Relaxed) > 20);
}

#[test]
#[ignore = "thorough"]
fn a_run_in_lanes_to_one_far_time_is_stopped_on_its_way() {
    let mut ensemble = Ensemble::new(ForestRuth, SYSTEM, starts(2, 100), 0.1).expect("starts");
    // The third question comes 65 536 steps after the second.
    let asked = AtomicUsize::new(0);
    ensemble.stop_if(move || asked.fetch_add(1, Ordering::Relaxed) >= 2);
    let mut rows = Vec::new();
    let next = ensemble.integrate_at(&[7000.0], |_| (), |(), _| (), keep(&mut rows, 0));
    assert_eq!((next, rows.len()), (0, 0));
}

#[test]
fn events_in_an_ensemble_are_those_of_single_runs() {
    let starts = starts(9, 4);
    let section = Event::rising(|state: &State<Vector2<f64>>| state.q[0]);
    let run = |points: &mut Vec<Vec<u64>>, run: &mut Integrator<_, _, _>| {
        run.integrate_with_events(60.0, &section, |state| {
            points.push(crate::systems::words(state));
            ControlFlow::<()>::Continue(())
        })?;
        Ok(())
    };
    let make = |start| Integrator::new(ForestRuth, SYSTEM, start, 0.1);
    let expected = alone(&starts, make, |integrator| {
        let mut points = Vec::new();
        (run(&mut points, integrator), points)
    });
    assert!(expected[0].1.len() > 5);
    let ensemble = Ensemble::new(ForestRuth, SYSTEM, starts.clone(), 0.1).expect("starts");
    let mut rows = Vec::new();
    ensemble.each(|_| Vec::new(), run, keep(&mut rows, 0));
    assert_eq!(rows, expected);
}
