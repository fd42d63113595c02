//! Poincaré's transformation of time.

use std::f64::consts::TAU;

use symplectic::adaptive::{DistancePower, Error, Monitor, Poincare};
use symplectic::nalgebra::{SVector, Vector2, Vector3};
use symplectic::system::Conservative;
use symplectic::{Event, General, Hamiltonian, Integrator, Method, ProvedFor, Scalar, State};

use super::kepler::{
    Gauss1, Gauss2, Gauss5, Kepler, Pulsating, assert_order, energy, pericentre, position,
};

/// `|q|^{3/2}`, the derivatives of which are left to dual numbers.
struct ByDuals;

impl Monitor for ByDuals {
    fn value<T: Scalar>(&self, q: &[T]) -> T {
        DistancePower(1.5).value(q)
    }
}

/// The position at a time, by steps of a size in τ.
fn at<M, S, W>(
    method: M,
    (system, monitor): (S, W),
    end: f64,
    size: f64,
) -> Result<Vector2<f64>, Error>
where
    M: Method + ProvedFor<General>,
    S: Hamiltonian<Class: Conservative, Vector<f64> = Vector2<f64>>,
    W: Monitor,
{
    let poincare = Poincare::new(system, monitor);
    let start: State<Vector3<f64>> = poincare.extend(&pericentre(0.9))?;
    let mut run = Integrator::new(method, poincare, start, size)?;
    let arrival = Event::rising(|state: &State<Vector3<f64>>| state.q[2] - end).by_steps();
    let found = run.find_event(1e3, &arrival)?.expect("time goes on");
    Ok(run.system().reduce(&found)?.q)
}

#[test]
fn poincare_steps_have_the_order_of_the_method() -> Result<(), Error> {
    fn errors<M, W>(method: M, monitor: fn() -> W, size: f64) -> Vec<f64>
    where
        M: Method + Copy + ProvedFor<General>,
        W: Monitor,
    {
        let sizes = [size, size / 2.0, size / 4.0];
        let errors = sizes.map(|size| {
            let found = at(method, (Kepler, monitor()), 1.0, size).expect("steps");
            (found - position(0.9, 1.0)).norm()
        });
        errors.to_vec()
    }
    let power = || DistancePower(1.5);
    assert_order("Gauss 1", 2.0, &errors(Gauss1, power, 0.1));
    assert_order("Gauss 2", 4.0, &errors(Gauss2, power, 0.1));
    assert_order("Gauss 2", 4.0, &errors(Gauss2, || ByDuals, 0.1));
    Ok(())
}

#[test]
fn the_energy_of_a_long_run_stays() -> Result<(), Error> {
    let poincare = Poincare::new(Kepler, ByDuals);
    let start: State<Vector3<f64>> = poincare.extend(&pericentre(0.9))?;
    let mut run = Integrator::new(Gauss2, poincare, start, 0.1)?;
    let mut spreads = [0.0_f64; 2];
    for (spread, end) in spreads.iter_mut().zip([TAU, 50.0 * TAU]) {
        while run.state().q[2] < end {
            run.step()?;
            *spread = spread.max((energy(run.state()) + 0.5).abs());
        }
    }
    assert!(
        spreads[0] > 1e-9 && spreads[1] < 1.5 * spreads[0],
        "{spreads:?}"
    );
    Ok(())
}

#[test]
fn the_hamiltonian_may_depend_on_time() -> Result<(), Error> {
    let mut fine = Integrator::new(Gauss5, Pulsating, pericentre(0.9), 1e-3)?;
    let expected = fine.integrate_to(1.5)?.q;
    let errors = [0.1, 0.05, 0.025].map(|size| {
        let found = at(Gauss2, (Pulsating, ByDuals), 1.5, size).expect("steps");
        (found - expected).norm()
    });
    assert_order("pulsating", 4.0, &errors);
    Ok(())
}

symplectic::hamiltonian! {
    /// Not separable.
    Product
    q: [x], p: [px];
    H = (x^2 + 1) (px^2 + 1)/2
}

/// `1/(1 + x²)`
struct Bell;

impl Monitor for Bell {
    fn value<T: Scalar>(&self, q: &[T]) -> T {
        (T::one() + q[0] * q[0]).recip()
    }
}

#[test]
fn a_general_hamiltonian_has_the_same_motion() -> Result<(), Error> {
    let start = State::from_arrays(0.0, [1.0], [0.5]);
    let mut fine = Integrator::new(Gauss5, Product, start.clone(), 1e-2)?;
    let expected = fine.integrate_to(2.0)?.clone();
    let errors = [0.025, 0.0125, 0.00625].map(|size| {
        let poincare = Poincare::new(Product, Bell);
        let start: State<SVector<f64, 2>> = poincare.extend(&start).expect("a start");
        let mut run = Integrator::new(Gauss2, poincare, start, size).expect("a run");
        let arrival = Event::rising(|state: &State<SVector<f64, 2>>| state.q[1] - 2.0).by_steps();
        let found = run
            .find_event(1e3, &arrival)
            .expect("steps")
            .expect("time goes on");
        let found = run.system().reduce(&found).expect("a state");
        (found.q - expected.q).norm() + (found.p - expected.p).norm()
    });
    assert_order("product", 4.0, &errors);
    Ok(())
}

/// Positive for x < 1/2 only.
struct Half;

impl Monitor for Half {
    fn value<T: Scalar>(&self, q: &[T]) -> T {
        T::from_f64(0.5) - q[0]
    }
}

#[test]
fn a_monitor_that_is_not_positive_is_an_error() -> Result<(), Error> {
    let poincare = Poincare::new(Product, Half);
    let outside = State::from_arrays(3.0, [1.0], [0.5]);
    let refused: Result<State<SVector<f64, 2>>, _> = poincare.extend(&outside);
    assert_eq!(
        refused,
        Err(Error::Core(symplectic::Error::Monitor {
            time: 3.0,
            value: -0.5
        }))
    );

    let start: State<SVector<f64, 2>> = poincare.extend(&State::from_arrays(3.0, [0.0], [5.0]))?;
    fails(Gauss1, &start)?;
    fails(Gauss2, &start)?;
    Ok(())
}

/// The step ends with the value of the monitor, also where other stages are NaN after it.
fn fails<M>(method: M, start: &State<SVector<f64, 2>>) -> Result<(), Error>
where
    M: Method + ProvedFor<General>,
{
    let poincare = Poincare::new(Product, Half);
    let mut run = Integrator::new(method, poincare, start.clone(), 1.0)?;
    let error = run.step().err();
    assert!(
        matches!(error, Some(symplectic::Error::Monitor { time: 3.0, .. })),
        "{error:?}"
    );
    assert_eq!(run.state(), start);
    Ok(())
}
