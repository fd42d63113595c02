//! Maps of positions, and their cotangent lifts.

use crate::Error;
use alloc::vec;

use num_traits::{Float, Zero};

use super::regular::{Factors, Singular};
use symplectic_core::inside::check_state;
use symplectic_core::{Error as CoreError, Scalar, State, Vector};
use symplectic_linearisation::HyperDual;

/// A map of positions `Q = Φ(q)`: a symmetry, or a change of coordinates. It is written once for all scalars, and its derivatives are
/// exact.
pub trait PointTransformation {
    /// The type of the vectors of positions, before and after the map.
    type Vector<T: Scalar>: Vector<Scalar = T>;

    /// Writes `Φ(q)` into `image`, which has the dimension of `q` and is zero on entry.
    fn map<T: Scalar>(&self, q: &Self::Vector<T>, image: &mut Self::Vector<T>);
}

/// The cotangent lift of a map of positions (Marsden & West 2001, §1.4.2):
///
/// ```text
/// Q = Φ(q)      P = p·(∂Φ/∂q)⁻¹
/// ```
///
/// It is symplectic, and `P·Q' = p·q'`. The lifts of the flow of `ξ_Q` are the Hamiltonian flow of the [momentum map](super::momentum_map)
/// `J = p·ξ_Q(q)`. (The paper has `Φ⁻¹` in the first slot, which contradicts this J.)
///
/// A map of n components takes n evaluations and the elimination of a full matrix; memory is allocated.
///
/// # Errors
///
/// [`Error::SingularTransformation`] if `∂Φ/∂q` is not invertible; [`Core(Dimension)`](CoreError::Dimension) and
/// [`Core(NonFiniteState)`](CoreError::NonFiniteState) for the state or its image; [`Core(Length)`](CoreError::Length) if the map changes
/// the dimension of a vector.
///
/// ```
/// use symplectic::nalgebra::SVector;
/// use symplectic::variational::{Error, PointTransformation, cotangent_lift};
/// use symplectic::{Scalar, State};
///
/// /// (x, y) in polar coordinates.
/// struct Polar;
///
/// impl PointTransformation for Polar {
///     type Vector<T: Scalar> = SVector<T, 2>;
///
///     fn map<T: Scalar>(&self, q: &SVector<T, 2>, image: &mut SVector<T, 2>) {
///         *image = SVector::from([q.dot(q).sqrt(), q[1].atan2(q[0])]);
///     }
/// }
///
/// # fn main() -> Result<(), Error> {
/// let state = State::from_arrays(0.0, [3.0, 4.0], [0.5, -1.0]);
/// let State { q, p, .. } = cotangent_lift(&Polar, &state)?;
/// assert_eq!(q[0], 5.0);
/// // The radial momentum q·p/r, and the angular momentum.
/// assert!((p[0] - -0.5).abs() < 1e-15 && (p[1] - -5.0).abs() < 1e-14);
/// # Ok(())
/// # }
/// ```
pub fn cotangent_lift<F: PointTransformation>(
    map: &F,
    state: &State<F::Vector<f64>>,
) -> Result<State<F::Vector<f64>>, Error> {
    let State { time, q, p } = state;
    let n = q.dimension();
    check_state(*time, q, p, n)?;
    let mut position = F::Vector::from_slice(&vec![HyperDual::zero(); n])?;
    let mut image = position.clone();
    for (dual, &value) in position.as_mut_slice().iter_mut().zip(q.as_slice()) {
        *dual = HyperDual::from_f64(value);
    }
    let (mut new, mut transposed) = (state.clone(), vec![0.0; n * n]);
    // Rows are divided by their largest entries, so that the units of q do not matter.
    let mut scales = vec![1.0; n];
    for (k, row) in transposed.chunks_exact_mut(n.max(1)).enumerate() {
        position.as_mut_slice()[k].set_first(1.0);
        image.as_mut_slice().fill(HyperDual::zero());
        map.map(&position, &mut image);
        position.as_mut_slice()[k].set_first(0.0);
        if image.dimension() != n {
            let (expected, found) = (n, image.dimension());
            return Err(CoreError::Length { expected, found }.into());
        }
        let places = row.iter_mut().zip(new.q.as_mut_slice());
        for ((slope, value), dual) in places.zip(image.as_slice()) {
            (*slope, *value) = (dual.first(), dual.real());
        }
        let largest = row
            .iter()
            .fold(0.0, |largest: f64, slope| largest.max(Float::abs(*slope)));
        if largest > 0.0 {
            scales[k] = largest;
            row.iter_mut().for_each(|slope| *slope /= largest);
        }
    }
    let mut factors = Factors::new(n);
    let singular =
        |Singular { component, pivot }| Error::SingularTransformation { component, pivot };
    factors.factor(&transposed).map_err(singular)?;
    new.p.as_mut_slice().fill(0.0);
    let zeros = p.zeros_like();
    let right = p.as_slice().iter().zip(&scales).map(|(p, scale)| p / scale);
    factors.correct(right, zeros.as_slice(), new.p.as_mut_slice());
    check_state(*time, &new.q, &new.p, n)?;
    Ok(new)
}
