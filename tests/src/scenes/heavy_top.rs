//! A heavy top with three different moments of inertia, its centre of mass on no axis, in three forms: on SO(3), by the columns of its
//! attitude in R⁹ with six constraints, and in Euler angles.
//!
//! *Needs:* in R⁹ a method that is `constrained`. *Source:* Leok & Zhang (2011), §5, for the form on SO(3); the numbers are our choice.
//! *Reference:* in Euler angles, [`EulerAngles`], which the orbit keeps away from their poles up to the time 10.

use symplectic::State;
use symplectic::nalgebra::{Matrix3, UnitQuaternion, Vector3};
use symplectic::rotation::{HeavyTop, RotationState};

/// The top.
pub const TOP: HeavyTop = HeavyTop {
    moments: Vector3::new(1.0, 1.4, 0.8),
    weight: 1.0,
    centre: Vector3::new(0.2, -0.1, 0.7),
};

symplectic::hamiltonian! {
    /// The columns of the attitude, which are orthonormal, with `J_i = tr(I)/2 − I_i`; `c` is the weight times the centre of mass.
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

symplectic::hamiltonian! {
    /// Euler angles, R = Rz(f) Rx(n) Rz(s).
    pub EulerAngles { I1: 1, I2: 1.4, I3: 0.8, cx: 0.2, cy: -0.1, cz: 0.7 }
    q: [f, n, s], p: [pf, pn, ps];
    let across = (pf - ps cos(n))/sin(n);
    let P1 = across sin(s) + pn cos(s);
    let P2 = across cos(s) - pn sin(s);
    H = P1^2/(2 I1) + P2^2/(2 I2) + ps^2/(2 I3) + cx sin(n) sin(s) + cy sin(n) cos(s) + cz cos(n)
}

/// The system in R⁹.
pub fn columns() -> Columns {
    Columns::new(weights().into(), (TOP.centre * TOP.weight).into())
}

/// `J_i = tr(I)/2 − I_i`
fn weights() -> Vector3<f64> {
    TOP.moments.map(|moment| TOP.moments.sum() / 2.0 - moment)
}

/// The state at time 0, in Euler angles.
pub fn start_in_angles() -> State<Vector3<f64>> {
    State::from_arrays(0.0, [0.3, 1.4, -0.4], [1.0, 0.4, 0.9])
}

/// The state at time 0.
pub fn start() -> RotationState {
    from_angles(&start_in_angles())
}

/// The state on SO(3) of a state in Euler angles.
pub fn from_angles(state: &State<Vector3<f64>>) -> RotationState {
    let ([f, n, s], [pf, pn, ps]) = state.to_arrays();
    let turn = |axis, angle| UnitQuaternion::from_axis_angle(&axis, angle);
    let attitude =
        turn(Vector3::z_axis(), f) * turn(Vector3::x_axis(), n) * turn(Vector3::z_axis(), s);
    let across = (pf - ps * n.cos()) / n.sin();
    let momentum = Vector3::new(
        across * s.sin() + pn * s.cos(),
        across * s.cos() - pn * s.sin(),
        ps,
    );
    RotationState::new(state.time, attitude, momentum)
}

/// The state in R⁹ of a state on SO(3): `p = Ṙ J`.
pub fn in_columns(state: &RotationState) -> State<Matrix3<f64>> {
    let attitude = state.attitude.to_rotation_matrix().into_inner();
    let rates = attitude * state.momentum.component_div(&TOP.moments).cross_matrix();
    State::new(
        state.time,
        attitude,
        rates * Matrix3::from_diagonal(&weights()),
    )
}

#[cfg(test)]
mod tests {
    use symplectic::Integrator;
    use symplectic::constraints::HolonomicConstraints;
    use symplectic::rotation::RotationSteps;

    use super::*;
    use crate::methods::{Gauss6, Lobatto4, Suzuki4};
    use crate::scenes::check;

    #[test]
    fn the_derivatives_are_those_of_the_energy() {
        check::derivatives(&EulerAngles::default(), &start_in_angles(), 1e-5, 1e-8);
        check::derivatives(&columns(), &in_columns(&start()), 1e-5, 1e-8);
    }

    /// All three have the same energy, and the same state at time 1.
    #[test]
    fn three_forms_are_the_same_motion() {
        let angles = start_in_angles();
        let mut by_angles =
            Integrator::new(Gauss6, EulerAngles::default(), angles, 1.0 / 32.0).expect("a start");
        let mut group =
            RotationSteps::composed(Suzuki4, TOP, start(), 1.0 / 256.0).expect("a start");
        let mut flat = Integrator::new(Lobatto4, columns(), in_columns(&start()), 1.0 / 64.0)
            .expect("a consistent start");
        let energy = by_angles.energy().expect("known");
        for other in [group.stepper().energy(), flat.energy()] {
            assert!((other.expect("known") - energy).abs() < 1e-14);
        }
        let expected = in_columns(&from_angles(by_angles.integrate_to(1.0).expect("steps")));
        let on_the_group = in_columns(group.integrate_to(1.0).expect("steps"));
        let in_the_plane = flat.integrate_to(1.0).expect("steps");
        for found in [&on_the_group, in_the_plane] {
            assert!((found.q - expected.q).norm() < 1e-8);
            assert!((found.p - expected.p).norm() < 1e-8);
        }
        let mut values = [1.0; 6];
        HolonomicConstraints::constraint_values(&columns(), &in_the_plane.q, &mut values);
        assert!(values.iter().all(|value| value.abs() < 1e-14));
    }

    /// The angles stay away from the poles up to the time of the reference.
    #[test]
    fn the_euler_angles_stay_away_from_the_poles() {
        let mut run = Integrator::new(
            Gauss6,
            EulerAngles::default(),
            start_in_angles(),
            1.0 / 32.0,
        )
        .expect("a start");
        for _ in 0..320 {
            assert!(run.step().expect("a step").q[1].sin().abs() > 0.1);
        }
    }
}
