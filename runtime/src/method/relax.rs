//! Computes new values of coupled stages, and their change.

use core::slice;

use num_traits::Zero;

use crate::method::HalfChange;
use crate::number::array::array;
use crate::number::linear_combination::{shortest, starts, sum_of_products};
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
    let terms = starts(terms, n);
    let rows: [_; N] = array(&[][..], |j| eight_by_eight(terms[j]));
    let splats: [_; N] = array(F64x8::zero(), |j| splat(factors[j]));
    relax_by::<R, V>(
        out,
        (base, low),
        (n, N),
        |j, i| (factors[j], terms[j][i]),
        |j, i| (splats[j], Eight::load(&rows[j][i])),
        change,
    );
}

/// The rows of a vector; none unless these are doubles.
#[cfg_attr(not(debug_assertions), inline(always))]
pub(crate) fn eight_by_eight<T: Scalar>(components: &[T]) -> &[[f64; 8]] {
    T::doubles(components).map_or(&[], Eight::rows)
}

/// The same double in all lanes.
#[cfg_attr(not(debug_assertions), inline(always))]
fn splat<T: Scalar>(number: T) -> F64x8 {
    T::doubles(slice::from_ref(&number)).map_or_else(F64x8::zero, |number| Eight::splat(number[0]))
}

/// The first `n` components of a stage, `out = base + low + Σ_j product(j)` over `count` products; records their change in `change`.
/// `product` gets the number of the component, and `rows` that of a row of eight doubles.
#[cfg_attr(not(debug_assertions), inline(always))]
pub(crate) fn relax_by<R: Summation, V: Vector>(
    out: &mut V,
    (base, low): (&V, &V),
    (n, count): (usize, usize),
    product: impl Fn(usize, usize) -> (V::Scalar, V::Scalar),
    rows: impl Fn(usize, usize) -> (F64x8, F64x8),
    change: &mut HalfChange,
) {
    let (out, base) = (&mut out.as_mut_slice()[..n], &base.as_slice()[..n]);
    let low = &low.as_slice()[..n];
    let mut local = *change;
    let rest = relax_rows::<R, V::Scalar>(out, (base, low), count, rows, &mut local);
    for i in rest..n {
        let new = value::<R, _>(base[i], low[i], count, |j| product(j, i));
        let new = moved(R::BEYOND, out[i], new);
        local.record(base[i], out[i], new);
        out[i] = new;
    }
    // A local copy stays in registers; behind the reference it would be stored for every component.
    *change = local;
}

/// [`relax_by`] with eight components side by side, for doubles; returns the index of the first remaining component.
#[cfg_attr(not(debug_assertions), inline(always))]
fn relax_rows<R: Summation, T: Scalar>(
    out: &mut [T],
    (base, low): (&[T], &[T]),
    count: usize,
    product: impl Fn(usize, usize) -> (F64x8, F64x8),
    change: &mut HalfChange,
) -> usize {
    let (Some(out), Some(base), Some(low)) =
        (T::doubles_mut(out), T::doubles(base), T::doubles(low))
    else {
        return 0;
    };
    let n = out.len() / Eight::WIDTH;
    if n == 0 {
        return 0;
    }
    let out = &mut Eight::rows_mut(out)[..n];
    let (base, low) = (&Eight::rows(base)[..n], &Eight::rows(low)[..n]);
    let zero = F64x8::zero();
    let (mut difference, mut scale) = (zero, zero);
    for i in 0..n {
        let start = Eight::load(&base[i]);
        let low = Eight::load(&low[i]);
        let new = value::<R, _>(start, low, count, |j| product(j, i));
        let old = Eight::load(&out[i]);
        let new = moved(R::BEYOND, old, new);
        out[i] = Eight::store(new);
        difference = difference.larger_or_nan((new - old).abs());
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

/// One component of a stage, or eight components side by side.
#[cfg_attr(not(debug_assertions), inline(always))]
fn value<R: Summation, T: Scalar>(
    base: T,
    low: T,
    count: usize,
    product: impl Fn(usize) -> (T, T),
) -> T {
    match count {
        0 => base,
        _ => base + sum_of_products(R::COMPENSATED.then_some(low), count, product),
    }
}
