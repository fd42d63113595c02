//! `H = (q² + 1)(p² + 1)/2` in one dimension: a Hamiltonian that is not separable, with polynomial derivatives.
//!
//! *Needs:* a method for general Hamiltonians. Not separable, not stiff; every orbit is periodic.
//! *Source:* Tao, Explicit symplectic approximation of nonseparable Hamiltonians, Phys. Rev. E 94, 043303 (2016).
//! *Reference:* recorded, [`recorded`].

use symplectic::nalgebra::SVector;
use symplectic::{General, Hamiltonian, Scalar, State};

use super::Needs;
use crate::references;

/// Its needs.
pub const NEEDS: Needs = Needs::GENERAL;

/// The system.
#[derive(Clone, Copy, Debug)]
pub struct Nonseparable;

impl Hamiltonian for Nonseparable {
    type Class = General;
    type Vector<T: Scalar> = SVector<T, 1>;

    const INLINED: bool = true;

    #[inline(always)]
    fn velocity<T: Scalar>(
        &self,
        _time: T,
        q: &SVector<T, 1>,
        p: &SVector<T, 1>,
        velocity: &mut SVector<T, 1>,
    ) {
        velocity[0] = p[0] * (q[0] * q[0] + T::one());
    }

    #[inline(always)]
    fn force<T: Scalar>(
        &self,
        _time: T,
        q: &SVector<T, 1>,
        p: &SVector<T, 1>,
        force: &mut SVector<T, 1>,
    ) {
        force[0] = -q[0] * (p[0] * p[0] + T::one());
    }

    fn energy<T: Scalar>(&self, _time: T, q: &SVector<T, 1>, p: &SVector<T, 1>) -> Option<T> {
        let one = T::one();
        Some((q[0] * q[0] + one) * (p[0] * p[0] + one) * T::from_f64(0.5))
    }
}

/// From the origin with the momentum −3, of energy 5.
pub fn start<T: Scalar>() -> State<SVector<T, 1>> {
    State::new(
        0.0,
        SVector::from([T::zero()]),
        SVector::from([T::from_f64(-3.0)]),
    )
}

/// The recorded reference at `time`, if there is one.
pub fn recorded(time: f64) -> Option<State<SVector<f64, 1>>> {
    references::find("nonseparable", "", time)
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::scenes::check;

    #[test]
    fn the_derivatives_are_those_of_the_energy() {
        let state = State::new(0.0, SVector::from([1.3]), SVector::from([-0.7]));
        check::derivatives(&Nonseparable, &state, 1e-5, 1e-8);
        check::needs(NEEDS, &Nonseparable, &state);
    }

    #[test]
    fn the_energy_is_conserved() {
        check::conservation(Nonseparable, start(), 1.0 / 32.0, 2.0, 1e-13);
    }
}
