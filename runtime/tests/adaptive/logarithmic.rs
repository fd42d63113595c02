//! The logarithmic Hamiltonian.

use symplectic::adaptive::{Error, Logarithmic};
use symplectic::nalgebra::{DVector, SVector, Vector2, Vector3};
use symplectic::{Event, Hamiltonian, Integrator, Method, ProvedFor, Separable, State, System};

use super::kepler::{
    ForestRuth, Gauss5, Kepler, McLachlanAtela, PositionJump, PositionVerlet, Pulsating,
    VelocityVerlet, assert_order, energy, laplace, pericentre, position,
};

/// The state at a time, by steps of a size in τ.
fn at<M, S>(method: M, system: S, end: f64, size: f64) -> Result<State<Vector2<f64>>, Error>
where
    M: Method + ProvedFor<Separable>,
    S: Hamiltonian<Class = Separable, Vector<f64> = Vector2<f64>>,
{
    let logarithmic = Logarithmic::new(system);
    let start: State<Vector3<f64>> = logarithmic.extend(&pericentre(0.9))?;
    let mut run = Integrator::new(method, logarithmic, start, size)?;
    let arrival = Event::rising(|state: &State<Vector3<f64>>| state.q[2] - end).by_steps();
    let found = run.find_event(1e3, &arrival)?.expect("time goes on");
    run.system().reduce(&found)
}

/// The largest errors of the energy, the angular momentum and the Laplace vector in a thousand steps.
fn orbit_error<M: Method + ProvedFor<Separable>>(method: M) -> Result<f64, Error> {
    let logarithmic = Logarithmic::new(Kepler);
    let start: State<Vector3<f64>> = logarithmic.extend(&pericentre(0.9))?;
    let mut run = Integrator::new(method, logarithmic, start, 0.05)?;
    let (momentum, vector) = laplace(&pericentre(0.9));
    let mut worst = 0.0_f64;
    for _ in 0..1000 {
        run.step()?;
        let state = run.system().reduce(run.state())?;
        let (found, laplace) = laplace(&state);
        let error = (found - momentum).abs() + (laplace - vector).norm();
        worst = worst.max(error + (energy(&state) + 0.5).abs());
    }
    Ok(worst)
}

#[test]
fn compositions_of_position_verlet_have_the_exact_kepler_orbit() -> Result<(), Error> {
    // 1000 steps of rounding, with terms of size 10 at the pericentre.
    assert!(orbit_error(PositionVerlet)? < 1e-12);
    assert!(orbit_error(PositionJump)? < 1e-12);
    // Beginning with a kick, the orbit has the error of the method.
    assert!(orbit_error(VelocityVerlet)? > 1e-3);
    assert!(orbit_error(ForestRuth)? > 1e-5);
    Ok(())
}

#[test]
fn logarithmic_steps_have_the_order_of_the_method() -> Result<(), Error> {
    fn errors<M: Method + Copy + ProvedFor<Separable>>(
        method: M,
        size: f64,
    ) -> Result<Vec<f64>, Error> {
        let sizes = [size, size / 2.0, size / 4.0].into_iter();
        let errors =
            sizes.map(|size| Ok((at(method, Kepler, 1.0, size)?.q - position(0.9, 1.0)).norm()));
        errors.collect()
    }
    assert_order("leapfrog", 2.0, &errors(PositionVerlet, 0.05)?);
    assert_order("leapfrog", 2.0, &errors(VelocityVerlet, 0.05)?);
    assert_order("triple jump", 4.0, &errors(PositionJump, 0.025)?);
    assert_order("Forest–Ruth", 4.0, &errors(ForestRuth, 0.025)?);
    let nystrom = McLachlanAtela.accept_lower_order();
    assert_order("Nyström", 3.0, &errors(nystrom, 0.05)?);
    Ok(())
}

#[test]
fn methods_for_quadratic_kinetic_energies_are_refused() -> Result<(), Error> {
    let logarithmic = Logarithmic::new(Kepler);
    let start: State<Vector3<f64>> = logarithmic.extend(&pericentre(0.5))?;
    let made = Integrator::new(McLachlanAtela, logarithmic, start, 0.1);
    assert!(matches!(
        made.err(),
        Some(symplectic::Error::NotQuadraticKinetic {
            order: 4,
            lower_order: 3,
            ..
        })
    ));
    Ok(())
}

#[test]
fn the_potential_may_depend_on_time() -> Result<(), Error> {
    // The same motion by steps of one size in t.
    let mut fine = Integrator::new(Gauss5, Pulsating, pericentre(0.9), 1e-3)?;
    let expected = fine.integrate_to(1.5)?;
    let errors = [0.05, 0.025, 0.0125].map(|size| {
        let found = at(ForestRuth, Pulsating, 1.5, size).expect("steps");
        (found.q - expected.q).norm()
    });
    assert_order("pulsating", 4.0, &errors[1..]);
    assert!(errors[2] < 1e-5, "{errors:?}");
    Ok(())
}

