//! New values of stages that are solved for, and how much they changed.

use core::mem;

use crate::array::array;
use crate::kernel::{shortest, starts, value};
use crate::{PartChange, Scalar, Summation, Vector};

/// Components that are combined side by side.
const LANES: usize = 8;

/// [`combine`](crate::combine) for a stage that is solved for: notes in `change` how far `out` moved.
#[inline(always)]
pub fn relax<R: Summation, V: Vector, const N: usize>(
    out: &mut V,
    base: &V,
    low: &V,
    factors: [V::Scalar; N],
    terms: [&V; N],
    change: &mut PartChange,
) {
    let n = shortest([&*out, base, low]).min(shortest(terms));
    let (out, base) = (&mut out.as_mut_slice()[..n], &base.as_slice()[..n]);
    let (low, terms) = (&low.as_slice()[..n], starts(terms, n));
    let mut local = *change;
    let whole = n / LANES;
    let blocks = |slice| whole_blocks(slice, whole);
    let (base_blocks, low_blocks) = (blocks(base), blocks(low));
    let term_blocks: [_; N] = array(&[][..], |j| blocks(terms[j]));
    let out_blocks = &mut out.as_chunks_mut::<LANES>().0[..whole];
    // Blocks have accumulators of their own for each component: code without a branch, for as many lanes as there are.
    let mut noted = Blocks::default();
    for block in 0..whole {
        let (base, low) = (base_blocks[block], low_blocks[block]);
        let term = |j: usize| term_blocks[j][block];
        let new = values::<R, _, N>(base, low, &factors, term);
        let old = mem::replace(&mut out_blocks[block], new);
        noted.note(base, old, new);
    }
    if whole > 0 {
        noted.join(&mut local);
    }
    for i in whole * LANES..n {
        let new = value::<R, _, N>(base[i], low[i], &factors, &terms, i);
        local.record(base[i], out[i], new);
        out[i] = new;
    }
    // A local copy stays in registers; behind the reference it would be stored for every component.
    *change = local;
}

/// What blocks of components note of how they moved, one after the other, each component apart.
#[derive(Default)]
struct Blocks {
    difference: [f64; LANES],
    base: [f64; LANES],
    new: [f64; LANES],
    /// All differences together: NaN if one is, which the largest may lose.
    sum: [f64; LANES],
}

impl Blocks {
    #[inline(always)]
    fn note<T: Scalar>(&mut self, base: [T; LANES], old: [T; LANES], new: [T; LANES]) {
        let moved: [f64; LANES] = array(0.0, |lane| (new[lane] - old[lane]).magnitude());
        raise(&mut self.difference, moved);
        raise(&mut self.base, array(0.0, |lane| base[lane].magnitude()));
        raise(&mut self.new, array(0.0, |lane| new[lane].magnitude()));
        for (lane, moved) in moved.iter().enumerate() {
            self.sum[lane] += moved;
        }
    }

    #[inline(always)]
    fn join(&self, change: &mut PartChange) {
        for lane in 0..LANES {
            let sum = self.sum[lane];
            let difference = if sum.is_nan() {
                sum
            } else {
                self.difference[lane]
            };
            change.join(difference, self.base[lane]);
            change.join(difference, self.new[lane]);
        }
    }
}

/// The larger of two numbers, component by component.
#[inline(always)]
fn raise(largest: &mut [f64; LANES], values: [f64; LANES]) {
    for (lane, &value) in values.iter().enumerate() {
        let largest = &mut largest[lane];
        *largest = if *largest > value { *largest } else { value };
    }
}

/// So many blocks of a slice.
#[inline(always)]
fn whole_blocks<T>(slice: &[T], count: usize) -> &[[T; LANES]] {
    &slice.as_chunks::<LANES>().0[..count]
}

/// A block of components of a stage: each is [`value`].
#[inline(always)]
fn values<R: Summation, T: Scalar, const N: usize>(
    base: [T; LANES],
    low: [T; LANES],
    factors: &[T; N],
    term: impl Fn(usize) -> [T; LANES],
) -> [T; LANES] {
    if N == 0 {
        return base;
    }
    let mut sums = [[T::zero(); LANES]; 2];
    for j in 0..N {
        let term = term(j);
        let sum = &mut sums[j % 2];
        for lane in 0..LANES {
            sum[lane] = match j {
                0 if R::COMPENSATED => factors[j].fused(term[lane], low[lane]),
                0 | 1 => factors[j] * term[lane],
                _ => factors[j].fused(term[lane], sum[lane]),
            };
        }
    }
    let mut values = base;
    for lane in 0..LANES {
        let mut sum = sums[0][lane];
        if N > 1 {
            sum += sums[1][lane];
        }
        values[lane] += sum;
    }
    values
}
