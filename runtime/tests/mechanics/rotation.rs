//! Rigid bodies on SO(3), against closed forms and the same motion in other coordinates.

use crate::methods::{Gauss6, Lobatto3, StoermerVerlet};
use symplectic::constraints::Constrained;
use symplectic::nalgebra::{Matrix3, SMatrix, UnitQuaternion, Vector3};
use symplectic::proved::StoermerVerletSteps;
use symplectic::rotation::{Error, FreeBody, HeavyTop, RigidBody, RotationState, RotationSteps};
use symplectic::{Error as CoreError, Integrator, Method, ProvedFor, Quantity, Separable, State};

symplectic::composition! {
    pub Suzuki4 { base: stormer-verlet, weights: suzuki(4), require: [order == 4] }
    Jump4 { base: lobatto-2, weights: triple_jump(4), require: [order == 4] }
    Jump6 { base: lobatto-2, weights: triple_jump(6), require: [order == 6] }
}

symplectic::hamiltonian! {
    /// A heavy body by its Euler angles, R = Rz(f) Rx(n) Rz(s); `drive` shakes gravity.
    pub EulerAngles { I1: 1, I2: 1, I3: 1, cx: 0, cy: 0, cz: 1, drive: 0 }
    q: [f, n, s], p: [pf, pn, ps];
    let across = (pf - ps cos(n))/sin(n);
    let P1 = across sin(s) + pn cos(s);
    let P2 = across cos(s) - pn sin(s);
    let height = cx sin(n) sin(s) + cy sin(n) cos(s) + cz cos(n);
    H = P1^2/(2 I1) + P2^2/(2 I2) + ps^2/(2 I3) + (1 + drive sin(3 t)) height
}

symplectic::hamiltonian! {
    /// The same body by the columns of its attitude, which are orthonormal, with `J_i = tr(I)/2 − I_i`.
    pub Columns { J: [3], c: [3] }
    q: [3; 3], p: [3; 3];
    H = sum(i: |p[i]|^2/(2 J[i])) + sum(i: c[i] q[i][2])
    constraints: {
        lengths(i) = |q[i]|^2 - 1,
        xy = q[0][0] q[1][0] + q[0][1] q[1][1] + q[0][2] q[1][2],
        yz = q[1][0] q[2][0] + q[1][1] q[2][1] + q[1][2] q[2][2],
        zx = q[2][0] q[0][0] + q[2][1] q[0][1] + q[2][2] q[0][2]
    }
}

/// A top with three different moments, its centre of mass on no axis.
pub const LOPSIDED: HeavyTop = HeavyTop {
    moments: Vector3::new(1.0, 1.4, 0.8),
    weight: 1.0,
    centre: Vector3::new(0.2, -0.1, 0.7),
};

/// Lagrange's top.
const LAGRANGE: HeavyTop = HeavyTop {
    moments: Vector3::new(1.0, 1.0, 0.6),
    weight: 1.0,
    centre: Vector3::new(0.0, 0.0, 0.8),
};

const ANGLES: [f64; 3] = [0.3, 0.9, -0.4];

fn attitude([f, n, s]: [f64; 3]) -> UnitQuaternion<f64> {
    let turn = |axis, angle| UnitQuaternion::from_axis_angle(&axis, angle);
    turn(Vector3::z_axis(), f) * turn(Vector3::x_axis(), n) * turn(Vector3::z_axis(), s)
}

pub fn start() -> RotationState {
    RotationState::new(0.0, attitude(ANGLES), Vector3::new(0.5, -0.3, 1.2))
}

/// Attitude and momentum as numbers that can be compared.
type Numbers = (Matrix3<f64>, Vector3<f64>);

fn numbers(state: &RotationState) -> Numbers {
    let matrix = state.attitude.to_rotation_matrix().into_inner();
    (matrix, state.momentum)
}

fn distance(a: &Numbers, b: &Numbers) -> f64 {
    (a.0 - b.0).norm().max((a.1 - b.1).norm())
}

