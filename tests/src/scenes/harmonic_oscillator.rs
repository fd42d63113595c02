//! The harmonic oscillator `H = (p² + ω²q²)/2`, the test problem for the stability of methods.
//!
//! *Needs:* nothing. Separable, quadratic kinetic energy; a single frequency is not stiff, but the step size must be
//! within the stability interval `hω < ν*` of the method. *Source:* every textbook; the start is our choice.
//! *Reference:* closed form, [`exact`].

use symplectic::nalgebra::SVector;
use symplectic::system::Masses;
use symplectic::{Scalar, SeparableHamiltonian, State};

use super::Needs;

/// Its needs.
pub const NEEDS: Needs = Needs::NOTHING;

/// The system.
#[derive(Clone, Copy, Debug)]
pub struct HarmonicOscillator {
    /// The frequency ω.
    pub omega: f64,
}

impl SeparableHamiltonian for HarmonicOscillator {
    type Vector<T: Scalar> = SVector<T, 1>;

    const MASSES: Masses = Masses::Unit;

    #[inline]
    fn velocity<T: Scalar>(&self, _time: T, p: &SVector<T, 1>, velocity: &mut SVector<T, 1>) {
        *velocity = *p;
    }

    #[inline]
    fn force<T: Scalar>(&self, _time: T, q: &SVector<T, 1>, force: &mut SVector<T, 1>) {
        let omega = T::from_f64(self.omega);
        force[0] = -(omega * omega * q[0]);
    }

    fn energy<T: Scalar>(&self, _time: T, q: &SVector<T, 1>, p: &SVector<T, 1>) -> Option<T> {
        let elongation = T::from_f64(self.omega) * q[0];
        Some((p[0] * p[0] + elongation * elongation) * T::from_f64(0.5))
    }
}

/// At rest with the elongation 1.
pub fn start<T: Scalar>() -> State<SVector<T, 1>> {
    State::from_arrays(0.0, [T::one()], [T::zero()])
}

/// The solution `q = cos ωt`, `p = −ω sin ωt`, to a few rounding errors for any number of periods.
pub fn exact(omega: f64, time: f64) -> State<SVector<f64, 1>> {
    // ωt as an unevaluated sum of two doubles.
    let angle = omega * time;
    let rest = omega.mul_add(time, -angle);
    let (sine, cosine) = angle.sin_cos();
    State::from_arrays(
        time,
        [cosine - rest * sine],
        [-omega * (sine + rest * cosine)],
    )
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::scenes::check;

    const SYSTEM: HarmonicOscillator = HarmonicOscillator { omega: 3.0 };

    #[test]
    fn the_derivatives_are_those_of_the_energy() {
        let state = State::from_arrays(0.0, [0.7], [-1.3]);
        check::derivatives(&SYSTEM, &state, 1e-5, 1e-8);
        check::needs(NEEDS, &SYSTEM, &state);
    }

    #[test]
    fn the_energy_is_conserved() {
        check::conservation(SYSTEM, start(), 0.125, 10.0, 1e-13);
    }

    #[test]
    fn the_closed_form_agrees_with_the_integrator() {
        let (found, expected) = (check::end(SYSTEM, start(), 0.125, 10.0), exact(3.0, 10.0));
        assert!((found.q - expected.q).norm() < 1e-13);
        assert!((found.p - expected.p).norm() < 1e-13);
    }

    #[test]
    fn the_angle_is_that_of_the_doubles_after_many_periods() {
        // mpmath 1.3, 40 digits, for the doubles 0.1 and 10⁹ + 1; the cosine of the rounded product is −0.45457839263.
        let state = exact(0.1, 1e9 + 1.0);
        assert!((state.q[0] + 0.454_578_389_611_146_2).abs() < 4.0 * f64::EPSILON);
    }
}
