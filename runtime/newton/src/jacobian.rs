//! Sources of the derivatives of a system.

use core::fmt::Debug;

use symplectic_core::system::{BandMatrix, Jacobian};
use symplectic_core::{Scalar, System, Vector};

/// A source of the derivatives of a system `S` over the vectors `V`.
pub trait Derivatives<V: Vector, S: System<V>>: Copy + Debug + 'static {
    /// Its memory, allocated once.
    type Memory: Clone + Debug;

    /// Allocates the memory, for vectors of the dimension of `prototype`.
    fn memory(prototype: &V) -> Self::Memory;

    /// Writes the derivatives at `(time, q, p)` into `jacobian`, which is zero on entry.
    fn evaluate(
        memory: &mut Self::Memory,
        system: &S,
        time: V::Scalar,
        q: &V,
        p: &V,
        jacobian: &mut Jacobian<V::Scalar>,
    );
}

/// The [second derivatives](System::second_derivatives) that the system provides; otherwise [`Differences`].
#[derive(Clone, Copy, Debug, Default)]
pub struct AnalyticOrDifferences;

impl<V: Vector, S: System<V>> Derivatives<V, S> for AnalyticOrDifferences {
    type Memory = Pairs<V>;

    fn memory(prototype: &V) -> Pairs<V> {
        <Differences as Derivatives<V, S>>::memory(prototype)
    }

    fn evaluate(
        memory: &mut Pairs<V>,
        system: &S,
        time: V::Scalar,
        q: &V,
        p: &V,
        jacobian: &mut Jacobian<V::Scalar>,
    ) {
        if !system.second_derivatives(time, q, p, jacobian) {
            jacobian.clear();
            Differences::evaluate(memory, system, time, q, p, jacobian);
        }
    }
}

/// Central difference quotients, for every system.
///
/// About ten digits of a derivative are correct, relative to the largest one. A Newton iteration then converges fast if
/// `h²` times that derivative is below about 10⁸. Inexact derivatives never make the result less precise.
#[derive(Clone, Copy, Debug, Default)]
pub struct Differences;

/// Memory of [`Differences`]: the shifted argument, and the values on both sides.
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
            if S::FORCED {
                shift(next, p, -by_p, group, groups);
                system.applied_force(time, q, next, other_force);
                shift(next, p, by_p, group, groups);
                system.applied_force(time, q, next, force);
                scatter(
                    &mut jacobian.applied_force_by_momentum,
                    group,
                    groups,
                    |i| quotient(force, other_force, by_p, i),
                );
            }
        }
    }
}

/// The step of the differences: `EPSILON^(2/5)` times the largest component. Rounding and truncation errors are then both small, and
/// the neighbourhood is small.
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

/// Shifts every component of this group, that is, with an index equal to `group` modulo `groups`.
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

/// Number of groups of columns. Columns in a group have no row in common and are found together (Curtis, Powell &
/// Reid, 1974).
pub(super) fn groups<T: Scalar>(jacobian: &Jacobian<T>) -> usize {
    let matrix = &jacobian.force_by_position;
    (2 * matrix.half_bandwidth() + 1).min(matrix.size()).max(1)
}

/// Writes the derivatives of a group of columns into the matrix.
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
