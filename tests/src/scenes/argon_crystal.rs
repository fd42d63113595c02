//! A frozen argon crystal: seven atoms in the plane, one in the middle of six, near the minimum of the Lennard-Jones
//! potential `V(r) = 4ε((σ/r)¹² − (σ/r)⁶)`; `H = Σ |p_i|²/(2m) + Σ_{i<j} V(|q_i − q_j|)`.
//!
//! Units: nanometres, nanoseconds, and for energies Boltzmann's constant times one kelvin.
//!
//! *Needs:* nothing. Separable, quadratic kinetic energy, not stiff; the atoms oscillate with periods of some 10⁻³ ns.
//! *Source:* GNI §I.4, Table 4.1, after Biesiadecki & Skeel, 1993. The tests compare the data with the energy and the
//! temperature stated in GNI. *Reference:* recorded, [`recorded`].

use symplectic::nalgebra::SVector;
use symplectic::{Scalar, SeparableHamiltonian, State};

use super::Needs;
use crate::references;

/// Its needs.
pub const NEEDS: Needs = Needs::NOTHING;

/// Number of atoms.
pub const ATOMS: usize = 7;

/// Number of coordinates; atom i has the coordinates 2i and 2i + 1.
pub const COORDINATES: usize = 2 * ATOMS;

/// ε in kelvin.
pub const DEPTH: f64 = 119.8;

/// σ in nanometres.
pub const DIAMETER: f64 = 0.341;

/// The mass of an atom, 66.34·10⁻²⁷ kg, over Boltzmann's constant, 1.380658·10⁻²³ J/K.
pub const MASS: f64 = 66.34e-4 / 1.380_658;

/// GNI Table 4.1: positions in nanometres.
const POSITIONS: [f64; COORDINATES] = [
    0.00, 0.00, 0.02, 0.39, 0.34, 0.17, 0.36, -0.21, -0.02, -0.40, -0.35, -0.16, -0.31, 0.21,
];

/// GNI Table 4.1: velocities in nanometres per nanosecond.
const VELOCITIES: [f64; COORDINATES] = [
    -30.0, -20.0, 50.0, -90.0, -70.0, -60.0, 90.0, 40.0, 80.0, 90.0, -40.0, 100.0, -80.0, -60.0,
];

/// The system.
#[derive(Clone, Copy, Debug)]
pub struct ArgonCrystal;

impl SeparableHamiltonian for ArgonCrystal {
    type Vector<T: Scalar> = SVector<T, COORDINATES>;

    #[inline]
    fn velocity<T: Scalar>(
        &self,
        _time: T,
        p: &SVector<T, COORDINATES>,
        velocity: &mut SVector<T, COORDINATES>,
    ) {
        *velocity = p * T::from_f64(1.0 / MASS);
    }

    #[inline]
    fn force<T: Scalar>(
        &self,
        _time: T,
        q: &SVector<T, COORDINATES>,
        force: &mut SVector<T, COORDINATES>,
    ) {
        force.fill(T::zero());
        for i in 0..ATOMS {
            for j in i + 1..ATOMS {
                let (difference, inverse) = separation(q, i, j);
                let sixth = sixth_power(inverse);
                // −V'(r)/r
                let push = T::from_f64(24.0 * DEPTH) * inverse * sixth * (sixth + sixth - T::one());
                for k in 0..2 {
                    let push = push * difference[k];
                    force[2 * i + k] -= push;
                    force[2 * j + k] += push;
                }
            }
        }
    }

    fn energy<T: Scalar>(
        &self,
        _time: T,
        q: &SVector<T, COORDINATES>,
        p: &SVector<T, COORDINATES>,
    ) -> Option<T> {
        let mut energy = p.dot(p) * T::from_f64(0.5 / MASS);
        for i in 0..ATOMS {
            for j in i + 1..ATOMS {
                let sixth = sixth_power(separation(q, i, j).1);
                energy += T::from_f64(4.0 * DEPTH) * sixth * (sixth - T::one());
            }
        }
        Some(energy)
    }
}

/// q_j − q_i and 1/r².
#[inline]
fn separation<T: Scalar>(q: &SVector<T, COORDINATES>, i: usize, j: usize) -> ([T; 2], T) {
    let d = [q[2 * j] - q[2 * i], q[2 * j + 1] - q[2 * i + 1]];
    (d, (d[0] * d[0] + d[1] * d[1]).recip())
}

/// (σ/r)⁶ from 1/r².
#[inline]
fn sixth_power<T: Scalar>(inverse: T) -> T {
    let square = T::from_f64(DIAMETER * DIAMETER) * inverse;
    square * square * square
}

/// The atoms near the corners of a hexagon, slowly moving.
pub fn start<T: Scalar>() -> State<SVector<T, COORDINATES>> {
    State::new(
        0.0,
        SVector::from(POSITIONS.map(T::from_f64)),
        SVector::from(VELOCITIES.map(|v| T::from_f64(MASS * v))),
    )
}

/// The temperature in kelvin: the mean kinetic energy per atom, with two degrees of freedom in the plane.
pub fn temperature(state: &State<SVector<f64, COORDINATES>>) -> f64 {
    state.p.norm_squared() / (2.0 * MASS * ATOMS as f64)
}

/// The recorded reference at `time`, if there is one.
pub fn recorded(time: f64) -> Option<State<SVector<f64, COORDINATES>>> {
    references::find("argon crystal", "", time)
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::scenes::check;

    #[test]
    fn the_derivatives_are_those_of_the_energy() {
        check::derivatives(&ArgonCrystal, &start(), 1e-6, 1e-6);
        check::needs(NEEDS, &ArgonCrystal, &start());
    }

    #[test]
    fn the_energy_is_conserved() {
        check::conservation(ArgonCrystal, start(), 5e-5, 1e-2, 1e-13);
    }

    #[test]
    fn energy_and_temperature_are_those_of_the_source() {
        let start = start();
        let energy = SeparableHamiltonian::energy(&ArgonCrystal, 0.0, &start.q, &start.p);
        let energy: f64 = energy.expect("an energy");
        // GNI: H ≈ −1260.2 and T ≈ 22.72 K, which a wrong digit in the table would change; the total momentum is zero.
        assert!((energy + 1260.2).abs() < 0.05, "{energy}");
        assert!((temperature(&start) - 22.72).abs() < 0.005);
        let momentum = |k: usize| -> f64 { VELOCITIES.iter().skip(k).step_by(2).sum() };
        assert_eq!([momentum(0), momentum(1)], [0.0, 0.0]);
    }
}
