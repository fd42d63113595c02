//! Constraints whose terms are much larger than gradient times position.

use symplectic::constraints::{Constrained, Gradients, HolonomicConstraints, consistent};
use symplectic::nalgebra::Vector2;
use symplectic::{Integrator, Method, ProvedFor, Separable, State};

use crate::systems::*;

/// A pendulum of unit mass about a pivot, through the origin.
#[derive(Clone, Copy)]
struct Pivot(Vector2<f64>);

impl symplectic::System<Vector2<f64>> for Pivot {
    type Class = Constrained<Separable>;
    type Solver = symplectic::solver::FixedPoint;

    fn velocity(&self, _: f64, _: &Vector2<f64>, p: &Vector2<f64>, velocity: &mut Vector2<f64>) {
        *velocity = *p;
    }

    fn force(&self, _: f64, _: &Vector2<f64>, _: &Vector2<f64>, force: &mut Vector2<f64>) {
        *force = Vector2::new(0.0, -9.81);
    }

    fn extra(&self) -> Option<&dyn HolonomicConstraints<Vector2<f64>>> {
        Some(self)
    }
}

impl HolonomicConstraints<Vector2<f64>> for Pivot {
    fn constraints(&self) -> usize {
        1
    }
    fn constraint_values(&self, q: &Vector2<f64>, values: &mut [f64]) {
        values[0] = (q - self.0).norm_squared() - self.0.norm_squared();
    }
    fn constraint_gradients(&self, q: &Vector2<f64>, gradients: &mut Gradients<f64>) {
        for k in 0..2 {
            gradients.set(0, k, 2.0 * (q[k] - self.0[k]));
        }
    }
}

/// Near the origin, φ has rounding errors of ε|pivot|², far above ε|∂φ/∂q||q|.
#[test]
fn constraints_hold_where_a_pendulum_passes_the_origin() {
    fn check<M: Method + ProvedFor<Constrained<Separable>>>(
        method: M,
        (pivot, q): ([f64; 2], [f64; 2]),
        (size, steps): (f64, u64),
    ) {
        let pendulum = Pivot(Vector2::from(pivot));
        let start = State::from_arrays(0.0, q, [0.0, 0.0]);
        let start = consistent(&pendulum, start).expect("near by");
        let mut run = Integrator::new(method, pendulum, start, size).expect("consistent");
        run.take_steps(steps).expect("steps");
        let mut value = [0.0];
        HolonomicConstraints::constraint_values(&pendulum, &run.state().q, &mut value);
        let bound = 32.0 * f64::EPSILON * pendulum.0.norm_squared();
        assert!(value[0].abs() <= bound, "{}: {:e}", M::NAME, value[0]);
    }
    let swing = ([0.0, 1.0], [0.6, 0.2]);
    check(Rattle, swing, (1e-4, 20_000));
    check(Lobatto3, swing, (1e-4, 20_000));
    check(Lobatto4, swing, (1e-4, 20_000));
    check(Rattle, ([0.0, 0.1], [0.001, 0.0]), (1e-3, 10_000));
    for pivot in [[1.0, 0.0], [0.1, 0.0], [0.0, 0.1]] {
        check(Rattle, (pivot, [0.0, 0.0]), (1e-3, 1000));
    }
}

/// An electron on a ring, in SI units: momenta of 1e-22, in which the velocity is not linear.
struct Electron;

impl symplectic::System<Vector2<f64>> for Electron {
    type Class = Constrained<Separable>;
    type Solver = symplectic::solver::FixedPoint;

    fn velocity(&self, _: f64, _: &Vector2<f64>, p: &Vector2<f64>, velocity: &mut Vector2<f64>) {
        let (mass, light) = (9.1e-31, 3e8);
        let gamma = 1.0_f64.hypot((p / (mass * light)).norm());
        *velocity = p / (mass * gamma);
    }

    fn force(&self, _: f64, _: &Vector2<f64>, _: &Vector2<f64>, force: &mut Vector2<f64>) {
        *force = Vector2::new(0.0, -1.6e-13);
    }

    fn extra(&self) -> Option<&dyn HolonomicConstraints<Vector2<f64>>> {
        Some(self)
    }
}

impl HolonomicConstraints<Vector2<f64>> for Electron {
    fn constraints(&self) -> usize {
        1
    }
    fn constraint_values(&self, q: &Vector2<f64>, values: &mut [f64]) {
        values[0] = q.norm_squared() - 1.0;
    }
    fn constraint_gradients(&self, q: &Vector2<f64>, gradients: &mut Gradients<f64>) {
        for k in 0..2 {
            gradients.set(0, k, 2.0 * q[k]);
        }
    }
}

/// Differences of the velocity are taken at the scale of the momentum.
#[test]
fn small_momenta_keep_their_constraint() {
    let start = State::from_arrays(0.0, [1.0, 0.0], [0.0, 1e-22]);
    let mut run = Integrator::new(Rattle, Electron, start, 1e-11).expect("a run");
    let end = run.take_steps(100).expect("steps");
    assert!((end.q.norm() - 1.0).abs() < 1e-15);
    assert!(end.p.norm() < 1e-21, "{}", end.p);
}
