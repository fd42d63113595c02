//! Computes new values of coupled stages, and their change.

use num_traits::Zero;

use crate::method::HalfChange;
use crate::number::array::array;
use crate::number::linear_combination::{shortest, starts, value};
use crate::number::rows::{Eight, Row};
use crate::number::summation::moved;
use crate::number::{F64x8, Lanes, Scalar, Summation, Vector};

/// [`combine`](crate::emitted::combine) for a coupled stage: records the change of `out` in `change`.
#[cfg_attr(not(debug_assertions), inline(always))]
pub(super) fn relax<R: Summation, V: Vector, const N: usize>(
    out: &mut V,
    base: &V,
    low: &V,
    factors: [V::Scalar; N],
    terms: [&V; N],
    change: &mut HalfChange,
) {
    let n = shortest([&*out, base, low]).min(shortest(terms));
    let (out, base) = (&mut out.as_mut_slice()[..n], &base.as_slice()[..n]);
    let (low, terms) = (&low.as_slice()[..n], starts(terms, n));
    let mut local = *change;
    let rest = relax_rows::<R, V::Scalar, N>(out, base, low, &factors, &terms, &mut local);
    for i in rest..n {
        let new = value::<R, _, N>(base[i], low[i], &factors, |j| terms[j][i]);
        let new = moved(R::BEYOND, out[i], new);
        local.record(base[i], out[i], new);
        out[i] = new;
    }
    // A local copy stays in registers; behind the reference it would be stored for every component.
    *change = local;
}

/// [`relax`] with eight components side by side, for doubles; returns the index of the first remaining component.
#[cfg_attr(not(debug_assertions), inline(always))]
fn relax_rows<R: Summation, T: Scalar, const N: usize>(
    out: &mut [T],
    base: &[T],
    low: &[T],
    factors: &[T; N],
    terms: &[&[T]; N],
    change: &mut HalfChange,
) -> usize {
    let (Some(out), Some(base), Some(low), Some(factors)) = (
        T::doubles_mut(out),
        T::doubles(base),
        T::doubles(low),
        T::doubles(factors),
    ) else {
        return 0;
    };
    let out = Eight::rows_mut(out);
    let (base, low) = (Eight::rows(base), Eight::rows(low));
    let terms: [_; N] = array(&[][..], |j| {
        T::doubles(terms[j]).map_or(&[][..], Eight::rows)
    });
    let n = (out.len()).min(base.len()).min(low.len());
    let n = terms.iter().fold(n, |n, term| n.min(term.len()));
    if n == 0 {
        return 0;
    }
    let (out, base, low) = (&mut out[..n], &base[..n], &low[..n]);
    let terms: [_; N] = array(&[][..], |j| &terms[j][..n]);
    let factors = array(F64x8::zero(), |j| Eight::splat(factors[j]));
    let zero = F64x8::zero();
    let (mut difference, mut scale) = (zero, zero);
    for i in 0..n {
        let start = Eight::load(&base[i]);
        let low = Eight::load(&low[i]);
        let new = value::<R, _, N>(start, low, &factors, |j| Eight::load(&terms[j][i]));
        let old = Eight::load(&out[i]);
        let new = moved(R::BEYOND, old, new);
        let change = (new - old).abs();
        out[i] = Eight::store(new);
        difference = difference.larger_or_nan(change);
        scale = scale.larger(start.abs()).larger(new.abs());
    }
    let difference = if difference.any_nan() {
        f64::NAN
    } else {
        difference.largest()
    };
    change.join(difference, scale.largest());
    n * Eight::WIDTH
}
