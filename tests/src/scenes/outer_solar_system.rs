//! The Sun and the five outer planets, `H = Σ |p_i|²/(2 m_i) − G Σ_{i<j} m_i m_j/|q_i − q_j|`, in astronomical units,
//! days and solar masses.
//!
//! *Needs:* nothing. Separable, quadratic kinetic energy, not stiff, no close encounters; many revolutions. *Source:*
//! GNI §I.2.4, after Ahnerts Kalender für Sternfreunde 1994: 5 September 1994, 0 h. The Sun's mass includes the masses
//! of the inner planets. *Reference:* recorded, [`recorded`]; at other times a much finer run of high order,
//! [`reference()`].

use std::array;

use symplectic::nalgebra::SVector;
use symplectic::{Error, Scalar, SeparableHamiltonian, State};

use super::Needs;
use crate::measure::integrate;
use crate::methods::Gauss8;
use crate::references;

/// Its needs.
pub const NEEDS: Needs = Needs::NOTHING;

/// Number of bodies.
pub const BODIES: usize = 6;

/// Number of coordinates; body i has the coordinates 3i, 3i + 1 and 3i + 2.
pub const COORDINATES: usize = 3 * BODIES;

/// The gravitational constant in AU³ per solar mass and day².
pub const GRAVITATIONAL_CONSTANT: f64 = 2.959_122_082_86e-4;

/// A body at the start.
#[derive(Clone, Copy, Debug)]
pub struct Body {
    /// Its name.
    pub name: &'static str,
    /// Its mass in solar masses.
    pub mass: f64,
    /// Its position in AU, relative to the Sun.
    pub position: [f64; 3],
    /// Its velocity in AU per day, relative to the Sun.
    pub velocity: [f64; 3],
}

/// GNI §I.2.4, Table 2.2.
pub const BODIES_AT_START: [Body; BODIES] = [
    Body {
        name: "Sun",
        mass: 1.000_005_976_82,
        position: [0.0, 0.0, 0.0],
        velocity: [0.0, 0.0, 0.0],
    },
    Body {
        name: "Jupiter",
        mass: 0.000_954_786_104_043,
        position: [-3.502_365_3, -3.816_984_7, -1.550_796_3],
        velocity: [0.005_654_29, -0.004_124_90, -0.001_905_89],
    },
    Body {
        name: "Saturn",
        mass: 0.000_285_583_733_151,
        position: [9.075_531_4, -3.045_835_3, -1.648_370_8],
        velocity: [0.001_683_18, 0.004_835_25, 0.001_924_62],
    },
    Body {
        name: "Uranus",
        mass: 0.000_043_727_316_454_6,
        position: [8.310_142_0, -16.290_108_6, -7.252_127_8],
        velocity: [0.003_541_78, 0.001_371_02, 0.000_550_29],
    },
    Body {
        name: "Neptune",
        mass: 0.000_051_775_913_844_9,
        position: [11.470_766_6, -25.729_482_9, -10.816_945_6],
        velocity: [0.002_889_30, 0.001_145_27, 0.000_396_77],
    },
    Body {
        name: "Pluto",
        mass: 1.0 / 1.3e8,
        position: [-15.538_735_7, -25.222_559_4, -3.190_238_2],
        velocity: [0.002_767_25, -0.001_707_02, -0.001_365_04],
    },
];

/// The system.
#[derive(Clone, Copy, Debug)]
pub struct OuterSolarSystem;

impl SeparableHamiltonian for OuterSolarSystem {
    type Vector<T: Scalar> = SVector<T, COORDINATES>;

    const INLINED: bool = true;

    #[inline(always)]
    fn velocity<T: Scalar>(
        &self,
        _time: T,
        p: &SVector<T, COORDINATES>,
        velocity: &mut SVector<T, COORDINATES>,
    ) {
        let (p, velocity) = (p.as_slice(), velocity.as_mut_slice());
        for (i, body) in BODIES_AT_START.iter().enumerate() {
            let inverse = T::from_f64(1.0 / body.mass);
            for k in 3 * i..3 * i + 3 {
                velocity[k] = p[k] * inverse;
            }
        }
    }

