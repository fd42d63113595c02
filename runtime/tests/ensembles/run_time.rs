//! Ensembles of tableaux at run time: the bits of trajectories alone, and the same method as emitted.

use symplectic::at_run_time::RunTimeTableau;
use symplectic::ensemble::{Ensemble, EnsembleError};
use symplectic::nalgebra::{SVector, Vector2};
use symplectic::simd::{F64x2, F64x4, F64x8};
use symplectic::{CheckpointError, Error, Integrator, Scalar, SeparableHamiltonian, State};

use crate::common::methods::{ForestRuth, Gauss4, McLachlanAtela, StoermerVerlet, Yoshida6};
use crate::common::systems::Product;
use crate::common::{distance, tableau};
use crate::systems::{Bits, HenonHeiles, alone, keep, starts, words};

const SYSTEM: HenonHeiles = HenonHeiles { amplitude: 0.02 };

/// Checks the bits of ends, and of states at times, in every width; `$make` is the ensemble, `$alone` the integrator.
macro_rules! check {
    ($what:expr, $starts:expr, $make:expr, $alone:expr) => {
        let time = $starts[0].time;
        let times = [0.0, 0.25, 3.1, 17.0].map(|after| time + after);
        let see = |seen: &mut Vec<_>, state: &State<Vector2<f64>>| seen.push(words(state));
        let ends: Vec<(Bits, ())> = alone(&$starts, $alone, |run| {
            (run.integrate_to(time + 20.3).map(|_| ()), ())
        });
        let seen: Vec<(Bits, Vec<Vec<u64>>)> = alone(&$starts, $alone, |run| {
            let mut seen = Vec::new();
            let outcome = run.integrate_at(&times, |state| see(&mut seen, state));
            (outcome.map(|_| ()), seen)
        });
        macro_rules! of {
            ($width:expr, $ensemble:expr) => {
                let ensemble = $ensemble;
                let mut rows = Vec::new();
                ensemble.integrate_to(time + 20.3, keep(&mut rows, 0));
                assert_eq!(rows, ends, "{}, {} lanes, to an end", $what, $width);
                let mut rows = Vec::new();
                ensemble.integrate_at(&times, |_| Vec::new(), see, keep(&mut rows, 0));
                assert_eq!(rows, seen, "{}, {} lanes, at times", $what, $width);
            };
        }
        of!(1, $make.one_by_one());
        of!(2, $make.in_lanes::<F64x2>());
        of!(4, $make.in_lanes::<F64x4>());
        of!(8, $make.in_lanes::<F64x8>());
    };
}

#[test]
#[ignore = "thorough"]
fn trajectories_of_run_time_tableaux_have_the_bits_of_single_runs() {
    // Some of them escape, in their lane.
    let starts = starts(21, 6);
    for tableau in [
        tableau(StoermerVerlet),
        tableau(ForestRuth),
        tableau(Yoshida6),
        tableau(Gauss4),
    ] {
        let name = tableau.name().to_owned();
        check!(
            name,
            starts,
            Ensemble::new(tableau.clone(), SYSTEM, starts.clone(), 0.1).expect("starts"),
            |start| Integrator::new(tableau.clone(), SYSTEM, start, 0.1)
        );
        check!(
            name,
            starts,
            Ensemble::plain(tableau.clone(), SYSTEM, starts.clone(), 0.1).expect("starts"),
            |start| Integrator::plain(tableau.clone(), SYSTEM, start, 0.1)
        );
    }
    let escaped = alone(
        &starts,
        |start| Integrator::new(tableau(ForestRuth), SYSTEM, start, 0.1),
        |run| (run.integrate_to(20.8).map(|_| ()), ()),
    );
    assert!(escaped.iter().any(|(bits, ())| bits.outcome.is_err()));
    assert!(escaped.iter().any(|(bits, ())| bits.outcome.is_ok()));
}

/// Lanes of a system that counts what it is asked for: an explicit tableau asks for eight trajectories at once.
#[derive(Clone, Copy)]
struct Counted<'a>(&'a std::sync::atomic::AtomicUsize);

impl SeparableHamiltonian for Counted<'_> {
    type Vector<T: Scalar> = SVector<T, 2>;

    fn velocity<T: Scalar>(&self, _time: T, p: &SVector<T, 2>, velocity: &mut SVector<T, 2>) {
        *velocity = *p;
    }

    fn force<T: Scalar>(&self, _time: T, q: &SVector<T, 2>, force: &mut SVector<T, 2>) {
        self.0.fetch_add(1, std::sync::atomic::Ordering::Relaxed);
        *force = -q;
    }
}

