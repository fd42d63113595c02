//! The Fermi–Pasta–Ulam–Tsingou chain with cubic forces, `H = Σ p_i²/2 + Σ (d²/2 + d⁴/4)` over all bonds, `d` the
//! difference of neighbours; the ends are fixed.
//!
//! *Needs:* nothing. Separable, quadratic kinetic energy, not stiff: no frequency exceeds 2 except at large amplitudes.
//! The number of particles is the dimension of the vector. *Source:* Fermi, Pasta, Ulam & Tsingou, Studies of nonlinear
//! problems (1955), the β chain with β = 1; the momenta at the start are our choice. *Reference:* recorded for few
//! particles, [`recorded`]; for many particles a finer run.

use symplectic::emitted::{Bonds, Chain};
use symplectic::nalgebra::DVector;
use symplectic::{Scalar, State};

use super::Needs;
use crate::references;

/// Its needs.
pub const NEEDS: Needs = Needs::NOTHING;

/// The number of particles in the benches.
pub const PARTICLES: usize = 1024;

/// The system, for vectors of any kind and dimension.
pub type FputChain = Chain<Beta>;

/// The system.
pub const fn system() -> FputChain {
    Chain::between_walls(Beta)
}

/// The bonds of the β chain.
#[derive(Clone, Copy, Debug)]
pub struct Beta;

impl Bonds for Beta {
    const INLINED: bool = true;

    #[inline(always)]
    fn tension<T: Scalar>(&self, _time: T, d: T) -> T {
        (d * d).fused(d, d)
    }

    fn bond_energy<T: Scalar>(&self, _time: T, d: T) -> Option<T> {
        let half = T::from_f64(0.5);
        let square = d * d;
        Some(half * square + half * half * square * square)
    }
}

/// The momenta of the start, at rest positions: `p_i = ((7919 i mod n) − n/2)/n`: equidistant numbers in a scattered
/// order.
pub fn momenta<T: Scalar>(particles: usize) -> impl Iterator<Item = T> {
    let n = particles as f64;
    (0..particles).map(move |i| T::from_f64(((7919 * i % particles) as f64 - 0.5 * n) / n))
}

/// The start as a dynamic vector.
pub fn start(particles: usize) -> State<DVector<f64>> {
    let p = DVector::from_iterator(particles, momenta(particles));
    State::new(0.0, DVector::zeros(particles), p)
}

/// The recorded reference from [`start`] with this number of particles at `time`, if there is one.
pub fn recorded(particles: usize, time: f64) -> Option<State<DVector<f64>>> {
    references::find("FPUT chain", &format!("N = {particles}"), time)
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::scenes::check;

    #[test]
    fn the_derivatives_are_those_of_the_energy() {
        for particles in [1, 2, 3, 16] {
            let mut state = start(particles);
            state.q = state.p.map(|p| (7.0 * p).sin());
            check::derivatives(&system(), &state, 1e-5, 1e-8);
            check::needs(NEEDS, &system(), &state);
        }
    }

    #[test]
    fn the_energy_is_conserved() {
        check::conservation(system(), start(16), 1.0 / 16.0, 4.0, 1e-13);
    }

    #[test]
    fn the_momenta_are_those_of_the_data() {
        let p: Vec<f64> = momenta(PARTICLES).collect();
        assert_eq!(p[0], -0.5);
        assert_eq!(p[1], (7919.0 % 1024.0 - 512.0) / 1024.0);
        assert_eq!(p.iter().sum::<f64>(), -0.5);
    }
}
