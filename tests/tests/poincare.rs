//! The Poincaré section of the Hénon–Heiles system at the energy 1/8.

use std::ops::ControlFlow;

use symplectic::nalgebra::Vector2;
use symplectic::{Error, Event, Hamiltonian, Integrator, State};
use symplectic_tests::methods::{Gauss4, Gauss8, StoermerVerlet};
use symplectic_tests::scenes::henon_heiles::{HenonHeiles, on_section};

const ENERGY: f64 = 0.125;

type Point = State<Vector2<f64>>;

fn energy_error(state: &Point) -> f64 {
    let energy = HenonHeiles.energy(state.time, &state.q, &state.p);
    energy.map_or(f64::NAN, |energy| (energy - ENERGY).abs())
}

/// The first points on the section, with Gauss 8 in lanes.
fn section(event: Event<impl Fn(&Point) -> f64>, step_size: f64) -> Result<Vec<Point>, Error> {
    let start = on_section(ENERGY, 0.2, 0.0);
    let mut integrator = Integrator::new(Gauss8, HenonHeiles, start, step_size)?;
    let mut points = Vec::new();
    integrator.integrate_with_events(1000.0, &event, |state| {
        points.push(state.clone());
        match points.len() {
            50 => ControlFlow::Break(()),
            _ => ControlFlow::Continue(()),
        }
    })?;
    Ok(points)
}

fn first(state: &Point) -> f64 {
    state.q[0]
}

#[test]
fn poincare_points_have_the_order_of_the_step_or_of_the_dense_output() -> Result<(), Error> {
    let by_steps = section(Event::rising(first).by_steps(), 0.25)?;
    let dense = section(Event::rising(first), 0.25)?;
    assert_eq!((by_steps.len(), dense.len()), (50, 50));
    let mut largest = [0.0_f64; 3];
    for (by_steps, dense) in by_steps.iter().zip(&dense) {
        assert!(by_steps.p[0] > 0.0 && dense.p[0] > 0.0);
        // Times are rounded to 2 units in the last place of at most 400.
        assert!(by_steps.q[0].abs() < 1e-12 && dense.q[0].abs() < 1e-12);
        let errors = [
            energy_error(by_steps),
            energy_error(dense),
            (by_steps.time - dense.time).abs(),
        ];
        for (largest, error) in largest.iter_mut().zip(errors) {
            *largest = largest.max(error);
        }
    }
    // The method has order 16, the polynomial 9.
    assert!(largest[0] < 1e-13, "{largest:?}");
    assert!(largest[1] < 1e-9 && largest[1] > largest[0], "{largest:?}");
    assert!(largest[2] < 1e-8 && largest[2] > 0.0, "{largest:?}");
    Ok(())
}

/// The points are those of the orbit, whatever the method and the step size.
#[test]
fn points_do_not_depend_on_the_steps() -> Result<(), Error> {
    let reference = section(Event::rising(first).by_steps(), 0.1)?;
    let other = section(Event::rising(first).by_steps(), 0.3)?;
    for (a, b) in reference.iter().zip(&other).take(20) {
        assert!((a.q - b.q).norm() < 1e-11 && (a.p - b.p).norm() < 1e-11);
    }
    fn next<M: symplectic::Method + Copy>(
        method: M,
        step_size: f64,
    ) -> Result<Option<Point>, Error> {
        let start = on_section(ENERGY, 0.2, 0.0);
        let mut integrator = Integrator::new(method, HenonHeiles, start, step_size)?;
        integrator.find_event(100.0, &Event::rising(first).by_steps())
    }
    for (found, bound) in [
        (next(Gauss4, 0.1)?, 1e-10),
        (next(StoermerVerlet, 0.01)?, 1e-3),
    ] {
        let found = found.expect("the orbit comes back");
        assert!((found.time - reference[0].time).abs() < bound);
        assert!((found.q - reference[0].q).norm() < bound);
    }
    Ok(())
}
