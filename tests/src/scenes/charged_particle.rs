//! A charged particle in a magnetic field that increases with the distance from an axis, and in a potential:
//! `H = |p − A(q)|²/2 + U(q)` with `A = (−q_2, q_1, 0) r/3`, `r² = q_1² + q_2²`, so that `B = rot A = (0, 0, r)`, and
//! `U = q_1³ − q_2³ + q_1⁴/5 + q_2⁴ + q_3⁴`.
//!
//! The momentum is canonical, `p = q' + A(q)`.
//!
//! *Needs:* a method for general Hamiltonians. Not separable, not stiff.
//! *Source:* Hairer & Lubich, Energy behaviour of the Boris method for charged-particle dynamics, BIT 58 (2018), with the
//! velocity of their start.
//! *Reference:* recorded, [`recorded`].

use symplectic::nalgebra::SVector;
use symplectic::{General, Hamiltonian, Scalar, State};

use super::Needs;
use crate::references;

/// Its needs: the mass is constant, but the canonical momentum depends on the position.
pub const NEEDS: Needs = Needs {
    quadratic_kinetic_energy: true,
    ..Needs::GENERAL
};

/// The system.
#[derive(Clone, Copy, Debug)]
pub struct ChargedParticle;

impl Hamiltonian for ChargedParticle {
    type Class = General;
    type Vector<T: Scalar> = SVector<T, 3>;

    #[inline]
    fn velocity<T: Scalar>(
        &self,
        _time: T,
        q: &SVector<T, 3>,
        p: &SVector<T, 3>,
        velocity: &mut SVector<T, 3>,
    ) {
        *velocity = p - potential(q);
    }

    #[inline]
    fn force<T: Scalar>(
        &self,
        _time: T,
        q: &SVector<T, 3>,
        p: &SVector<T, 3>,
        force: &mut SVector<T, 3>,
    ) {
        let [x, y, z] = [q[0], q[1], q[2]];
        let number = T::from_f64;
        let radius = (x * x + y * y).sqrt();
        let velocity = p - potential(q);
        // Σ_k v_k ∂A_k/∂q_i, where 3A = (−y, x, 0) r and ∂r/∂q = (x, y, 0)/r.
        let around = (x * velocity[1] - y * velocity[0]) / radius;
        let third = number(3.0).recip();
        force[0] = third * (radius * velocity[1] + around * x);
        force[1] = third * (around * y - radius * velocity[0]);
        force[0] -= x * x * (number(3.0) + number(0.8) * x);
        force[1] += y * y * (number(3.0) - number(4.0) * y);
        force[2] = number(-4.0) * z * z * z;
    }

    fn energy<T: Scalar>(&self, _time: T, q: &SVector<T, 3>, p: &SVector<T, 3>) -> Option<T> {
        let velocity = p - potential(q);
        let [x, y, z] = [q[0] * q[0], q[1] * q[1], q[2] * q[2]];
        let cubes = x * q[0] - y * q[1];
        // As doubles, 4·0.2 is exactly the 0.8 of the force.
        let fourth = T::from_f64(0.2) * x * x + y * y + z * z;
        Some(velocity.dot(&velocity) * T::from_f64(0.5) + cubes + fourth)
    }
}

/// A(q).
#[inline]
fn potential<T: Scalar>(q: &SVector<T, 3>) -> SVector<T, 3> {
    let third = (q[0] * q[0] + q[1] * q[1]).sqrt() / T::from_f64(3.0);
    SVector::from([-q[1] * third, q[0] * third, T::zero()])
}

/// Position (0, 1, 0.1), velocity (0.09, 0.55, 0.3).
pub fn start<T: Scalar>() -> State<SVector<T, 3>> {
    let place = SVector::from([0.0, 1.0, 0.1].map(T::from_f64));
    let velocity = SVector::from([0.09, 0.55, 0.3].map(T::from_f64));
    State::new(0.0, place, velocity + potential(&place))
}

/// The recorded reference at `time`, if there is one.
pub fn recorded(time: f64) -> Option<State<SVector<f64, 3>>> {
    references::find("charged particle", "", time)
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::scenes::check;

    #[test]
    fn the_derivatives_are_those_of_the_energy() {
        let state = State::from_arrays(0.0, [0.7, -0.4, 0.3], [0.2, 0.5, -0.6]);
        check::derivatives(&ChargedParticle, &state, 1e-5, 1e-8);
        check::needs(NEEDS, &ChargedParticle, &state);
    }

    #[test]
    fn the_energy_is_conserved() {
        check::conservation(ChargedParticle, start(), 1.0 / 16.0, 5.0, 1e-13);
    }

    #[test]
    fn the_field_turns_the_particle() {
        // q'' = q' × B − grad U with B = (0, 0, r), from the time derivative of the velocity along the flow.
        let state: State<SVector<f64, 3>> =
            State::from_arrays(0.0, [0.7, -0.4, 0.3], [0.2, 0.5, -0.6]);
        let velocity = |state: &State<SVector<f64, 3>>| state.p - potential(&state.q);
        let step = 1e-4;
        let at = |step: f64| {
            velocity(&check::end(
                ChargedParticle,
                state.clone(),
                step.abs(),
                step,
            ))
        };
        let found = (at(step) - at(-step)) / (2.0 * step);
        let [x, y, z] = [0.7, -0.4, 0.3_f64];
        let (v, field) = (velocity(&state), (x * x + y * y).sqrt());
        let expected = [
            v[1] * field - 3.0 * x * x - 0.8 * x * x * x,
            -v[0] * field + 3.0 * y * y - 4.0 * y * y * y,
            -4.0 * z * z * z,
        ];
        assert!((found - SVector::from(expected)).norm() < 1e-7);
    }
}
