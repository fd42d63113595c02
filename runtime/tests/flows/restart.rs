//! Runs of flows that are interrupted.

use symplectic::flow::{Drift, FlowSteps, Kick, Palindrome};
use symplectic::nalgebra::{Vector1, Vector2};
use symplectic::{CheckpointError, Event, Integrator, State, acceleration};

use super::output::{Well, heated};
use crate::common::methods::StoermerVerlet;
use crate::common::systems::point;

#[test]
fn a_run_goes_on_with_the_same_bits() -> Result<(), Box<dyn std::error::Error>> {
    let mut whole = heated(7)?;
    whole.set_step_size(0.07)?;
    for steps in [0, 1, 3, 40] {
        whole.take_steps(steps)?;
        let checkpoint = whole.checkpoint()?;
        assert_eq!(checkpoint, whole.checkpoint()?);
        let mut resumed = heated(7)?;
        resumed.take_steps(5)?;
        resumed.restore(&checkpoint)?;
        assert_eq!(resumed.checkpoint()?, checkpoint);
        let mut copy = whole.clone();
        for other in [&mut resumed, &mut copy] {
            let mut whole = whole.clone();
            // Also inside the step before.
            assert_eq!(
                other.state_at(whole.state().time - 0.03),
                whole.state_at(whole.state().time - 0.03)
            );
            assert_eq!(other.take_steps(10)?, whole.take_steps(10)?);
            assert_eq!(other.integrate_to(7.0)?, whole.integrate_to(7.0)?);
            assert_eq!(other.steps(), whole.steps());
        }
    }
    Ok(())
}

/// A search from an event starts on it; a restored run knows.
#[test]
fn a_restored_run_does_not_find_the_last_event_again() -> Result<(), Box<dyn std::error::Error>> {
    for seed in 0..20 {
        let event = Event::rising(|state: &State<Vector1<f64>>| state.p[0]);
        let mut whole = heated(seed)?;
        let found = whole.find_event(50.0, &event)?.expect("a turn");
        whole.set_state(found.clone())?;
        let checkpoint = whole.checkpoint()?;
        let mut resumed = heated(seed)?;
        resumed.restore(&checkpoint)?;
        assert_eq!(resumed.checkpoint()?, checkpoint);
        assert_eq!(
            resumed.find_event(80.0, &event)?,
            whole.find_event(80.0, &event)?
        );
    }
    Ok(())
}

#[test]
fn checkpoints_of_other_runs_are_refused() -> Result<(), Box<dyn std::error::Error>> {
    let mut run = heated(7)?;
    run.take_steps(3)?;
    let checkpoint = run.checkpoint()?;
    let mut other = heated(8)?;
    other.step()?;
    let before = other.checkpoint()?;
    let refused = other.restore(&checkpoint);
    assert_eq!(refused, Err(CheckpointError::OtherSystem));
    assert_eq!(other.checkpoint()?, before);
    assert_eq!(other.stepper().flow().inner.inner.draws(), 1);

    // It carries nothing: no bath.
    let step = Palindrome::new(Kick::new(Well), Drift::new(Well));
    let mut without = FlowSteps::run(step, point(1.2, 0.3), 0.1)?;
    let refused = without.restore(&checkpoint);
    assert!(matches!(
        refused,
        Err(CheckpointError::OtherRun {
            what: "definition",
            ..
        })
    ));

    let free = || acceleration::<Vector2<f64>, _>(|_, _, _| ());
    let start = State::from_arrays(0.0, [1.0, 2.0], [0.0, 0.0]);
    let mut plane = FlowSteps::run(Drift::new(free()), start, 0.1)?;
    let refused = plane.restore(&without.checkpoint()?);
    assert!(matches!(
        refused,
        Err(CheckpointError::OtherRun {
            what: "dimension",
            ..
        })
    ));

    let mut stages = Integrator::new(StoermerVerlet, Well, point(1.2, 0.3), 0.1)?;
    let refused = stages.restore(&checkpoint);
    assert!(matches!(
        refused,
        Err(CheckpointError::OtherRun { what: "method", .. })
    ));
    Ok(())
}

#[cfg(feature = "serde")]
#[test]
fn a_checkpoint_is_written_and_read() -> Result<(), Box<dyn std::error::Error>> {
    let mut run = heated(7)?;
    run.take_steps(9)?;
    let text = serde_json::to_string(&run.checkpoint()?)?;
    let mut resumed = heated(7)?;
    resumed.restore(&serde_json::from_str(&text)?)?;
    assert_eq!(resumed.take_steps(9)?, run.take_steps(9)?);
    Ok(())
}
