//! Stiff systems with their derivatives and the magnitude of their rounding errors.

#![allow(
    clippy::needless_range_loop,
    reason = "the indices are those of the formulas"
)]

use symplectic::nalgebra::SVector;
use symplectic::solver::FixedPoint;
use symplectic::system::Jacobian;
use symplectic::{Scalar, Separable, System};

/// A separable system with unit masses and `N` components.
pub trait Stiff<const N: usize>: Copy {
    /// Writes the force at `q`.
    fn force<T: Scalar>(&self, q: &[T; N], force: &mut [T; N]);

    /// `∂force_i/∂q_j` at `q`.
    fn derivative<T: Scalar>(&self, q: &[T; N]) -> [[T; N]; N];

    /// The sum of the absolute values of all terms in each component of the force.
    fn terms(&self, q: &[f64; N]) -> [f64; N];
}

/// A stiff system as a system for integrators.
#[derive(Clone, Copy, Debug)]
pub struct Steps<S>(pub S);

impl<T: Scalar, S: Stiff<N>, const N: usize> System<SVector<T, N>> for Steps<S> {
    type Class = Separable;
    type Solver = FixedPoint;

    fn velocity(
        &self,
        _time: T,
        _q: &SVector<T, N>,
        p: &SVector<T, N>,
        velocity: &mut SVector<T, N>,
    ) {
        *velocity = *p;
    }

    fn force(&self, _time: T, q: &SVector<T, N>, _p: &SVector<T, N>, force: &mut SVector<T, N>) {
        self.0.force(&q.data.0[0], &mut force.data.0[0]);
    }

    fn second_derivatives(
        &self,
        _time: T,
        q: &SVector<T, N>,
        _p: &SVector<T, N>,
        jacobian: &mut Jacobian<T>,
    ) -> bool {
        let derivative = self.0.derivative(&q.data.0[0]);
        for i in 0..N {
            jacobian.velocity_by_momentum.set(i, i, T::one());
            for j in 0..N {
                jacobian.force_by_position.set(i, j, derivative[i][j]);
            }
        }
        true
    }
}

/// Adds the force of a spring of stiffness `k` and length 1 between `ends`, the indices of their first components;
/// `None` is a fixed end at the origin.
fn spring<T: Scalar, const N: usize>(
    k: f64,
    q: &[T; N],
    ends: (Option<usize>, usize),
    force: &mut [T; N],
) {
    let (d, length) = vector(q, ends);
    for c in 0..2 {
        let pull = d[c] * (T::from_f64(k) * (length.recip() - T::one()));
        force[ends.1 + c] += pull;
        if let Some(from) = ends.0 {
            force[from + c] -= pull;
        }
    }
}

fn vector<T: Scalar, const N: usize>(
    q: &[T; N],
    (from, to): (Option<usize>, usize),
) -> ([T; 2], T) {
    let origin = |c: usize| from.map_or(T::zero(), |from| q[from + c]);
    let d = [q[to] - origin(0), q[to + 1] - origin(1)];
    (d, (d[0] * d[0] + d[1] * d[1]).sqrt())
}

fn spring_derivative<T: Scalar, const N: usize>(
    k: f64,
    q: &[T; N],
    ends: (Option<usize>, usize),
    derivative: &mut [[T; N]; N],
) {
    let (d, length) = vector(q, ends);
    let (k, inverse) = (T::from_f64(k), length.recip());
    for c in 0..2 {
        for e in 0..2 {
            let unit = if c == e { T::one() } else { T::zero() };
            let entry =
                k * (unit * (inverse - T::one()) - d[c] * d[e] * (inverse * inverse * inverse));
            derivative[ends.1 + c][ends.1 + e] += entry;
            if let Some(from) = ends.0 {
                derivative[from + c][from + e] += entry;
                derivative[from + c][ends.1 + e] -= entry;
                derivative[ends.1 + c][from + e] -= entry;
            }
        }
    }
}

