//! Sixteen rigid triangles in the plane, each of three masses on three rods, in a harmonic trap: 48 holonomic constraints, as of the molecules
//! of a planar box of water.
//!
//! The trap turns no triangle: each one rotates uniformly while its centre of mass oscillates.
//!
//! *Needs:* a method that is `constrained`. *Source:* our choice. *Reference:* closed form, [`exact`].

use symplectic::State;
use symplectic::nalgebra::DVector;

/// Number of triangles.
pub const TRIANGLES: usize = 16;
/// Three masses of a triangle, and their places when it is not turned.
const ATOMS: [(f64, [f64; 2]); 3] = [(16.0, [0.0, 0.0]), (1.0, [1.0, 0.0]), (1.0, [0.0, 1.0])];
/// Their total mass.
const MASS: f64 = 18.0;

/// Number of components of a position.
const N: usize = 6 * TRIANGLES;

symplectic::hamiltonian! {
    /// Masses on rods of these lengths, each mass with the trap `m|q|²/2`.
    pub Triangles { m: [..], rods: pairs, length: [rods] }
    q: [..; 2], p: [..; 2];
    H = sum(i: |p[i]|^2/(2 m[i]) + m[i] |q[i]|^2/2)
    constraints: { rod(s = (i, j) in rods) = |q[i] - q[j]|^2 - length[s]^2 }
}

/// The system.
pub fn system() -> Triangles {
    let masses = (0..TRIANGLES).flat_map(|_| ATOMS.map(|(mass, _)| mass));
    let rods = (0..TRIANGLES).flat_map(|k| {
        [
            (3 * k, 3 * k + 1),
            (3 * k, 3 * k + 2),
            (3 * k + 1, 3 * k + 2),
        ]
    });
    let lengths = (0..TRIANGLES).flat_map(|_| [1.0, 1.0, 2.0_f64.sqrt()]);
    Triangles::new(masses.collect(), rods.collect(), lengths.collect())
}

/// The state at `time`.
pub fn exact(time: f64) -> State<DVector<f64>> {
    let (mut q, mut p) = (DVector::zeros(N), DVector::zeros(N));
    let (swing_rate, swing) = time.sin_cos();
    for triangle in 0..TRIANGLES {
        let k = triangle as f64;
        // The centre of mass swings between these places.
        let [x, y] = [0.3 * (k % 4.0) + 0.2, 0.3 * (k / 4.0).floor() - 0.4];
        let spin = 0.8 + 0.05 * k;
        let (sine, cosine) = (0.1 * k + spin * time).sin_cos();
        for (atom, (mass, place)) in ATOMS.into_iter().enumerate() {
            // The centre of the masses of a triangle that is not turned is at (1/18, 1/18).
            let [a, b] = place.map(|coordinate| coordinate - 1.0 / MASS);
            let turned = [cosine * a - sine * b, sine * a + cosine * b];
            let rates = [-spin * turned[1], spin * turned[0]];
            let first = 2 * (3 * triangle + atom);
            for (axis, centre) in [x, y].into_iter().enumerate() {
                q[first + axis] = centre * swing + turned[axis];
                p[first + axis] = mass * (rates[axis] - centre * swing_rate);
            }
        }
    }
    State::new(time, q, p)
}

/// The state at time 0.
pub fn start() -> State<DVector<f64>> {
    exact(0.0)
}

#[cfg(test)]
mod tests {
    use symplectic::constraints::HolonomicConstraints;
    use symplectic::{Integrator, System};

    use super::*;
    use crate::methods::Lobatto4;
    use crate::scenes::check;

    #[test]
    fn the_derivatives_are_those_of_the_energy() {
        check::derivatives(&system(), &exact(0.3), 1e-5, 1e-8);
    }

    /// By difference quotients the momenta match the velocities; the rods keep their lengths; a method of order 6 stays near.
    #[test]
    fn the_closed_form_is_a_motion() {
        let (before, here, after) = (exact(0.7 - 1e-4), exact(0.7), exact(0.7 + 1e-4));
        let mut velocity = here.q.clone();
        System::velocity(&system(), 0.7, &here.q, &here.p, &mut velocity);
        assert!(((after.q - before.q) / 2e-4 - velocity).norm() < 1e-7);
        let mut values = [1.0; 3 * TRIANGLES];
        HolonomicConstraints::constraint_values(&system(), &here.q, &mut values);
        assert!(values.iter().all(|value| value.abs() < 4e-15));
        let mut run = Integrator::new(Lobatto4, system(), start(), 1.0 / 16.0).expect("a start");
        let end = run.integrate_to(2.0).expect("steps");
        assert!((&end.q - exact(2.0).q).norm() < 1e-7);
    }
}
