//! Ensembles that cannot be made.

use symplectic::ensemble::{Ensemble, EnsembleError, Histogram};
use symplectic::nalgebra::DVector;
use symplectic::{Error, State};

use crate::common::methods::StoermerVerlet;
use crate::systems::{HenonHeiles, Pendulums, starts};

const SYSTEM: HenonHeiles = HenonHeiles { amplitude: 0.0 };

#[test]
fn the_trajectory_that_cannot_start_is_named() {
    let mut bad = starts(5, 100);
    bad[3].p[1] = f64::NAN;
    let error = Ensemble::new(StoermerVerlet, SYSTEM, bad, 0.1).expect_err("NaN");
    assert!(matches!(
        error,
        EnsembleError::Start {
            trajectory: 3,
            error: Error::NonFiniteState { .. }
        }
    ));
    assert!(error.to_string().starts_with("trajectory 3: "), "{error}");

    let vector = |dimension: usize| DVector::from_element(dimension, 0.1);
    let uneven = [2, 2, 3].map(|n| State::new(0.0, vector(n), vector(n)));
    let error = Ensemble::new(StoermerVerlet, Pendulums, uneven.to_vec(), 0.1);
    let expected = EnsembleError::Dimension {
        trajectory: 2,
        found: 3,
        expected: 2,
    };
    assert_eq!(error.expect_err("uneven"), expected);
    let halves = vec![State::new(0.0, vector(2), vector(1))];
    let error = Ensemble::new(StoermerVerlet, Pendulums, halves, 0.1);
    assert!(matches!(
        error.expect_err("q and p differ"),
        EnsembleError::Start {
            trajectory: 0,
            error: Error::Dimension { .. }
        }
    ));
}

#[test]
fn an_ensemble_refuses_empty_starts_bad_step_sizes_and_bad_parts() {
    let error = Ensemble::new(StoermerVerlet, SYSTEM, starts(0, 100), 0.1);
    assert_eq!(error.expect_err("empty"), EnsembleError::Empty);
    for size in [f64::NAN, 0.0, f64::INFINITY] {
        let error = Ensemble::new(StoermerVerlet, SYSTEM, starts(2, 100), size);
        assert!(matches!(
            error.expect_err("no step size"),
            EnsembleError::All(Error::StepSize { .. })
        ));
    }
    for (part, count) in [(0, 0), (3, 3)] {
        let ensemble = Ensemble::new(StoermerVerlet, SYSTEM, starts(2, 100), 0.1);
        let ensemble = ensemble.expect("starts");
        for error in [ensemble.to_shard(part, count), ensemble.shard(part, count)] {
            assert_eq!(
                error.expect_err("no part"),
                EnsembleError::Shard { part, count }
            );
        }
    }
}

#[test]
fn a_histogram_refuses_bad_bins_and_limits() {
    for (low, high, bins) in [
        (0.0, 1.0, 0),
        (0.0, 1.0, usize::MAX),
        (1.0, 1.0, 3),
        (f64::NAN, 1.0, 3),
    ] {
        let error = Histogram::new(low, high, bins).expect_err("no bins");
        assert!(matches!(error, EnsembleError::Histogram { .. }), "{error}");
    }
}
