//! Computes new values of coupled stages, and their change.

use core::marker::PhantomData;
use core::slice;

use num_traits::Zero;

use crate::contract::HalfChange;
use crate::number::linear_combination::{Products, shortest, starts, sum_of};
use crate::number::registers::{self, Widest, Work};
#[cfg(feature = "alloc")]
use crate::number::registers::{EightLanes, in_eight_lanes};
use crate::number::rows::{Eight, Row, WideEight, WidestEight};
use crate::number::summation::moved;
use crate::number::{Lanes, Scalar, Summation, Vector};

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
    let vectors = starts(terms, n);
    let sum = LinearCombination {
        count: || N,
        factor: move |j: usize| factors[j],
        vector: move |j: usize| vectors[j],
    };
    relax_by::<R, V>(out, (base, low), n, sum, change);
}

/// `Σ_j factor_j vector_j` over `count` terms.
#[derive(Clone, Copy)]
pub(crate) struct LinearCombination<C, F, W> {
    /// A function, because it is a constant in generated code.
    pub(crate) count: C,
    pub(crate) factor: F,
    pub(crate) vector: W,
}

/// The first `n` components of a stage, `out = base + low + sum`; records their change in `change`.
#[cfg_attr(not(debug_assertions), inline(always))]
pub(crate) fn relax_by<'a, R: Summation, V: Vector>(
    out: &mut V,
    (base, low): (&V, &V),
    n: usize,
    sum: LinearCombination<
        impl Fn() -> usize + Copy,
        impl Fn(usize) -> V::Scalar + Copy,
        impl Fn(usize) -> &'a [V::Scalar] + Copy,
    >,
    change: &mut HalfChange,
) {
    let (out, base) = (&mut out.as_mut_slice()[..n], &base.as_slice()[..n]);
    let low = &low.as_slice()[..n];
    let mut local = *change;
    let rest = relax_rows::<R, V::Scalar>(out, (base, low), sum, &mut local);
    for i in rest..n {
        let product = |j: usize| ((sum.factor)(j), (sum.vector)(j)[i]);
        let new = value::<R, _>(base[i], low[i], (sum.count)(), product);
        let new = moved(R::OVERRELAXED, out[i], new);
        local.record(base[i], out[i], new);
        out[i] = new;
    }
    // A local copy stays in registers; behind the reference it would be stored for every component.
    *change = local;
}

/// [`relax_by`] with eight components side by side, for doubles; returns the index of the first remaining component.
#[cfg_attr(not(debug_assertions), inline(always))]
fn relax_rows<'a, R: Summation, T: Scalar>(
    out: &mut [T],
    (base, low): (&[T], &[T]),
    sum: LinearCombination<
        impl Fn() -> usize + Copy,
        impl Fn(usize) -> T + Copy,
        impl Fn(usize) -> &'a [T] + Copy,
    >,
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
    let count = out.len();
    let sum = LinearCombination {
        count: sum.count,
        factor: move |j: usize| double((sum.factor)(j)),
        vector: move |j: usize| Eight::rows(T::doubles((sum.vector)(j)).unwrap_or(&[])),
    };
    let (out, base, low) = (Eight::rows_mut(out), Eight::rows(base), Eight::rows(low));
    macro_rules! rows {
        ($kind:ty) => {
            Rows::<R, $kind, _> {
                out: &mut out[..n],
                base: &base[..n],
                low: &low[..n],
                sum,
                kind: PhantomData,
            }
        };
    }
    // Constant conditions first: other numbers compile without this code.
    let (difference, scale) = if registers::UNKNOWN && T::IS_DOUBLE && count >= registers::LONG {
        match Widest::find() {
            Widest::Build => rows!(Eight).run(),
            Widest::Avx2(avx2) => avx2.run(rows!(WideEight)),
            Widest::Avx512(avx512) => avx512.run(rows!(WidestEight)),
        }
    } else {
        rows!(Eight).run()
    };
    change.join(difference, scale);
    n * Eight::WIDTH
}

/// A number that is a double.
#[cfg_attr(not(debug_assertions), inline(always))]
fn double<T: Scalar>(number: T) -> f64 {
    T::doubles(slice::from_ref(&number)).map_or(0.0, |number| number[0])
}

/// The rows of a stage, in registers `K`, the same number of each vector. The work returns the largest change and the largest number.
struct Rows<'a, R, K, L> {
    out: &'a mut [[f64; 8]],
    base: &'a [[f64; 8]],
    low: &'a [[f64; 8]],
    sum: L,
    kind: PhantomData<(R, K)>,
}

