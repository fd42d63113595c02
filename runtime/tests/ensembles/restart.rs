//! Ensembles that are interrupted go on with the same rows.

#[cfg(feature = "serde")]
use std::ops::ControlFlow;

use symplectic::ensemble::Ensemble;
#[cfg(feature = "serde")]
use symplectic::ensemble::{EnsembleCheckpoint, Moments};
use symplectic::nalgebra::Vector2;
use symplectic::{CheckpointError, Retry};

use crate::common::methods::{ForestRuth, StoermerVerlet};
use crate::systems::{Bits, HenonHeiles, keep, starts};

type Run = Ensemble<ForestRuth, HenonHeiles, Vector2<f64>>;

fn ensemble(count: usize, amplitude: f64, size: f64) -> Run {
    Ensemble::new(
        ForestRuth,
        HenonHeiles { amplitude },
        starts(count, 7),
        size,
    )
    .expect("starts")
}

fn rows(ensemble: &Run, first: usize) -> Vec<(Bits, ())> {
    let mut rows = Vec::new();
    ensemble.integrate_to(20.0, keep(&mut rows, first));
    rows
}

#[test]
fn a_resumed_ensemble_has_the_same_rows() {
    let whole = rows(&ensemble(40, 0.02, 0.1), 0);
    // Also from where a group of lanes is cut, from the start and from the end.
    for stop in [0, 1, 6, 16, 39, 40] {
        let checkpoint = ensemble(40, 0.02, 0.1).checkpoint(stop).expect("f64");
        let mut resumed = ensemble(40, 0.02, 0.1);
        resumed.check(&checkpoint).expect("the same run");
        assert_eq!(resumed.trajectories(), 0..40);
        resumed.restore(&checkpoint).expect("the same run");
        assert_eq!(resumed.trajectories(), stop..40);
        assert_eq!(rows(&resumed, stop), whole[stop..], "{stop}");
    }
    // Of a part.
    let part = || ensemble(40, 0.02, 0.1).shard(1, 3).expect("a part");
    let checkpoint = part().checkpoint(20).expect("f64");
    let mut resumed = part();
    resumed.restore(&checkpoint).expect("the same run");
    assert_eq!(rows(&resumed, 20), whole[20..26]);
    // A part without trajectories.
    let part = || ensemble(2, 0.02, 0.1).shard(0, 3).expect("a part");
    let checkpoint = part().checkpoint(0).expect("f64");
    part().restore(&checkpoint).expect("the same run");
    assert!(rows(&part(), 0).is_empty());
}

symplectic::hamiltonian! {
    Swing { lift: 9.81, friction: 0 }
    q: [a], p: [pa];
    H = pa^2/2 - lift cos(a)
    friction: friction
}

#[test]
fn a_checkpoint_of_another_ensemble_is_refused() {
    let checkpoint = ensemble(40, 0.02, 0.1).checkpoint(5).expect("f64");
    let what = |mut other: Run| match other.restore(&checkpoint) {
        Err(CheckpointError::OtherRun { what, .. }) => {
            assert_eq!(other.trajectories().start, 0);
            what
        }
        Err(CheckpointError::OtherSystem) => "system",
        other => panic!("{other:?}"),
    };
    assert_eq!(what(ensemble(41, 0.02, 0.1)), "trajectories");
    assert_eq!(what(ensemble(40, 0.03, 0.1)), "system");
    assert_eq!(what(ensemble(40, 0.02, 0.2)), "step size");
    let mut retries = ensemble(40, 0.02, 0.1);
    retries.set_retry(Retry::Split { halvings: 2 });
    assert_eq!(what(retries), "tolerance, bound on the sweeps or retry");
    let mut other = starts(40, 7);
    other[30].q[0] = 0.11;
    let system = HenonHeiles { amplitude: 0.02 };
    let other = Ensemble::new(ForestRuth, system, other, 0.1).expect("starts");
    assert_eq!(what(other), "starts");
    // The first trajectories are the same, but not the system of the others.
    let halves = |amplitude: f64| {
        let mut first = starts(40, 7);
        let second = first.split_off(20);
        let families = [0.02, amplitude].map(|amplitude| HenonHeiles { amplitude });
        Ensemble::of_families(ForestRuth, families.into_iter().zip([first, second]), 0.1)
    };
    assert_eq!(what(halves(0.03).expect("starts")), "starts");
    let mut same = halves(0.02).expect("starts");
    same.restore(&checkpoint).expect("the same run");

    // At rest in its lowest position a pendulum shows neither its length nor its friction.
    let swings = |lift: f64, friction: f64| {
        let rest = vec![symplectic::State::from_arrays(0.0, [0.0], [0.0]); 3];
        let system = Swing { lift, friction };
        Ensemble::new(StoermerVerlet, system, rest, 0.1).expect("starts")
    };
    let checkpoint = swings(9.81, 0.1).checkpoint(1).expect("f64");
    for (lift, friction, same) in [(9.81, 0.1, true), (4.0, 0.1, false), (9.81, 0.2, false)] {
        let found = swings(lift, friction).restore(&checkpoint);
        let refused = matches!(found, Err(CheckpointError::OtherSystem));
        assert!(found.is_ok() == same && refused != same, "{found:?}");
    }

    let checkpoint = ensemble(40, 0.02, 0.1).checkpoint(5).expect("f64");
    let mut other = Ensemble::new(StoermerVerlet, system, starts(40, 7), 0.1).expect("starts");
    assert!(matches!(
        other.restore(&checkpoint),
        Err(CheckpointError::OtherRun { what: "method", .. })
    ));
}