fn spring_terms<const N: usize>(
    k: f64,
    q: &[f64; N],
    ends: (Option<usize>, usize),
    terms: &mut [f64; N],
) {
    let (d, length) = vector(q, ends);
    for c in 0..2 {
        let size = d[c].abs() * k * (length.recip() + 1.0);
        terms[ends.1 + c] += size;
        if let Some(from) = ends.0 {
            terms[from + c] += size;
        }
    }
}

/// A hanging chain of `N/2` masses on springs of length 1 in a plane. A single mass is a spring pendulum.
#[derive(Clone, Copy, Debug)]
pub struct HangingChain {
    /// Stiffness.
    pub k: f64,
}

fn ends<const N: usize>() -> impl Iterator<Item = (Option<usize>, usize)> {
    (0..N / 2).map(|i| ((i > 0).then(|| 2 * (i - 1)), 2 * i))
}

impl<const N: usize> Stiff<N> for HangingChain {
    fn force<T: Scalar>(&self, q: &[T; N], force: &mut [T; N]) {
        for (c, force) in force.iter_mut().enumerate() {
            *force = if c % 2 == 0 { T::zero() } else { -T::one() };
        }
        ends::<N>().for_each(|ends| spring(self.k, q, ends, force));
    }

    fn derivative<T: Scalar>(&self, q: &[T; N]) -> [[T; N]; N] {
        let mut derivative = [[T::zero(); N]; N];
        ends::<N>().for_each(|ends| spring_derivative(self.k, q, ends, &mut derivative));
        derivative
    }

    fn terms(&self, q: &[f64; N]) -> [f64; N] {
        let mut terms = [1.0; N];
        ends::<N>().for_each(|ends| spring_terms(self.k, q, ends, &mut terms));
        terms
    }
}

/// The stiff and soft springs of GNI §I.5.1.
#[derive(Clone, Copy, Debug)]
pub struct Fput {
    /// ω²
    pub k: f64,
}

/// The signs of the components in the elongation of each soft spring.
const SOFT: [[f64; 6]; 4] = [
    [1.0, 0.0, 0.0, -1.0, 0.0, 0.0],
    [-1.0, 1.0, 0.0, -1.0, -1.0, 0.0],
    [0.0, -1.0, 1.0, 0.0, -1.0, -1.0],
    [0.0, 0.0, 1.0, 0.0, 0.0, 1.0],
];

fn soft<T: Scalar>(signs: &[f64; 6], q: &[T; 6]) -> T {
    let mut sum = T::zero();
    for (sign, q) in signs.iter().zip(q) {
        if *sign != 0.0 {
            sum += T::from_f64(*sign) * *q;
        }
    }
    sum
}

impl Stiff<6> for Fput {
    fn force<T: Scalar>(&self, q: &[T; 6], force: &mut [T; 6]) {
        for i in 0..6 {
            force[i] = if i < 3 {
                T::zero()
            } else {
                -(T::from_f64(self.k) * q[i])
            };
        }
        for signs in &SOFT {
            let d = soft(signs, q);
            for i in 0..6 {
                if signs[i] != 0.0 {
                    force[i] -= T::from_f64(signs[i]) * (d * d * d);
                }
            }
        }
    }

    fn derivative<T: Scalar>(&self, q: &[T; 6]) -> [[T; 6]; 6] {
        let mut derivative = [[T::zero(); 6]; 6];
        for i in 3..6 {
            derivative[i][i] = -T::from_f64(self.k);
        }
        for signs in &SOFT {
            let d = soft(signs, q);
            for i in 0..6 {
                for j in 0..6 {
                    derivative[i][j] -= T::from_f64(3.0 * signs[i] * signs[j]) * (d * d);
                }
            }
        }
        derivative
    }

    fn terms(&self, q: &[f64; 6]) -> [f64; 6] {
        let mut terms = [0.0; 6];
        for i in 3..6 {
            terms[i] = self.k * q[i].abs();
        }
        for signs in &SOFT {
            let d: f64 = signs.iter().zip(q).map(|(s, q)| (s * q).abs()).sum();
            for i in 0..6 {
                terms[i] += (signs[i] * d * d * d).abs();
            }
        }
        terms
    }
}