impl<'a, R, K, C, F, W> Work for Rows<'_, R, K, LinearCombination<C, F, W>>
where
    R: Summation,
    K: Row<f64, Array = [f64; 8], Numbers: Lanes>,
    C: Fn() -> usize,
    F: Fn(usize) -> f64,
    W: Fn(usize) -> &'a [[f64; 8]],
{
    type Output = (f64, f64);

    #[cfg_attr(not(debug_assertions), inline(always))]
    fn run(self) -> (f64, f64) {
        let zero = K::Numbers::zero();
        let (mut difference, mut scale) = (zero, zero);
        let n = self.out.len();
        // A local copy: memory behind a reference would be read again after every store.
        let (out, sum) = (self.out, self.sum);
        let (base, low) = (&self.base[..n], &self.low[..n]);
        for row in 0..n {
            let start = K::load(&base[row]);
            let products = AtRow::<K, _> {
                row,
                sum: &sum,
                kind: PhantomData,
            };
            let new = value::<R, _>(start, K::load(&low[row]), (sum.count)(), products);
            let old = K::load(&out[row]);
            let new = moved(R::OVERRELAXED, old, new);
            out[row] = K::store(new);
            difference = difference.larger_or_nan((new - old).abs());
            scale = scale.larger(start.abs()).larger(new.abs());
        }
        let difference = match difference.any_nan() {
            true => f64::NAN,
            false => difference.largest(),
        };
        (difference, scale.largest())
    }
}

/// The products of one row. Not a closure: see [`Products`].
struct AtRow<'a, K, L> {
    row: usize,
    sum: &'a L,
    kind: PhantomData<K>,
}

impl<'a, K, C, F, W> Products<K::Numbers> for AtRow<'_, K, LinearCombination<C, F, W>>
where
    K: Row<f64, Array = [f64; 8]>,
    F: Fn(usize) -> f64,
    W: Fn(usize) -> &'a [[f64; 8]],
{
    #[cfg_attr(not(debug_assertions), inline(always))]
    fn product(&self, j: usize) -> (K::Numbers, K::Numbers) {
        let factor = K::splat((self.sum.factor)(j));
        (factor, K::load(&(self.sum.vector)(j)[self.row]))
    }
}

/// The largest number of stages that are computed side by side: the number of lanes.
#[cfg(feature = "alloc")]
const STAGES: usize = 8;

/// All stages of short vectors of doubles side by side; `columns` has the factors of each term. Returns `false`, and does nothing, for other
/// vectors. The bits are those of [`relax_by`].
#[cfg(feature = "alloc")]
#[inline]
pub(super) fn relax_side_by_side<R: Summation, V: Vector>(
    columns: &[[f64; STAGES]],
    out: &mut [V],
    (base, low): (&V, &V),
    terms: &[V],
    change: &mut HalfChange,
) -> bool {
    let n = shortest([base, low])
        .min(shortest(terms))
        .min(shortest(&*out));
    let (stages, count) = (out.len(), terms.len());
    let is_short = n < registers::LONG && count <= STAGES && stages <= STAGES;
    let (Some(base), Some(low)) = (
        V::Scalar::doubles(base.as_slice()),
        V::Scalar::doubles(low.as_slice()),
    ) else {
        return false;
    };
    if columns.is_empty() || columns.len() != count || !is_short {
        return false;
    }
    let mut places = out.iter_mut();
    let mut vectors = terms.iter();
    let (difference, scale) = in_eight_lanes(SideBySide::<R> {
        columns,
        out: core::array::from_fn(|_| {
            let vector = places.next().map(V::as_mut_slice);
            let doubles = vector.and_then(V::Scalar::doubles_mut);
            doubles.unwrap_or(&mut [])
        }),
        terms: core::array::from_fn(|_| {
            let vector = vectors.next().map(V::as_slice);
            vector.and_then(V::Scalar::doubles).unwrap_or(&[])
        }),
        base: &base[..n],
        low: &low[..n],
        stages,
        sums: PhantomData,
    });
    change.join(difference, scale);
    true
}

