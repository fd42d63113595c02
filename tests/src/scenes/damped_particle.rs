//! A particle in the plane with the potential `V = |q|²(|q|² − 1)²`, `H = |p|²/2 + V(q)`, and with the damping force
//! `−10⁻³ q'`.
//!
//! [`DampedParticle`] is the system without this force, [`WithFriction`] the system with it: its energy changes at the
//! rate `−DAMPING |q'|²`.
//!
//! *Needs:* nothing. Separable, quadratic kinetic energy, not stiff; a well at the origin and one around the unit
//! circle, with a ridge of the height 4/27 between them.
//! *Source:* Marsden & West, Discrete mechanics and variational integrators (2001), Example 3.2.3 and Figure 2, where no
//! initial values are given; the start is our choice.
//! *Reference:* recorded for the conservative part, [`recorded`].

use symplectic::nalgebra::SVector;
use symplectic::{Scalar, SeparableHamiltonian, State};

use super::Needs;
use crate::references;

/// Its needs.
pub const NEEDS: Needs = Needs::NOTHING;

/// The coefficient of the damping force.
pub const DAMPING: f64 = 1e-3;

/// The conservative part of the system.
#[derive(Clone, Copy, Debug)]
pub struct DampedParticle;

impl SeparableHamiltonian for DampedParticle {
    type Vector<T: Scalar> = SVector<T, 2>;

    #[inline]
    fn velocity<T: Scalar>(&self, _time: T, p: &SVector<T, 2>, velocity: &mut SVector<T, 2>) {
        *velocity = *p;
    }

    #[inline]
    fn force<T: Scalar>(&self, _time: T, q: &SVector<T, 2>, force: &mut SVector<T, 2>) {
        // With s = |q|² the potential is s(s − 1)², and its derivative with respect to s is (s − 1)(3s − 1).
        let square = q.dot(q);
        let slope = (square - T::one()) * (T::from_f64(3.0) * square - T::one());
        *force = -*q * (slope + slope);
    }

    fn energy<T: Scalar>(&self, _time: T, q: &SVector<T, 2>, p: &SVector<T, 2>) -> Option<T> {
        let square = q.dot(q);
        let height = square - T::one();
        Some(p.dot(p) * T::from_f64(0.5) + square * height * height)
    }
}

symplectic::hamiltonian! {
    /// The system with its friction.
    pub WithFriction { damping: 1e-3 }
    q: [2], p: [2];
    H = |p|^2/2 + |q|^2 (|q|^2 - 1)^2
    force: { q[i] = -damping p[i] }
}

/// Outside the circle, with the momentum (0, 1/2) and an energy above the ridge.
pub fn start<T: Scalar>() -> State<SVector<T, 2>> {
    let vector = |components: [f64; 2]| SVector::from(components.map(T::from_f64));
    State::new(0.0, vector([1.25, 0.0]), vector([0.0, 0.5]))
}

/// The recorded reference of the conservative part at `time`, if there is one.
pub fn recorded(time: f64) -> Option<State<SVector<f64, 2>>> {
    references::find("damped particle", "no damping", time)
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::scenes::check;

    #[test]
    fn the_derivatives_are_those_of_the_energy() {
        let state = State::from_arrays(0.0, [0.7, -0.4], [0.2, 0.5]);
        check::derivatives(&DampedParticle, &state, 1e-5, 1e-8);
        check::needs(NEEDS, &DampedParticle, &state);
    }

    /// The force differs by the friction only, and the energy changes by its work.
    #[test]
    fn friction_is_the_only_difference() {
        use symplectic::System;
        let State { q, p, .. } = State::from_arrays(0.0, [0.7, -0.4], [0.2, 0.5]);
        let (mut with, mut without) = (q, q);
        WithFriction::new().force(0.0, &q, &p, &mut with);
        System::force(&DampedParticle, 0.0, &q, &p, &mut without);
        assert!((with - without + p * DAMPING).norm() < 4e-16);
        let energies = [
            WithFriction::new().energy(0.0, &q, &p),
            System::energy(&DampedParticle, 0.0, &q, &p),
        ];
        assert!(energies[0].is_some() && energies[0] == energies[1]);
    }

    #[test]
    fn the_energy_is_conserved() {
        check::conservation(DampedParticle, start(), 1.0 / 32.0, 10.0, 1e-13);
    }
}
