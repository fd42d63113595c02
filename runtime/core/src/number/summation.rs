//! How increments are added to the state.

use core::marker::PhantomData;

use crate::number::Scalar;

mod sealed {
    pub trait Sealed {}
    impl Sealed for super::Compensated {}
    impl Sealed for super::Plain {}
    impl<R> Sealed for super::Overrelaxed<R> {}
}

/// How a step adds its increments to the state: [`Compensated`] or [`Plain`]. Sealed.
pub trait Summation: sealed::Sealed + Copy + Default + 'static {
    /// Whether the state carries the round-off of its sums.
    const COMPENSATED: bool;

    /// Whether stages of an iteration are moved twice as far as by these sums.
    #[doc(hidden)]
    const OVERRELAXED: bool = false;
}

/// Compensated sums: the state is an unevaluated sum of two numbers, and increments are added in this precision.
///
/// With plain sums each step has a rounding error relative to the state, and the energy makes a random walk of that size. Here the rounding
/// error is relative to the increment. Two more conditions are needed: coefficients that are symplectic as rounded (`μ̃_ij + μ_ji = 1`) and
/// an iteration that continues until it stagnates. Brouwer's law remains: the energy error grows like the square root of the number of
/// steps, without drift (Hairer, McLachlan & Razakarivony, 2008; Antoñana, Makazaga & Murua, 2017). This is measured for Kepler,
/// Hénon–Heiles and `(q² + 1)(p² + 1)/2`, which is not separable (`--example drift` of the tests).
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub struct Compensated;

/// Plain sums: faster, but the rounding errors of the state add up from step to step. The iteration of coupled stages ends as
/// soon as the change is down to rounding.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub struct Plain;

impl Summation for Compensated {
    const COMPENSATED: bool = true;
}

impl Summation for Plain {
    const COMPENSATED: bool = false;
}

/// The sums of `R` in an over-relaxed sweep, which moves stages twice as far. If it converges fast, this approximately mirrors the stages.
#[derive(Clone, Copy, Debug, Default)]
pub struct Overrelaxed<R>(PhantomData<R>);

impl<R: Summation> Summation for Overrelaxed<R> {
    const COMPENSATED: bool = R::COMPENSATED;

    const OVERRELAXED: bool = true;
}

/// The updated value of a stage, over-relaxed if `overrelaxed`.
#[cfg_attr(not(debug_assertions), inline(always))]
pub fn moved<T: Scalar>(overrelaxed: bool, old: T, new: T) -> T {
    match overrelaxed {
        true => new + (new - old),
        false => new,
    }
}

/// The rounded sum and its round-off (Knuth).
#[cfg_attr(not(debug_assertions), inline(always))]
pub fn two_sum<T: Scalar>(a: T, b: T) -> (T, T) {
    let sum = a + b;
    let part = sum - a;
    (sum, (a - (sum - part)) + (b - part))
}

/// `two_sum` if `a` is at least as large as `b`, or is zero (Dekker).
#[cfg_attr(not(debug_assertions), inline(always))]
pub fn fast_two_sum<T: Scalar>(a: T, b: T) -> (T, T) {
    let sum = a + b;
    (sum, b - (sum - a))
}

/// The terms of a sum, by their numbers from 0. A closure is enough, except for lanes: one with operations of lanes may not be inlined.
pub trait Terms<T> {
    /// The term of this number.
    fn term(&self, number: usize) -> T;
}

impl<T, F: Fn(usize) -> T> Terms<T> for F {
    #[cfg_attr(not(debug_assertions), inline(always))]
    fn term(&self, number: usize) -> T {
        self(number)
    }
}

/// The terms from a number on.
struct TermsFrom<'a, X>(usize, &'a X);

impl<T, X: Terms<T>> Terms<T> for TermsFrom<'_, X> {
    #[cfg_attr(not(debug_assertions), inline(always))]
    fn term(&self, number: usize) -> T {
        self.1.term(self.0 + number)
    }
}

