//! The sine-Gordon lattice, a ring of pendulums coupled by springs,
//! `H = Σ (p_i²/2 + (q_{i+1} − q_i)²/(2d²) + 1 − cos q_i)` with the spacing `d = 1/4`.
//!
//! *Needs:* nothing. Separable, quadratic kinetic energy; no frequency exceeds `√(1 + 4/d²)`, about 8. The number of
//! pendulums is the dimension of the vector. *Source:* Duncan, Symplectic finite difference approximations of the
//! nonlinear Klein–Gordon equation, SIAM J. Numer. Anal. 34 (1997); the start is a breather of the equation
//! `q_tt = q_xx − sin q` at its zero. *Reference:* recorded, [`recorded`].

use symplectic::emitted::{Bonds, Chain};
use symplectic::nalgebra::SVector;
use symplectic::{Scalar, State};

use super::Needs;
use crate::references;

/// Its needs.
pub const NEEDS: Needs = Needs::NOTHING;

/// The number of pendulums of the recorded reference.
pub const PENDULUMS: usize = 64;

/// 1/d².
const STIFFNESS: f64 = 16.0;

/// `exp(wd)`, the decay of the breather from one pendulum to the next, with `w = 4 ln(5/4)`.
const RATIO: f64 = 1.25;

/// w.
const DECAY: f64 = 0.892_574_205_256_839;

/// The system, for vectors of any kind and dimension.
pub const fn system() -> Chain<Pendulums> {
    Chain::ring(Pendulums)
}

/// The springs and the pendulums.
#[derive(Clone, Copy, Debug)]
pub struct Pendulums;

impl Bonds for Pendulums {
    const INLINED: bool = true;

    #[inline(always)]
    fn tension<T: Scalar>(&self, _time: T, stretch: T) -> T {
        T::from_f64(STIFFNESS) * stretch
    }

    #[inline(always)]
    fn outer_force<T: Scalar>(&self, _time: T, position: T) -> Option<T> {
        Some(-position.sin())
    }

    fn bond_energy<T: Scalar>(&self, _time: T, stretch: T) -> Option<T> {
        Some(T::from_f64(0.5 * STIFFNESS) * stretch * stretch)
    }

    fn outer_energy<T: Scalar>(&self, _time: T, position: T) -> Option<T> {
        Some(T::one() - position.cos())
    }
}

/// The momenta `4w/cosh(wx)` of a breather centred at pendulum `n/2`.
///
/// Only products and quotients are used, so that the doubles are the same on every machine.
pub fn momenta<T: Scalar>(pendulums: usize) -> impl Iterator<Item = T> {
    (0..pendulums).map(move |i| {
        let mut growth = 1.0;
        for _ in 0..i.abs_diff(pendulums / 2) {
            growth *= RATIO;
        }
        T::from_f64(8.0 * DECAY / (growth + 1.0 / growth))
    })
}

/// All pendulums at the lowest point, with the momenta of a breather.
pub fn start<T: Scalar>() -> State<SVector<T, PENDULUMS>> {
    let p = SVector::from_iterator(momenta(PENDULUMS));
    State::new(0.0, SVector::zeros(), p)
}

/// The recorded reference at `time` from [`start`], if there is one.
pub fn recorded(time: f64) -> Option<State<SVector<f64, PENDULUMS>>> {
    references::find("sine-Gordon lattice", "N = 64", time)
}

#[cfg(test)]
mod tests {
    use symplectic::System;

    use super::*;
    use crate::scenes::check;

    #[test]
    fn the_derivatives_are_those_of_the_energy() {
        let mut state = start();
        state.q = state.p.map(|p: f64| (2.0 * p).sin());
        check::derivatives(&system(), &state, 1e-5, 1e-6);
        check::needs(NEEDS, &system(), &state);
    }

    #[test]
    fn the_energy_is_conserved() {
        check::conservation(system(), start(), 1.0 / 16.0, 2.0, 1e-13);
    }

    #[test]
    fn the_breather_has_its_energy_and_motion() {
        // The breather of the differential equation has the energy 16w, and at its centre q = 4 atan(w/ω sin ωt), ω² =
        // 1 − w².
        let start = start();
        let energy = System::energy(&system(), 0.0, &start.q, &start.p);
        let energy: f64 = energy.expect("an energy");
        assert!(
            (energy * 0.25 / (16.0 * DECAY) - 1.0).abs() < 1e-4,
            "{energy}"
        );
        let omega = (1.0 - DECAY * DECAY).sqrt();
        for time in [1.0, 3.0] {
            let end = check::end(system(), start.clone(), 1.0 / 16.0, time);
            let expected = 4.0 * (DECAY / omega * (omega * time).sin()).atan();
            // The discretization error is d²/12 times the fourth derivative.
            let error = (end.q[PENDULUMS / 2] - expected).abs();
            assert!(error < 0.05, "{error}");
        }
    }
}
