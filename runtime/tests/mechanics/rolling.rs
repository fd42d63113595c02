//! The methods and the systems with non-holonomic constraints of these tests.

use symplectic::constraints::{Gradients, Nonholonomic, NonholonomicConstraints};
use symplectic::nalgebra::{SVector, Vector3, Vector4};
use symplectic::system::Masses;
use symplectic::{General, Hamiltonian, Scalar, Separable, State};

pub use crate::methods::Midpoint;

symplectic::tableau! {
    pub Trapezoid { basis: polynomial(2), nodes: lobatto(2), require: [nonholonomic, order == 2] }
    /// Four stages, at 0, 1/3, 2/3 and 1.
    pub Thirds { basis: polynomial(4), nodes: newton-cotes(4), require: [nonholonomic, order == 2] }
    /// The constraint at the start of a step.
    pub AtStart { basis: polynomial(1), nodes: [0], require: [nonholonomic, order == 1] }
    /// The constraint at its end.
    pub AtEnd { basis: polynomial(1), nodes: [1], require: [nonholonomic, order == 1] }
}

symplectic::composition! {
    pub Midpoint4 { base: gauss-1, weights: triple_jump(4), require: [order == 4] }
    pub Midpoint6 { base: gauss-1, weights: suzuki(6), require: [order == 6] }
    pub Trapezoid4 { base: lobatto-2, weights: suzuki(4), require: [order == 4] }
    /// Gauss with two stages has order 4 without constraints, and order 2 with them.
    pub Gauss1And2 { compose: [[1/2, base: gauss-1], [1/2, base: gauss-2]], require: [nonholonomic, order == 2] }
    /// A step of order 1 and its adjoint.
    pub QuarterAndAdjoint {
        base: [basis: polynomial(3), nodes: [0, 1/4, 1]],
        weights: [1/2, adjoint(1/2)],
        require: [nonholonomic, order == 2],
    }
}

type V3<T> = SVector<T, 3>;
type V4<T> = SVector<T, 4>;

/// A disk of radius 0.7 that rolls upright on a plane: (x, y) below its centre, the angle θ by which it has rolled and its heading φ.
///
/// H = (px² + py²)/2 + pθ²/0.6 + pφ²/0.4,  x' = R θ' cos φ, y' = R θ' sin φ.
#[derive(Clone, Copy)]
pub struct Disk;

pub const RADIUS: f64 = 0.7;

impl Hamiltonian for Disk {
    type Class = Nonholonomic<Separable>;
    type Vector<T: Scalar> = V4<T>;

    fn velocity<T: Scalar>(&self, _: T, _: &V4<T>, p: &V4<T>, velocity: &mut V4<T>) {
        *velocity = V4::from([
            p[0],
            p[1],
            p[2] * T::from_f64(1.0 / 0.3),
            p[3] * T::from_f64(1.0 / 0.2),
        ]);
    }

    fn force<T: Scalar>(&self, _: T, _: &V4<T>, _: &V4<T>, force: &mut V4<T>) {
        *force = V4::zeros();
    }

    fn extra<T: Scalar>(&self) -> Option<&dyn NonholonomicConstraints<V4<T>>> {
        Some(self)
    }
}

impl<T: Scalar> NonholonomicConstraints<V4<T>> for Disk {
    fn nonholonomic_constraints(&self) -> usize {
        2
    }
    fn nonholonomic_rows(&self, q: &V4<T>, rows: &mut Gradients<T>) {
        let radius = T::from_f64(RADIUS);
        rows.set(0, 0, T::one());
        rows.set(0, 2, -radius * q[3].cos());
        rows.set(1, 1, T::one());
        rows.set(1, 2, -radius * q[3].sin());
    }
}

/// It rolls with the rate 1.3 and turns with the rate 0.8.
pub fn disk_start() -> State<Vector4<f64>> {
    let (rolls, turns, heading) = (1.3, 0.8, 0.3_f64);
    let speed = RADIUS * rolls;
    let q = [0.2, -0.4, 0.1, heading];
    let (sin, cos) = heading.sin_cos();
    State::from_arrays(0.0, q, [speed * cos, speed * sin, 0.3 * rolls, 0.2 * turns])
}

/// A skate on a plane that slopes down along x: H = |p|²/2 − s x, x' sin a − y' cos a = 0.
#[derive(Clone, Copy)]
pub struct Skate {
    pub slope: f64,
}

