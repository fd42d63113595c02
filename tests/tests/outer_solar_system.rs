//! The outer solar system over 200 000 days, 46 revolutions of Jupiter, with methods from the macro.

use std::sync::OnceLock;

use symplectic::nalgebra::SVector;
use symplectic::{Error, Method, State};
use symplectic_tests::measure::{integrate, largest, observe, position_error};
use symplectic_tests::methods::{Gauss4, Gauss8, Lobatto4, StoermerVerlet};
use symplectic_tests::order::ObservedOrder;
use symplectic_tests::scenes::outer_solar_system::{
    BODIES, BODIES_AT_START, COORDINATES, GRAVITATIONAL_CONSTANT, OuterSolarSystem,
    angular_momentum, reference, start, total_momentum,
};

type Point = State<SVector<f64, COORDINATES>>;

const DAYS: f64 = 200_000.0;

/// What the reference may be off by, in AU: see `the_reference_is_good_to_rounding`.
const REFERENCE_ERROR: f64 = 5e-11;

/// The state after [`DAYS`]; one computation for all tests.
fn end() -> Result<&'static Point, Error> {
    static END: OnceLock<Result<Point, Error>> = OnceLock::new();
    END.get_or_init(|| reference(DAYS))
        .as_ref()
        .map_err(Clone::clone)
}

#[test]
fn the_reference_is_good_to_rounding() -> Result<(), Error> {
    // Both step sizes are far below what order 16 needs; what is left is rounding: 1000 steps change the energy by
    // √1000 ε in relative terms, by which Jupiter, 290 radians on at 5 AU, is off by 2e-11.
    for step_size in [100.0, 400.0] {
        let other = integrate(Gauss8, OuterSolarSystem, &start(), DAYS, step_size)?;
        let distance = position_error(&other, end()?);
        assert!(distance < REFERENCE_ERROR, "{step_size}: {distance:e}");
    }
    Ok(())
}

/// Runs with all `step_sizes`: the position error falls with `order`, and the energy error neither grows in time nor
/// differs from `order`.
fn check<M: Method + Copy>(
    method: M,
    order: f64,
    tolerance: f64,
    step_sizes: &[f64],
) -> Result<(), Error> {
    let (mut positions, mut energies) = (Vec::new(), Vec::new());
    for &step_size in step_sizes {
        let run = observe(method, &OuterSolarSystem, &start(), DAYS, step_size, |_| {})?;
        assert_eq!(run.steps as f64, DAYS / step_size);
        let error = position_error(&run.end, end()?);
        assert!(
            error > 10.0 * REFERENCE_ERROR,
            "{step_size} is not above rounding: {error:e}"
        );
        positions.push((step_size, error));
        energies.push((step_size, run.energy_error()));
        // Every quarter holds more than ten revolutions of Jupiter, whose excursions the error follows.
        let [first, _, _, last] = run.energy_errors;
        assert!(
            last < 1.25 * first && last > 0.8 * first,
            "{step_size}: {:?}",
            run.energy_errors
        );
    }
    let order_of_positions = ObservedOrder::of(&positions);
    assert!(
        order_of_positions.shows(order, tolerance),
        "{} positions: {order_of_positions}",
        M::NAME
    );
    let order_of_energies = ObservedOrder::of(&energies);
    assert!(
        order_of_energies.shows(order, tolerance),
        "{} energies: {order_of_energies}",
        M::NAME
    );
    Ok(())
}

#[test]
fn stoermer_verlet_has_order_2_and_bounded_energy() -> Result<(), Error> {
    // 40 days is where the phase error of Jupiter stops being small against a radian.
    check(StoermerVerlet, 2.0, 0.1, &[40.0, 20.0, 10.0, 5.0])
}

#[test]
fn lobatto_4_has_order_6_and_bounded_energy() -> Result<(), Error> {
    check(Lobatto4, 6.0, 0.1, &[400.0, 250.0, 200.0, 125.0, 100.0])
}

#[test]
fn gauss_4_has_order_8_and_bounded_energy() -> Result<(), Error> {
    check(Gauss4, 8.0, 0.2, &[400.0, 250.0, 200.0, 160.0, 125.0])
}

/// Momentum and angular momentum are linear and bilinear in (q, p): a symplectic partitioned method conserves them
/// exactly, so what is lost is rounding. A step rounds a component of the state by a few ε/2, all with one sign at worst.
fn conserves<M: Method + Copy>(method: M, step_size: f64) -> Result<(), Error> {
    let start = start();
    let before = (total_momentum(&start), angular_momentum(&start));
    let norm = |body: usize, v: &SVector<f64, COORDINATES>| v.fixed_rows::<3>(3 * body).norm();
    let (mut p_scale, mut l_scale) = (0.0_f64, 0.0_f64);
    let (mut p_error, mut l_error) = (0.0_f64, 0.0_f64);
    let run = observe(
        method,
        &OuterSolarSystem,
        &start,
        DAYS,
        step_size,
        |state| {
            let now = (total_momentum(state), angular_momentum(state));
            for k in 0..3 {
                p_error = largest(p_error, (now.0[k] - before.0[k]).abs());
                l_error = largest(l_error, (now.1[k] - before.1[k]).abs());
            }
            p_scale = p_scale.max((0..BODIES).map(|i| norm(i, &state.p)).sum());
            l_scale = l_scale.max(
                (0..BODIES)
                    .map(|i| norm(i, &state.q) * norm(i, &state.p))
                    .sum(),
            );
        },
    )?;
    let bound = 2.0 * f64::EPSILON * run.steps as f64;
    assert!(
        p_error <= bound * p_scale,
        "{} momentum: {p_error:e} of {p_scale:e}",
        M::NAME
    );
    assert!(
        l_error <= bound * l_scale,
        "{} angular momentum: {l_error:e} of {l_scale:e}",
        M::NAME
    );
    // The bound is worth something: the energy is not conserved to it.
    assert!(
        run.energy_error() > 100.0 * bound,
        "{}: {:e}",
        M::NAME,
        run.energy_error()
    );
    Ok(())
}

#[test]
fn momentum_and_angular_momentum_are_conserved_to_rounding() -> Result<(), Error> {
    conserves(StoermerVerlet, 40.0)?;
    conserves(Lobatto4, 400.0)?;
    conserves(Gauss4, 400.0)
}

#[test]
fn the_planets_keep_their_semi_major_axes() -> Result<(), Error> {
    // Semi-major axes from the energy of each planet and the Sun, against those of the planets' orbits in AU; the data
    // are osculating, hence the per cent.
    let axes = [5.20, 9.55, 19.2, 30.1, 39.5];
    for state in [&start(), end()?] {
        for (i, axis) in (1..BODIES).zip(axes) {
            let part = |v: &SVector<f64, COORDINATES>, body: usize| {
                SVector::<f64, 3>::from_fn(|k, _| v[3 * body + k])
            };
            let (sun, planet) = (BODIES_AT_START[0].mass, BODIES_AT_START[i].mass);
            let distance = (part(&state.q, i) - part(&state.q, 0)).norm();
            let velocity = part(&state.p, i) / planet - part(&state.p, 0) / sun;
            let attraction = GRAVITATIONAL_CONSTANT * (sun + planet);
            let found = (2.0 / distance - velocity.norm_squared() / attraction).recip();
            assert!(
                (found / axis - 1.0).abs() < 0.03,
                "{}: {found}",
                BODIES_AT_START[i].name
            );
        }
    }
    Ok(())
}
