//! Three bodies with masses 3, 4 and 5, at rest at the corners of a triangle with sides 3, 4 and 5, each opposite the
//! side of the same number: `H = Σ |p_i|²/(2m_i) − Σ_{i<j} m_i m_j/|q_i − q_j|` in the plane.
//!
//! *Needs:* nothing except steps that resolve its close encounters. Separable, quadratic kinetic energy; the smallest
//! distance is 4·10⁻⁴ (at t = 15.83) before a body is ejected at about t = 60. *Source:* Burrau, Astron. Nachr. 195
//! (1913); Szebehely & Peters, Astron. J. 72 (1967), who found the end. *Reference:* recorded, [`recorded`].

use std::array;

use symplectic::nalgebra::SVector;
use symplectic::{Scalar, SeparableHamiltonian, State};

use super::Needs;
use crate::references;

/// Its needs.
pub const NEEDS: Needs = Needs::NOTHING;

/// Number of bodies.
pub const BODIES: usize = 3;

/// Number of coordinates; body i has the coordinates 2i and 2i + 1.
pub const COORDINATES: usize = 2 * BODIES;

/// The masses.
pub const MASSES: [f64; BODIES] = [3.0, 4.0, 5.0];

/// The system.
#[derive(Clone, Copy, Debug)]
pub struct PythagoreanThreeBody;

impl SeparableHamiltonian for PythagoreanThreeBody {
    type Vector<T: Scalar> = SVector<T, COORDINATES>;

    #[inline]
    fn velocity<T: Scalar>(
        &self,
        _time: T,
        p: &SVector<T, COORDINATES>,
        velocity: &mut SVector<T, COORDINATES>,
    ) {
        for k in 0..COORDINATES {
            velocity[k] = p[k] / T::from_f64(MASSES[k / 2]);
        }
    }

    #[inline]
    fn force<T: Scalar>(
        &self,
        _time: T,
        q: &SVector<T, COORDINATES>,
        force: &mut SVector<T, COORDINATES>,
    ) {
        force.fill(T::zero());
        for (i, j) in PAIRS {
            let (difference, square) = separation(q, i, j);
            let strength = T::from_f64(MASSES[i] * MASSES[j]) / (square * square.sqrt());
            for k in 0..2 {
                let pull = strength * difference[k];
                force[2 * i + k] += pull;
                force[2 * j + k] -= pull;
            }
        }
    }

    fn energy<T: Scalar>(
        &self,
        _time: T,
        q: &SVector<T, COORDINATES>,
        p: &SVector<T, COORDINATES>,
    ) -> Option<T> {
        let mut energy = T::zero();
        for k in 0..COORDINATES {
            energy += p[k] * p[k] / T::from_f64(2.0 * MASSES[k / 2]);
        }
        for (i, j) in PAIRS {
            energy -= T::from_f64(MASSES[i] * MASSES[j]) / separation(q, i, j).1.sqrt();
        }
        Some(energy)
    }
}

const PAIRS: [(usize, usize); 3] = [(0, 1), (0, 2), (1, 2)];

/// q_j − q_i and the square of its length.
#[inline]
fn separation<T: Scalar>(q: &SVector<T, COORDINATES>, i: usize, j: usize) -> ([T; 2], T) {
    let d = array::from_fn(|k| q[2 * j + k] - q[2 * i + k]);
    (d, d[0] * d[0] + d[1] * d[1])
}

/// The distances of the pairs of bodies: of 3 and 4, of 3 and 5, of 4 and 5.
pub fn distances<T: Scalar>(q: &SVector<T, COORDINATES>) -> [T; 3] {
    PAIRS.map(|(i, j)| separation(q, i, j).1.sqrt())
}

/// At rest at the corners (1, 3), (−2, −1) and (1, −1), with the centre of mass in the origin.
pub fn start<T: Scalar>() -> State<SVector<T, COORDINATES>> {
    let corners = [1.0, 3.0, -2.0, -1.0, 1.0, -1.0];
    State::new(
        0.0,
        SVector::from(corners.map(T::from_f64)),
        SVector::zeros(),
    )
}

/// The recorded reference at `time`, if there is one.
pub fn recorded(time: f64) -> Option<State<SVector<f64, COORDINATES>>> {
    references::find("Pythagorean three-body", "", time)
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::scenes::check;

    #[test]
    fn the_derivatives_are_those_of_the_energy() {
        let mut state = start();
        state.p = SVector::from([0.3, -0.2, 0.5, 0.7, -1.1, 0.4]);
        check::derivatives(&PythagoreanThreeBody, &state, 1e-5, 1e-8);
        check::needs(NEEDS, &PythagoreanThreeBody, &state);
    }

    #[test]
    fn the_energy_is_conserved() {
        check::conservation(PythagoreanThreeBody, start(), 1.0 / 256.0, 1.5, 1e-13);
    }

    #[test]
    fn the_bodies_are_opposite_to_the_sides_of_their_number() {
        assert_eq!(distances(&start::<f64>().q), [5.0, 4.0, 3.0]);
    }
}
