//! Systems given by their Lagrangian.

use crate::error::Error;
use crate::number::{Scalar, Vector};

/// A mechanical system given by its Lagrangian `L(t, q, v)`, written once for every scalar. Its derivatives are exact, by hyper-dual
/// numbers: the momentum `p = ∂L/∂v`, the rate `p' = ∂L/∂q + f`, and their Jacobians.
///
/// L need not be quadratic in the velocities. [`lagrangian!`](macro@crate::lagrangian) writes this trait from a formula.
///
/// ```
/// use symplectic::nalgebra::SVector;
/// use symplectic::system::Lagrangian;
/// use symplectic::Scalar;
///
/// /// A relativistic particle in a harmonic trap, with rest mass and speed of light 1: L = −√(1 − v²) − q²/2.
/// struct Relativistic;
///
/// impl Lagrangian for Relativistic {
///     type Vector<T: Scalar> = SVector<T, 1>;
///
///     fn lagrangian<T: Scalar>(&self, _time: T, q: &SVector<T, 1>, v: &SVector<T, 1>) -> T {
///         -(T::one() - v[0] * v[0]).sqrt() - q[0] * q[0] * T::from_f64(0.5)
///     }
/// }
/// ```
pub trait Lagrangian {
    /// The vectors of positions, velocities and momenta.
    type Vector<T: Scalar>: Vector<Scalar = T>;

    /// Whether there is an applied [`force`](Self::force).
    const FORCED: bool = false;

    /// `L(t, q, v)`, in units of energy.
    fn lagrangian<T: Scalar>(&self, time: T, q: &Self::Vector<T>, v: &Self::Vector<T>) -> T;

    /// Writes `∂L/∂v` and `∂L/∂q` and returns `true`; with `false` hyper-dual numbers compute them.
    /// [`lagrangian!`](macro@crate::lagrangian) implements it: one evaluation, where hyper-dual numbers need one for each component.
    fn gradient<T: Scalar>(
        &self,
        _time: T,
        _q: &Self::Vector<T>,
        _v: &Self::Vector<T>,
        _by_velocity: &mut Self::Vector<T>,
        _by_position: &mut Self::Vector<T>,
    ) -> bool {
        false
    }

    /// Writes the applied force `f(t, q, v)`, which is not in L, into `force`, which is initially zero. Used only if `FORCED` is `true`.
    fn force<T: Scalar>(
        &self,
        _time: T,
        _q: &Self::Vector<T>,
        _v: &Self::Vector<T>,
        _force: &mut Self::Vector<T>,
    ) {
    }

    /// See [`crate::Hamiltonian::check_dimension`].
    #[doc(hidden)]
    fn check_dimension(&self, _dimension: usize) -> Result<(), Error> {
        Ok(())
    }
}

impl<L: Lagrangian> Lagrangian for &L {
    type Vector<T: Scalar> = L::Vector<T>;

    const FORCED: bool = L::FORCED;

    fn lagrangian<T: Scalar>(&self, time: T, q: &L::Vector<T>, v: &L::Vector<T>) -> T {
        (**self).lagrangian(time, q, v)
    }

    fn gradient<T: Scalar>(
        &self,
        time: T,
        q: &L::Vector<T>,
        v: &L::Vector<T>,
        by_velocity: &mut L::Vector<T>,
        by_position: &mut L::Vector<T>,
    ) -> bool {
        (**self).gradient(time, q, v, by_velocity, by_position)
    }

    fn force<T: Scalar>(
        &self,
        time: T,
        q: &L::Vector<T>,
        v: &L::Vector<T>,
        force: &mut L::Vector<T>,
    ) {
        (**self).force(time, q, v, force);
    }

    fn check_dimension(&self, dimension: usize) -> Result<(), Error> {
        (**self).check_dimension(dimension)
    }
}
