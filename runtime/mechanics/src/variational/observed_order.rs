//! The order of a discrete Lagrangian, from its momenta.

use crate::Error;
use num_traits::Float;

use super::checks::DiscretePath;
use super::discrete_lagrangian::DiscreteLagrangian;
use symplectic_core::inside::{check_step_size, larger_or_nan};
use symplectic_core::{State, Vector};

/// The order of a discrete Lagrangian observed along an orbit. It is `log2` of the ratio of the errors of its momenta in steps of size
/// `step_size` and half that size, both from `time`.
///
/// ```text
/// error(h) = max(|−D1 Ld(q(t), q(t + h)) − p(t)|, |D2 Ld(q(t), q(t + h)) − p(t + h)|)
/// ```
///
/// with the discrete forces if there are any. `orbit(t)` is the exact state at the time t, or a more precise one. Along an orbit these
/// errors are `O(h^r)` and that of `Ld` is `O(h^{r+1})`, because a derivative with respect to an end removes a power of h. Here r is the
/// order of the [steps](super::VariationalIntegrator) (Marsden & West 2001, Theorem 2.3.1).
///
/// The result is near r if h is small and the errors are far above rounding: compare several step sizes. It is NaN if both errors are zero.
///
/// # Errors
///
/// Those of `orbit`; [`Core(StepSize)`](symplectic_core::Error::StepSize); [`Core(Dimension)`](symplectic_core::Error::Dimension) if
/// positions differ in dimension.
///
/// ```
/// use symplectic::nalgebra::SVector;
/// use symplectic::variational::{DiscreteLagrangian, Error, observed_order};
/// use symplectic::{Scalar, State};
///
/// /// The oscillator L = (v² − q²)/2, with the potential at (1 − α)q0 + αq1.
/// struct Oscillator(f64);
///
/// impl DiscreteLagrangian for Oscillator {
///     type Vector<T: Scalar> = SVector<T, 1>;
///
///     fn value<T: Scalar>(&self, _time: T, h: T, q0: &SVector<T, 1>, q1: &SVector<T, 1>) -> T {
///         let (v, way) = ((q1[0] - q0[0]) / h, q1[0] - q0[0]);
///         let q = q0[0] + way * T::from_f64(self.0);
///         h * (v * v - q * q) * T::from_f64(0.5)
///     }
/// }
///
/// # fn main() -> Result<(), Error> {
/// let orbit = |time: f64| Ok(State::from_arrays(time, [time.sin()], [time.cos()]));
/// for h in [0.02, 0.01] {
///     assert!((observed_order(&Oscillator(0.5), orbit, 0.6, h)? - 2.0).abs() < 0.05);
///     assert!((observed_order(&Oscillator(0.3), orbit, 0.6, h)? - 1.0).abs() < 0.05);
/// }
/// # Ok(())
/// # }
/// ```
pub fn observed_order<L: DiscreteLagrangian>(
    lagrangian: &L,
    mut orbit: impl FnMut(f64) -> Result<State<L::Vector<f64>>, Error>,
    time: f64,
    step_size: f64,
) -> Result<f64, Error> {
    check_step_size(step_size)?;
    let start = orbit(time)?;
    let mut error = |step_size: f64| -> Result<f64, Error> {
        let end = orbit(time + step_size)?;
        let path = DiscretePath {
            time,
            step_size,
            q0: &start.q,
            q1: &end.q,
        };
        let (p0, p1) = path.momenta(lagrangian)?;
        let momenta = [(&p0, &start.p), (&p1, &end.p)];
        Ok(momenta.iter().fold(0.0, |largest, (found, exact)| {
            let pairs = found.as_slice().iter().zip(exact.as_slice());
            pairs.fold(largest, |largest, (found, exact)| {
                larger_or_nan(largest, Float::abs(found - exact))
            })
        }))
    };
    Ok(Float::log2(error(step_size)? / error(step_size / 2.0)?))
}
