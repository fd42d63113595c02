//! Vectors of dual numbers, and the vectors of their values and slopes.

use alloc::vec;

use num_traits::Zero;

use symplectic_core::Vector;
use symplectic_linearisation::Dual;

/// The first and the second half of the components.
#[cfg_attr(not(debug_assertions), inline(always))]
pub(super) fn halves<T>(components: &[T]) -> (&[T], &[T]) {
    components.split_at(components.len() / 2)
}

/// [`halves`], mutable.
#[cfg_attr(not(debug_assertions), inline(always))]
pub(super) fn halves_mut<T>(components: &mut [T]) -> (&mut [T], &mut [T]) {
    components.split_at_mut(components.len() / 2)
}

/// The zero vector of a dimension; `None` if the vector type has a different fixed dimension.
#[cfg_attr(not(debug_assertions), inline(always))]
pub(super) fn zeros<V: Vector>(dimension: usize) -> Option<V> {
    let blank = V::blank();
    if blank.dimension() == dimension {
        return Some(blank);
    }
    V::from_slice(&vec![V::Scalar::zero(); dimension]).ok()
}

/// The dual vector of values and slopes; `None` unless both have the dimension of the vector.
#[cfg_attr(not(debug_assertions), inline(always))]
pub(super) fn joined<T: Copy, V: Vector<Scalar = Dual<T>>>(
    values: &[T],
    slopes: &[T],
) -> Option<V> {
    if values.len() != slopes.len() {
        return None;
    }
    let mut duals: V = zeros(values.len())?;
    let parts = values.iter().zip(slopes);
    for (dual, (&value, &slope)) in duals.as_mut_slice().iter_mut().zip(parts) {
        *dual = Dual { value, slope };
    }
    Some(duals)
}

/// Splits dual numbers into values and slopes.
#[cfg_attr(not(debug_assertions), inline(always))]
pub(super) fn part<T: Copy>(duals: &[Dual<T>], values: &mut [T], slopes: &mut [T]) {
    let places = values.iter_mut().zip(slopes);
    for (dual, (value, slope)) in duals.iter().zip(places) {
        (*value, *slope) = (dual.value, dual.slope);
    }
}
