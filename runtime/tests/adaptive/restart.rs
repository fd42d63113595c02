//! Runs that are interrupted.

use symplectic::adaptive::{AdaptiveSteps, DistancePower, Error};
use symplectic::{CheckpointError, Integrator};

use super::kepler::{Gauss2, Kepler, VelocityVerlet, pericentre};

#[test]
fn a_run_goes_on_with_the_same_bits() -> Result<(), Box<dyn std::error::Error>> {
    let run = |exponent: f64, epsilon: f64| {
        let monitor = DistancePower(exponent);
        AdaptiveSteps::run(Gauss2, Kepler, monitor, pericentre(0.9), epsilon)
    };
    let mut whole = run(1.5, 0.1)?;
    whole.take_steps(37)?;
    let checkpoint = whole.checkpoint()?;
    // Its ε is that of the checkpoint.
    let mut resumed = run(1.5, 0.2)?;
    resumed.restore(&checkpoint)?;
    assert_eq!(resumed.take_steps(100)?, whole.take_steps(100)?);
    assert_eq!(resumed.step_size(), whole.step_size());
    assert_eq!(resumed.checkpoint()?, whole.checkpoint()?);

    let mut copy = whole.clone();
    assert_eq!(copy.take_steps(50)?, whole.take_steps(50)?);

    let mut other = run(1.0, 0.1)?;
    let before = other.state().clone();
    assert_eq!(
        other.restore(&checkpoint),
        Err(CheckpointError::OtherSystem)
    );
    assert_eq!((other.state(), other.stepper().epsilon()), (&before, 0.1));
    Ok(())
}

#[test]
fn another_monitor_of_the_same_value_is_refused() -> Result<(), Error> {
    // |q| = 1 all along.
    let circle = |exponent: f64| {
        let monitor = DistancePower(exponent);
        AdaptiveSteps::run(VelocityVerlet, Kepler, monitor, pericentre(0.0), 0.1)
    };
    let checkpoint = circle(1.5)?.checkpoint().expect("a checkpoint");
    assert_eq!(
        circle(1.0)?.restore(&checkpoint),
        Err(CheckpointError::OtherSystem)
    );
    assert_eq!(circle(1.5)?.restore(&checkpoint), Ok(()));
    Ok(())
}

#[test]
fn checkpoints_of_other_runs_are_refused() -> Result<(), Error> {
    let monitor = DistancePower(1.5);
    let mut adaptive = AdaptiveSteps::run(VelocityVerlet, Kepler, monitor, pericentre(0.9), 0.1)?;
    let mut fixed = Integrator::new(VelocityVerlet, Kepler, pericentre(0.9), 0.1)?;
    let of_adaptive = adaptive.checkpoint().expect("a checkpoint");
    let of_fixed = fixed.checkpoint().expect("a checkpoint");
    for refused in [fixed.restore(&of_adaptive), adaptive.restore(&of_fixed)] {
        let refused = refused.expect_err("of another run");
        assert!(matches!(
            refused,
            CheckpointError::OtherRun { what: "method", .. }
        ));
    }
    Ok(())
}