    #[inline(always)]
    fn force<T: Scalar>(
        &self,
        _time: T,
        q: &SVector<T, COORDINATES>,
        force: &mut SVector<T, COORDINATES>,
    ) {
        force.fill(T::zero());
        let (q, force) = (q.as_slice(), force.as_mut_slice());
        for i in 0..BODIES {
            for j in i + 1..BODIES {
                let (difference, square) = separation(q, i, j);
                let strength = T::from_f64(strength(i, j)) / (square * square.sqrt());
                for k in 0..3 {
                    let pull = strength * difference[k];
                    force[3 * i + k] += pull;
                    force[3 * j + k] -= pull;
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
        let (q, p) = (q.as_slice(), p.as_slice());
        let mut energy = T::zero();
        for (i, body) in BODIES_AT_START.iter().enumerate() {
            let square =
                p[3 * i] * p[3 * i] + p[3 * i + 1] * p[3 * i + 1] + p[3 * i + 2] * p[3 * i + 2];
            energy += square * T::from_f64(0.5 / body.mass);
            for j in i + 1..BODIES {
                energy -= T::from_f64(strength(i, j)) / separation(q, i, j).1.sqrt();
            }
        }
        Some(energy)
    }
}

/// G m_i m_j.
const fn strength(i: usize, j: usize) -> f64 {
    GRAVITATIONAL_CONSTANT * BODIES_AT_START[i].mass * BODIES_AT_START[j].mass
}

/// q_j − q_i and the square of its length.
#[inline(always)]
fn separation<T: Scalar>(q: &[T], i: usize, j: usize) -> ([T; 3], T) {
    let d = [
        q[3 * j] - q[3 * i],
        q[3 * j + 1] - q[3 * i + 1],
        q[3 * j + 2] - q[3 * i + 2],
    ];
    (d, d[0] * d[0] + d[1] * d[1] + d[2] * d[2])
}

/// The state at time 0, momenta `p = m v`.
pub fn start<T: Scalar>() -> State<SVector<T, COORDINATES>> {
    let body = |coordinate: usize| (&BODIES_AT_START[coordinate / 3], coordinate % 3);
    State::new(
        0.0,
        SVector::from_fn(|coordinate, _| {
            let (body, k) = body(coordinate);
            T::from_f64(body.position[k])
        }),
        SVector::from_fn(|coordinate, _| {
            let (body, k) = body(coordinate);
            T::from_f64(body.mass * body.velocity[k])
        }),
    )
}

/// The total momentum `Σ p_i`, conserved because the forces cancel in pairs.
pub fn total_momentum<T: Scalar>(state: &State<SVector<T, COORDINATES>>) -> [T; 3] {
    array::from_fn(|k| (0..BODIES).fold(T::zero(), |sum, body| sum + state.p[3 * body + k]))
}

/// The total angular momentum `Σ q_i × p_i`, conserved because the forces act along the lines between the bodies.
pub fn angular_momentum<T: Scalar>(state: &State<SVector<T, COORDINATES>>) -> [T; 3] {
    let State { q, p, .. } = state;
    array::from_fn(|k| {
        (0..BODIES).fold(T::zero(), |sum, body| {
            let (l, m) = (3 * body + (k + 1) % 3, 3 * body + (k + 2) % 3);
            sum + (q[l] * p[m] - q[m] * p[l])
        })
    })
}

/// The state in the frame of the centre of mass, which is at rest in the origin.
pub fn to_barycentre(state: &State<SVector<f64, COORDINATES>>) -> State<SVector<f64, COORDINATES>> {
    let mass = |coordinate: usize| BODIES_AT_START[coordinate / 3].mass;
    let total: f64 = BODIES_AT_START.iter().map(|body| body.mass).sum();
    let momentum = total_momentum(state);
    let centre: [f64; 3] = array::from_fn(|k| {
        let bodies = (0..BODIES).map(|body| 3 * body + k);
        bodies.map(|i| mass(i) * state.q[i]).sum::<f64>() / total
    });
    State::new(
        state.time,
        SVector::from_fn(|i, _| state.q[i] - centre[i % 3]),
        SVector::from_fn(|i, _| state.p[i] - mass(i) / total * momentum[i % 3]),
    )
}

/// The state at `time`, by Gauss with eight stages (order 16) in steps of 200 days.
///
/// Its error is due to rounding only: after 200 000 days the position agrees with a run in steps of 400 days to 1e-10
/// AU, as a test checks.
///
/// # Errors
///
/// Those of [`Integrator::integrate_to`](symplectic::Integrator::integrate_to).
pub fn reference(time: f64) -> Result<State<SVector<f64, COORDINATES>>, Error> {
    integrate(Gauss8, OuterSolarSystem, &start(), time, 200.0)
}

/// The recorded reference at `time`, if there is one.
pub fn recorded(time: f64) -> Option<State<SVector<f64, COORDINATES>>> {
    references::find("outer solar system", "", time)
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::scenes::check;

    #[test]
    fn the_stated_needs_are_true() {
        check::needs(NEEDS, &OuterSolarSystem, &start());
    }
}
