//! Small measurements for the writers, and small studies.

use std::time::Duration;
use std::vec::Vec;

use nalgebra::Vector1;

use super::*;
use symplectic::{Separable, State, System, acceleration};

symplectic::tableau! {
    Verlet { basis: polynomial(2), nodes: lobatto(2) }
    Gauss4 { basis: polynomial(4), nodes: gauss(4) }
}

/// A curve from errors and seconds.
pub(super) fn curve(method: &str, runs: &[(f64, f64)]) -> Curve {
    let measured = |error, seconds| Measured {
        error,
        energy_error: Some(error / 10.0),
        drifts: vec![Some(error / 100.0)],
        seconds,
        repetitions: 5,
        steps: Some((100.0 * seconds) as u64),
        evaluations: (1e6 * seconds) as u64,
        mean_iterations: 0.0,
        most_iterations: 0,
    };
    let point = |(index, &(error, seconds)): (usize, &(f64, f64))| Point {
        parameter: 0.5_f64.powi(index as i32),
        outcome: Outcome::Measured(measured(error, seconds)),
    };
    Curve {
        method: method.into(),
        parameter: Parameter::StepSize,
        points: runs.iter().enumerate().map(point).collect(),
        trace: Some(Trace {
            parameter: 0.5,
            ranges: vec![Some((-1e-6, 1e-5)), None, Some((0.0, 2e-5))],
        }),
    }
}

/// A problem with three methods, a failed run and a skipped run.
pub(super) fn measurements() -> Measurements {
    let method = |name: &str, kind, stages| MethodRecord {
        name: name.into(),
        kind,
        definition: (kind != Kind::Peer).then(|| "basis: …".into()),
        stages,
        facts: vec![Fact::new("order", "4, proved")],
    };
    let mut verlet = curve("Verlet", &[(1e-2, 1e-3), (1e-4, 1e-2)]);
    verlet.points.push(Point {
        parameter: 0.25,
        outcome: Outcome::Skipped {
            reason: "it would take about 1 s".into(),
        },
    });
    let mut gauss = curve("Gauss 4", &[(1e-3, 1e-3), (1e-7, 2e-3), (1e-13, 4e-3)]);
    gauss.points.insert(
        0,
        Point {
            parameter: 2.0,
            outcome: Outcome::Failed {
                error: "the stages did not converge, \"so\" <it> says".into(),
            },
        },
    );
    let mut peer = curve("DOP853", &[(1e-4, 2e-3), (1e-10, 1e-2)]);
    peer.parameter = Parameter::Tolerance;
    peer.trace = None;
    Measurements {
        title: "A small study".into(),
        circumstances: vec![Fact::new("machine", "a small one")],
        targets: vec![1e-3, 1e-6, 1e-9, 1e-12],
        methods: vec![
            method("Verlet", Kind::Explicit, Some(2)),
            method("Gauss 4", Kind::Implicit, Some(4)),
            method("DOP853", Kind::Peer, None),
        ],
        problems: vec![ProblemRecord {
            name: "Kepler & co".into(),
            description: "H = |p|²/2 − 1/|q|".into(),
            needs: "nothing".into(),
            dimension: 2,
            start: 0.0,
            end: 100.0,
            reference: "closed form".into(),
            uncertainty: 1e-15,
            traced_at: None,
            invariants: vec!["angular momentum".into()],
            curves: vec![verlet, gauss, peer],
        }],
        verdicts: vec![verdicts()],
        limits: vec![StabilityLimit {
            method: "Verlet".into(),
            proved: 2.0,
            measured: 2.000_02,
        }],
    }
}

/// A table with each kind of verdict, one that contradicts the proof, and a method that was not run.
fn verdicts() -> Verdicts {
    let mut table = Verdicts::new("Stiff & extreme", "Longer steps than anyone would take.");
    table.add_column("Verlet", vec![Fact::new("stable for hω in", "(0, 2)")]);
    let proved = |verdict, proved_stable| Cell {
        verdict,
        proved_stable: Some(proved_stable),
    };
    table.set("short", "Verlet", Verdict::Accurate { error: 2e-5 });
    table.set(
        "long",
        "Verlet",
        proved(Verdict::Unstable { steps: 12 }, false),
    );
    table.set(
        "short",
        "Gauss 4",
        proved(
            Verdict::Bounded {
                energy: 0.5,
                error: 0.25,
            },
            false,
        ),
    );
    table.set(
        "long",
        "Gauss 4",
        Verdict::Stopped {
            cause: Cause::NoConvergence,
            error: "step 1 of size 1 did not converge".into(),
        },
    );
    table.set("only Gauss", "Gauss 4", Verdict::Accurate { error: 0.0 });
    table
}

fn settings() -> Settings {
    Settings {
        targets: vec![1e-3, 1e-6],
        // The result must not depend on the speed of the machine.
        budget: Duration::from_secs(60),
        repetitions: Repetitions {
            least: 1,
            most: 1,
            enough: Duration::ZERO,
        },
    }
}

/// The oscillator from (1, 0) to time 10.
fn oscillator() -> Problem<Vector1<f64>, impl System<Vector1<f64>, Class = Separable> + Clone> {
    let system = acceleration::<Vector1<f64>, _>(|_, q, acceleration| *acceleration = -q)
        .with_energy(|_, q, p| (q[0] * q[0] + p[0] * p[0]) / 2.0);
    let start = State::from_arrays(0.0, [1.0], [0.0]);
    let end: f64 = 10.0;
    let reference = Reference::known(
        State::from_arrays(end, [end.cos()], [-end.sin()]),
        "closed form",
        1e-16,
    );
    Problem::new("oscillator", system, start, reference, 4.0)
}

