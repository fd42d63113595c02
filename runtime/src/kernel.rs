//! The linear combinations that generated code is made of.

use crate::{Coefficient, PartChange, Scalar, Vector};

/// `out = base + h Σ_j coefficients_j terms_j`; a copy of `base` where there are no terms.
///
/// The increments are summed before they meet the base, which is usually larger. Nothing is allocated. Vectors
/// of different dimension, which only a system that resized a result can bring here, are combined up to the
/// shortest one; the integrator then reports [`Error::EvaluationDimension`](crate::Error::EvaluationDimension).
///
/// ```
/// use symplectic::{Coefficient, combine};
/// use symplectic::nalgebra::Vector2;
///
/// let (q, force) = (Vector2::new(1.0, 2.0), Vector2::new(4.0, 8.0));
/// let mut out = Vector2::zeros();
/// combine(&mut out, &q, 0.5, [1.0, -0.5].map(Coefficient::exact), [&force, &q]);
/// assert_eq!(out, Vector2::new(2.75, 5.5));
/// combine(&mut out, &q, 0.5, [], []);
/// assert_eq!(out, q);
/// ```
#[inline(always)]
pub fn combine<V: Vector, const N: usize>(
    out: &mut V,
    base: &V,
    h: f64,
    coefficients: [Coefficient; N],
    terms: [&V; N],
) {
    let weights = coefficients.map(|c| V::Scalar::weight(h, c));
    let (out, base, terms) = common(out.as_mut_slice(), base.as_slice(), terms.map(V::as_slice));
    for i in 0..out.len() {
        out[i] = accumulate(base[i], &weights, &terms, i);
    }
}

/// [`combine`] for a stage that is solved for: notes in `change` how far `out` moved.
#[inline(always)]
pub fn relax<V: Vector, const N: usize>(
    out: &mut V,
    base: &V,
    h: f64,
    coefficients: [Coefficient; N],
    terms: [&V; N],
    change: &mut PartChange,
) {
    let weights = coefficients.map(|c| V::Scalar::weight(h, c));
    let (out, base, terms) = common(out.as_mut_slice(), base.as_slice(), terms.map(V::as_slice));
    // A local copy stays in registers; behind the reference it would be stored for every component.
    let mut local = *change;
    for i in 0..out.len() {
        let new = accumulate(base[i], &weights, &terms, i);
        local.record(base[i], out[i], new);
        out[i] = new;
    }
    *change = local;
}

/// Copies one vector of an array to others, which starts an iteration from a single evaluation.
#[inline]
pub fn copy_to<V: Vector, const N: usize>(vectors: &mut [V], from: usize, to: [usize; N]) {
    for index in to {
        if let Ok([source, target]) = vectors.get_disjoint_mut([from, index]) {
            // Component by component: `clone_from` of a dynamic vector may allocate.
            let components = target.as_mut_slice().iter_mut().zip(source.as_slice());
            components.for_each(|(target, source)| *target = *source);
        }
    }
}

/// All slices cut to the shortest length, so that one comparison bounds every index of the loop.
#[inline(always)]
fn common<'a, T, const N: usize>(
    out: &'a mut [T],
    base: &'a [T],
    terms: [&'a [T]; N],
) -> (&'a mut [T], &'a [T], [&'a [T]; N]) {
    let mut n = out.len().min(base.len());
    for term in &terms {
        n = n.min(term.len());
    }
    (&mut out[..n], &base[..n], terms.map(|term| &term[..n]))
}

#[inline(always)]
fn accumulate<T: Scalar, const N: usize>(
    base: T,
    weights: &[T; N],
    terms: &[&[T]; N],
    i: usize,
) -> T {
    if N == 0 {
        return base;
    }
    // Starting from the first product, not from zero: 0 + x is an addition that the compiler has to keep.
    let mut sum = weights[0] * terms[0][i];
    for j in 1..N {
        sum += weights[j] * terms[j][i];
    }
    base + sum
}
