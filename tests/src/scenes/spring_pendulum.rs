//! A pendulum on a stiff spring of length 1, `H = |p|²/2 + ω²(|q| − 1)²/2 + q_2`.
//!
//! *Needs:* nothing. Separable, quadratic kinetic energy; stiff: the spring oscillates with frequency ω, the pendulum
//! with frequencies of order one. *Source:* GNI §XV.1, the pendulum on a spring; the start is our choice.

use symplectic::nalgebra::SVector;
use symplectic::system::Masses;
use symplectic::{Scalar, SeparableHamiltonian, State};

use super::Needs;

/// Its needs.
pub const NEEDS: Needs = Needs {
    stiff: true,
    ..Needs::NOTHING
};

/// The system.
#[derive(Clone, Copy, Debug)]
pub struct SpringPendulum {
    /// The frequency ω of the spring.
    pub omega: f64,
}

impl SeparableHamiltonian for SpringPendulum {
    type Vector<T: Scalar> = SVector<T, 2>;

    const MASSES: Masses = Masses::Unit;

    #[inline]
    fn velocity<T: Scalar>(&self, _time: T, p: &SVector<T, 2>, velocity: &mut SVector<T, 2>) {
        *velocity = *p;
    }

    #[inline]
    fn force<T: Scalar>(&self, _time: T, q: &SVector<T, 2>, force: &mut SVector<T, 2>) {
        let length = q.dot(q).sqrt();
        let stiffness = T::from_f64(self.omega * self.omega);
        *force = q * (stiffness * (length.recip() - T::one()));
        force[1] -= T::one();
    }

    fn energy<T: Scalar>(&self, _time: T, q: &SVector<T, 2>, p: &SVector<T, 2>) -> Option<T> {
        let stretch = T::from_f64(self.omega) * (q.dot(q).sqrt() - T::one());
        Some((p.dot(p) + stretch * stretch) * T::from_f64(0.5) + q[1])
    }
}

/// Horizontal, with a relaxed spring, moving up.
pub fn start<T: Scalar>() -> State<SVector<T, 2>> {
    State::from_arrays(0.0, [T::one(), T::zero()], [T::zero(), T::one()])
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::scenes::check;

    const SYSTEM: SpringPendulum = SpringPendulum { omega: 50.0 };

    #[test]
    fn the_derivatives_are_those_of_the_energy() {
        let state = State::from_arrays(0.0, [0.7, -0.9], [0.2, 0.5]);
        check::derivatives(&SYSTEM, &state, 1e-5, 1e-8);
        check::needs(NEEDS, &SYSTEM, &state);
    }

    #[test]
    fn the_energy_is_conserved() {
        check::conservation(SYSTEM, start(), 1.0 / 256.0, 2.0, 1e-12);
    }
}