#[test]
fn dynamic_vectors_have_one_component_more_too() -> Result<(), Error> {
    let fixed = Logarithmic::new(Kepler);
    let start: State<Vector3<f64>> = fixed.extend(&pericentre(0.9))?;
    let dynamic: State<DVector<f64>> = fixed.extend(&pericentre(0.9))?;
    let mut fixed = Integrator::new(ForestRuth, fixed, start, 0.05)?;
    let mut heap = Integrator::new(ForestRuth, Logarithmic::new(Kepler), dynamic, 0.05)?;
    fixed.take_steps(100)?;
    heap.take_steps(100)?;
    assert_eq!(fixed.state().q.as_slice(), heap.state().q.as_slice());
    assert_eq!(fixed.energy(), heap.energy());
    let short: Result<State<Vector2<f64>>, _> = Logarithmic::new(Kepler).extend(&pericentre(0.9));
    assert_eq!(
        short,
        Err(Error::Core(symplectic::Error::Length {
            expected: 2,
            found: 3
        }))
    );
    Ok(())
}

symplectic::hamiltonian! {
    /// U < 0 for |x| < 1 only.
    Well
    q: [x], p: [px];
    H = px^2/2 + (x^2 - 1)/2
}

symplectic::hamiltonian! {
    Relativistic
    q: [x], p: [px];
    H = sqrt(1 + px^2) - 1/sqrt(1 + x^2)
}

#[test]
fn the_domain_is_kept_to() -> Result<(), Error> {
    let well = Logarithmic::new(Well);
    let outside = State::from_arrays(2.0, [3.0], [0.0]);
    let refused: Result<State<SVector<f64, 2>>, _> = well.extend(&outside);
    let what = "−U";
    let expected = Error::Core(symplectic::Error::LogarithmicDomain {
        time: 2.0,
        step: 0,
        what,
        value: -4.0,
    });
    assert_eq!(refused, Err(expected));

    // A drift out of the well, in a step that is too long.
    let start: State<SVector<f64, 2>> = well.extend(&State::from_arrays(2.0, [0.0], [3.0]))?;
    let mut run = Integrator::new(PositionVerlet, well, start.clone(), 0.5)?;
    let error = run.step().err();
    // x = p ε/2 / (T + B) = 1.5, with T + B = −U = 1/2.
    let expected = symplectic::Error::LogarithmicDomain {
        time: 2.0,
        step: 1,
        what,
        value: -0.625,
    };
    assert_eq!(error, Some(expected));
    assert_eq!(*run.state(), start);

    // A kick so strong that T + B is negative.
    let well = Logarithmic::new(Well);
    let start: State<SVector<f64, 2>> = well.extend(&State::from_arrays(0.0, [0.9], [3.0]))?;
    let mut run = Integrator::new(VelocityVerlet, well, start, 0.3)?;
    let Some(symplectic::Error::LogarithmicDomain {
        step: 1,
        what: "T + B",
        value,
        ..
    }) = run.step().err()
    else {
        panic!("a step")
    };
    // p = 3 − 0.15 · 0.9/0.095, B = −H.
    let p: f64 = 3.0 - 0.15 * 0.9 / 0.095;
    let expected = p * p / 2.0 - (9.0 / 2.0 - 0.19 / 2.0);
    assert!((value - expected).abs() < 1e-12, "{value} {expected}");

    let relativistic = Logarithmic::new(Relativistic);
    let start = State::from_arrays(0.0, [0.5], [1.0]);
    let refused: Result<State<SVector<f64, 2>>, _> = relativistic.extend(&start);
    assert!(matches!(
        refused,
        Err(Error::LogarithmicMasses { component: 0, .. })
    ));
    Ok(())
}

#[test]
fn an_energy_outside_the_domain_is_not_the_fault_of_a_step() -> Result<(), Error> {
    let logarithmic = Logarithmic::new(Kepler);
    let start: State<Vector3<f64>> = logarithmic.extend(&pericentre(0.9))?;
    let mut run = Integrator::new(PositionVerlet, logarithmic, start, 0.05)?;
    // T + B is negative.
    let (q, p) = (Vector3::new(0.1, 0.0, 0.0), Vector3::new(0.0, 1.0, -9.0));
    let energy = System::energy(run.system(), 0.0, &q, &p);
    assert!(energy.is_some_and(f64::is_nan));
    // The force overflows, and T + B is positive.
    run.set_state(State::from_arrays(
        0.0,
        [1e-200, 0.0, 0.0],
        [0.0, 1.0, 1e300],
    ))?;
    let error = run.step().err();
    assert!(
        matches!(error, Some(symplectic::Error::NonFinite { .. })),
        "{error:?}"
    );
    Ok(())
}