#[test]
fn explicit_tableaux_go_side_by_side() {
    let count = |in_lanes: bool| {
        let calls = std::sync::atomic::AtomicUsize::new(0);
        let ensemble = Ensemble::new(tableau(ForestRuth), Counted(&calls), starts(16, 100), 0.1);
        let mut ensemble = ensemble.expect("starts");
        if !in_lanes {
            ensemble = ensemble.one_by_one();
        }
        ensemble.take_steps(100, |_| std::ops::ControlFlow::Continue(()));
        calls.into_inner()
    };
    let (alone, together) = (count(false), count(true));
    assert!(alone >= 16 * 300, "{alone}");
    // Beside the steps, every start is looked at in lanes and alone.
    assert!(together < alone / 8 + 100, "{together} beside {alone}");
}

#[test]
fn ends_are_those_of_the_emitted_method() {
    let starts = starts(12, 100);
    let mut emitted = Vec::new();
    let ensemble = Ensemble::new(ForestRuth, SYSTEM, starts.clone(), 0.05).expect("starts");
    ensemble.integrate_to(20.0, |row| {
        emitted.push(row.state);
        std::ops::ControlFlow::Continue(())
    });
    let mut found = Vec::new();
    let ensemble =
        Ensemble::new(tableau(ForestRuth), SYSTEM, starts.clone(), 0.05).expect("starts");
    ensemble.integrate_to(20.0, |row| {
        found.push(row.state);
        std::ops::ControlFlow::Continue(())
    });
    assert_eq!(found.len(), starts.len());
    for (emitted, found) in emitted.iter().zip(&found) {
        // 390 steps with a rounding error each.
        assert!(distance(emitted, found) < 1e-13, "{emitted:?} {found:?}");
    }
    // Another method is farther away by its error.
    let mut other = Vec::new();
    let ensemble = Ensemble::new(tableau(StoermerVerlet), SYSTEM, starts, 0.05);
    ensemble.expect("starts").integrate_to(20.0, |row| {
        other.push(row.state);
        std::ops::ControlFlow::Continue(())
    });
    assert!(distance(&other[0], &found[0]) > 1e-6);
}

/// H = p⁴/4 + q²/2
#[derive(Clone, Copy, Debug)]
struct Quartic;

impl SeparableHamiltonian for Quartic {
    type Vector<T: Scalar> = SVector<T, 1>;

    fn velocity<T: Scalar>(&self, _time: T, p: &SVector<T, 1>, velocity: &mut SVector<T, 1>) {
        velocity[0] = p[0] * p[0] * p[0];
    }

    fn force<T: Scalar>(&self, _time: T, q: &SVector<T, 1>, force: &mut SVector<T, 1>) {
        *force = -q;
    }
}

#[test]
fn methods_for_other_systems_are_refused() {
    let starts = || vec![State::from_arrays(0.0, [0.4], [0.3]); 3];
    let nystrom = tableau(McLachlanAtela);
    let error = Ensemble::new(nystrom.clone(), Quartic, starts(), 0.1).expect_err("not quadratic");
    let expected = matches!(
        error,
        EnsembleError::Start {
            trajectory: 0,
            error: Error::NotQuadraticKinetic { .. }
        }
    );
    assert!(expected, "{error:?}");
    let accepted = nystrom.accept_lower_order();
    Ensemble::new(accepted.clone(), Quartic, starts(), 0.1).expect("of lower order");

    let splitting = tableau(ForestRuth);
    let error = Ensemble::plain(splitting.clone(), Product, starts(), 0.1);
    let expected = EnsembleError::All(Error::SeparableTableau {
        order: 4,
        lower_order: splitting.orders().general,
    });
    assert_eq!(error.expect_err("not separable"), expected);
    Ensemble::plain(tableau(Gauss4), Product, starts(), 0.1).expect("general");
}

type Run = Ensemble<RunTimeTableau, HenonHeiles, Vector2<f64>>;

#[test]
fn a_checkpoint_knows_its_tableau() {
    let make = |tableau: &RunTimeTableau| -> Run {
        Ensemble::new(tableau.clone(), SYSTEM, starts(20, 7), 0.1).expect("starts")
    };
    let rows = |run: &Run, first| {
        let mut rows: Vec<(Bits, ())> = Vec::new();
        run.integrate_to(10.0, keep(&mut rows, first));
        rows
    };
    let (forest_ruth, verlet) = (tableau(ForestRuth), tableau(StoermerVerlet));
    let checkpoint = make(&forest_ruth).checkpoint(9).expect("f64");
    let mut resumed = make(&forest_ruth);
    resumed.restore(&checkpoint).expect("the same run");
    assert_eq!(rows(&resumed, 9), rows(&make(&forest_ruth), 0)[9..]);
    let error = make(&verlet).restore(&checkpoint);
    assert!(
        matches!(
            error,
            Err(CheckpointError::OtherRun {
                what: "definition",
                ..
            })
        ),
        "{error:?}"
    );
}
