//! Generating functions of all types, momentum maps, and checks of a step: symplectic, also with constraints, and equivariant.

use crate::methods::{Gauss2, Gauss3, Lobatto3};
use symplectic::constraints::consistent;
use symplectic::nalgebra::{Rotation2, Vector2, Vector3};
use symplectic::stepper::StepMap;
use symplectic::variational::{Error, momentum_map, step_with_generating_function};
use symplectic::{Error as CoreError, Integrator, State, assert_conserved};

use super::forces::Ring;

symplectic::hamiltonian! {
    /// Not separable, and symmetric under rotations.
    pub Twisted
    q: [2], p: [2];
    H = |p|^2 (1 + |q|^2)/2 + |q|^4/4
}

symplectic::hamiltonian! {
    /// A spherical pendulum, H not separable.
    pub Bead
    q: [3], p: [3];
    H = |p|^2 (2 + q[2])/2 + q[2]
    constraints: { sphere = |q|^2 - 1 }
}

fn near(a: f64, b: f64) -> State<Vector2<f64>> {
    State::from_arrays(
        0.0,
        [0.8 + a, 0.3 - 0.4 * b],
        [0.2 + 0.5 * a - 0.6 * b, 0.7 + b],
    )
}

/// Along a family of steps `dL_d = p1·dq1 − p0·dq0`, `dH_d⁺ = p0·dq0 + q1·dp1` and `dH_d⁻ = −q0·dp0 − p1·dq1`.
#[test]
fn generating_functions_of_three_types_have_their_differentials() -> Result<(), Error> {
    let step = |a: f64| -> Result<_, Error> {
        let start = near(a, 0.3 * a);
        let mut run = Integrator::new(Gauss3, Twisted, start.clone(), 0.25)?;
        let generating = step_with_generating_function(&mut run)?;
        Ok((start, run.into_state(), generating))
    };
    const STEP: f64 = 1e-3;
    let [low, mid, high] = [step(-STEP)?, step(0.0)?, step(STEP)?];
    let slope = |low: f64, high: f64| (high - low) / (2.0 * STEP);
    let (start, end, generating) = &mid;
    let of = |f: &dyn Fn(&State<Vector2<f64>>) -> Vector2<f64>| {
        [
            (f(&high.0) - f(&low.0)) / (2.0 * STEP),
            (f(&high.1) - f(&low.1)) / (2.0 * STEP),
        ]
    };
    let ([dq0, dq1], [dp0, dp1]) = (of(&|state| state.q), of(&|state| state.p));
    let type_one = slope(
        low.2.discrete_lagrangian(&low.1.p),
        high.2.discrete_lagrangian(&high.1.p),
    );
    let type_two = slope(low.2.value, high.2.value);
    let type_three = slope(
        low.2.type_three(&low.0.q, &low.1.p),
        high.2.type_three(&high.0.q, &high.1.p),
    );
    for (found, expected) in [
        (type_one, end.p.dot(&dq1) - start.p.dot(&dq0)),
        (type_two, start.p.dot(&dq0) + end.q.dot(&dp1)),
        (type_three, -start.q.dot(&dp0) - end.p.dot(&dq1)),
    ] {
        // Differences of order 2.
        assert!((found - expected).abs() < 2e-6, "{found} {expected}");
        assert!(found.abs() > 1e-2);
    }
    assert!((generating.q1 - end.q).norm() < 1e-14);
    Ok(())
}

#[test]
fn momentum_maps_are_conserved() -> Result<(), Error> {
    let angular = |state: &State<Vector2<f64>>| {
        momentum_map(state, |q, out| *out = Vector2::new(-q[1], q[0]))
    };
    let mut run = Integrator::new(Gauss2, Twisted, near(0.0, 0.0), 0.1)?;
    assert_conserved!(run, 1000, angular, 4e-15);
    assert!((angular(run.state()) - (0.8 * 0.7 - 0.3 * 0.2)).abs() < 4e-15);
    Ok(())
}

#[test]
#[should_panic(expected = "`angular` is not conserved")]
fn friction_conserves_nothing() {
    let angular = |state: &State<Vector2<f64>>| state.q.perp(&state.p);
    let ring = Ring { gamma: 0.1 };
    let mut run = Integrator::new(Gauss2, ring, near(0.0, 0.0), 0.1).expect("a run");
    assert_conserved!(run, 10, angular, 1e-12);
}

#[test]
fn steps_commute_with_rotations_only() -> Result<(), Error> {
    let run = Integrator::new(Lobatto3, Twisted, near(0.0, 0.0), 0.1)?;
    let turn = Rotation2::new(1.1);
    let turned =
        |state: &State<Vector2<f64>>| State::new(state.time, turn * state.q, turn * state.p);
    assert!(run.equivariance_defect(turned)? < 1e-14);
    let stretched =
        |state: &State<Vector2<f64>>| State::new(state.time, state.q * 2.0, state.p / 2.0);
    assert!(run.equivariance_defect(stretched)? > 1e-2);
    Ok(())
}

/// On the constrained phase space too.
#[test]
fn constrained_steps_are_symplectic() -> Result<(), Error> {
    let family = |a: f64, b: f64| {
        let (q, p) = ([0.6 + a, 0.1 * b, -0.8], [0.3 - a, 0.5 + b, 0.2]);
        let state: State<Vector3<f64>> = State::from_arrays(0.0, q, p);
        consistent(&Bead, state).expect("a state on the sphere")
    };
    let run = Integrator::new(Lobatto3, Bead, family(0.0, 0.0), 0.2)?;
    let defect = run.symplecticity_defect(family)?;
    assert!(defect < 1e-10, "{defect:e}");
    // A family that is not on the sphere is an error.
    let off = |a: f64, _: f64| State::from_arrays(0.0, [0.6 + a, 0.0, -0.8], [0.0, 0.5, 0.0]);
    assert!(matches!(
        run.symplecticity_defect(off),
        Err(CoreError::InconsistentStart { .. })
    ));
    let run = Integrator::new(Gauss2, Ring { gamma: 0.1 }, near(0.0, 0.0), 0.2)?;
    assert!(run.symplecticity_defect(near)? > 1e-3);
    Ok(())
}