/// What is kept in a file.
#[cfg(feature = "serde")]
type Kept = (EnsembleCheckpoint, Moments);

/// Goes on from a file, and writes to it after every fifth row; waits after 17 rows if it is to be killed there.
#[cfg(feature = "serde")]
fn go_on(path: &std::path::Path, hold: bool) -> Moments {
    let mut run = ensemble(60, 0.0, 0.1);
    let mut moments = Moments::new(2);
    if let Ok(text) = std::fs::read_to_string(path) {
        let kept: Kept = serde_json::from_str(&text).expect("a checkpoint");
        run.restore(&kept.0).expect("the same run");
        moments = kept.1;
    }
    run.integrate_to(20.0, |row| {
        if row.outcome.is_ok() {
            moments.add(row.state.q.as_slice()).expect("two components");
        }
        if row.trajectory % 5 == 4 {
            let checkpoint = run.checkpoint(row.trajectory + 1).expect("f64");
            let text = serde_json::to_string(&(checkpoint, &moments)).expect("text");
            // A file is there in full or not at all.
            let new = path.with_extension("new");
            std::fs::write(&new, text).expect("a file");
            std::fs::rename(&new, path).expect("a file");
        }
        if hold && row.trajectory == 17 {
            std::fs::write(path.with_extension("here"), "").expect("a file");
            std::thread::sleep(std::time::Duration::from_secs(600));
        }
        ControlFlow::Continue(())
    });
    moments
}

/// What is killed: it does nothing unless [`a_killed_ensemble_goes_on`] has set the variable.
#[cfg(feature = "serde")]
#[test]
fn helper_process_that_is_killed() {
    if let Some(path) = std::env::var_os("SYMPLECTIC_ENSEMBLE") {
        go_on(path.as_ref(), true);
    }
}

#[cfg(feature = "serde")]
#[test]
fn a_killed_ensemble_goes_on() {
    let folder = std::env::temp_dir().join(format!("symplectic-ensemble-{}", std::process::id()));
    std::fs::create_dir_all(&folder).expect("a folder");
    let path = folder.join("kept");
    let program = std::env::current_exe().expect("this program");
    let mut child = std::process::Command::new(program)
        .args(["--exact", "restart::helper_process_that_is_killed"])
        .env("SYMPLECTIC_ENSEMBLE", &path)
        .stdout(std::process::Stdio::null())
        .spawn()
        .expect("a process");
    while !path.with_extension("here").exists() {
        assert!(child.try_wait().expect("a process").is_none());
        std::thread::sleep(std::time::Duration::from_millis(20));
    }
    child.kill().expect("a process");
    child.wait().expect("a process");
    let text = std::fs::read_to_string(&path).expect("a file");
    let (checkpoint, _): Kept = serde_json::from_str(&text).expect("a checkpoint");
    let mut run = ensemble(60, 0.0, 0.1);
    run.restore(&checkpoint).expect("the same run");
    assert_eq!(run.trajectories().start, 15);

    let resumed = go_on(&path, false);
    let whole = go_on(&folder.join("other"), false);
    assert_eq!(resumed, whole);
    assert!(whole.count() > 40);
    // A file that was changed.
    let changed = text.replacen("\"next\":15", "\"next\":16", 1);
    let (changed, _): Kept = serde_json::from_str(&changed).expect("a checkpoint");
    let damaged = ensemble(60, 0.0, 0.1).restore(&changed);
    assert!(matches!(damaged, Err(CheckpointError::Damaged { .. })));
    std::fs::remove_dir_all(&folder).expect("a folder");
}

/// Two signs that change: sums of products of their bits with odd numbers would not.
#[test]
fn a_checkpoint_distinguishes_starts_of_opposite_sign() {
    let make = |mirrored: usize| {
        let mut starts = starts(40, 100);
        for start in &mut starts[mirrored..=mirrored] {
            start.p = -start.p;
        }
        let system = HenonHeiles { amplitude: 0.02 };
        Ensemble::new(ForestRuth, system, starts, 0.1).expect("starts")
    };
    let checkpoint = make(7).checkpoint(5).expect("f64");
    make(7).restore(&checkpoint).expect("the same run");
    for other in [8, 0] {
        make(other)
            .restore(&checkpoint)
            .expect_err("two starts go the other way");
    }
    let run = |size: f64| {
        let force = move |_: f64, q: &Vector2<f64>, force: &mut Vector2<f64>| *force = q * size;
        let start = symplectic::State::from_arrays(0.0, [0.5, 0.25], [0.1, 0.2]);
        let system = symplectic::acceleration(force);
        symplectic::Integrator::new(StoermerVerlet, system, start, 0.1).expect("a start")
    };
    let checkpoint = run(1.0).checkpoint().expect("f64");
    run(1.0).restore(&checkpoint).expect("the same run");
    let error = run(-1.0).restore(&checkpoint).expect_err("another force");
    assert!(matches!(error, CheckpointError::OtherSystem), "{error}");
}

#[test]
fn a_part_of_a_resumed_ensemble_begins_at_the_checkpoint() {
    let whole = rows(&ensemble(40, 0.02, 0.1), 0);
    let checkpoint = ensemble(40, 0.02, 0.1).checkpoint(17).expect("f64");
    for (part, first) in [(0, 10), (1, 17), (2, 20), (3, 30)] {
        let mut resumed = ensemble(40, 0.02, 0.1);
        resumed.restore(&checkpoint).expect("the same run");
        let part = resumed.shard(part, 4).expect("a part");
        let end = part.trajectories().end;
        assert_eq!(part.trajectories(), first..end);
        assert_eq!(rows(&part, first), whole[first..end]);
    }
}