/// The heavy body at t = 1 by Gauss with six stages in Euler angles.
fn by_angles(body: &HeavyTop, drive: f64) -> Numbers {
    let RotationState { momentum, .. } = start();
    let [_, n, s] = ANGLES;
    let across = momentum.x * s.sin() + momentum.y * s.cos();
    let p = [
        across * n.sin() + momentum.z * n.cos(),
        momentum.x * s.cos() - momentum.y * s.sin(),
        momentum.z,
    ];
    let ([i1, i2, i3], [cx, cy, cz]) = (body.moments.into(), (body.centre * body.weight).into());
    let system = EulerAngles {
        I1: i1,
        I2: i2,
        I3: i3,
        cx,
        cy,
        cz,
        drive,
    };
    let start = State::from_arrays(0.0, ANGLES, p);
    let mut run = Integrator::new(Gauss6, system, start, 0.02).expect("a run");
    let (q, p) = run.integrate_to(1.0).expect("steps").to_arrays();
    let [_, n, s] = q;
    let across = (p[0] - p[2] * n.cos()) / n.sin();
    let momentum = Vector3::new(
        across * s.sin() + p[1] * s.cos(),
        across * s.cos() - p[1] * s.sin(),
        p[2],
    );
    numbers(&RotationState::new(1.0, attitude(q), momentum))
}

/// The heavy body at t = 1 in R⁹.
fn by_columns<M>(method: M, body: &HeavyTop, steps: u32) -> Numbers
where
    M: Method + ProvedFor<Constrained<Separable>>,
{
    let inertia = body.moments;
    let j = inertia.map(|moment| inertia.sum() / 2.0 - moment);
    let RotationState { momentum, .. } = start();
    let r = attitude(ANGLES).to_rotation_matrix().into_inner();
    let rate = r * momentum.component_div(&inertia).cross_matrix();
    let system = Columns::new(j.into(), (body.centre * body.weight).into());
    let start = State::new(0.0, r, rate * Matrix3::from_diagonal(&j));
    let mut run = Integrator::new(method, system, start, 1.0 / f64::from(steps)).expect("a run");
    let State { q, p, .. } = run.integrate_to(1.0).expect("steps");
    let turning: SMatrix<f64, 3, 3> =
        q.transpose() * p * Matrix3::from_diagonal(&j.map(f64::recip));
    let velocity = Vector3::new(turning[(2, 1)], turning[(0, 2)], turning[(1, 0)]);
    (*q, velocity.component_mul(&inertia))
}

fn on_the_group<M: StoermerVerletSteps, B: RigidBody>(method: M, body: B, steps: u32) -> Numbers {
    let size = 1.0 / f64::from(steps);
    let mut run = RotationSteps::composed(method, body, start(), size).expect("a run");
    numbers(run.integrate_to(1.0).expect("steps"))
}

/// The order, from the error at t = 1 with a number of steps and with twice as many.
fn assert_order(order: f64, reference: &Numbers, steps: u32, at: impl Fn(u32) -> Numbers) {
    let [coarse, fine] = [steps, 2 * steps].map(|steps| distance(&at(steps), reference));
    let slope = (coarse / fine).log2();
    assert!(
        (slope - order).abs() < 0.05,
        "slope {slope} instead of {order}: {coarse:e} {fine:e}"
    );
}

fn assert_orders<B: RigidBody>(body: &B, reference: &Numbers) {
    assert_order(2.0, reference, 80, |steps| {
        on_the_group(StoermerVerlet, body, steps)
    });
    assert_order(4.0, reference, 40, |steps| {
        on_the_group(Suzuki4, body, steps)
    });
    assert_order(4.0, reference, 80, |steps| on_the_group(Jump4, body, steps));
    assert_order(6.0, reference, 40, |steps| on_the_group(Jump6, body, steps));
}

/// R(t) = exp(tπ/I1) R0 exp(tλe3), λ = Π3 (1/I3 − 1/I1), where I1 = I2.
#[test]
fn steps_of_a_free_symmetric_top_have_their_orders() {
    let body = FreeBody::new(1.0, 1.0, 0.4);
    let RotationState {
        attitude, momentum, ..
    } = start();
    let precession = UnitQuaternion::new(attitude * momentum);
    let spin = UnitQuaternion::new(Vector3::z() * (momentum.z * (1.0 / 0.4 - 1.0)));
    let end = RotationState::new(1.0, precession * attitude * spin, spin.inverse() * momentum);
    assert_orders(&body, &numbers(&end));
}

/// A sphere turns about its momentum, and a step of any size below half a turn does so exactly.
#[test]
fn a_sphere_turns_exactly_in_steps_of_any_size() {
    let start = RotationState::new(0.0, attitude(ANGLES), Vector3::new(1.0, -2.0, 2.0));
    let mut run = RotationSteps::run(FreeBody::new(1.0, 1.0, 1.0), start, 1.0).expect("a run");
    let turn = UnitQuaternion::new(start.momentum * 7.0);
    let end = RotationState::new(7.0, start.attitude * turn, start.momentum);
    let found = numbers(run.integrate_to(7.0).expect("steps"));
    assert!(distance(&found, &numbers(&end)) < 1e-14);
}

