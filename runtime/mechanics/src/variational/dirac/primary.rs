//! Primary constraints on the momenta of a degenerate Lagrangian.

use crate::Error;
use alloc::vec;
use alloc::vec::Vec;

use num_traits::Float;

use super::DiracSystem;
use super::failure::MAX_ITERATIONS;
use super::rows::Rows;
use super::step::{LAST_CHANGE, largest_contradiction};
use crate::rank::{RankElimination, Rest};
use crate::variational::lagrangian::derivatives::Derivatives;
use symplectic_core::system::Lagrangian;
use symplectic_core::{Error as CoreError, Quantity, State, Vector};

/// A constraint `direction·p = value` on the momentum at a position.
#[derive(Clone, Debug, PartialEq)]
pub struct PrimaryConstraint<V> {
    /// A vector of the kernel of `∂²L/∂v∂v`. One of its components is 1, and that component of the other directions is 0.
    pub direction: V,
    /// `direction·∂L/∂v`.
    pub value: f64,
}

/// Dirac's primary constraints of a Lagrangian, at a state of positions and velocities: one for each dimension of the kernel of
/// `∂²L/∂v∂v`, none if the Lagrangian is regular.
///
/// Allocates memory; for tests and reports.
///
/// # Errors
///
/// [`Core(Dimension)`](CoreError::Dimension) if `q` and `v` differ; [`Core(NonFiniteState)`](CoreError::NonFiniteState) if a derivative of
/// L is not finite; [`Core(ResizedEvaluation)`](CoreError::ResizedEvaluation).
///
/// ```
/// use symplectic::nalgebra::SVector;
/// use symplectic::variational::primary_constraints;
/// use symplectic::system::Lagrangian;
/// use symplectic::Scalar;
///
/// /// L = (x' + y')²/2 + x z' − (x² + z²)/2
/// struct Degenerate;
///
/// impl Lagrangian for Degenerate {
///     type Vector<T: Scalar> = SVector<T, 3>;
///
///     fn lagrangian<T: Scalar>(&self, _time: T, q: &SVector<T, 3>, v: &SVector<T, 3>) -> T {
///         let half = T::from_f64(0.5);
///         (v[0] + v[1]).powi(2) * half + q[0] * v[2] - (q[0] * q[0] + q[2] * q[2]) * half
///     }
/// }
///
/// # fn main() -> Result<(), symplectic::variational::Error> {
/// let (q, v) = (SVector::from([3.0, 1.0, 2.0]), SVector::from([0.5, 0.1, 0.0]));
/// let found = primary_constraints(&Degenerate, 0.0, &q, &v)?;
/// // py − px = 0 and pz = x.
/// let found: Vec<_> = found.iter().map(|found| (found.direction.into(), found.value)).collect();
/// assert_eq!(found, [([-1.0, 1.0, 0.0], 0.0), ([0.0, 0.0, 1.0], 3.0)]);
/// # Ok(())
/// # }
/// ```
pub fn primary_constraints<L: Lagrangian>(
    lagrangian: &L,
    time: f64,
    q: &L::Vector<f64>,
    v: &L::Vector<f64>,
) -> Result<Vec<PrimaryConstraint<L::Vector<f64>>>, Error> {
    let n = q.dimension();
    let mut derivatives = derivatives_like::<L>(q, v)?;
    derivatives.second(lagrangian, time, q.as_slice(), v.as_slice());
    derivatives.check(time)?;
    let mut linear = RankElimination::new(n, n);
    for row in 0..n {
        for column in 0..n {
            let entry = derivatives.momentum_by_velocity[row * n + column];
            linear.add(row, column, entry);
        }
    }
    if !linear.is_finite() {
        return Err(NOT_FINITE.into());
    }
    linear.eliminate(0..n, 0..n);
    let free: Vec<usize> = (0..n).filter(|&column| !linear.has_pivot(column)).collect();
    let constraint = |component| {
        let mut direction = q.zeros_like();
        let null = linear.null_vector(component);
        direction.as_mut_slice().copy_from_slice(null);
        let products = null.iter().zip(&derivatives.momentum).map(|(n, p)| n * p);
        let value = products.sum();
        PrimaryConstraint { direction, value }
    };
    Ok(free.into_iter().map(constraint).collect())
}

const NOT_FINITE: CoreError = CoreError::NonFiniteState {
    what: Quantity::Lagrangian,
};

fn derivatives_like<L: Lagrangian>(
    q: &L::Vector<f64>,
    v: &L::Vector<f64>,
) -> Result<Derivatives<L>, CoreError> {
    let (position, momentum) = (q.dimension(), v.dimension());
    if position != momentum {
        return Err(CoreError::Dimension { position, momentum });
    }
    Derivatives::new(position)
}

/// A velocity v with `∂L/∂v = p` and `w(q) v = 0`, found from zero: undetermined components are zero.
pub(super) fn consistent_velocity<L: DiracSystem>(
    system: &L,
    State { time, q, p }: &State<L::Vector<f64>>,
) -> Result<L::Vector<f64>, Error> {
    let (n, q, p) = (q.dimension(), q.as_slice(), p.as_slice());
    let mut rows = Rows::new(system, q)?;
    let m = rows.constraints();
    let mut derivatives = Derivatives::<L>::new(n)?;
    let mut linear = RankElimination::new(n + m, n);
    let (mut v, mut settled) = (vec![0.0; n], false);
    for _ in 0..MAX_ITERATIONS {
        derivatives.second(system, *time, q, &v);
        derivatives.check_dimension(*time)?;
        linear.clear();
        for (k, &p) in p.iter().enumerate() {
            let momentum = derivatives.momentum[k];
            let mut size = Float::abs(p) + Float::abs(momentum);
            for j in 0..n {
                let entry = derivatives.momentum_by_velocity[k * n + j];
                linear.add(k, j, entry);
                size += Float::abs(entry * v[j])
                    + Float::abs(derivatives.momentum_by_position[k * n + j] * q[j]);
            }
            linear.add_right(k, p - momentum, size);
        }
        let moving = CoreError::MovingGradients { time: *time };
        for entry in rows.at(system, q).ok_or(moving)? {
            let (row, term) = (n + entry.constraint, entry.value * v[entry.component]);
            linear.add(row, entry.component, entry.value);
            linear.add_right(row, -term, Float::abs(term));
        }
        if !linear.is_finite() {
            return Err(NOT_FINITE.into());
        }
        linear.eliminate(0..n, 0..n);
        linear.eliminate(n..n + m, 0..n);
        let (mut changed, mut size) = (0.0_f64, 0.0_f64);
        for (v, change) in v.iter_mut().zip(linear.solve()) {
            *v += change;
            changed = changed.max(Float::abs(*change));
            size = size.max(Float::abs(*v));
        }
        if changed <= LAST_CHANGE * size {
            if settled {
                break;
            }
            settled = true;
        }
    }
    match largest_contradiction(linear.rests()) {
        Some(Rest { row, value, .. }) if row < n => Err(Error::PrimaryConstraint {
            component: row,
            value: Float::abs(value),
        }),
        Some(Rest { row, value, .. }) => Err(CoreError::InconsistentVelocity {
            constraint: row - n,
            name: None,
            rate: Float::abs(value),
        }
        .into()),
        None if settled => Ok(Vector::from_slice(&v)?),
        None => Err(Error::NoVelocity {
            time: *time,
            component: None,
        }),
    }
}