impl Hamiltonian for Skate {
    type Class = Nonholonomic<Separable>;
    type Vector<T: Scalar> = V3<T>;

    const MASSES: Masses = Masses::Unit;

    fn velocity<T: Scalar>(&self, _: T, _: &V3<T>, p: &V3<T>, velocity: &mut V3<T>) {
        *velocity = *p;
    }

    fn force<T: Scalar>(&self, _: T, _: &V3<T>, _: &V3<T>, force: &mut V3<T>) {
        *force = V3::from([T::from_f64(self.slope), T::zero(), T::zero()]);
    }

    fn extra<T: Scalar>(&self) -> Option<&dyn NonholonomicConstraints<V3<T>>> {
        Some(self)
    }
}

impl<T: Scalar> NonholonomicConstraints<V3<T>> for Skate {
    fn nonholonomic_constraints(&self) -> usize {
        1
    }
    fn nonholonomic_rows(&self, q: &V3<T>, rows: &mut Gradients<T>) {
        rows.set(0, 0, q[2].sin());
        rows.set(0, 1, -q[2].cos());
    }
}

/// The non-holonomic oscillator: H = (|p|² + x² + y²)/2, z' = y x'.
#[derive(Clone, Copy)]
pub struct Oscillator;

impl Hamiltonian for Oscillator {
    type Class = Nonholonomic<Separable>;
    type Vector<T: Scalar> = V3<T>;

    const MASSES: Masses = Masses::Unit;

    fn velocity<T: Scalar>(&self, _: T, _: &V3<T>, p: &V3<T>, velocity: &mut V3<T>) {
        *velocity = *p;
    }

    fn force<T: Scalar>(&self, _: T, q: &V3<T>, _: &V3<T>, force: &mut V3<T>) {
        *force = V3::from([-q[0], -q[1], T::zero()]);
    }

    fn energy<T: Scalar>(&self, _: T, q: &V3<T>, p: &V3<T>) -> Option<T> {
        Some((p.dot(p) + q[0] * q[0] + q[1] * q[1]) * T::from_f64(0.5))
    }

    fn extra<T: Scalar>(&self) -> Option<&dyn NonholonomicConstraints<V3<T>>> {
        Some(self)
    }
}

impl<T: Scalar> NonholonomicConstraints<V3<T>> for Oscillator {
    fn nonholonomic_constraints(&self) -> usize {
        1
    }
    fn nonholonomic_rows(&self, q: &V3<T>, rows: &mut Gradients<T>) {
        rows.set(0, 0, q[1]);
        rows.set(0, 2, -T::one());
    }
}

pub fn oscillator_start() -> State<Vector3<f64>> {
    // z' = y x' = 0.5 · 0.8
    State::from_arrays(0.0, [0.6, 0.5, -0.1], [0.8, 0.9, 0.4])
}

/// The oscillator at a time: y'' = −y; with s = √(1 + y²) and dτ = dt/s the constraint leaves d²x/dτ² = −x, and z' = y x'.
pub fn oscillator_exact(time: f64) -> State<Vector3<f64>> {
    let State { q, p, .. } = oscillator_start();
    let y = |t: f64| q[1] * t.cos() + p[1] * t.sin();
    let s = |t: f64| y(t).hypot(1.0);
    let momentum = p[0] * s(0.0);
    let x_rate = |t: f64, tau: f64| (momentum * tau.cos() - q[0] * tau.sin()) / s(t);
    let rates = |t: f64, [tau, _]: [f64; 2]| [1.0 / s(t), y(t) * x_rate(t, tau)];
    // The classical method of order 4, with an error of 10⁻¹⁵.
    const STEPS: u32 = 4000;
    let h = time / f64::from(STEPS);
    let mut values = [0.0, q[2]];
    for k in 0..STEPS {
        let t = f64::from(k) * h;
        let moved = |rate: [f64; 2], by: f64| [values[0] + by * rate[0], values[1] + by * rate[1]];
        let first = rates(t, values);
        let second = rates(t + h / 2.0, moved(first, h / 2.0));
        let third = rates(t + h / 2.0, moved(second, h / 2.0));
        let fourth = rates(t + h, moved(third, h));
        for c in 0..2 {
            values[c] += h / 6.0 * (first[c] + 2.0 * (second[c] + third[c]) + fourth[c]);
        }
    }
    let [tau, z] = values;
    let x = q[0] * tau.cos() + momentum * tau.sin();
    let rate = x_rate(time, tau);
    let turned = p[1] * time.cos() - q[1] * time.sin();
    State::from_arrays(time, [x, y(time), z], [rate, turned, y(time) * rate])
}

