//! Momenta and velocities of a Lagrangian.

use crate::Error;
use num_traits::Float;

use super::derivatives::Derivatives;
use crate::variational::regular::Factors;
use symplectic_core::Vector;
use symplectic_core::inside::check_state;
use symplectic_core::system::Lagrangian;

/// The momentum `p = ∂L/∂v(t, q, v)`, with the dimension of `q`.
///
/// # Errors
///
/// [`Core(Dimension)`](symplectic_core::Error::Dimension) if `q` and `v` differ,
/// [`Core(NonFiniteState)`](symplectic_core::Error::NonFiniteState) if `q`, `v` or the momentum is not finite,
/// [`Core(ResizedEvaluation)`](symplectic_core::Error::ResizedEvaluation).
///
/// ```
/// # use symplectic::nalgebra::SVector;
/// # use symplectic::variational::momentum_of_velocity;
/// # use symplectic::system::Lagrangian;
/// # use symplectic::Scalar;
/// /// A charge in a magnetic field, L = |v|²/2 + (x y' − y x').
/// struct Charge;
///
/// impl Lagrangian for Charge {
///     type Vector<T: Scalar> = SVector<T, 2>;
///
///     fn lagrangian<T: Scalar>(&self, _time: T, q: &SVector<T, 2>, v: &SVector<T, 2>) -> T {
///         v.dot(v) * T::from_f64(0.5) + q[0] * v[1] - q[1] * v[0]
///     }
/// }
///
/// # fn main() -> Result<(), symplectic::variational::Error> {
/// let (q, v) = (SVector::from([3.0, 1.0]), SVector::from([0.5, 2.0]));
/// assert_eq!(momentum_of_velocity(&Charge, 0.0, &q, &v)?, SVector::from([-0.5, 5.0]));
/// # Ok(())
/// # }
/// ```
pub fn momentum_of_velocity<L: Lagrangian>(
    lagrangian: &L,
    time: f64,
    q: &L::Vector<f64>,
    v: &L::Vector<f64>,
) -> Result<L::Vector<f64>, Error> {
    check_state(time, q, v, q.dimension())?;
    lagrangian.check_dimension(q.dimension())?;
    let mut derivatives = Derivatives::new(q.dimension())?;
    derivatives.first(lagrangian, time, q.as_slice(), v.as_slice());
    derivatives.check(time)?;
    let mut momentum = q.zeros_like();
    momentum
        .as_mut_slice()
        .copy_from_slice(&derivatives.momentum);
    Ok(momentum)
}

/// The velocity `v` with `∂L/∂v(t, q, v) = p`, by Newton's iteration from `v = 0`. A change is halved if it leads to a point where L is not
/// finite.
///
/// # Errors
///
/// [`Core(Dimension)`](symplectic_core::Error::Dimension) if `q` and `p` differ,
/// [`Core(NonFiniteState)`](symplectic_core::Error::NonFiniteState),
/// [`Core(ResizedEvaluation)`](symplectic_core::Error::ResizedEvaluation), [`Error::NoVelocity`] if L does not determine the velocity or no
/// velocity is found.
///
/// ```
/// use symplectic::nalgebra::SVector;
/// use symplectic::variational::{momentum_of_velocity, velocity_of_momentum};
/// use symplectic::system::Lagrangian;
/// use symplectic::Scalar;
///
/// /// A free particle at relativistic speeds: p = v/√(1 − v²).
/// struct Free;
///
/// impl Lagrangian for Free {
///     type Vector<T: Scalar> = SVector<T, 1>;
///
///     fn lagrangian<T: Scalar>(&self, _time: T, _q: &SVector<T, 1>, v: &SVector<T, 1>) -> T {
///         -(T::one() - v[0] * v[0]).sqrt()
///     }
/// }
///
/// # fn main() -> Result<(), symplectic::variational::Error> {
/// let (q, v) = (SVector::from([0.0]), SVector::from([0.8]));
/// let p = momentum_of_velocity(&Free, 0.0, &q, &v)?;
/// assert!((p[0] - 4.0 / 3.0).abs() < 1e-15);
/// assert!((velocity_of_momentum(&Free, 0.0, &q, &p)?[0] - 0.8).abs() < 1e-15);
/// # Ok(())
/// # }
/// ```
pub fn velocity_of_momentum<L: Lagrangian>(
    lagrangian: &L,
    time: f64,
    q: &L::Vector<f64>,
    p: &L::Vector<f64>,
) -> Result<L::Vector<f64>, Error> {
    check_state(time, q, p, q.dimension())?;
    lagrangian.check_dimension(q.dimension())?;
    velocity_near(lagrangian, time, q, p, q.zeros_like())
}

/// [`velocity_of_momentum`] by an iteration that begins at `velocity`; `q` and `p` are valid for a state.
pub(super) fn velocity_near<L: Lagrangian>(
    lagrangian: &L,
    time: f64,
    q: &L::Vector<f64>,
    p: &L::Vector<f64>,
    mut velocity: L::Vector<f64>,
) -> Result<L::Vector<f64>, Error> {
    let n = q.dimension();
    let mut derivatives = Derivatives::new(n)?;
    let mut factors = Factors::new(n);
    let mut change = q.zeros_like();
    let not_found = |component| Error::NoVelocity { time, component };
    let (mut last, mut stalled) = (f64::INFINITY, 0);
    for _ in 0..MAX_ITERATIONS {
        derivatives.second(lagrangian, time, q.as_slice(), velocity.as_slice());
        let pairs = velocity.as_mut_slice().iter_mut();
        let pairs = pairs.zip(change.as_mut_slice());
        derivatives.check_dimension(time)?;
        if !derivatives.is_finite() {
            for (velocity, change) in pairs {
                *change *= 0.5;
                *velocity -= *change;
            }
            last = f64::INFINITY;
            continue;
        }
        factors
            .factor(&derivatives.momentum_by_velocity)
            .map_err(|singular| not_found(Some(singular.component)))?;
        let right = p.as_slice().iter().zip(&derivatives.momentum);
        let step = factors.solve(right.map(|(p, momentum)| p - momentum));
        let (mut changed, mut size) = (0.0_f64, 0.0_f64);
        for ((velocity, change), &step) in pairs.zip(step) {
            *velocity += step;
            *change = step;
            changed = changed.max(Float::abs(step));
            size = size.max(Float::abs(*velocity));
        }
        stalled +=
            u32::from(changed <= STATIONARY * size && changed > last / 2.0 && changed < 2.0 * last);
        if changed <= 4.0 * f64::EPSILON * size || stalled == MAX_STALLED {
            return Ok(velocity);
        }
        last = changed;
    }
    Err(not_found(None))
}

/// Changes below this, relative to the velocity, that no longer decrease are rounding errors of `∂L/∂v`.
const STATIONARY: f64 = 1e-9;
/// Number of such changes after which the iteration has stagnated.
const MAX_STALLED: u32 = 4;
/// Maximum number of iterations and halvings together.
const MAX_ITERATIONS: u32 = 1000;
