//! Starts of systems with non-holonomic constraints, and systems whose constraints are wrong.

use symplectic::constraints::{Gradients, Nonholonomic, NonholonomicConstraints};
use symplectic::nalgebra::Vector2;
use symplectic::{Error, Integrator, Method, ProvedFor, Separable, State};

use crate::rolling::{Midpoint, Skate};

/// A point in the plane with unit mass and these rows: what each test gets wrong.
#[derive(Clone, Copy)]
struct Point {
    rows: &'static [[f64; 2]],
    /// A row and a component that are not there.
    beyond: Option<(usize, usize)>,
}

const fn point(rows: &'static [[f64; 2]]) -> Point {
    Point { rows, beyond: None }
}

impl symplectic::System<Vector2<f64>> for Point {
    type Class = Rows;
    type Solver = symplectic::solver::FixedPoint;

    fn velocity(&self, _: f64, _: &Vector2<f64>, p: &Vector2<f64>, velocity: &mut Vector2<f64>) {
        *velocity = *p;
    }

    fn force(&self, _: f64, _: &Vector2<f64>, _: &Vector2<f64>, force: &mut Vector2<f64>) {
        *force = Vector2::new(0.0, -1.0);
    }

    fn extra(&self) -> Option<&dyn NonholonomicConstraints<Vector2<f64>>> {
        Some(self)
    }
}

impl NonholonomicConstraints<Vector2<f64>> for Point {
    fn nonholonomic_constraints(&self) -> usize {
        self.rows.len()
    }
    fn nonholonomic_rows(&self, _: &Vector2<f64>, rows: &mut Gradients<f64>) {
        for (constraint, row) in self.rows.iter().enumerate() {
            for (component, &value) in row.iter().enumerate() {
                rows.set(constraint, component, value);
            }
        }
        if let Some((constraint, component)) = self.beyond {
            rows.set(constraint, component, 1.0);
        }
    }
}

fn refused<M: Method + ProvedFor<Rows>>(method: M, system: Point, p: [f64; 2]) -> Error {
    let state = State::from_arrays(0.0, [0.3, 0.4], p);
    match Integrator::new(method, system, state, 0.1) {
        Err(error) => error,
        Ok(_) => panic!("accepted"),
    }
}

type Rows = Nonholonomic<Separable>;

#[test]
fn a_velocity_that_does_not_obey_is_refused() {
    let start = State::from_arrays(0.0, [0.0, 0.0, 0.0], [1.0, 0.25, 0.0]);
    let error = match Integrator::new(Midpoint, Skate { slope: 1.0 }, start, 0.1) {
        Err(error) => error,
        Ok(_) => panic!("accepted"),
    };
    assert_eq!(
        error,
        Error::InconsistentVelocity {
            constraint: 0,
            name: None,
            rate: 0.25
        }
    );
    assert!(
        error
            .to_string()
            .contains("constraints::consistent_momentum(&system, state)"),
        "{error}"
    );
}

#[test]
fn dependent_rows_are_refused() {
    let error = refused(Midpoint, point(&[[1.0, 2.0], [2.0, 4.0]]), [2.0, -1.0]);
    assert!(
        matches!(error, Error::DependentConstraints { constraint: 1, .. }),
        "{error}"
    );
    let error = refused(Midpoint, point(&[[0.0, 0.0]]), [2.0, -1.0]);
    assert!(
        matches!(error, Error::DependentConstraints { constraint: 0, .. }),
        "{error}"
    );
}

#[test]
fn rows_that_are_missing_too_many_or_misplaced_are_refused() {
    let error = refused(Midpoint, point(&[]), [2.0, -1.0]);
    assert!(
        matches!(
            error,
            Error::ConstraintCount {
                constraints: 0,
                dimension: 2
            }
        ),
        "{error}"
    );
    assert!(
        error.to_string().contains("nonholonomic_constraints"),
        "{error}"
    );
    let rows = &[[1.0, 2.0], [1.0, 0.0], [0.0, 1.0]];
    let error = refused(Midpoint, point(rows), [2.0, -1.0]);
    assert!(
        matches!(
            error,
            Error::ConstraintCount {
                constraints: 3,
                dimension: 2
            }
        ),
        "{error}"
    );
    let mut beyond = point(&[[1.0, 2.0]]);
    beyond.beyond = Some((0, 2));
    let error = refused(Midpoint, beyond, [2.0, -1.0]);
    assert!(
        matches!(
            error,
            Error::GradientPlace {
                constraint: 0,
                component: 2,
                ..
            }
        ),
        "{error}"
    );
    let error = refused(Midpoint, point(&[[f64::NAN, 1.0]]), [2.0, -1.0]);
    assert!(
        matches!(
            error,
            Error::NonFinite { .. } | Error::NonFiniteState { .. }
        ),
        "{error}"
    );
}
