//! The double pendulum with masses and lengths 1,
//! `H = (p_1² + 2p_2² − 2p_1 p_2 cos δ)/(2(1 + sin² δ)) − g(2 cos q_1 + cos q_2)`, where `δ = q_1 − q_2`; angles from
//! the vertical, in radians.
//!
//! *Needs:* a method for general Hamiltonians, sine and cosine. Not separable, not stiff; chaotic, so that neighbouring
//! orbits part exponentially.
//! *Source:* the equations are those of every textbook of mechanics; the angles at the start are our choice.
//! *Reference:* recorded, [`recorded`].

use symplectic::nalgebra::SVector;
use symplectic::{General, Hamiltonian, Scalar, State};

use super::Needs;
use crate::references;

/// What it needs.
pub const NEEDS: Needs = Needs::GENERAL;

/// The acceleration of gravity g.
pub const GRAVITY: f64 = 9.8;

/// The system.
#[derive(Clone, Copy, Debug)]
pub struct DoublePendulum;

impl Hamiltonian for DoublePendulum {
    type Class = General;
    type Vector<T: Scalar> = SVector<T, 2>;

    #[inline(always)]
    fn velocity<T: Scalar>(
        &self,
        _time: T,
        q: &SVector<T, 2>,
        p: &SVector<T, 2>,
        velocity: &mut SVector<T, 2>,
    ) {
        *velocity = velocities((q[0] - q[1]).cos(), p);
    }

    #[inline(always)]
    fn force<T: Scalar>(
        &self,
        _time: T,
        q: &SVector<T, 2>,
        p: &SVector<T, 2>,
        force: &mut SVector<T, 2>,
    ) {
        let (sines, cosine) = sines(q);
        *force = forces(sines, cosine, p);
    }

    #[inline(always)]
    fn slopes<T: Scalar>(
        &self,
        _time: T,
        q: &SVector<T, 2>,
        p: &SVector<T, 2>,
        (velocity, force): (&mut SVector<T, 2>, &mut SVector<T, 2>),
    ) {
        let (sines, cosine) = sines(q);
        *velocity = velocities(cosine, p);
        *force = forces(sines, cosine, p);
    }

    fn energy<T: Scalar>(&self, _time: T, q: &SVector<T, 2>, p: &SVector<T, 2>) -> Option<T> {
        let (sine, cosine) = (q[0] - q[1]).sin_cos();
        let two = T::from_f64(2.0);
        let numerator = p[0] * p[0] + (p[1] * p[1] - p[0] * p[1] * cosine) * two;
        let kinetic = numerator / (two * (T::one() + sine * sine));
        Some(kinetic - T::from_f64(GRAVITY) * (two * q[0].cos() + q[1].cos()))
    }
}

/// `1/(1 + sin² δ)`
#[inline(always)]
fn inverse<T: Scalar>(cosine: T) -> T {
    (T::from_f64(2.0) - cosine * cosine).recip()
}

/// The velocities by `cos δ`.
#[inline(always)]
fn velocities<T: Scalar>(cosine: T, p: &SVector<T, 2>) -> SVector<T, 2> {
    let inverse = inverse(cosine);
    SVector::from([
        (p[0] - p[1] * cosine) * inverse,
        (p[1] + p[1] - p[0] * cosine) * inverse,
    ])
}

/// `sin δ`, `sin q_1`, `sin q_2`, and `cos δ`.
#[inline(always)]
fn sines<T: Scalar>(q: &SVector<T, 2>) -> ([T; 3], T) {
    let [(sine, cosine), (first, _), (second, _)] = T::sin_cos_all([q[0] - q[1], q[0], q[1]]);
    ([sine, first, second], cosine)
}

/// The forces by these sines and `cos δ`.
#[inline(always)]
fn forces<T: Scalar>([sine, first, second]: [T; 3], cosine: T, p: &SVector<T, 2>) -> SVector<T, 2> {
    let inverse = inverse(cosine);
    let product = p[0] * p[1];
    let twice_kinetic =
        (p[0] * p[0] + (p[1] * p[1] - product * cosine) * T::from_f64(2.0)) * inverse;
    // ∂H/∂δ
    let coupling = sine * inverse * (product - twice_kinetic * cosine);
    SVector::from([
        -coupling - first * T::from_f64(2.0 * GRAVITY),
        coupling - second * T::from_f64(GRAVITY),
    ])
}

/// At rest with the angles (1, 1/2).
pub fn start<T: Scalar>() -> State<SVector<T, 2>> {
    State::new(
        0.0,
        SVector::from([1.0, 0.5].map(T::from_f64)),
        SVector::from([T::zero(), T::zero()]),
    )
}

/// The recorded reference at `time`, if there is one.
pub fn recorded(time: f64) -> Option<State<SVector<f64, 2>>> {
    references::find("double pendulum", "", time)
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::scenes::check;

    #[test]
    fn the_derivatives_are_those_of_the_energy() {
        let state = State::new(0.0, SVector::from([1.0, -0.4]), SVector::from([0.7, -1.3]));
        check::derivatives(&DoublePendulum, &state, 1e-5, 1e-8);
        check::needs(NEEDS, &DoublePendulum, &state);
    }

    #[test]
    fn the_energy_is_conserved() {
        check::conservation(DoublePendulum, start(), 1.0 / 64.0, 2.0, 1e-13);
    }
}