/// The sleigh of Chaplygin: its blade at (x, y) in the direction a, its mass 1 a length ahead, its moment of inertia about that 0.4.
///
/// H = |p|²/2 + (pa + ℓ(px sin a − py cos a))²/0.8,  x' sin a − y' cos a = 0. The masses depend on the place.
#[derive(Clone, Copy)]
pub struct Sleigh;

pub const LENGTH: f64 = 0.5;
pub const INERTIA: f64 = 0.4;

impl Sleigh {
    /// The rate a'.
    fn rate<T: Scalar>(q: &V3<T>, p: &V3<T>) -> T {
        let across = p[0] * q[2].sin() - p[1] * q[2].cos();
        (p[2] + T::from_f64(LENGTH) * across) * T::from_f64(1.0 / INERTIA)
    }
}

impl Hamiltonian for Sleigh {
    type Class = Nonholonomic<General>;
    type Vector<T: Scalar> = V3<T>;

    fn velocity<T: Scalar>(&self, _: T, q: &V3<T>, p: &V3<T>, velocity: &mut V3<T>) {
        let rate = Self::rate(q, p);
        let arm = T::from_f64(LENGTH) * rate;
        *velocity = V3::from([p[0] + arm * q[2].sin(), p[1] - arm * q[2].cos(), rate]);
    }

    fn force<T: Scalar>(&self, _: T, q: &V3<T>, p: &V3<T>, force: &mut V3<T>) {
        let along = p[0] * q[2].cos() + p[1] * q[2].sin();
        let torque = -(T::from_f64(LENGTH) * Self::rate(q, p) * along);
        *force = V3::from([T::zero(), T::zero(), torque]);
    }

    fn extra<T: Scalar>(&self) -> Option<&dyn NonholonomicConstraints<V3<T>>> {
        Some(self)
    }
}

impl<T: Scalar> NonholonomicConstraints<V3<T>> for Sleigh {
    fn nonholonomic_constraints(&self) -> usize {
        1
    }
    fn nonholonomic_rows(&self, q: &V3<T>, rows: &mut Gradients<T>) {
        rows.set(0, 0, q[2].sin());
        rows.set(0, 1, -q[2].cos());
    }
}

/// The momentum with a speed along the blade and a rate: p = ∂L/∂v, the mass at (x + ℓ cos a, y + ℓ sin a).
pub fn sleigh_momentum(a: f64, speed: f64, rate: f64) -> Vector3<f64> {
    let (sin, cos) = a.sin_cos();
    let (vx, vy) = (
        speed * cos - LENGTH * rate * sin,
        speed * sin + LENGTH * rate * cos,
    );
    Vector3::new(vx, vy, INERTIA * rate + LENGTH * (vy * cos - vx * sin))
}

/// A pendulum of length 1 with its holonomic constraint as rows: x x' + y y' = 0.
#[derive(Clone, Copy)]
pub struct PendulumByRows;

impl Hamiltonian for PendulumByRows {
    type Class = Nonholonomic<Separable>;
    type Vector<T: Scalar> = SVector<T, 2>;

    const MASSES: Masses = Masses::Unit;

    fn velocity<T: Scalar>(
        &self,
        time: T,
        q: &SVector<T, 2>,
        p: &SVector<T, 2>,
        velocity: &mut SVector<T, 2>,
    ) {
        crate::systems::Pendulum.velocity(time, q, p, velocity);
    }

    fn force<T: Scalar>(
        &self,
        time: T,
        q: &SVector<T, 2>,
        p: &SVector<T, 2>,
        force: &mut SVector<T, 2>,
    ) {
        crate::systems::Pendulum.force(time, q, p, force);
    }

    fn extra<T: Scalar>(&self) -> Option<&dyn NonholonomicConstraints<SVector<T, 2>>> {
        Some(self)
    }
}

impl<T: Scalar> NonholonomicConstraints<SVector<T, 2>> for PendulumByRows {
    fn nonholonomic_constraints(&self) -> usize {
        1
    }
    fn nonholonomic_rows(&self, q: &SVector<T, 2>, rows: &mut Gradients<T>) {
        rows.set(0, 0, q[0]);
        rows.set(0, 1, q[1]);
    }
}
