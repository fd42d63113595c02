//! The derivatives of a system, and where they are from.

use alloc::vec;
use alloc::vec::Vec;
use core::fmt::Debug;

use crate::number::{Scalar, Vector};
use crate::system::System;

/// A square matrix, the entries `(i, j)` of which are zero where `|i − j|` is above a half bandwidth.
#[derive(Clone, Debug)]
pub struct BandMatrix<T> {
    size: usize,
    half_bandwidth: usize,
    /// By rows; every one has room for the whole band.
    entries: Vec<T>,
}

impl<T: Scalar> BandMatrix<T> {
    /// A zero matrix.
    ///
    /// ```
    /// use symplectic::solver::BandMatrix;
    ///
    /// let mut tridiagonal = BandMatrix::new(3, 1);
    /// tridiagonal.set(0, 1, 2.0);
    /// tridiagonal.set(0, 2, 4.0);
    /// assert_eq!((tridiagonal.get(0, 1), tridiagonal.get(0, 2)), (2.0, 0.0));
    /// let mut product = [0.0; 3];
    /// tridiagonal.multiply(&[1.0, 10.0, 100.0], &mut product);
    /// assert_eq!(product, [20.0, 0.0, 0.0]);
    /// ```
    pub fn new(size: usize, half_bandwidth: usize) -> Self {
        let half_bandwidth = half_bandwidth.min(size.saturating_sub(1));
        Self {
            size,
            half_bandwidth,
            entries: vec![T::zero(); size * (2 * half_bandwidth + 1)],
        }
    }

    /// The entries, with those of the band beyond the matrix.
    pub(super) fn entries_mut(&mut self) -> &mut [T] {
        &mut self.entries
    }

    /// The number of rows.
    pub const fn size(&self) -> usize {
        self.size
    }

    /// The largest `|i − j|` of an entry that is stored.
    pub const fn half_bandwidth(&self) -> usize {
        self.half_bandwidth
    }

    /// The place of an entry; none outside the band.
    #[inline(always)]
    fn place(&self, i: usize, j: usize) -> Option<usize> {
        let inside = i < self.size && j < self.size && i.abs_diff(j) <= self.half_bandwidth;
        inside.then(|| i * (2 * self.half_bandwidth + 1) + j + self.half_bandwidth - i)
    }

    /// An entry; zero outside the band.
    #[inline]
    pub fn get(&self, i: usize, j: usize) -> T {
        self.place(i, j)
            .map_or_else(T::zero, |place| self.entries[place])
    }

    /// Sets an entry; outside the band it stays zero.
    #[inline]
    pub fn set(&mut self, i: usize, j: usize, value: T) {
        if let Some(place) = self.place(i, j) {
            self.entries[place] = value;
        }
    }

    /// Adds to an entry; outside the band it stays zero.
    #[inline]
    pub fn add(&mut self, i: usize, j: usize, value: T) {
        if let Some(place) = self.place(i, j) {
            self.entries[place] += value;
        }
    }

    /// The columns of the band in a row.
    pub fn columns(&self, i: usize) -> core::ops::Range<usize> {
        i.saturating_sub(self.half_bandwidth)..(i + self.half_bandwidth + 1).min(self.size)
    }

    /// Writes the product with a vector.
    pub fn multiply(&self, vector: &[T], product: &mut [T]) {
        for (i, out) in product.iter_mut().enumerate().take(self.size) {
            let columns = self.columns(i);
            let Some(place) = self.place(i, columns.start) else {
                continue;
            };
            let row = self.entries[place..].iter().zip(&vector[columns.clone()]);
            let row = row.take(columns.len());
            *out = row.fold(T::zero(), |sum, (&entry, &x)| sum + entry * x);
        }
    }

    /// Sets all entries to zero.
    pub fn clear(&mut self) {
        self.entries.fill(T::zero());
    }

    fn is_finite(&self) -> bool {
        self.entries.iter().all(|entry| entry.is_finite())
    }
}

