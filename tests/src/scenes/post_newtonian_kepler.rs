//! The first post-Newtonian two-body problem, in units of the total mass, relative coordinates and the reduced mass:
//!
//! `H = p²/2 − 1/r + ε(−(1 − 3ν) p⁴/8 − ((3 + ν) p² + ν p_r²)/(2r) + 1/(2r²))`, `p_r = q·p/r`,
//!
//! with `ε = 1/c²` and the ratio `ν = m_1 m_2/(m_1 + m_2)²` between 0 and 1/4.
//!
//! *Needs:* a method for general Hamiltonians. Not separable, not stiff; the pericentre advances by `6πε/(a(1 − e²))`
//! per revolution, to first order. *Source:* Damour & Schäfer, Nuovo Cimento B 101 (1988), the Hamiltonian in ADM
//! coordinates; the start, at the pericentre of the Newtonian orbit with e = 0.6, is our choice. *Reference:* recorded,
//! [`recorded`].

use symplectic::nalgebra::SVector;
use symplectic::{General, Hamiltonian, Scalar, State};

use super::{Needs, kepler};
use crate::references;

/// Its needs.
pub const NEEDS: Needs = Needs::GENERAL;

/// The system of the recorded reference: equal masses, speeds of a few per cent of that of light.
pub const EQUAL_MASSES: PostNewtonianKepler = PostNewtonianKepler {
    epsilon: 0.001,
    mass_ratio: 0.25,
};

/// The system.
#[derive(Clone, Copy, Debug)]
pub struct PostNewtonianKepler {
    /// ε = 1/c².
    pub epsilon: f64,
    /// ν.
    pub mass_ratio: f64,
}

impl Hamiltonian for PostNewtonianKepler {
    type Class = General;
    type Vector<T: Scalar> = SVector<T, 2>;

    #[inline]
    fn velocity<T: Scalar>(
        &self,
        _time: T,
        q: &SVector<T, 2>,
        p: &SVector<T, 2>,
        velocity: &mut SVector<T, 2>,
    ) {
        let [epsilon, nu] = [self.epsilon, self.mass_ratio].map(T::from_f64);
        let Orbit { inverse, radial } = Orbit::new(q, p);
        let along = self.fourth::<T>() * p.dot(p) + (T::from_f64(3.0) + nu) * inverse;
        *velocity =
            p * (T::one() - epsilon * along) - q * (epsilon * nu * radial * inverse * inverse);
    }

    #[inline]
    fn force<T: Scalar>(
        &self,
        _time: T,
        q: &SVector<T, 2>,
        p: &SVector<T, 2>,
        force: &mut SVector<T, 2>,
    ) {
        let [epsilon, nu] = [self.epsilon, self.mass_ratio].map(T::from_f64);
        let [half, three] = [0.5, 3.0].map(T::from_f64);
        let Orbit { inverse, radial } = Orbit::new(q, p);
        // The coefficient of q/r³: ∂(1/r)/∂q = −q/r³, and p_r²/r = (q·p)²/r³.
        let correction = half * ((three + nu) * p.dot(p) + three * nu * radial * radial) - inverse;
        let square = inverse * inverse;
        *force = -(q * (square * inverse * (T::one() + epsilon * correction)))
            + p * (epsilon * nu * radial * square);
    }

    fn energy<T: Scalar>(&self, _time: T, q: &SVector<T, 2>, p: &SVector<T, 2>) -> Option<T> {
        let [epsilon, nu] = [self.epsilon, self.mass_ratio].map(T::from_f64);
        let [half, three] = [0.5, 3.0].map(T::from_f64);
        let Orbit { inverse, radial } = Orbit::new(q, p);
        let square = p.dot(p);
        let newton = half * square - inverse;
        let motion = T::from_f64(0.25) * self.fourth::<T>() * square * square;
        let mixed = ((three + nu) * square + nu * radial * radial - inverse) * inverse;
        Some(newton - epsilon * (motion + half * mixed))
    }
}

impl PostNewtonianKepler {
    /// (1 − 3ν)/2
    fn fourth<T: Scalar>(&self) -> T {
        (T::one() - T::from_f64(3.0) * T::from_f64(self.mass_ratio)) * T::from_f64(0.5)
    }
}

struct Orbit<T> {
    /// 1/r
    inverse: T,
    /// p_r
    radial: T,
}

impl<T: Scalar> Orbit<T> {
    #[inline]
    fn new(q: &SVector<T, 2>, p: &SVector<T, 2>) -> Self {
        let inverse = q.dot(q).sqrt().recip();
        Self {
            inverse,
            radial: q.dot(p) * inverse,
        }
    }
}

/// The pericentre of the Newtonian orbit of eccentricity 0.6.
pub fn start<T: Scalar>() -> State<SVector<T, 2>> {
    kepler::start(0.6)
}

/// The recorded reference of [`EQUAL_MASSES`] at `time`, if there is one.
pub fn recorded(time: f64) -> Option<State<SVector<f64, 2>>> {
    references::find("post-Newtonian Kepler", "ε = 0.001, ν = 1/4", time)
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::scenes::check;
    use std::f64::consts::{PI, TAU};
    use symplectic::{Event, Integrator};

    #[test]
    fn the_derivatives_are_those_of_the_energy() {
        let state = State::from_arrays(0.0, [0.7, -0.4], [0.2, 0.9]);
        for (epsilon, mass_ratio) in [(0.0, 0.0), (0.1, 0.0), (0.1, 0.25), (0.3, 0.125)] {
            let system = PostNewtonianKepler {
                epsilon,
                mass_ratio,
            };
            check::derivatives(&system, &state, 1e-5, 1e-8);
        }
        check::needs(NEEDS, &EQUAL_MASSES, &state);
    }

    #[test]
    fn the_energy_is_conserved() {
        check::conservation(EQUAL_MASSES, start(), 1.0 / 64.0, 5.0, 1e-13);
    }

    #[test]
    fn the_pericentre_advances_by_the_known_angle() {
        let system = PostNewtonianKepler {
            epsilon: 1e-6,
            mass_ratio: 0.25,
        };
        let pericentre =
            Event::rising(|state: &State<SVector<f64, 2>>| state.q.dot(&state.p)).by_steps();
        let mut integrator =
            Integrator::new(crate::methods::Gauss8, system, start(), 1.0 / 32.0).expect("a start");
        integrator.integrate_to(1.0).expect("small steps converge");
        let place = integrator
            .find_event(TAU * 1.25, &pericentre)
            .expect("a turn");
        let place = place.expect("a pericentre after one turn");
        // The Newtonian start is also a pericentre of the corrected orbit; both elements change by O(ε).
        let expected = 6.0 * PI * 1e-6 / (1.0 - 0.36);
        let angle = place.q[1].atan2(place.q[0]);
        assert!(
            (angle / expected - 1.0).abs() < 1e-4,
            "{angle:e} {expected:e}"
        );
    }
}
