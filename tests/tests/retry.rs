//! Steps that fail and are taken again in parts.

use symplectic::nalgebra::{Vector1, Vector2};
use symplectic::{Error, Integrator, Retry, Separable, State, System, separable};
use symplectic_tests::methods::{Gauss4, Gauss8};
use symplectic_tests::scenes::kepler::{Kepler, start};

/// An oscillator that is stiff for a while: ω² = 1 + 2500 exp(−(t − 5)²).
fn stiff_for_a_while() -> impl System<Vector1<f64>, Class = Separable> {
    separable::<Vector1<f64>, _, _>(
        |_, p, velocity| *velocity = *p,
        |time, q, force| *force = -q * (1.0 + 2500.0 * (-(time - 5.0) * (time - 5.0)).exp()),
    )
}

#[test]
fn split_steps_pass_a_stiff_interval() -> Result<(), Error> {
    const END: f64 = 10.0;
    let begin = || State::new(0.0, Vector1::new(1.0), Vector1::new(0.0));
    let mut fine = Integrator::new(Gauss8, stiff_for_a_while(), begin(), 1.0 / 64.0)?;
    let reference = fine.integrate_to(END)?.clone();

    let mut integrator = Integrator::new(Gauss8, stiff_for_a_while(), begin(), 0.25)?;
    let error = integrator.integrate_to(END).map(|_| ()).expect_err("stiff");
    assert!(matches!(error, Error::NoConvergence { .. }), "{error}");
    let stopped = integrator.state().time;
    assert!(stopped > 3.0 && stopped < 5.0, "{stopped}");
    // It goes on from where it stopped.
    integrator.set_retry(Retry::Split { halvings: 4 });
    integrator.integrate_to(END)?;
    let statistics = *integrator.statistics();
    assert!(statistics.rejected > 2 && statistics.steps >= 40 + statistics.rejected);
    let distance = (integrator.state().q - reference.q).norm();
    // A part has hω ≈ 6 at the most, a whole oscillation.
    assert!(distance < 1e-3, "{distance:e}");
    // The times are those of whole steps.
    let mut whole = Integrator::new(Gauss8, stiff_for_a_while(), begin(), 0.25)?;
    whole.set_retry(Retry::Split { halvings: 4 });
    let times: Result<Vec<f64>, Error> = whole
        .states()
        .take(40)
        .map(|state| state.map(|state| state.time))
        .collect();
    let expected: Vec<f64> = (1..=40).map(|step| f64::from(step) * 0.25).collect();
    assert_eq!(times?, expected);
    assert_eq!(whole.state(), integrator.state());
    Ok(())
}

#[test]
fn a_failed_retry_leaves_state_and_statistics_unchanged() -> Result<(), Error> {
    // Straight into the centre.
    let begin = State::new(0.0, Vector2::new(1.0, 0.0), Vector2::new(0.0, 0.0));
    let mut integrator = Integrator::new(Gauss4, Kepler, begin, 0.05)?;
    integrator.set_retry(Retry::Split { halvings: 3 });
    let error = loop {
        let before = (integrator.state().clone(), *integrator.statistics());
        let remainder = (*integrator.remainder().0, *integrator.remainder().1);
        if let Err(error) = integrator.step() {
            assert_eq!(integrator.state(), &before.0);
            assert_eq!(integrator.statistics(), &before.1);
            assert_eq!(integrator.remainder(), (&remainder.0, &remainder.1));
            break error;
        }
        assert!(integrator.state().time < 2.0, "through the centre");
    };
    // The error is that of the whole step.
    let (Error::NoConvergence { step_size, .. } | Error::NonFinite { step_size, .. }) = error
    else {
        panic!("{error}");
    };
    assert_eq!(step_size, 0.05);
    Ok(())
}

#[test]
fn a_step_that_goes_well_is_not_split() -> Result<(), Error> {
    let mut with = Integrator::new(Gauss4, Kepler, start::<f64>(0.3), 0.1)?;
    with.set_retry(Retry::Split { halvings: u32::MAX });
    let mut without = Integrator::new(Gauss4, Kepler, start::<f64>(0.3), 0.1)?;
    for _ in 0..100 {
        assert_eq!(with.step()?, without.step()?);
    }
    assert_eq!(with.statistics(), without.statistics());
    Ok(())
}
