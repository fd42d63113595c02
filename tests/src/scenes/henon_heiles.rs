//! The Hénon–Heiles system, `H = (|p|² + |q|²)/2 + q_1² q_2 − q_2³/3`: a star in a galaxy.
//!
//! *Needs:* nothing. Separable, quadratic kinetic energy, not stiff; orbits are bounded up to the energy 1/6, and
//! many are chaotic from 1/12 on.
//! *Source:* Hénon & Heiles, 1964; Hairer, Lubich & Wanner, Geometric Numerical Integration (GNI), §I.3.
//! *Reference:* recorded, [`recorded`].

use symplectic::nalgebra::SVector;
use symplectic::system::Masses;
use symplectic::{Scalar, SeparableHamiltonian, State};

use super::Needs;
use crate::references;

/// Its needs.
pub const NEEDS: Needs = Needs::NOTHING;

/// The system.
#[derive(Clone, Copy, Debug)]
pub struct HenonHeiles;

impl SeparableHamiltonian for HenonHeiles {
    type Vector<T: Scalar> = SVector<T, 2>;

    const MASSES: Masses = Masses::Unit;
    const INLINED: bool = true;

    #[inline(always)]
    fn velocity<T: Scalar>(&self, _time: T, p: &SVector<T, 2>, velocity: &mut SVector<T, 2>) {
        *velocity = *p;
    }

    #[inline(always)]
    fn force<T: Scalar>(&self, _time: T, q: &SVector<T, 2>, force: &mut SVector<T, 2>) {
        let product = q[0] * q[1];
        force[0] = -q[0] - product - product;
        force[1] = q[1] * q[1] - q[0] * q[0] - q[1];
    }

    fn energy<T: Scalar>(&self, _time: T, q: &SVector<T, 2>, p: &SVector<T, 2>) -> Option<T> {
        let third = q[1] * q[1] * q[1] / T::from_f64(3.0);
        let harmonic = (p.dot(p) + q.dot(q)) * T::from_f64(0.5);
        Some(harmonic + q[0] * q[0] * q[1] - third)
    }
}

/// From the origin with the momentum (0.3, 0.4), of energy 1/8.
pub fn start<T: Scalar>() -> State<SVector<T, 2>> {
    let [first, second] = [0.3, 0.4].map(T::from_f64);
    State::new(
        0.0,
        SVector::from([T::zero(), T::zero()]),
        SVector::from([first, second]),
    )
}

/// From the origin with the momentum `(1/2, 1/2)/√3`, of energy 1/12 up to rounding.
pub fn start_at_one_twelfth<T: Scalar>() -> State<SVector<T, 2>> {
    let component = T::from_f64((1.0_f64 / 12.0).sqrt());
    State::from_arrays(0.0, [T::zero(), T::zero()], [component, component])
}

/// From the point (q_2, p_2) of the section q_1 = 0, with this energy and q_1 increasing; NaN if there is no such
/// state.
pub fn on_section(energy: f64, q2: f64, p2: f64) -> State<SVector<f64, 2>> {
    let rest = 2.0 * energy - p2 * p2 - q2 * q2 + 2.0 / 3.0 * q2 * q2 * q2;
    State::from_arrays(0.0, [0.0, q2], [rest.sqrt(), p2])
}

/// The recorded reference at `time` from [`start`], if there is one.
pub fn recorded(time: f64) -> Option<State<SVector<f64, 2>>> {
    references::find("Hénon–Heiles", "E = 1/8", time)
}

/// The recorded reference at `time` from [`start_at_one_twelfth`], if there is one.
pub fn recorded_at_one_twelfth(time: f64) -> Option<State<SVector<f64, 2>>> {
    references::find("Hénon–Heiles", "E = 1/12", time)
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::scenes::check;

    #[test]
    fn the_derivatives_are_those_of_the_energy() {
        let state = State::new(0.0, SVector::from([0.3, -0.4]), SVector::from([0.2, 0.5]));
        check::derivatives(&HenonHeiles, &state, 1e-5, 1e-8);
        check::needs(NEEDS, &HenonHeiles, &state);
    }

    #[test]
    fn the_energy_is_conserved() {
        check::conservation(HenonHeiles, start(), 0.25, 10.0, 1e-13);
    }
}