/// The derivatives of the velocity and the force of a system, at one time, position and momentum.
///
/// That of the force by the momentum is not among them: it is −(∂velocity/∂q)ᵀ, for both are second derivatives of H.
#[derive(Clone, Debug)]
pub struct Jacobian<T> {
    /// ∂velocity_i/∂q_j = ∂²H/∂p_i∂q_j; zero for a separable system.
    pub velocity_by_position: BandMatrix<T>,
    /// ∂velocity_i/∂p_j = ∂²H/∂p_i∂p_j
    pub velocity_by_momentum: BandMatrix<T>,
    /// ∂force_i/∂q_j = −∂²H/∂q_i∂q_j
    pub force_by_position: BandMatrix<T>,
}

impl<T: Scalar> Jacobian<T> {
    /// Zero, for systems of this dimension.
    pub fn new(dimension: usize, half_bandwidth: usize) -> Self {
        let zero = BandMatrix::new(dimension, half_bandwidth);
        Self {
            velocity_by_position: zero.clone(),
            velocity_by_momentum: zero.clone(),
            force_by_position: zero,
        }
    }

    /// Sets all entries to zero.
    pub fn clear(&mut self) {
        self.velocity_by_position.clear();
        self.velocity_by_momentum.clear();
        self.force_by_position.clear();
    }

    /// Whether all entries are finite.
    pub fn is_finite(&self) -> bool {
        self.velocity_by_position.is_finite()
            && self.velocity_by_momentum.is_finite()
            && self.force_by_position.is_finite()
    }
}

/// A system that knows its second derivatives, for [`Newton`](crate::solver::Newton) with [`Analytic`].
///
/// ```
/// use symplectic::nalgebra::SVector;
/// use symplectic::{Error, Integrator, Scalar, SeparableHamiltonian, State};
/// use symplectic::solver::{Analytic, Dense, Jacobian, Linearized, Newton};
///
/// symplectic::tableau! { Gauss3 { basis: polynomial(3), nodes: gauss(3) } }
///
/// /// H = p²/2 + 10¹² (1 − cos q)
/// struct Stiff;
///
/// impl SeparableHamiltonian for Stiff {
///     type Vector<T: Scalar> = SVector<T, 1>;
///
///     fn velocity<T: Scalar>(&self, _time: T, p: &SVector<T, 1>, velocity: &mut SVector<T, 1>) {
///         *velocity = *p;
///     }
///
///     fn force<T: Scalar>(&self, _time: T, q: &SVector<T, 1>, force: &mut SVector<T, 1>) {
///         force[0] = -q[0].sin() * T::from_f64(1e12);
///     }
/// }
///
/// impl Linearized<SVector<f64, 1>> for Stiff {
///     fn derivatives(&self, _: f64, q: &SVector<f64, 1>, _: &SVector<f64, 1>, jacobian: &mut Jacobian<f64>) {
///         jacobian.velocity_by_momentum.set(0, 0, 1.0);
///         jacobian.force_by_position.set(0, 0, -1e12 * q[0].cos());
///     }
/// }
///
/// # fn main() -> Result<(), Error> {
/// let start = State::new(0.0, SVector::from([1e-6]), SVector::from([0.0]));
/// let integrator = Integrator::new(Gauss3, Stiff, start, 0.01)?;
/// let mut integrator = integrator.with_solver(Newton::<Dense<Analytic>>::new());
/// integrator.integrate_to(1.0)?;
/// assert!(integrator.statistics().mean_iterations() < 6.0);
/// # Ok(())
/// # }
/// ```
pub trait Linearized<V: Vector>: System<V> {
    /// Writes the derivatives at `(time, q, p)` into `jacobian`, which is zero before.
    fn derivatives(&self, time: V::Scalar, q: &V, p: &V, jacobian: &mut Jacobian<V::Scalar>);
}

/// Where the derivatives of a system `S` over the vectors `V` are from.
pub trait Derivatives<V: Vector, S: System<V>>: Copy + Debug + 'static {
    /// What it needs, made once.
    type Memory: Clone + Debug;

    /// That, for vectors of the dimension of `prototype`.
    fn memory(prototype: &V) -> Self::Memory;

    /// Writes the derivatives at `(time, q, p)` into `jacobian`, which is zero before.
    fn evaluate(
        memory: &mut Self::Memory,
        system: &S,
        time: V::Scalar,
        q: &V,
        p: &V,
        jacobian: &mut Jacobian<V::Scalar>,
    );
}

/// The derivatives that the system itself gives: [`Linearized`].
#[derive(Clone, Copy, Debug, Default)]
pub struct Analytic;

impl<V: Vector, S: Linearized<V>> Derivatives<V, S> for Analytic {
    type Memory = ();

