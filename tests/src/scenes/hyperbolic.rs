//! `H = qp` in one dimension: a Hamiltonian without a Lagrangian, because `p q' − H` vanishes for all velocities.
//!
//! *Needs:* a method for general Hamiltonians that does not go through a Lagrangian. Not separable, degenerate; the
//! position grows and the momentum decays exponentially. *Source:* Leok & Zhang, Discrete Hamiltonian variational
//! integrators, §1. *Reference:* closed form, [`exact`].

use symplectic::nalgebra::SVector;
use symplectic::{General, Hamiltonian, Scalar, State};

use super::Needs;

/// Its needs.
pub const NEEDS: Needs = Needs {
    // ∂²H/∂p² is constant: zero.
    quadratic_kinetic_energy: true,
    degenerate: true,
    ..Needs::GENERAL
};

/// The system.
#[derive(Clone, Copy, Debug)]
pub struct Hyperbolic;

impl Hamiltonian for Hyperbolic {
    type Class = General;
    type Vector<T: Scalar> = SVector<T, 1>;

    #[inline]
    fn velocity<T: Scalar>(
        &self,
        _time: T,
        q: &SVector<T, 1>,
        _p: &SVector<T, 1>,
        velocity: &mut SVector<T, 1>,
    ) {
        *velocity = *q;
    }

    #[inline]
    fn force<T: Scalar>(
        &self,
        _time: T,
        _q: &SVector<T, 1>,
        p: &SVector<T, 1>,
        force: &mut SVector<T, 1>,
    ) {
        *force = -*p;
    }

    fn energy<T: Scalar>(&self, _time: T, q: &SVector<T, 1>, p: &SVector<T, 1>) -> Option<T> {
        Some(q[0] * p[0])
    }
}

/// `q = p = 1`.
pub fn start<T: Scalar>() -> State<SVector<T, 1>> {
    State::from_arrays(0.0, [T::one()], [T::one()])
}

/// The solution `q = eᵗ`, `p = e⁻ᵗ`.
pub fn exact(time: f64) -> State<SVector<f64, 1>> {
    State::from_arrays(time, [time.exp()], [(-time).exp()])
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::scenes::check;

    #[test]
    fn the_derivatives_are_those_of_the_energy() {
        let state = State::from_arrays(0.0, [0.7], [-1.3]);
        check::derivatives(&Hyperbolic, &state, 1e-5, 1e-8);
        check::needs(NEEDS, &Hyperbolic, &state);
    }

    #[test]
    fn the_energy_is_conserved() {
        check::conservation(Hyperbolic, start(), 0.125, 4.0, 1e-13);
    }

    #[test]
    fn the_closed_form_agrees_with_the_integrator() {
        let (found, expected) = (check::end(Hyperbolic, start(), 0.125, 4.0), exact(4.0));
        assert!((found.q[0] / expected.q[0] - 1.0).abs() < 1e-13);
        assert!((found.p[0] / expected.p[0] - 1.0).abs() < 1e-13);
    }
}