#[test]
fn steps_of_a_free_asymmetric_body_have_their_orders() {
    let moments = Vector3::new(1.0, 1.4, 0.8);
    let weightless = HeavyTop {
        weight: 0.0,
        ..LOPSIDED
    };
    assert_orders(&FreeBody { moments }, &by_angles(&weightless, 0.0));
}

#[test]
fn steps_of_heavy_tops_have_their_orders() {
    for body in [LAGRANGE, LOPSIDED] {
        assert_orders(&body, &by_angles(&body, 0.0));
    }
}

/// The same tops in R⁹ with six constraints.
#[test]
fn heavy_tops_with_constraints_end_where_rotations_do() {
    for body in [LAGRANGE, LOPSIDED] {
        let reference = by_angles(&body, 0.0);
        assert_order(2.0, &reference, 80, |steps| {
            by_columns(StoermerVerlet, &body, steps)
        });
        assert_order(4.0, &reference, 40, |steps| {
            by_columns(Lobatto3, &body, steps)
        });
        assert!(distance(&by_columns(Lobatto3, &body, 1000), &reference) < 1e-12);
        assert!(distance(&on_the_group(Jump6, body, 400), &reference) < 1e-12);
    }
}

/// A top in gravity that is shaken.
struct Shaken(f64);

impl RigidBody for Shaken {
    fn moments(&self) -> Vector3<f64> {
        LOPSIDED.moments
    }

    fn torque(&self, time: f64, attitude: &UnitQuaternion<f64>) -> Vector3<f64> {
        LOPSIDED.torque(time, attitude) * (1.0 + self.0 * (3.0 * time).sin())
    }
}

/// A torque that depends on time: at the ends of every step of a composition.
#[test]
fn time_dependent_torques_keep_the_orders() {
    assert_orders(&Shaken(0.5), &by_angles(&LOPSIDED, 0.5));
    let mut run = RotationSteps::run(Shaken(0.5), start(), 0.1).expect("a run");
    run.step().expect("a step");
    assert_eq!(run.stepper().energy(), None);
}

/// Π0 = −D1 Ld and Π1 = D2 Ld, with the derivatives of Ld = hℓ(ξ) by differences along R exp(εη).
#[test]
fn a_free_step_is_that_of_its_discrete_lagrangian() {
    let (body, size) = (FreeBody::new(1.0, 1.4, 0.8), 0.9);
    let mut run = RotationSteps::run(body, start(), size).expect("a run");
    let end = *run.step().expect("a step");
    let value = |before: UnitQuaternion<f64>, after: UnitQuaternion<f64>| {
        let xi = (before.inverse() * after).scaled_axis() / size;
        size * xi.dot(&xi.component_mul(&body.moments)) / 2.0
    };
    let turned = |attitude: UnitQuaternion<f64>, axis: usize, by: f64| {
        let mut turn = Vector3::zeros();
        turn[axis] = by;
        attitude * UnitQuaternion::new(turn)
    };
    const STEP: f64 = 1e-5;
    for axis in 0..3 {
        let [before, after] =
            [STEP, -STEP].map(|by| value(turned(start().attitude, axis, by), end.attitude));
        let momentum = -(before - after) / (2.0 * STEP);
        assert!((momentum - start().momentum[axis]).abs() < 1e-9);
        let [before, after] =
            [STEP, -STEP].map(|by| value(start().attitude, turned(end.attitude, axis, by)));
        let momentum = (before - after) / (2.0 * STEP);
        assert!((momentum - end.momentum[axis]).abs() < 1e-9);
    }
}

