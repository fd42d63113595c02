//! The double pendulum with masses and lengths 1,
//! `H = (p_1² + 2p_2² − 2p_1 p_2 cos δ)/(2(1 + sin² δ)) − g(2 cos q_1 + cos q_2)`, where `δ = q_1 − q_2`; angles from
//! the vertical, in radians.
//!
//! *Needs:* a method for general Hamiltonians, sine and cosine. Not separable, not stiff; chaotic: neighbouring orbits
//! diverge exponentially. *Source:* the equations are those of every textbook of mechanics; the angles at the start are
//! our choice. *Reference:* recorded, [`recorded`].

use symplectic::nalgebra::SVector;
use symplectic::{General, Hamiltonian, Scalar, State};

use super::Needs;
use crate::references;

/// Its needs.
pub const NEEDS: Needs = Needs::GENERAL;

/// The acceleration of gravity g.
pub const GRAVITY: f64 = 9.8;

/// The system.
#[derive(Clone, Copy, Debug)]
pub struct DoublePendulum;

impl Hamiltonian for DoublePendulum {
    type Class = General;
    type Vector<T: Scalar> = SVector<T, 2>;

    const INLINED: bool = true;

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

/// The velocities from `cos δ`.
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

/// The forces from these sines and `cos δ`.
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

symplectic::hamiltonian! {
    /// The double pendulum in Cartesian coordinates, with two rods as constraints.
    pub OnRods { g: 9.8 }
    q: [x1, y1, x2, y2], p: [px1, py1, px2, py2];
    H = (px1^2 + py1^2 + px2^2 + py2^2)/2 + g (y1 + y2)
    constraints: { first = x1^2 + y1^2 - 1, second = (x2 - x1)^2 + (y2 - y1)^2 - 1 }
}

/// The state of [`OnRods`] for a state in angles.
pub fn on_rods(state: &State<SVector<f64, 2>>) -> State<SVector<f64, 4>> {
    let ([(s1, c1), (s2, c2)], v) = (
        [state.q[0].sin_cos(), state.q[1].sin_cos()],
        velocities(Scalar::cos(state.q[0] - state.q[1]), &state.p),
    );
    let (first, second) = ([v[0] * c1, v[0] * s1], [v[1] * c2, v[1] * s2]);
    State::from_arrays(
        state.time,
        [s1, -c1, s1 + s2, -c1 - c2],
        [
            first[0],
            first[1],
            first[0] + second[0],
            first[1] + second[1],
        ],
    )
}

/// The states of [`OnRods`] at rest beside these angles: their rounding errors are independent.
pub fn neighbours([first, second]: [f64; 2], orbits: u32) -> Vec<State<SVector<f64, 4>>> {
    let at_rest = |k: u32| {
        let mut angles = start::<f64>();
        angles.q = [first + 1e-3 * f64::from(k), second].into();
        on_rods(&angles)
    };
    (0..orbits).map(at_rest).collect()
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

    /// Both formulations have the same energy, and the rods have length 1.
    #[test]
    fn rods_are_the_same_motion() {
        use symplectic::System;
        use symplectic::constraints::HolonomicConstraints;
        let state = State::new(0.0, SVector::from([1.0, -0.4]), SVector::from([0.7, -1.3]));
        let rods = on_rods(&state);
        let energies = [
            System::energy(&DoublePendulum, 0.0, &state.q, &state.p),
            System::energy(&OnRods::new(), 0.0, &rods.q, &rods.p),
        ];
        let [Some(angles), Some(cartesian)] = energies else {
            panic!("both are known")
        };
        assert!((angles - cartesian).abs() < 1e-14);
        let mut lengths = [1.0; 2];
        HolonomicConstraints::constraint_values(&OnRods::new(), &rods.q, &mut lengths);
        assert!(lengths.iter().all(|length| length.abs() < 1e-15));
    }

    #[test]
    fn the_energy_is_conserved() {
        check::conservation(DoublePendulum, start(), 1.0 / 64.0, 2.0, 1e-13);
    }
}
