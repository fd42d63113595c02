//! Displacements of an orbit with steps of variable size.

use symplectic::adaptive::{AdaptiveSteps, DistancePower, Monitor};
use symplectic::nalgebra::{SVector, Vector2};
use symplectic::tangent::{Error, Tangent};
use symplectic::{Scalar, State};

use super::kepler::{ForestRuth, Kepler, VelocityVerlet, pericentre};

/// `|q|^{3/2}`, its derivative by dual numbers.
#[derive(Clone, Copy)]
struct Power;

impl Monitor for Power {
    fn value<T: Scalar>(&self, q: &[T]) -> T {
        DistancePower(1.5).value(q)
    }
}

/// (q', p') at a state.
fn rates(state: &State<Vector2<f64>>) -> (Vector2<f64>, Vector2<f64>) {
    (state.p, -state.q / state.q.norm().powi(3))
}

fn start(displacement: f64) -> Result<State<SVector<f64, 4>>, Error> {
    let state = pericentre(0.9);
    let (dq, dp) = rates(&state);
    Tangent::new(Kepler).start(&state, (&(dq * displacement), &(dp * displacement)))
}

#[test]
fn a_displacement_does_not_choose_the_steps() -> Result<(), Error> {
    fn check<W: Monitor + Copy>(monitor: W) -> Result<(), Error> {
        let tangent = Tangent::new(Kepler);
        let method = VelocityVerlet;
        let mut alone = AdaptiveSteps::run(method, Kepler, monitor, pericentre(0.9), 0.05)?;
        for displacement in [1e-3, 1.0, 1e3] {
            let start = start(displacement)?;
            let mut run = AdaptiveSteps::run(method, tangent, monitor, start, 0.05)?;
            alone.set_state(pericentre(0.9))?;
            run.take_steps(300)?;
            alone.take_steps(300)?;
            assert_eq!(&tangent.state(run.state())?, alone.state());
            assert_eq!(run.step_size(), alone.step_size());
            assert_eq!(run.steps(), 300);
            // From another state on.
            run.set_state(self::start(displacement)?)?;
            alone.set_state(pericentre(0.9))?;
            assert_eq!(run.step()?.time, alone.step()?.time);
        }
        assert_eq!(alone.steps(), 903);
        Ok(())
    }
    check(DistancePower(1.5))?;
    check(Power)
}

/// A displacement along the flow stays along the flow, to the order of the method.
#[test]
fn a_displacement_solves_the_variational_equations() -> Result<(), Error> {
    let tangent = Tangent::new(Kepler);
    let error = |epsilon: f64, steps: u64| -> Result<f64, Error> {
        let monitor = DistancePower(1.5);
        let mut run = AdaptiveSteps::run(ForestRuth, tangent, monitor, start(1.0)?, epsilon)?;
        run.take_steps(steps)?;
        let (dq, dp) = tangent.displacement(run.state())?;
        let (q, p) = rates(&tangent.state(run.state())?);
        Ok((dq - q).norm() + (dp - p).norm())
    };
    let slope = (error(0.02, 400)? / error(0.01, 800)?).log2();
    assert!((slope - 4.0).abs() < 0.2, "{slope}");
    Ok(())
}

#[test]
fn a_run_with_a_displacement_goes_on() -> Result<(), Box<dyn std::error::Error>> {
    let run = |epsilon: f64| {
        let (tangent, monitor) = (Tangent::new(Kepler), DistancePower(1.5));
        AdaptiveSteps::run(VelocityVerlet, tangent, monitor, start(1.0)?, epsilon)
    };
    let mut whole = run(0.05)?;
    whole.take_steps(37)?;
    let mut resumed = run(0.1)?;
    resumed.restore(&whole.checkpoint()?)?;
    assert_eq!(resumed.take_steps(50)?, whole.take_steps(50)?);
    assert_eq!(resumed.integrate_to(10.0)?, whole.integrate_to(10.0)?);
    Ok(())
}