/// After 10⁵ steps: RᵀR = 1 to rounding; the momentum in space to the last bit, or about the vertical to rounding; no drift of the energy.
#[test]
#[ignore = "thorough"]
fn rotations_keep_orthogonality_momentum_and_energy() {
    fn orthogonality(state: &RotationState) -> f64 {
        let r = state.attitude.to_rotation_matrix().into_inner();
        (r.transpose() * r - Matrix3::identity()).norm()
    }
    let mut free = RotationSteps::run(FreeBody::new(1.0, 1.4, 0.8), start(), 0.1).expect("a run");
    let momentum = free.stepper().spatial_momentum();
    let length = start().momentum.norm();
    let mut heavy = RotationSteps::run(LOPSIDED, start(), 0.05).expect("a run");
    let vertical = heavy.stepper().spatial_momentum().z;
    // The mean energies of the first and the last of ten parts.
    let mut means = [0.0; 10];
    for k in 0..100_000 {
        let state = *free.step().expect("a step");
        assert_eq!(free.stepper().spatial_momentum(), momentum);
        let top = *heavy.step().expect("a step");
        assert!(
            (heavy.stepper().spatial_momentum().z - vertical).abs() < 4e-15,
            "{k}"
        );
        means[k / 10_000] += heavy.stepper().energy().expect("it is known") / 10_000.0;
        if k % 16 == 15 {
            let worst = orthogonality(&state).max(orthogonality(&top));
            assert!(worst < 2e-15, "{k}: {worst:e}");
            assert!((state.momentum.norm() - length).abs() < 4e-15 * length);
            assert!((state.spatial_momentum() - momentum).norm() < 4e-15 * length);
            assert!((top.spatial_momentum().z - vertical).abs() < 8e-15, "{k}");
        }
    }
    let start_energy = RotationSteps::run(LOPSIDED, start(), 0.05)
        .expect("a run")
        .stepper()
        .energy();
    let offset = means[0] - start_energy.expect("it is known");
    let drift = means[9] - means[0];
    assert!(drift.abs() < 0.05 * offset.abs(), "{means:?}");
}

/// There and back again.
#[test]
fn steps_are_reversible() {
    let mut run = RotationSteps::composed(Suzuki4, LOPSIDED, start(), 0.05).expect("a run");
    for _ in 0..200 {
        run.step().expect("a step");
    }
    assert!(distance(&numbers(run.state()), &numbers(&start())) > 0.1);
    run.set_step_size(-0.05).expect("a size");
    for _ in 0..200 {
        run.step().expect("a step");
    }
    assert!(distance(&numbers(run.state()), &numbers(&start())) < 1e-12);
    assert!(run.state().time.abs() < 1e-14);
    assert_eq!(run.steps(), 400);
}

/// A body whose torque is not a number after a while.
struct Broken;

impl RigidBody for Broken {
    fn moments(&self) -> Vector3<f64> {
        Vector3::new(1.0, 1.0, 1.0)
    }

    fn torque(&self, time: f64, _attitude: &UnitQuaternion<f64>) -> Vector3<f64> {
        Vector3::repeat((0.25 - time).sqrt())
    }
}

#[test]
fn steps_of_half_a_turn_and_bad_bodies_are_refused() {
    let start = RotationState::new(0.0, UnitQuaternion::identity(), Vector3::new(0.0, 0.0, 3.2));
    let sphere = FreeBody::new(1.0, 1.0, 1.0);
    let mut run = RotationSteps::run(sphere, start, 1.0).expect("a run");
    let error = run.step().expect_err("more than half a turn");
    let half_turn = |angle: f64| (angle - 3.2).abs() < 1e-15;
    assert!(
        matches!(error, Error::HalfTurn { time: 0.0, step_size: 1.0, step: 1, angle } if half_turn(angle)),
        "{error}"
    );
    assert_eq!(run.state(), &start);
    run.set_step_size(0.98).expect("a size");
    run.step().expect("below half a turn");

    let new = |body: FreeBody, state, size| RotationSteps::run(body, state, size).map(|_| ());
    let wrong = Error::MomentOfInertia {
        axis: 1,
        value: 0.0,
    };
    assert_eq!(new(FreeBody::new(1.0, 0.0, 1.0), start, 0.1), Err(wrong));
    assert_eq!(
        new(sphere, start, 0.0),
        Err(Error::Core(CoreError::StepSize { value: 0.0 }))
    );
    let infinite = RotationState {
        momentum: Vector3::repeat(f64::INFINITY),
        ..start
    };
    let what = Quantity::Momentum;
    assert_eq!(
        new(sphere, infinite, 0.1),
        Err(Error::Core(CoreError::NonFiniteState { what }))
    );

    let mut run = RotationSteps::run(Broken, start, 0.1).expect("a run");
    let error = run.integrate_to(1.0).expect_err("no torque");
    let expected = Error::Core(CoreError::NonFinite {
        time: 0.2,
        step_size: 0.1,
        step: 3,
        what: Quantity::Torque,
        stage: None,
    });
    assert_eq!(error, expected);
    assert_eq!(run.state().time, 0.2);

    let far = RotationState {
        time: 1e17,
        ..start
    };
    let mut run = RotationSteps::run(sphere, far, 0.1).expect("a run");
    assert!(matches!(
        run.step(),
        Err(Error::Core(CoreError::TimeResolution { .. }))
    ));
}
