//! The state of a system.

use nalgebra::SVector;

use crate::error::Error;
use crate::number::{Scalar, Vector, Visit, Words, copy, scalar_words};

/// A point of phase space at a time.
///
/// ```
/// use symplectic::State;
/// use symplectic::nalgebra::Vector2;
///
/// let state = State::new(0.0, Vector2::new(0.4, 0.0), Vector2::new(0.0, 2.0));
/// assert_eq!(state.p[1], 2.0);
/// ```
#[derive(Clone, Debug, PartialEq)]
pub struct State<V> {
    /// Time t.
    pub time: f64,
    /// Position q.
    pub q: V,
    /// Momentum p, of the same dimension as `q`.
    pub p: V,
}

/// A state with its time.
pub trait Timed: Clone {
    /// The time.
    fn time(&self) -> f64;
}

impl<V: Clone> Timed for State<V> {
    #[inline]
    fn time(&self) -> f64 {
        self.time
    }
}

impl<V: Vector> Words for State<V> {
    fn words(&mut self, visit: &mut Visit<'_>) {
        self.time.words(visit);
        scalar_words(self.q.as_mut_slice(), visit);
        scalar_words(self.p.as_mut_slice(), visit);
    }
}

impl<V> State<V> {
    /// The state `(q, p)` at `time`.
    pub const fn new(time: f64, q: V, p: V) -> Self {
        Self { time, q, p }
    }
}

impl<V: Vector> State<V> {
    /// The state with these components, in vectors of static or dynamic dimension.
    ///
    /// # Errors
    ///
    /// [`Error::Dimension`] if the slices differ in length, [`Error::Length`] if a static vector has another
    /// dimension.
    ///
    /// ```
    /// use symplectic::nalgebra::{DVector, Vector2};
    /// use symplectic::{Error, State};
    ///
    /// let state: State<DVector<f64>> = State::from_slices(0.0, &[0.4, 0.0], &[0.0, 2.0])?;
    /// assert_eq!(state.as_slices(), (&[0.4, 0.0][..], &[0.0, 2.0][..]));
    /// let wrong = State::<Vector2<f64>>::from_slices(0.0, &[0.4], &[2.0]);
    /// assert_eq!(wrong, Err(Error::Length { expected: 2, found: 1 }));
    /// # Ok::<(), Error>(())
    /// ```
    pub fn from_slices(time: f64, q: &[V::Scalar], p: &[V::Scalar]) -> Result<Self, Error> {
        if q.len() != p.len() {
            return Err(Error::Dimension {
                position: q.len(),
                momentum: p.len(),
            });
        }
        Ok(Self::new(time, V::from_slice(q)?, V::from_slice(p)?))
    }

    /// Copies another state of the same dimension.
    #[doc(hidden)]
    pub fn copy_from(&mut self, other: &Self) {
        self.time = other.time;
        copy(&mut self.q, &other.q);
        copy(&mut self.p, &other.p);
    }

    /// The components of position and momentum.
    pub fn as_slices(&self) -> (&[V::Scalar], &[V::Scalar]) {
        (self.q.as_slice(), self.p.as_slice())
    }
}

impl<T: Scalar, const N: usize> State<SVector<T, N>> {
    /// The state with these components.
    ///
    /// ```
    /// use symplectic::State;
    ///
    /// let state = State::from_arrays(0.0, [0.4, 0.0], [0.0, 2.0]);
    /// assert_eq!(state.to_arrays(), ([0.4, 0.0], [0.0, 2.0]));
    /// ```
    pub fn from_arrays(time: f64, q: [T; N], p: [T; N]) -> Self {
        Self::new(time, SVector::from(q), SVector::from(p))
    }

    /// The components of position and momentum.
    pub fn to_arrays(&self) -> ([T; N], [T; N]) {
        (self.q.data.0[0], self.p.data.0[0])
    }
}
