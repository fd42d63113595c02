//! Vectors of dual numbers, from vectors of values and slopes.

use alloc::vec;

use num_traits::Zero;

use crate::number::Vector;
use crate::number::dual::Dual;

/// Both halves of the components: values and slopes.
#[inline(always)]
pub(super) fn halves<W: Vector>(vector: &W) -> (&[W::Scalar], &[W::Scalar]) {
    let components = vector.as_slice();
    components.split_at(components.len() / 2)
}

/// The zero vector of a dimension; nothing where such vectors have another one.
#[inline(always)]
pub(super) fn zeros<V: Vector>(dimension: usize) -> Option<V> {
    let blank = V::blank();
    if blank.dimension() == dimension {
        return Some(blank);
    }
    V::from_slice(&vec![V::Scalar::zero(); dimension]).ok()
}

/// The dual numbers of values and slopes.
#[inline(always)]
pub(super) fn joined<W: Vector, V: Vector<Scalar = Dual<W::Scalar>>>(vector: &W) -> Option<V> {
    let (values, slopes) = halves(vector);
    let mut duals: V = zeros(values.len())?;
    let parts = values.iter().zip(slopes);
    for (dual, (&value, &slope)) in duals.as_mut_slice().iter_mut().zip(parts) {
        *dual = Dual { value, slope };
    }
    Some(duals)
}

/// Writes values and slopes of dual numbers.
#[inline(always)]
pub(super) fn part<V: Vector<Scalar = Dual<W::Scalar>>, W: Vector>(duals: &V, out: &mut W) {
    let (values, slopes) = out.as_mut_slice().split_at_mut(duals.dimension());
    let places = values.iter_mut().zip(slopes);
    for (dual, (value, slope)) in duals.as_slice().iter().zip(places) {
        (*value, *slope) = (dual.value, dual.slope);
    }
}
