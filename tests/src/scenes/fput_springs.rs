//! Six point masses between walls, joined by stiff harmonic springs and soft quartic ones in turn, in the coordinates
//! `q = (x_01, x_02, x_03, x_11, x_12, x_13)`: three mean displacements of the ends of a stiff spring, then its
//! three elongations.
//!
//! `H = |p|²/2 + ω²/2 Σ x_1i² + ((x_01 − x_11)⁴ + Σ_{i<3} (x_0,i+1 − x_1,i+1 − x_0i − x_1i)⁴ + (x_03 + x_13)⁴)/4`
//!
//! *Needs:* nothing. Separable, quadratic kinetic energy; stiff: an explicit method or a fixed-point iteration requires
//! `hω` of order one. *Source:* GNI §I.5.1, with ω = 50 (10³ and 10⁵ are our choice); after Galgani, Giorgilli,
//! Martinoli & Vanzini, 1992. *Reference:* recorded for these frequencies, [`recorded`].

use symplectic::nalgebra::SVector;
use symplectic::system::Masses;
use symplectic::{Scalar, SeparableHamiltonian, State};

use super::Needs;
use crate::references;

/// Its needs.
pub const NEEDS: Needs = Needs {
    stiff: true,
    ..Needs::NOTHING
};

/// Number of stiff springs.
const SPRINGS: usize = 3;

/// Number of coordinates.
pub const COORDINATES: usize = 2 * SPRINGS;

/// The frequency of the stiff springs in GNI.
pub const OMEGA: f64 = 50.0;

/// The system.
#[derive(Clone, Copy, Debug)]
pub struct FputSprings {
    /// The frequency ω of the stiff springs.
    pub omega: f64,
}

impl SeparableHamiltonian for FputSprings {
    type Vector<T: Scalar> = SVector<T, COORDINATES>;

    const MASSES: Masses = Masses::Unit;
    const INLINED: bool = true;

    #[inline(always)]
    fn velocity<T: Scalar>(
        &self,
        _time: T,
        p: &SVector<T, COORDINATES>,
        velocity: &mut SVector<T, COORDINATES>,
    ) {
        *velocity = *p;
    }

    #[inline(always)]
    fn force<T: Scalar>(
        &self,
        _time: T,
        q: &SVector<T, COORDINATES>,
        force: &mut SVector<T, COORDINATES>,
    ) {
        let mut tensions = elongations(q);
        for d in &mut tensions {
            *d = *d * *d * *d;
        }
        let stiffness = T::from_f64(self.omega * self.omega);
        for i in 0..SPRINGS {
            let (left, right) = (tensions[i], tensions[i + 1]);
            force[i] = right - left;
            force[SPRINGS + i] = (right + left) - stiffness * q[SPRINGS + i];
        }
    }

    fn energy<T: Scalar>(
        &self,
        _time: T,
        q: &SVector<T, COORDINATES>,
        p: &SVector<T, COORDINATES>,
    ) -> Option<T> {
        let half = T::from_f64(0.5);
        let stiff = T::from_f64(self.omega * self.omega);
        let mut energy = p.dot(p) * half;
        for i in SPRINGS..COORDINATES {
            energy += stiff * q[i] * q[i] * half;
        }
        for d in elongations(q) {
            energy += d * d * d * d * (half * half);
        }
        Some(energy)
    }
}

/// Elongations of the soft springs, from wall to wall; hence the sign of the last one, `−(x_03 + x_13)`.
#[inline(always)]
fn elongations<T: Scalar>(q: &SVector<T, COORDINATES>) -> [T; SPRINGS + 1] {
    [
        q[0] - q[3],
        (q[1] - q[4]) - (q[0] + q[3]),
        (q[2] - q[5]) - (q[1] + q[4]),
        -(q[2] + q[5]),
    ]
}

/// GNI §I.5.1: `x_01 = 1`, `y_01 = 1`, `x_11 = ω⁻¹`, `y_11 = 1`, all others zero.
pub fn start<T: Scalar>(omega: f64) -> State<SVector<T, COORDINATES>> {
    let coordinates = |values: [f64; COORDINATES]| SVector::from(values.map(T::from_f64));
    State::new(
        0.0,
        coordinates([1.0, 0.0, 0.0, 1.0 / omega, 0.0, 0.0]),
        coordinates([1.0, 0.0, 0.0, 1.0, 0.0, 0.0]),
    )
}

/// The recorded reference from [`start`] with this frequency at `time`, if there is one.
pub fn recorded(omega: f64, time: f64) -> Option<State<SVector<f64, COORDINATES>>> {
    references::find("FPUT springs", &format!("ω = {omega}"), time)
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::scenes::check;

    #[test]
    fn the_derivatives_are_those_of_the_energy() {
        let state = State::new(
            0.0,
            SVector::from([1.0, -0.3, 0.4, 0.1, -0.2, 0.15]),
            SVector::from([1.0, 0.2, -0.5, 0.3, 0.9, -1.0]),
        );
        let system = FputSprings { omega: OMEGA };
        check::derivatives(&system, &state, 1e-4, 1e-6);
        check::needs(NEEDS, &system, &state);
    }

    #[test]
    fn the_energy_is_conserved() {
        let system = FputSprings { omega: OMEGA };
        check::conservation(system, start(OMEGA), 1.0 / 128.0, 2.0, 1e-13);
    }

    #[test]
    fn the_stiff_springs_exchange_energy_slowly() {
        // GNI Fig. I.5.2: the sum of the energies of the stiff springs is an adiabatic invariant.
        let oscillatory = |state: &State<SVector<f64, COORDINATES>>| -> f64 {
            let spring = |i: usize| state.p[i].powi(2) + (OMEGA * state.q[i]).powi(2);
            (SPRINGS..COORDINATES).map(spring).sum::<f64>() / 2.0
        };
        let begin = start(OMEGA);
        let end = check::end(
            FputSprings { omega: OMEGA },
            begin.clone(),
            1.0 / 64.0,
            20.0,
        );
        // The change is of order ω⁻¹; with a wrong factor in the soft forces it would not be an invariant.
        let change = (oscillatory(&end) - oscillatory(&begin)).abs();
        assert!(change < 4.0 / OMEGA, "{change}");
    }
}