    fn memory(_prototype: &V) {}

    fn evaluate(
        (): &mut (),
        system: &S,
        time: V::Scalar,
        q: &V,
        p: &V,
        jacobian: &mut Jacobian<V::Scalar>,
    ) {
        system.derivatives(time, q, p, jacobian);
    }
}

/// Quotients of central differences: for every system.
///
/// About ten digits of a derivative are right, relative to the largest one: enough for a Newton iteration to converge fast as long as
/// `h²` times that derivative is below 10⁸ or so. This never makes its result less precise.
#[derive(Clone, Copy, Debug, Default)]
pub struct Differences;

/// Memory of [`Differences`]: an argument next to the point, and the values on both sides.
type Pairs<V> = [V; 5];

impl<V: Vector, S: System<V>> Derivatives<V, S> for Differences {
    type Memory = Pairs<V>;

    fn memory(prototype: &V) -> Pairs<V> {
        core::array::from_fn(|_| prototype.zeros_like())
    }

    fn evaluate(
        [next, velocity, force, other_velocity, other_force]: &mut Pairs<V>,
        system: &S,
        time: V::Scalar,
        q: &V,
        p: &V,
        jacobian: &mut Jacobian<V::Scalar>,
    ) {
        let (by_q, by_p) = (step(q), step(p));
        let groups = groups(jacobian);
        let quotient = |high: &V, low: &V, by: f64, i: usize| {
            let scale = V::Scalar::from_f64((2.0 * by).recip());
            Some((*high.as_slice().get(i)? - *low.as_slice().get(i)?) * scale)
        };
        for group in 0..groups {
            shift(next, q, -by_q, group, groups);
            system.velocity(time, next, p, other_velocity);
            system.force(time, next, p, other_force);
            shift(next, q, by_q, group, groups);
            system.velocity(time, next, p, velocity);
            system.force(time, next, p, force);
            scatter(&mut jacobian.velocity_by_position, group, groups, |i| {
                quotient(velocity, other_velocity, by_q, i)
            });
            scatter(&mut jacobian.force_by_position, group, groups, |i| {
                quotient(force, other_force, by_q, i)
            });
            shift(next, p, -by_p, group, groups);
            system.velocity(time, q, next, other_velocity);
            shift(next, p, by_p, group, groups);
            system.velocity(time, q, next, velocity);
            scatter(&mut jacobian.velocity_by_momentum, group, groups, |i| {
                quotient(velocity, other_velocity, by_p, i)
            });
        }
    }
}

/// Two fifths of the digits below the largest component: rounding and truncation make small errors both, and the neighbourhood is
/// small.
fn step<V: Vector>(vector: &V) -> f64 {
    let components = vector.as_slice().iter().map(|x| x.magnitude());
    let largest = components.fold(0.0, f64::max);
    let digits = num_traits::Float::powf(V::Scalar::EPSILON, 0.4);
    if largest > f64::MIN_POSITIVE / digits && largest.is_finite() {
        digits * largest
    } else {
        digits
    }
}

/// Moves every component whose number is that of the group.
fn shift<V: Vector>(out: &mut V, from: &V, by: f64, group: usize, groups: usize) {
    let pairs = out.as_mut_slice().iter_mut().zip(from.as_slice());
    for (i, (out, from)) in pairs.enumerate() {
        *out = if i % groups == group {
            *from + V::Scalar::from_f64(by)
        } else {
            *from
        };
    }
}

/// How many groups of columns there are: those in one have no row in common, and are found together (Curtis, Powell &
/// Reid, 1974).
pub(super) fn groups<T: Scalar>(jacobian: &Jacobian<T>) -> usize {
    let matrix = &jacobian.force_by_position;
    (2 * matrix.half_bandwidth() + 1).min(matrix.size()).max(1)
}

/// Writes the derivatives in the direction of the columns of a group to their places.
pub(super) fn scatter<T: Scalar>(
    matrix: &mut BandMatrix<T>,
    group: usize,
    groups: usize,
    derivative: impl Fn(usize) -> Option<T>,
) {
    for i in 0..matrix.size() {
        for j in matrix.columns(i).filter(|j| j % groups == group) {
            if let Some(value) = derivative(i) {
                matrix.set(i, j, value);
            }
        }
    }
}
