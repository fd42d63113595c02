//! Point vortices in the plane with the strengths Γ_i in units of 2π: `H = −Σ_{i<j} Γ_i Γ_j ln |z_i − z_j|`, where
//! `Γ_i x_i' = ∂H/∂y_i` and `Γ_i y_i' = −∂H/∂x_i`.
//!
//! The coordinates x_i are the positions and `p_i = Γ_i y_i` the momenta.
//!
//! *Needs:* a method for general Hamiltonians that does not go through a Lagrangian. Not separable; degenerate, because
//! H is invariant under a common translation; four or more vortices are chaotic. *Source:* Newton, The N-vortex problem
//! (2001); the start is our choice. *Reference:* recorded, [`recorded`]; two vortices rotate about their centre at the
//! rate `(Γ_1 + Γ_2)/d²`.

use symplectic::nalgebra::SVector;
use symplectic::{General, Hamiltonian, Scalar, State};

use super::Needs;
use crate::references;

/// Its needs.
pub const NEEDS: Needs = Needs {
    degenerate: true,
    ..Needs::GENERAL
};

/// The four vortices of the recorded reference.
pub const FOUR: PointVortices<4> = PointVortices {
    strengths: [1.0, 2.0, 1.0, 1.0],
};

/// The system.
#[derive(Clone, Copy, Debug)]
pub struct PointVortices<const N: usize> {
    /// The strengths Γ_i, none of them zero.
    pub strengths: [f64; N],
}

impl<const N: usize> Hamiltonian for PointVortices<N> {
    type Class = General;
    type Vector<T: Scalar> = SVector<T, N>;

    #[inline]
    fn velocity<T: Scalar>(
        &self,
        _time: T,
        q: &SVector<T, N>,
        p: &SVector<T, N>,
        velocity: &mut SVector<T, N>,
    ) {
        velocity.fill(T::zero());
        self.pairs(q, p, |i, j, [_, y], square| {
            let speed = y / square;
            velocity[i] += T::from_f64(self.strengths[j]) * speed;
            velocity[j] -= T::from_f64(self.strengths[i]) * speed;
        });
    }

    #[inline]
    fn force<T: Scalar>(
        &self,
        _time: T,
        q: &SVector<T, N>,
        p: &SVector<T, N>,
        force: &mut SVector<T, N>,
    ) {
        force.fill(T::zero());
        self.pairs(q, p, |i, j, [x, _], square| {
            let push = T::from_f64(self.strengths[i] * self.strengths[j]) * x / square;
            force[i] -= push;
            force[j] += push;
        });
    }

    fn energy<T: Scalar>(&self, _time: T, q: &SVector<T, N>, p: &SVector<T, N>) -> Option<T> {
        let mut energy = T::zero();
        self.pairs(q, p, |i, j, _, square| {
            let strength = T::from_f64(0.5 * self.strengths[i] * self.strengths[j]);
            energy -= strength * square.ln();
        });
        Some(energy)
    }
}

impl<const N: usize> PointVortices<N> {
    /// Visits every pair i < j with z_j − z_i and the square of its length.
    #[inline]
    fn pairs<T: Scalar>(
        &self,
        q: &SVector<T, N>,
        p: &SVector<T, N>,
        mut visit: impl FnMut(usize, usize, [T; 2], T),
    ) {
        for j in 1..N {
            for i in 0..j {
                let height = |k: usize| p[k] / T::from_f64(self.strengths[k]);
                let [x, y] = [q[j] - q[i], height(j) - height(i)];
                visit(i, j, [x, y], x * x + y * y);
            }
        }
    }

    /// The vortices at these places `(x_i, y_i)`.
    pub fn at<T: Scalar>(&self, places: [[f64; 2]; N]) -> State<SVector<T, N>> {
        State::new(
            0.0,
            SVector::from_fn(|i, _| T::from_f64(places[i][0])),
            SVector::from_fn(|i, _| T::from_f64(self.strengths[i] * places[i][1])),
        )
    }
}

/// [`FOUR`] in the corners of a quadrangle.
pub fn start<T: Scalar>() -> State<SVector<T, 4>> {
    FOUR.at([[1.0, 0.0], [-1.0, 0.0], [0.0, 1.5], [0.5, -1.0]])
}

/// The centre `Σ Γ_i z_i` and the moment `Σ Γ_i |z_i|²`, which are conserved.
pub fn moments<const N: usize>(
    system: &PointVortices<N>,
    state: &State<SVector<f64, N>>,
) -> [f64; 3] {
    let terms = (0..N).map(|i| {
        let (strength, x, y) = (system.strengths[i], state.q[i], state.p[i]);
        [strength * x, y, strength * x * x + y * y / strength]
    });
    terms.fold([0.0; 3], |sum, term| [0, 1, 2].map(|k| sum[k] + term[k]))
}

/// The recorded reference of [`FOUR`] at `time`, if there is one.
pub fn recorded(time: f64) -> Option<State<SVector<f64, 4>>> {
    references::find("point vortices", "N = 4", time)
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::scenes::check;

    #[test]
    fn the_derivatives_are_those_of_the_energy() {
        check::derivatives(&FOUR, &start(), 1e-5, 1e-8);
        check::needs(NEEDS, &FOUR, &start());
    }

    #[test]
    fn the_energy_and_the_moments_are_conserved() {
        check::conservation(FOUR, start(), 1.0 / 32.0, 5.0, 1e-13);
        let end = check::end(FOUR, start(), 1.0 / 32.0, 5.0);
        let (before, after) = (moments(&FOUR, &start()), moments(&FOUR, &end));
        for (before, after) in before.iter().zip(after) {
            assert!((before - after).abs() < 1e-13 * (1.0 + before.abs()));
        }
    }

    #[test]
    fn two_vortices_turn_around_their_centre() {
        let pair = PointVortices {
            strengths: [1.0, 2.0],
        };
        let end = check::end(pair, pair.at([[2.0, 0.0], [-1.0, 0.0]]), 1.0 / 8.0, 3.0);
        // The rate is 3/3².
        let (sine, cosine) = 1.0_f64.sin_cos();
        let expected = pair.at([[2.0 * cosine, 2.0 * sine], [-cosine, -sine]]);
        assert!((end.q - expected.q).norm() < 1e-13 && (end.p - expected.p).norm() < 1e-13);
    }
}
