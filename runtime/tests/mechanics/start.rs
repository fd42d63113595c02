//! Starts, and systems whose constraints are wrong.

use symplectic::constraints::{
    Constrained, Gradients, HolonomicConstraints, Nonholonomic, consistent, constraint_force,
};
use symplectic::friction::Damped;
use symplectic::nalgebra::{SVector, Vector2};
use symplectic::system::Class;
use symplectic::{Error, Integrator, ProvedFor, Quantity, Separable, State};

use crate::systems::*;

/// A point in the plane with unit mass and these constraints: what each test gets wrong.
#[derive(Clone, Copy)]
struct Point {
    constraints: usize,
    values: fn(&[f64; 2]) -> [f64; 3],
    gradients: fn(&[f64; 2]) -> [[f64; 2]; 3],
    /// A constraint and a component that are not there.
    beyond: Option<(usize, usize)>,
}

const CIRCLE: Point = Point {
    constraints: 1,
    values: |q| [q[0] * q[0] + q[1] * q[1] - 1.0, 0.0, 0.0],
    gradients: |q| [[2.0 * q[0], 2.0 * q[1]], [0.0; 2], [0.0; 2]],
    beyond: None,
};

impl symplectic::System<Vector2<f64>> for Point {
    type Class = Constrained<Separable>;
    type Solver = symplectic::solver::FixedPoint;

    fn velocity(&self, _: f64, _: &Vector2<f64>, p: &Vector2<f64>, velocity: &mut Vector2<f64>) {
        *velocity = *p;
    }

    fn force(&self, _: f64, _: &Vector2<f64>, _: &Vector2<f64>, force: &mut Vector2<f64>) {
        *force = Vector2::new(0.0, -1.0);
    }

    fn extra(&self) -> Option<&dyn HolonomicConstraints<Vector2<f64>>> {
        Some(self)
    }
}

impl HolonomicConstraints<Vector2<f64>> for Point {
    fn constraints(&self) -> usize {
        self.constraints
    }
    fn constraint_values(&self, q: &Vector2<f64>, values: &mut [f64]) {
        values.copy_from_slice(&(self.values)(&[q[0], q[1]])[..values.len()]);
    }
    fn constraint_gradients(&self, q: &Vector2<f64>, gradients: &mut Gradients<f64>) {
        let rows = (self.gradients)(&[q[0], q[1]]);
        for (constraint, row) in rows.iter().take(self.constraints).enumerate() {
            for (component, &value) in row.iter().enumerate() {
                gradients.set(constraint, component, value);
            }
        }
        if let Some((constraint, component)) = self.beyond {
            gradients.set(constraint, component, 1.0);
        }
    }
}

fn refused(system: Point, q: [f64; 2], p: [f64; 2]) -> Error {
    let state = State::from_arrays(0.0, q, p);
    match Integrator::new(Rattle, system, state, 0.1) {
        Err(error) => error,
        Ok(_) => panic!("accepted"),
    }
}

#[test]
fn a_start_off_the_constraints_is_refused() {
    let error = refused(CIRCLE, [1.1, 0.0], [0.0, 1.0]);
    assert!(
        matches!(error, Error::InconsistentStart { constraint: 0, .. }),
        "{error}"
    );
    assert!(
        error
            .to_string()
            .contains("constraints::consistent(&system, state)"),
        "{error}"
    );
    let error = refused(CIRCLE, [1.0, 0.0], [1.0, 1.0]);
    let Error::InconsistentStart { value, rate, .. } = error else {
        panic!("{error}");
    };
    assert_eq!((value, rate), (0.0, 2.0));
    let fine = State::from_arrays(0.0, [1.0, 0.0], [0.0, 1.0]);
    assert!(Integrator::new(Rattle, CIRCLE, fine, 0.1).is_ok());
}

#[test]
fn a_state_that_replaces_another_is_checked_too() {
    let start = State::from_arrays(0.0, [1.0, 0.0], [0.0, 1.0]);
    let mut run = Integrator::new(Rattle, CIRCLE, start.clone(), 0.1).expect("a run");
    let error = run.set_state(State::from_arrays(0.0, [2.0, 0.0], [0.0, 1.0]));
    assert!(
        matches!(error, Err(Error::InconsistentStart { .. })),
        "{error:?}"
    );
    assert_eq!(run.state(), &start);
}