/// Stages in lanes.
#[cfg(feature = "alloc")]
struct SideBySide<'a, R> {
    columns: &'a [[f64; STAGES]],
    out: [&'a mut [f64]; STAGES],
    terms: [&'a [f64]; STAGES],
    base: &'a [f64],
    low: &'a [f64],
    stages: usize,
    sums: PhantomData<R>,
}

#[cfg(feature = "alloc")]
impl<R: Summation> EightLanes for SideBySide<'_, R> {
    type Output = (f64, f64);

    #[cfg_attr(not(debug_assertions), inline(always))]
    fn run<L: Lanes<Array = [f64; STAGES]>>(self) -> (f64, f64) {
        let Self {
            columns,
            out,
            terms,
            base,
            low,
            stages,
            ..
        } = self;
        let last = stages.clamp(1, STAGES) - 1;
        let (mut difference, mut scale) = (L::zero(), L::zero());
        for k in 0..base.len() {
            let products = OfComponent {
                k,
                columns,
                terms: &terms,
            };
            let (start, low) = (L::from_f64(base[k]), L::from_f64(low[k]));
            let new = value::<R, L>(start, low, columns.len(), products);
            // Lanes without a stage repeat the last one, as those of the columns do.
            let old = L::from_fn(|lane| out[lane.min(last)][k]);
            let new = moved(R::OVERRELAXED, old, new);
            difference = difference.larger_or_nan((new - old).abs());
            scale = scale.larger_or_nan(start.abs()).larger_or_nan(new.abs());
            let new = new.to_array();
            for stage in 0..=last {
                out[stage][k] = new[stage];
            }
        }
        let largest = |lanes: L| match lanes.any_nan() {
            true => f64::NAN,
            false => lanes.largest(),
        };
        (largest(difference), largest(scale))
    }
}

/// The products of one component, for all stages.
#[cfg(feature = "alloc")]
struct OfComponent<'a> {
    k: usize,
    columns: &'a [[f64; STAGES]],
    terms: &'a [&'a [f64]; STAGES],
}

#[cfg(feature = "alloc")]
impl<L: Lanes<Array = [f64; STAGES]>> Products<L> for OfComponent<'_> {
    #[cfg_attr(not(debug_assertions), inline(always))]
    fn product(&self, j: usize) -> (L, L) {
        (
            L::from_array(self.columns[j]),
            L::from_f64(self.terms[j][self.k]),
        )
    }
}

/// One component of a stage, or eight components side by side.
#[cfg_attr(not(debug_assertions), inline(always))]
fn value<R: Summation, T: Scalar>(base: T, low: T, count: usize, products: impl Products<T>) -> T {
    match count {
        0 => base,
        _ => base + sum_of(R::COMPENSATED.then_some(low), count, products),
    }
}

#[cfg(test)]
mod tests {
    #[cfg(feature = "alloc")]
    use std::{vec, vec::Vec};

    #[cfg(feature = "alloc")]
    use nalgebra::DVector;

    use super::*;
    #[cfg(feature = "alloc")]
    use crate::number::array::array;
    #[cfg(feature = "alloc")]
    use crate::number::registers::in_eight_lanes_of;
    use crate::number::registers::{Avx2, Avx512};
    use crate::number::summation::Overrelaxed;
    use crate::number::{Compensated, Plain};

    /// Five rows of pseudo-random numbers of many sizes.
    fn rows(seed: u64) -> [[f64; 8]; 5] {
        let mut state = seed;
        [[(); 8]; 5].map(|row| {
            row.map(|()| {
                state = state
                    .wrapping_mul(6_364_136_223_846_793_005)
                    .wrapping_add(1);
                let size = [1e-300, 1e-16, 1.0, 3e5, 1e150][(state >> 40) as usize % 5];
                size * ((state >> 11) as f64 / 2_f64.powi(53) - 0.5)
            })
        })
    }

    /// The stage, its largest change and its largest number, as bits.
    macro_rules! taken {
        ($sums:ty, $kind:ty, $terms:expr, $work:ident => $run:expr) => {{
            let mut out = rows(1);
            let (base, low, terms) = (rows(2), rows(3), $terms);
            let $work = Rows::<$sums, $kind, _> {
                out: &mut out,
                base: &base,
                low: &low,
                sum: LinearCombination {
                    count: || terms.len(),
                    factor: |j: usize| [0.3, -1.7, 1e-3][j],
                    vector: |j: usize| &terms[j][..],
                },
                kind: PhantomData,
            };
            let (difference, scale): (f64, f64) = $run;
            let stage = out.map(|row| row.map(f64::to_bits));
            // NaN has many bit patterns.
            (stage, difference.max(-1.0).to_bits(), scale.to_bits())
        }};
    }