/// `base + low + Σ_j term_j` over `count` terms, as the nearest number and the rest.
#[cfg_attr(not(debug_assertions), inline(always))]
pub fn add<R: Summation, T: Scalar>(base: T, low: T, count: usize, terms: impl Terms<T>) -> (T, T) {
    if count == 0 {
        return (base, low);
    }
    let mut sum = eight::<R, T>(count, &terms);
    for block in 1..count.div_ceil(8) {
        let terms = TermsFrom(8 * block, &terms);
        sum = pair::<R, T>(sum, eight::<R, T>(count - 8 * block, &terms));
    }
    if !R::COMPENSATED {
        return (base + sum.0, low);
    }
    add_sum(base, low, sum)
}

/// `base + low + sum`, as the nearest number and the rest.
#[cfg_attr(not(debug_assertions), inline(always))]
pub fn add_sum<T: Scalar>(base: T, low: T, sum: Sum<T>) -> (T, T) {
    let (high, error) = two_sum(base, sum.0);
    let rest = sum.1.map_or(low, |rest| rest + low);
    fast_two_sum(high, rest + error)
}

/// A sum, and its round-off if it is known.
pub type Sum<T> = (T, Option<T>);

/// The sum of the first eight terms, at least one. They are added in pairs, and pairs of pairs, so that additions need not wait for one
/// another.
#[cfg_attr(not(debug_assertions), inline(always))]
fn eight<R: Summation, T: Scalar>(count: usize, terms: &impl Terms<T>) -> Sum<T> {
    let second = if 1 < count {
        Some(four::<R, T>(1, count, terms))
    } else {
        None
    };
    joined::<R, T>(four::<R, T>(0, count, terms), second)
}

/// The sum of every other term of eight.
#[cfg_attr(not(debug_assertions), inline(always))]
fn four<R: Summation, T: Scalar>(first: usize, count: usize, terms: &impl Terms<T>) -> Sum<T> {
    let second = if first + 2 < count {
        Some(two::<R, T>(first + 2, count, terms))
    } else {
        None
    };
    joined::<R, T>(two::<R, T>(first, count, terms), second)
}

/// The sum of every fourth term of eight.
#[cfg_attr(not(debug_assertions), inline(always))]
fn two<R: Summation, T: Scalar>(first: usize, count: usize, terms: &impl Terms<T>) -> Sum<T> {
    let second = if first + 4 < count {
        Some((terms.term(first + 4), None))
    } else {
        None
    };
    joined::<R, T>((terms.term(first), None), second)
}

/// The sum of `first` and, if present, `second`.
#[cfg_attr(not(debug_assertions), inline(always))]
fn joined<R: Summation, T: Scalar>(first: Sum<T>, second: Option<Sum<T>>) -> Sum<T> {
    match second {
        Some(second) => pair::<R, T>(first, second),
        None => first,
    }
}

/// The sum of two sums.
#[cfg_attr(not(debug_assertions), inline(always))]
fn pair<R: Summation, T: Scalar>(a: Sum<T>, b: Sum<T>) -> Sum<T> {
    if !R::COMPENSATED {
        return (a.0 + b.0, None);
    }
    let (sum, error) = two_sum(a.0, b.0);
    let rests = match (a.1, b.1) {
        (Some(a), Some(b)) => Some(a + b),
        (rest, None) | (None, rest) => rest,
    };
    (sum, Some(rests.map_or(error, |rests| error + rests)))
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn two_sum_splits_a_sum_without_error() {
        for (a, b) in [(1.0, 1e-20), (1e-20, 1.0), (0.1, 0.2), (-3.0, 3.0 + 1e-15)] {
            let (sum, rest) = two_sum(a, b);
            assert_eq!(sum, a + b);
            // The round-off is below half a unit in the last place, so adding it changes nothing.
            assert_eq!(sum + rest, sum);
        }
        assert_eq!(two_sum(1.0, 1e-20), (1.0, 1e-20));
        assert_eq!(two_sum(1e-20, 1.0), (1.0, 1e-20));
        assert_eq!(fast_two_sum(1.0, 1e-20), (1.0, 1e-20));
        assert_eq!(
            two_sum(1.0_f32, 2.0_f32.powi(-30)),
            (1.0, 2.0_f32.powi(-30))
        );
    }
}