#[test]
fn systems_whose_constraints_are_wrong_are_refused() {
    let start = ([1.0, 0.0], [0.0, 1.0]);
    let at = |system: Point| refused(system, start.0, start.1);
    let error = at(Point {
        constraints: 0,
        ..CIRCLE
    });
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
    let error = at(Point {
        constraints: 3,
        ..CIRCLE
    });
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
    let error = at(Point {
        beyond: Some((1, 0)),
        ..CIRCLE
    });
    assert!(
        matches!(
            error,
            Error::GradientPlace {
                constraint: 1,
                component: 0,
                ..
            }
        ),
        "{error}"
    );
    let sign: fn(&[f64; 2]) -> [[f64; 2]; 3] =
        |q| [[2.0 * q[0], -2.0 * q[1] + 1.0], [0.0; 2], [0.0; 2]];
    let error = at(Point {
        gradients: sign,
        ..CIRCLE
    });
    assert!(
        matches!(error, Error::GradientMismatch { constraint: 0, .. }),
        "{error}"
    );
    // Right at the start only, where y is zero.
    let twice: fn(&[f64; 2]) -> [[f64; 2]; 3] = |q| [[2.0 * q[0], 4.0 * q[1]], [0.0; 2], [0.0; 2]];
    let error = at(Point {
        gradients: twice,
        ..CIRCLE
    });
    assert!(
        matches!(error, Error::GradientMismatch { constraint: 0, .. }),
        "{error}"
    );
    // A constraint that is constant, and one that is there twice.
    let constant = Point {
        values: |_| [0.0; 3],
        gradients: |_| [[0.0; 2]; 3],
        ..CIRCLE
    };
    assert!(
        matches!(
            at(constant),
            Error::DependentConstraints {
                constraint: 0,
                pivot: 0.0,
                ..
            }
        ),
        "{}",
        at(constant)
    );
    let twice = Point {
        constraints: 2,
        values: |q| {
            let value = (CIRCLE.values)(q)[0];
            [value, 3.0 * value, 0.0]
        },
        gradients: |q| {
            let row = (CIRCLE.gradients)(q)[0];
            [row, row.map(|x| 3.0 * x), [0.0; 2]]
        },
        ..CIRCLE
    };
    assert!(
        matches!(at(twice), Error::DependentConstraints { constraint: 1, .. }),
        "{}",
        at(twice)
    );
}

/// A cross of two lines, whose gradient vanishes where they meet: the first step goes there exactly.
#[test]
fn a_configuration_where_the_gradient_vanishes_ends_the_run() {
    let cross = Point {
        values: |q| [q[0] * q[1], 0.0, 0.0],
        gradients: |q| [[q[1], q[0]], [0.0; 2], [0.0; 2]],
        ..CIRCLE
    };
    let start = State::from_arrays(0.0, [0.0, 0.1328125], [0.0, -1.0]);
    let mut run = Integrator::new(Rattle, cross, start.clone(), 0.125).expect("a run");
    let error = run.step().expect_err("no multiplier");
    assert!(
        matches!(error, Error::DependentConstraints { constraint: 0, .. }),
        "{error}"
    );
    assert_eq!(run.state(), &start);
}

#[test]
fn consistent_projects_onto_the_constraints() {
    let read = State::from_arrays(0.0, [0.6, -0.79], [0.8, 0.61]);
    let state: State<Vector2<f64>> = consistent(&Pendulum, read).expect("near by");
    assert!((state.q.norm() - 1.0).abs() < 1e-15 && state.q.dot(&state.p).abs() < 1e-15);
    // One that is consistent stays as it is.
    let again = consistent(&Pendulum, state.clone()).expect("consistent");
    assert_eq!(again, state);
    // Masses count: the light end moves.
    let state = State::from_arrays(0.0, [0.0, 0.0, -1.0, 0.0, 0.3, -2.0], [0.0; 6]);
    let state: State<SVector<f64, 6>> = consistent(&DoubleSpherical, state).expect("near by");
    let mut values = [0.0; 2];
    DoubleSpherical.constraint_values(&state.q, &mut values);
    assert!(values.iter().all(|value| value.abs() < 1e-15), "{values:?}");
    // From the middle of the circle there is no nearest state.
    let middle = State::from_arrays(0.0, [0.0, 0.0], [0.0, 0.0]);
    assert!(consistent(&Pendulum, middle).is_err());
}

/// A pendulum at rest on a slope has momenta that are rounding errors of its forces: a run goes on from there.
#[test]
fn rounding_errors_at_rest_are_consistent() {
    let start = State::from_arrays(0.0, [0.6, -0.8], [0.0, 0.0]);
    let turned = Turned(Vector2::new(0.6, -0.8));
    let mut run = Integrator::new(Lobatto3, turned, start, 0.1).expect("a run");
    let mut moved = false;
    for _ in 0..20 {
        let state = run.step().expect("a step").clone();
        moved |= state.p.norm() > 0.0;
        Integrator::new(Lobatto3, turned, state, 0.1).expect("consistent");
    }
    assert!(moved, "every momentum is zero");
}