    macro_rules! compare {
        ($sums:ty, $terms:expr) => {
            let expected = taken!($sums, Eight, $terms, work => work.run());
            if let Some(avx2) = Avx2::detect() {
                assert_eq!(taken!($sums, WideEight, $terms, work => avx2.run(work)), expected);
            }
            if let Some(avx512) = Avx512::detect() {
                assert_eq!(taken!($sums, WidestEight, $terms, work => avx512.run(work)), expected);
            }
        };
    }

    /// The stages, their largest change and their scale, as bits, row by row; and the same side by side, in these registers.
    #[cfg(feature = "alloc")]
    fn by_rows_and_side_by_side<R: Summation>(
        (stages, count, n): (usize, usize, usize),
        registers: Widest,
    ) -> [Vec<u64>; 2] {
        let numbers = |seed: usize, stage: usize| {
            let all = rows((97 * seed + stage) as u64 + 11);
            let numbers = all.as_flattened()[..n].iter();
            DVector::from_iterator(n, numbers.copied())
        };
        let vectors = |seed: usize, count: usize| -> Vec<DVector<f64>> {
            (0..count).map(|stage| numbers(seed, stage)).collect()
        };
        let (base, low, terms) = (numbers(1, 0), numbers(2, 0), vectors(3, count));
        let factor = |stage: usize, j: usize| 0.3 - 0.7 * stage as f64 + 1.1 * j as f64;
        let bits = |stages: &[DVector<f64>], [difference, scale]: [f64; 2]| {
            let stages = stages.iter().flatten().map(|x| x.to_bits());
            // NaN has many bit patterns.
            let sizes = [difference, scale].map(|x| x.max(-1.0).to_bits());
            stages.chain(sizes).collect()
        };
        let (mut out, mut change) = (vectors(4, stages), HalfChange::default());
        for (stage, out) in out.iter_mut().enumerate() {
            let sum = LinearCombination {
                count: || count,
                factor: |j: usize| factor(stage, j),
                vector: |j: usize| terms[j].as_slice(),
            };
            relax_by::<R, _>(out, (&base, &low), n, sum, &mut change);
        }
        let by_rows = bits(&out, [change.difference(), change.scale()]);
        let mut out = vectors(4, stages);
        let column = |j: usize| array(0.0, |lane| factor(lane.min(stages - 1), j));
        let columns: Vec<[f64; STAGES]> = (0..count).map(column).collect();
        let mut places = out.iter_mut();
        let work = SideBySide::<R> {
            columns: &columns,
            out: core::array::from_fn(|_| match places.next() {
                Some(vector) => vector.as_mut_slice(),
                None => &mut [],
            }),
            terms: core::array::from_fn(|j| terms.get(j).map_or(&[][..], |term| term.as_slice())),
            base: base.as_slice(),
            low: low.as_slice(),
            stages,
            sums: PhantomData,
        };
        let (difference, scale) = in_eight_lanes_of(registers, work);
        [by_rows, bits(&out, [difference, scale])]
    }

    #[cfg(feature = "alloc")]
    #[test]
    fn stages_side_by_side_have_the_bits_of_rows() {
        let mut registers = vec![Widest::Build];
        registers.extend(Avx2::detect().map(Widest::Avx2));
        registers.extend(Avx512::detect().map(Widest::Avx512));
        for registers in registers {
            for size in (1..=8).flat_map(|s| [(s, s, 1), (s, 9 - s, 7), (s, s, 8), (s, s, 31)]) {
                let [rows, lanes] = by_rows_and_side_by_side::<Plain>(size, registers);
                assert_eq!(rows, lanes, "{size:?}, {registers:?}");
                let [rows, lanes] = by_rows_and_side_by_side::<Compensated>(size, registers);
                assert_eq!(rows, lanes, "{size:?}, {registers:?}");
                let [rows, lanes] =
                    by_rows_and_side_by_side::<Overrelaxed<Compensated>>(size, registers);
                assert_eq!(rows, lanes, "{size:?}, {registers:?}");
            }
        }
    }

    #[test]
    fn stages_have_the_same_bits_in_all_registers() {
        let with_nan = || {
            let mut terms = rows(5);
            terms[3][6] = f64::NAN;
            terms
        };
        compare!(Plain, [rows(4), rows(5), rows(6)]);
        compare!(Plain, [rows(4), with_nan(), rows(6)]);
        compare!(Compensated, [rows(4), rows(5), rows(6)]);
        compare!(Compensated, [rows(4)]);
        compare!(Overrelaxed<Compensated>, [rows(4), with_nan()]);
        compare!(Plain, [[[0.0; 8]; 5]; 0]);
    }
}