#[test]
fn a_study_of_an_oscillator_measures_all_its_curves() {
    let problem = oscillator()
        .method(Verlet)
        .run("Gauss", |system, start, h| {
            Ok(symplectic::Integrator::plain(Gauss4, system, start, h)?
                .with_solver(symplectic::solver::FixedPoint))
        });
    let study = Study::new("Oscillator").problem(problem.conserving("twice the energy", |state| {
        state.q[0] * state.q[0] + state.p[0] * state.p[0]
    }));
    let mut seen = Vec::new();
    let found = study.run(&settings(), |advance| seen.push(advance.fraction));
    assert!(
        seen.is_sorted() && seen.len() >= 3 && seen.iter().all(|part| (0.0..=1.0).contains(part))
    );
    assert_eq!(found.methods[0].name, "Verlet");
    assert_eq!(
        found.methods.iter().map(|m| m.kind).collect::<Vec<_>>(),
        [Kind::Explicit, Kind::Implicit]
    );
    let [verlet, gauss] = &found.problems[0].curves[..] else {
        panic!("{found:?}");
    };
    // The frequency of Verlet is 1 + h²/24. With q = cos 10 and p = −sin 10 the relative error of p is h²/24·10·cot 10;
    // that of q contains the tangent instead.
    let (step_size, run) = verlet.measured().last().expect("Verlet has runs");
    let h = 10.0 / run.steps.expect("they are counted") as f64;
    assert!(h <= step_size * (1.0 + 1e-12));
    let (expected, found) = (h * h / 24.0 * 10.0 / 10_f64.tan(), run.error);
    assert!((found / expected - 1.0).abs() < 0.5, "{found} {expected}");
    assert!(
        gauss
            .measured()
            .all(|(_, run)| run.mean_iterations > 1.0 && run.seconds > 0.0)
    );
    // A function of the energy deviates as much as the energy.
    for (_, run) in verlet.measured().chain(gauss.measured()) {
        assert_eq!(run.drifts, [run.energy_error]);
    }
}

#[test]
fn failed_runs_are_kept_with_their_errors() {
    let problem = oscillator()
        .on_ladder(Ladder::Halve {
            first: 10.0,
            halvings: 3,
        })
        .method(Gauss4)
        .peer(
            "moody",
            Ladder::decades(1, 3),
            |tolerance, _observe| match tolerance {
                0.1 => Err("not today".into()),
                0.01 => Ok(Finish::explicit(
                    State::from_arrays(10.0, [f64::NAN], [0.0]),
                    None,
                    1,
                )),
                _ => Ok(Finish::explicit(
                    State::from_arrays(10.0, [-0.8], [0.5]),
                    None,
                    1,
                )),
            },
        );
    let found = Study::new("Failures")
        .problem(problem)
        .run(&settings(), |_| {});
    let [gauss, moody] = &found.problems[0].curves[..] else {
        panic!("{found:?}");
    };
    assert_eq!(gauss.points.len(), 4);
    let failed = |curve: &Curve, index: usize| match &curve.points[index].outcome {
        Outcome::Failed { error } => error.clone(),
        other => panic!("{other:?}"),
    };
    assert!(
        failed(gauss, 0).contains("did not converge"),
        "{}",
        failed(gauss, 0)
    );
    assert!(gauss.measured().count() >= 1);
    assert_eq!(failed(moody, 0), "not today");
    assert_eq!(failed(moody, 1), "the state at the end is not finite");
    assert_eq!(moody.measured().count(), 1);
    assert_eq!(moody.parameter, Parameter::Tolerance);
    // A peer without observed states has no energy over time.
    assert!(moody.trace.is_none());
}

#[test]
fn runs_beyond_the_budget_are_skipped_with_the_reason() {
    let none = Settings {
        budget: Duration::from_nanos(1),
        ..settings()
    };
    let found = Study::new("Haste")
        .problem(oscillator().method(Verlet))
        .run(&none, |_| {});
    let points = &found.problems[0].curves[0].points;
    assert!(found.problems[0].curves[0].is_cut());
    let last = points.last().map(|point| &point.outcome);
    assert!(
        matches!(last, Some(Outcome::Skipped { reason }) if reason.contains("budget")),
        "{points:?}"
    );
}

#[test]
fn methods_can_be_left_out() {
    let mut study = Study::new("Fewer").problem(oscillator().method(Verlet).method(Gauss4));
    study.retain_methods(|name| name == "Gauss4");
    let found = study.run(&settings(), |_| {});
    assert_eq!(found.methods.len(), 1);
    assert_eq!(found.problems[0].curves.len(), 1);
}

#[test]
fn json_comes_back_as_it_was() {
    let before = measurements();
    let json = before.json().expect("all numbers are finite");
    assert_eq!(
        Measurements::from_json(&json).expect("it was written"),
        before
    );
    assert!(Measurements::from_json("{}").is_err());
    // Files without verdicts and limits can be read.
    let older = json
        .split_once(",\n  \"verdicts\"")
        .map(|(older, _)| format!("{older}}}"))
        .expect("they come last");
    let older = Measurements::from_json(&older).expect("it was written");
    assert!(older.verdicts.is_empty() && older.problems == before.problems);
}

#[test]
fn facts_are_added_to_definitions() {
    let mut found = measurements();
    found.add_facts(|definition| vec![Fact::new("definition", definition)]);
    assert_eq!(found.methods[0].facts.len(), 2);
    assert_eq!(found.methods[2].facts.len(), 1);
}