/// What is not finite is no dependent constraint.
#[test]
fn a_nonfinite_constraint_is_named() {
    let broken = Point {
        gradients: |_| [[f64::NAN, 0.0], [0.0; 2], [0.0; 2]],
        ..CIRCLE
    };
    let constraint = |error: &Error| {
        let what = Quantity::Constraint;
        matches!(error, Error::NonFiniteState { what: found } if *found == what)
    };
    let error = refused(broken, [1.0, 0.0], [0.0, 1.0]);
    assert!(constraint(&error), "{error}");
    let state = State::from_arrays(0.0, [1.0, 0.0], [0.0, 1.0]);
    let error = constraint_force(&broken, &state).expect_err("NaN");
    assert!(constraint(&error), "{error}");
    // In a step, at its middle stage.
    let beyond = Point {
        gradients: |q| {
            let x = if q[1] > 0.04 { f64::NAN } else { 2.0 * q[0] };
            [[x, 2.0 * q[1]], [0.0; 2], [0.0; 2]]
        },
        ..CIRCLE
    };
    let mut run = Integrator::new(Lobatto3, beyond, state, 0.1).expect("a run");
    let error = run.step().expect_err("NaN");
    let what = Quantity::Constraint;
    let named =
        matches!(error, Error::NonFinite { what: found, stage: Some(2), .. } if found == what);
    assert!(named, "{error}");
    let nowhere = State::from_arrays(0.0, [f64::NAN, 0.0], [0.0, 1.0]);
    let error = consistent(&CIRCLE, nowhere).expect_err("NaN");
    let what = Quantity::Position;
    let named = matches!(error, Error::NonFiniteState { what: found } if found == what);
    assert!(named, "{error}");
}

/// Gradients that were set in other places in one step are an error of that step only.
#[test]
fn a_run_goes_on_after_misplaced_gradients() {
    struct Once(std::cell::Cell<bool>);

    impl symplectic::System<Vector2<f64>> for Once {
        type Class = Constrained<Separable>;
        type Solver = symplectic::solver::FixedPoint;

        fn velocity(
            &self,
            _: f64,
            _: &Vector2<f64>,
            p: &Vector2<f64>,
            velocity: &mut Vector2<f64>,
        ) {
            *velocity = *p;
        }

        fn force(&self, _: f64, _: &Vector2<f64>, _: &Vector2<f64>, force: &mut Vector2<f64>) {
            *force = Vector2::new(0.0, -1.0);
        }

        fn extra(&self) -> Option<&dyn HolonomicConstraints<Vector2<f64>>> {
            Some(self)
        }
    }

    impl HolonomicConstraints<Vector2<f64>> for Once {
        fn constraints(&self) -> usize {
            1
        }
        fn constraint_values(&self, q: &Vector2<f64>, values: &mut [f64]) {
            values[0] = q.norm_squared() - 1.0;
        }
        fn constraint_gradients(&self, q: &Vector2<f64>, gradients: &mut Gradients<f64>) {
            gradients.set(0, 0, 2.0 * q[0]);
            gradients.set(0, 1, 2.0 * q[1]);
            if self.0.take() {
                gradients.set(0, 1, 0.0);
            }
        }
    }

    let start = State::from_arrays(0.0, [1.0, 0.0], [0.0, 1.0]);
    let once = Once(std::cell::Cell::new(false));
    let mut run = Integrator::new(Rattle, once, start, 0.1).expect("a run");
    run.step().expect("a step");
    run.system().0.set(true);
    let error = run.step().expect_err("misplaced");
    assert!(matches!(error, Error::MovingGradients { .. }), "{error}");
    run.step().expect("a step");
}

/// Constraints and friction that the class promises, and the system forgets, are not left out in silence.
#[test]
fn constraints_and_friction_that_the_system_does_not_give_are_refused() {
    struct Silent<C>(core::marker::PhantomData<C>);

    impl<C: Class> symplectic::System<Vector2<f64>> for Silent<C> {
        type Class = C;
        type Solver = symplectic::solver::FixedPoint;

        fn velocity(
            &self,
            _: f64,
            _: &Vector2<f64>,
            p: &Vector2<f64>,
            velocity: &mut Vector2<f64>,
        ) {
            *velocity = *p;
        }

        fn force(&self, _: f64, q: &Vector2<f64>, _: &Vector2<f64>, force: &mut Vector2<f64>) {
            *force = -q;
        }
    }

    fn refused<C: Class>() -> Error
    where
        Rattle: ProvedFor<C>,
    {
        let start = State::from_arrays(0.0, [1.0, 0.0], [0.0, 1.0]);
        let silent = Silent::<C>(core::marker::PhantomData);
        let error = Integrator::new(Rattle, silent, start, 0.1).map(|_| ());
        error.expect_err("refused")
    }

    for (error, forgotten) in [
        (refused::<Constrained<Separable>>(), "HolonomicConstraints"),
        (
            refused::<Nonholonomic<Separable>>(),
            "NonholonomicConstraints",
        ),
        (refused::<Damped>(), "Friction"),
    ] {
        assert!(matches!(error, Error::NoExtra { by, .. } if by == forgotten));
        assert!(error.to_string().contains(forgotten), "{error}");
    }
}
