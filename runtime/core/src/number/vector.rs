//! The vectors of positions and momenta.

use core::any::Any;
use core::fmt::Debug;
use core::mem;

use nalgebra::SMatrix;

use crate::error::Error;
use crate::number::Scalar;

/// Largest memory, in bytes, that is copied to keep it in registers.
pub(crate) const LIGHT: usize = 1 << 14;

/// Whether a vector holds its components, and nothing else, in place. Moving the vector out then leaves one of the same length.
#[cfg_attr(not(debug_assertions), inline(always))]
pub(crate) fn is_in_place<V: Vector>(vector: &V) -> bool {
    !mem::needs_drop::<V>() && vector.dimension() * size_of::<V::Scalar>() == size_of::<V>()
}

/// A position, a momentum or one of their derivatives: components of one [`Scalar`] type, contiguous in memory.
///
/// Implemented by [`nalgebra::SVector`] and [`nalgebra::SMatrix`] (static dimension, nothing on the heap; the columns of a matrix are
/// bodies in space). With the feature `alloc` also implemented by [`nalgebra::DVector`] (dimension known at run time).
///
/// ```
/// use symplectic::Vector;
/// use symplectic::nalgebra::{DVector, Vector3};
///
/// assert_eq!(Vector3::new(1.0, 2.0, 3.0).dimension(), 3);
/// assert_eq!(DVector::from_vec(vec![1.0_f32, 2.0]).zeros_like(), DVector::zeros(2));
/// ```
pub trait Vector: Clone + Debug + PartialEq + 'static {
    /// The type of a component.
    type Scalar: Scalar;
    /// The same kind of vector over another scalar, for example over dual numbers.
    type With<T: Scalar>: Vector<Scalar = T>;

    /// Number of components.
    fn dimension(&self) -> usize;
    /// The components.
    fn as_slice(&self) -> &[Self::Scalar];
    /// The components, mutable.
    fn as_mut_slice(&mut self) -> &mut [Self::Scalar];
    /// The vector with these components.
    ///
    /// # Errors
    ///
    /// [`Error::Length`] if a vector of this type has another dimension.
    fn from_slice(components: &[Self::Scalar]) -> Result<Self, Error>;
    /// A vector without components, or the zero vector if their number is fixed: the value that remains when a vector is moved out.
    /// Allocates no memory.
    fn blank() -> Self;
    /// The zero vector of the same dimension.
    fn zeros_like(&self) -> Self;
    /// The zero vector of the same dimension over another scalar.
    fn zeros_with<T: Scalar>(&self) -> Self::With<T>;
}

/// The vector as a vector of type `W`, if `V` is the same type.
#[cfg_attr(not(debug_assertions), inline(always))]
pub fn same<V: Vector, W: Vector>(vector: &V) -> Option<&W> {
    (vector as &dyn Any).downcast_ref()
}

/// Mutable [`same`].
#[cfg_attr(not(debug_assertions), inline(always))]
pub fn same_mut<V: Vector, W: Vector>(vector: &mut V) -> Option<&mut W> {
    (vector as &mut dyn Any).downcast_mut()
}

impl<T: Scalar, const R: usize, const C: usize> Vector for SMatrix<T, R, C> {
    type Scalar = T;
    type With<U: Scalar> = SMatrix<U, R, C>;

    #[cfg_attr(not(debug_assertions), inline(always))]
    fn dimension(&self) -> usize {
        R * C
    }

    #[cfg_attr(not(debug_assertions), inline(always))]
    fn as_slice(&self) -> &[T] {
        self.data.0.as_flattened()
    }

    #[cfg_attr(not(debug_assertions), inline(always))]
    fn as_mut_slice(&mut self) -> &mut [T] {
        self.data.0.as_flattened_mut()
    }

    #[inline]
    fn from_slice(components: &[T]) -> Result<Self, Error> {
        let mut vector = Self::blank();
        if components.len() != R * C {
            return Err(Error::Length {
                expected: R * C,
                found: components.len(),
            });
        }
        vector.as_mut_slice().copy_from_slice(components);
        Ok(vector)
    }

    #[inline]
    fn blank() -> Self {
        SMatrix::from([[T::zero(); R]; C])
    }

    #[inline]
    fn zeros_like(&self) -> Self {
        self.zeros_with()
    }

    #[inline]
    fn zeros_with<U: Scalar>(&self) -> SMatrix<U, R, C> {
        SMatrix::from([[U::zero(); R]; C])
    }
}

#[cfg(feature = "alloc")]
impl<T: Scalar> Vector for nalgebra::DVector<T> {
    type Scalar = T;
    type With<U: Scalar> = nalgebra::DVector<U>;

    #[cfg_attr(not(debug_assertions), inline(always))]
    fn dimension(&self) -> usize {
        self.len()
    }

    #[cfg_attr(not(debug_assertions), inline(always))]
    fn as_slice(&self) -> &[T] {
        self.data.as_slice()
    }

    #[cfg_attr(not(debug_assertions), inline(always))]
    fn as_mut_slice(&mut self) -> &mut [T] {
        self.data.as_mut_slice()
    }

    #[inline]
    fn from_slice(components: &[T]) -> Result<Self, Error> {
        Ok(nalgebra::DVector::from_column_slice(components))
    }

    #[inline]
    fn blank() -> Self {
        nalgebra::DVector::from_element(0, T::zero())
    }

    #[inline]
    fn zeros_like(&self) -> Self {
        self.zeros_with()
    }

    #[inline]
    fn zeros_with<U: Scalar>(&self) -> nalgebra::DVector<U> {
        nalgebra::DVector::from_element(self.len(), U::zero())
    }
}

/// The vector plus 1/16 to 1/8 of its largest component, or of 1 if it is zero, in every component.
pub fn beside<V: Vector>(vector: &V) -> V {
    let sizes = vector.as_slice().iter().map(|x| x.magnitude());
    let size = match sizes.fold(0.0, f64::max) {
        0.0 => 1.0,
        size => size,
    };
    let mut beside = vector.clone();
    for (k, component) in beside.as_mut_slice().iter_mut().enumerate() {
        let ratio = 1.0 + (k as f64 * 0.618_033_988_749_895) % 1.0;
        *component += V::Scalar::from_f64(size * ratio / 16.0);
    }
    beside
}
