//! Kepler's problem with eccentricity 0.6 against its closed form, over 20 periods.

use symplectic::nalgebra::{SVector, Vector2};
use symplectic::{Error, Method, SeparableHamiltonian, State};
use symplectic_tests::measure::{integrate, largest, observe, position_error};
use symplectic_tests::methods::{Gauss4, Gauss8, Lobatto3, StoermerVerlet};
use symplectic_tests::order::ObservedOrder;
use symplectic_tests::scenes::kepler::{Kepler, angular_momentum, exact, start};

const ECCENTRICITY: f64 = 0.6;

const END: f64 = 125.0;

/// Runs with 1/`rates` as step sizes: the errors of position and energy fall with `order`, and the latter does not grow.
fn check<M: Method + Copy>(
    method: M,
    order: f64,
    tolerance: f64,
    rates: &[f64],
) -> Result<(), Error> {
    let reference = exact(ECCENTRICITY, END);
    let (mut positions, mut energies) = (Vec::new(), Vec::new());
    for rate in rates {
        let run = observe(
            method,
            &Kepler,
            &start(ECCENTRICITY),
            END,
            rate.recip(),
            |_| {},
        )?;
        assert_eq!(run.steps as f64, END * rate);
        positions.push((rate.recip(), position_error(&run.end, &reference)));
        energies.push((rate.recip(), run.energy_error()));
        // Every quarter holds five pericentres, where the error has its peaks.
        let [first, _, _, last] = run.energy_errors;
        assert!(
            last < 1.25 * first && last > 0.8 * first,
            "{rate}: {:?}",
            run.energy_errors
        );
    }
    let order_of_positions = ObservedOrder::of(&positions);
    assert!(
        order_of_positions.shows(order, tolerance),
        "{} positions: {order_of_positions}",
        M::NAME
    );
    // The peak at the pericentre may fall between two steps.
    let order_of_energies = ObservedOrder::of(&energies);
    assert!(
        order_of_energies.shows(order, 1.5 * tolerance),
        "{} energies: {order_of_energies}",
        M::NAME
    );
    Ok(())
}

#[test]
fn stoermer_verlet_has_order_2() -> Result<(), Error> {
    check(StoermerVerlet, 2.0, 0.1, &[256.0, 512.0, 1024.0])
}

#[test]
fn lobatto_3_has_order_4() -> Result<(), Error> {
    check(Lobatto3, 4.0, 0.1, &[32.0, 64.0, 128.0, 256.0])
}

#[test]
fn gauss_4_has_order_8() -> Result<(), Error> {
    // Rounding, 1e-13 or so after 125 time units, is two orders of magnitude below the last error.
    check(Gauss4, 8.0, 0.25, &[20.0, 24.0, 28.0, 32.0, 40.0])
}

/// The angular momentum is bilinear in (q, p): a symplectic partitioned method conserves it exactly, so what is lost is
/// rounding. A step rounds q and p by a few ε/2, all with one sign at worst.
fn conserves<M: Method + Copy>(method: M, step_size: f64) -> Result<(), Error> {
    let start = start(ECCENTRICITY);
    let before: f64 = angular_momentum(&start);
    let (mut error, mut scale) = (0.0_f64, 0.0_f64);
    let run = observe(method, &Kepler, &start, END, step_size, |state| {
        error = largest(error, (angular_momentum(state) - before).abs());
        scale = scale.max(state.q.norm() * state.p.norm());
    })?;
    let bound = 2.0 * f64::EPSILON * run.steps as f64;
    assert!(error <= bound * scale, "{}: {error:e} of {scale}", M::NAME);
    // The bound is worth something: the energy is not conserved to it.
    assert!(
        run.energy_error() > 1000.0 * bound,
        "{}: {:e}",
        M::NAME,
        run.energy_error()
    );
    Ok(())
}

#[test]
fn the_angular_momentum_is_conserved_to_rounding() -> Result<(), Error> {
    conserves(Gauss4, 0.125)?;
    conserves(Lobatto3, 0.03125)?;
    conserves(StoermerVerlet, 0.03125)
}

#[test]
fn the_closed_form_solves_the_equations() -> Result<(), Error> {
    for eccentricity in [0.0, 0.3, 0.6, 0.9] {
        for time in [0.01, 0.5, 3.0, 3.3, 6.2, 40.0, -2.0] {
            // Central differences are off by h²/6 times third derivatives, which on a Kepler orbit are sums of a few
            // terms no larger than 1 + |q|⁻⁵.
            let h = 1e-4;
            let slope = |part: fn(State<Vector2<f64>>) -> Vector2<f64>| {
                (part(exact(eccentricity, time + h)) - part(exact(eccentricity, time - h)))
                    / (2.0 * h)
            };
            let State { q, p, .. } = exact(eccentricity, time);
            let mut force = SVector::zeros();
            SeparableHamiltonian::force(&Kepler, time, &q, &mut force);
            let bound = 10.0 * h * h * (1.0 + q.norm().powi(-5));
            let (dq, dp) = (slope(|state| state.q) - p, slope(|state| state.p) - force);
            assert!(
                dq.norm() < bound && dp.norm() < bound,
                "{eccentricity} {time}: {dq} {dp}"
            );
        }
    }
    Ok(())
}

#[test]
fn the_closed_form_is_the_limit_of_fine_runs() -> Result<(), Error> {
    // Order 16 in 2500 steps is down to rounding: 50 ε in the energy, by which the phase is off by 125 · 1.5 · 50 ε.
    for eccentricity in [0.3, ECCENTRICITY] {
        let fine = integrate(Gauss8, Kepler, &start(eccentricity), END, 0.05)?;
        let distance = position_error(&fine, &exact(eccentricity, END));
        assert!(
            distance < 125.0 * 1.5 * 50.0 * f64::EPSILON,
            "{eccentricity}: {distance:e}"
        );
    }
    Ok(())
}

#[test]
fn the_orbit_is_the_one_of_semi_major_axis_1() {
    let State { time, q, p } = start::<f64>(ECCENTRICITY);
    assert_eq!(Kepler.energy(time, &q, &p), Some(-0.5));
    assert_eq!(angular_momentum(&start::<f64>(ECCENTRICITY)), 0.8);
}
