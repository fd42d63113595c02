//! Doubles side by side, as one scalar.

use core::fmt::Debug;

use crate::number::array::array;
use crate::number::registers::{self, Avx2, Avx512, Work};
use crate::number::scalar::elementary;
use crate::number::words::{Visit, words};
use crate::number::{Scalar, larger_or_nan};

/// The largest number of [`Lanes`].
#[doc(hidden)]
pub const MAX_LANES: usize = 16;

/// Several doubles side by side, in one register of the processor if its registers are wide enough.
///
/// Every lane has the bits of the same computation with a single double, and all lanes are computed at once. Only `tan`, inverse and
/// hyperbolic functions are computed lane by lane. The target sets the width of the registers; integrators and ensembles detect wider ones
/// when they are created, if the system is [inlined](crate::Hamiltonian::INLINED).
///
/// ```
/// use symplectic::Scalar;
/// use symplectic::simd::{F64x4, Lanes};
///
/// let x = F64x4::from_fn(|lane| lane as f64);
/// assert_eq!((x * x + F64x4::from_f64(0.5)).to_array(), [0.5, 1.5, 4.5, 9.5]);
/// assert_eq!(x.sin().to_array()[3], Scalar::sin(3.0_f64));
/// ```
pub trait Lanes: Scalar {
    /// One double for each lane.
    type Array: Copy + Debug + AsRef<[f64]>;

    /// The number of lanes.
    const WIDTH: usize;

    /// The double of each lane, by its number from 0.
    fn from_fn(lane: impl FnMut(usize) -> f64) -> Self;

    /// The double of each lane.
    fn from_array(doubles: Self::Array) -> Self;

    /// The doubles of the lanes.
    fn to_array(self) -> Self::Array;

    /// The number of a lane.
    #[cfg_attr(not(debug_assertions), inline(always))]
    fn get(self, lane: usize) -> f64 {
        self.to_array().as_ref()[lane]
    }

    /// Sets the number of a lane, if there is such a lane.
    fn set(&mut self, lane: usize, number: f64);

    /// The larger of two numbers in each lane; either of them if one is NaN.
    fn larger(self, other: Self) -> Self;

    /// The larger of two numbers in each lane, both results of [`abs`](Scalar::abs); NaN if one of them is NaN.
    fn larger_or_nan(self, other: Self) -> Self;

    /// The number of one lane, by its number from 0, in all lanes.
    fn broadcast(self, lane: usize) -> Self;

    /// The largest number; any lane if one of them is NaN.
    fn largest(self) -> f64;

    /// Whether any number is above `bound`; false for NaN.
    fn any_above(self, bound: f64) -> bool;

    /// Whether all numbers are below `bound`; false for NaN.
    fn all_below(self, bound: f64) -> bool;

    /// Whether any number is NaN.
    fn any_nan(self) -> bool;

    /// Selects in each lane the number of `yes` if this number is below `bound`, and otherwise, also for NaN, that of `no`.
    fn if_below(self, bound: Self, yes: Self, no: Self) -> Self;

    /// The lanes in which the first number is at most the second, as bits; not those with NaN.
    fn at_most(self, other: Self) -> u32;

    /// The lanes in which the first number is below the second, as bits; not those with NaN.
    fn below(self, other: Self) -> u32;

    /// The numbers of `yes` in the lanes whose bits are set, and those of `no` in the others.
    #[cfg_attr(not(debug_assertions), inline(always))]
    fn select(lanes: u32, yes: Self, no: Self) -> Self {
        let (yes, no) = (yes.to_array(), no.to_array());
        Self::from_fn(|lane| {
            let mask = u64::from(lanes >> lane & 1).wrapping_neg();
            let (yes, no) = (yes.as_ref()[lane].to_bits(), no.as_ref()[lane].to_bits());
            f64::from_bits(yes & mask | no & !mask)
        })
    }
}

/// The lanes of one group, from a list over the stages.
#[cfg_attr(not(debug_assertions), inline(always))]
pub(crate) fn lanes<L: Lanes>(list: &[f64], group: usize) -> L {
    let list = &list[group * L::WIDTH..(group + 1) * L::WIDTH];
    L::from_fn(|lane| list[lane])
}

/// The double of a stage, from the lanes of its group.
#[cfg_attr(not(debug_assertions), inline(always))]
pub(crate) fn lane_of<L: Lanes>(group: L, stage: usize) -> f64 {
    group.get(stage % L::WIDTH)
}

/// The number of one lane in all lanes. Two lanes are exchanged between registers. Otherwise the compiler reads the second lane from memory
/// that was just written in larger pieces, and the processor waits for these.
trait Broadcast {
    fn broadcast(self, lane: usize) -> Self;
}

impl Broadcast for wide::f64x2 {
    #[cfg_attr(not(debug_assertions), inline(always))]
    fn broadcast(self, lane: usize) -> Self {
        let [first, second] = Self::transpose([self; 2]);
        if lane == 0 { first } else { second }
    }
}

macro_rules! broadcast {
    ($($name:ty)*) => {
        $(
            impl Broadcast for $name {
                #[cfg_attr(not(debug_assertions), inline(always))]
                fn broadcast(self, lane: usize) -> Self {
                    Self::splat(self.to_array()[lane])
                }
            }
        )*
    };
}

broadcast! { wide::f64x4 wide::f64x8 }
#[cfg(target_arch = "x86_64")]
broadcast! { registers::f64x4 registers::f64x8 registers::eight_doubles }

/// The largest of several numbers, or any of them if one is NaN. The two halves are compared, because narrower registers suffice for these.
trait Largest {
    fn largest(self) -> f64;
}

impl Largest for [f64; 8] {
    #[cfg_attr(not(debug_assertions), inline(always))]
    fn largest(self) -> f64 {
        let lower = wide::f64x4::new(array(0.0, |lane| self[lane]));
        let upper = wide::f64x4::new(array(0.0, |lane| self[lane + 4]));
        lower.fast_max(upper).to_array().largest()
    }
}

impl Largest for [f64; 4] {
    #[cfg_attr(not(debug_assertions), inline(always))]
    fn largest(self) -> f64 {
        let [a, b, c, d] = self;
        let (lower, upper) = (wide::f64x2::new([a, b]), wide::f64x2::new([c, d]));
        lower.fast_max(upper).to_array().largest()
    }
}

impl Largest for [f64; 2] {
    #[cfg_attr(not(debug_assertions), inline(always))]
    fn largest(self) -> f64 {
        let [a, b] = self;
        if a > b { a } else { b }
    }
}

/// The arithmetic of lanes, from their `map` and `zip`.
macro_rules! operators {
    ($name:ident) => {
        $crate::number::lanes::operators! { $name,
            Add add AddAssign add_assign, Sub sub SubAssign sub_assign,
            Mul mul MulAssign mul_assign, Div div DivAssign div_assign
        }

        impl core::ops::Neg for $name {
            type Output = Self;
            #[cfg_attr(not(debug_assertions), inline(always))]
            fn neg(self) -> Self {
                self.map(core::ops::Neg::neg)
            }
        }

        impl num_traits::Zero for $name {
            #[cfg_attr(not(debug_assertions), inline(always))]
            fn zero() -> Self {
                Self::from_f64(0.0)
            }

            fn is_zero(&self) -> bool {
                *self == Self::zero()
            }
        }

        impl num_traits::One for $name {
            #[cfg_attr(not(debug_assertions), inline(always))]
            fn one() -> Self {
                Self::from_f64(1.0)
            }
        }
    };
    ($name:ident, $($operator:ident $function:ident $assign:ident $assigning:ident),*) => {
        $(
            impl core::ops::$operator for $name {
                type Output = Self;
                #[cfg_attr(not(debug_assertions), inline(always))]
                fn $function(self, other: Self) -> Self {
                    self.zip(other, core::ops::$operator::$function)
                }
            }

            impl core::ops::$assign for $name {
                #[cfg_attr(not(debug_assertions), inline(always))]
                fn $assigning(&mut self, other: Self) {
                    *self = core::ops::$operator::$function(*self, other);
                }
            }
        )*
    };
}
pub(super) use operators;

/// Panic message: lanes of registers that were not found.
const NOT_FOUND: &str = "registers are found before they are used";

macro_rules! lane_by_lane {
    ($($function:ident)*) => {
        $(
            #[inline]
            fn $function(self) -> Self {
                let lanes = self.to_array();
                Self::from_fn(|lane| Scalar::$function(lanes[lane]))
            }
        )*
    };
}

macro_rules! lanes {
    ($name:ident, $inner:ty, $width:literal, $text:literal $(, $registers:ident)?) => {
        #[doc = $text]
        #[derive(Clone, Copy, Debug, PartialEq)]
        pub struct $name(pub(crate) $inner);

        operators!($name);

        impl Scalar for $name {
            const EPSILON: f64 = f64::EPSILON;

            fn as_words(&mut self, visit: &mut Visit<'_>) {
                let mut lanes = self.to_array();
                words!(visit: lanes);
                *self = Self::from_array(lanes);
            }

            #[cfg_attr(not(debug_assertions), inline(always))]
            fn from_f64(value: f64) -> Self {
                Self(<$inner>::splat(value))
            }

            #[cfg_attr(not(debug_assertions), inline(always))]
            fn from_lanes(numbers: &[f64; MAX_LANES]) -> Self {
                Self::from_fn(|lane| numbers[lane])
            }

            #[inline]
            fn magnitude(self) -> f64 {
                let [first, rest @ ..] = self.to_array().map(f64::abs);
                rest.into_iter().fold(first, larger_or_nan)
            }

            #[cfg_attr(not(debug_assertions), inline(always))]
            fn fused(self, factor: Self, term: Self) -> Self {
                if !cfg!(feature = "fma") {
                    self * factor + term
                } else if cfg!(target_feature = "fma") {
                    Self(self.0.mul_add(factor.0, term.0))
                } else {
                    // Without the instruction, `mul_add` of `wide` rounds twice.
                    let (x, y, z) = (self.to_array(), factor.to_array(), term.to_array());
                    Self::from_fn(|lane| x[lane].fused(y[lane], z[lane]))
                }
            }

            $(
                const FOUND: bool = true;

                #[cfg_attr(not(debug_assertions), inline(always))]
                fn in_registers<W: Work>(work: W) -> W::Output {
                    match $registers::detect() {
                        Some(registers) => registers.run(work),
                        None => unreachable!("{}", NOT_FOUND),
                    }
                }
            )?

            #[cfg_attr(not(debug_assertions), inline(always))]
            fn sqrt(self) -> Self {
                Self(self.0.sqrt())
            }

            #[cfg_attr(not(debug_assertions), inline(always))]
            fn recip(self) -> Self {
                Self::from_f64(1.0) / self
            }

            #[cfg_attr(not(debug_assertions), inline(always))]
            fn abs(self) -> Self {
                Self(self.0.abs())
            }

            #[inline]
            fn sign(self) -> Self {
                let lanes = self.to_array();
                Self::from_fn(|lane| lanes[lane].sign())
            }

            #[cfg_attr(not(debug_assertions), inline(always))]
            fn or_zero(self, base: Self) -> Self {
                let (lanes, base) = (self.to_array(), base.to_array());
                Self::from_fn(|lane| lanes[lane].or_zero(base[lane]))
            }

            elementary! { exp -> Self, ln -> Self, sin -> Self, cos -> Self, sin_cos -> (Self, Self) }

            lane_by_lane! { tan asin acos atan sinh cosh tanh }

            #[inline]
            fn atan2(self, x: Self) -> Self {
                let (y, x) = (self.to_array(), x.to_array());
                Self::from_fn(|lane| Scalar::atan2(y[lane], x[lane]))
            }
        }

        impl $name {
            #[cfg_attr(not(debug_assertions), inline(always))]
            fn map(self, function: impl Fn($inner) -> $inner) -> Self {
                Self(function(self.0))
            }

            #[cfg_attr(not(debug_assertions), inline(always))]
            fn zip(self, other: Self, function: impl Fn($inner, $inner) -> $inner) -> Self {
                Self(function(self.0, other.0))
            }

            /// [`larger_or_nan`](Lanes::larger_or_nan) by bits: the bits of non-negative numbers have the order of the numbers, and NaN is
            /// above them. All widths use eight lanes: the maximum is then one instruction, which the compiler narrows.
            #[cfg_attr(not(debug_assertions), inline(always))]
            fn larger_by_bits(self, other: Self) -> Self {
                let bits = |numbers: Self| {
                    let lanes = numbers.to_array();
                    let bits = |lane: usize| lanes.get(lane).map_or(0, |x| x.to_bits().cast_signed());
                    wide::i64x8::new(array(0, bits))
                };
                let larger = bits(self).max(bits(other)).to_array();
                Self::from_fn(|lane| f64::from_bits(larger[lane].cast_unsigned()))
            }

            /// [`larger_or_nan`](Lanes::larger_or_nan) by sums.
            #[cfg_attr(not(debug_assertions), inline(always))]
            fn larger_by_sums(self, other: Self) -> Self {
                Self(self.0.fast_max(other.0) | (self.0 + other.0).is_nan())
            }
        }

        impl Lanes for $name {
            type Array = [f64; $width];

            const WIDTH: usize = $width;

            #[cfg_attr(not(debug_assertions), inline(always))]
            fn from_fn(lane: impl FnMut(usize) -> f64) -> Self {
                Self(<$inner>::new(array(0.0, lane)))
            }

            #[cfg_attr(not(debug_assertions), inline(always))]
            fn from_array(doubles: [f64; $width]) -> Self {
                Self(<$inner>::new(doubles))
            }

            #[cfg_attr(not(debug_assertions), inline(always))]
            fn to_array(self) -> [f64; $width] {
                self.0.to_array()
            }

            #[cfg_attr(not(debug_assertions), inline(always))]
            fn set(&mut self, lane: usize, number: f64) {
                let lanes: &mut [f64; $width] = bytemuck::cast_mut(&mut self.0);
                if let Some(place) = lanes.get_mut(lane) {
                    *place = number;
                }
            }

            #[cfg_attr(not(debug_assertions), inline(always))]
            fn larger(self, other: Self) -> Self {
                Self(self.0.fast_max(other.0))
            }

            #[cfg_attr(not(debug_assertions), inline(always))]
            fn larger_or_nan(self, other: Self) -> Self {
                // These targets compare integers in one instruction.
                if cfg!(any(target_feature = "sse4.2", target_arch = "aarch64")) && !Self::FOUND {
                    self.larger_by_bits(other)
                } else {
                    self.larger_by_sums(other)
                }
            }

            #[cfg_attr(not(debug_assertions), inline(always))]
            fn broadcast(self, lane: usize) -> Self {
                Self(Broadcast::broadcast(self.0, lane))
            }

            #[cfg_attr(not(debug_assertions), inline(always))]
            fn largest(self) -> f64 {
                Largest::largest(self.to_array())
            }

            #[cfg_attr(not(debug_assertions), inline(always))]
            fn any_above(self, bound: f64) -> bool {
                self.0.simd_gt(<$inner>::splat(bound)).any()
            }

            #[cfg_attr(not(debug_assertions), inline(always))]
            fn all_below(self, bound: f64) -> bool {
                self.0.simd_lt(<$inner>::splat(bound)).all()
            }

            #[cfg_attr(not(debug_assertions), inline(always))]
            fn any_nan(self) -> bool {
                self.0.is_nan().any()
            }

            #[cfg_attr(not(debug_assertions), inline(always))]
            fn if_below(self, bound: Self, yes: Self, no: Self) -> Self {
                Self(self.0.simd_lt(bound.0).bitselect(yes.0, no.0))
            }

            #[cfg_attr(not(debug_assertions), inline(always))]
            fn at_most(self, other: Self) -> u32 {
                self.0.simd_le(other.0).to_bitmask()
            }

            #[cfg_attr(not(debug_assertions), inline(always))]
            fn below(self, other: Self) -> u32 {
                self.0.simd_lt(other.0).to_bitmask()
            }
        }
    };
}

lanes!(
    F64x2,
    wide::f64x2,
    2,
    "Two doubles side by side: [`Lanes`]."
);
lanes!(
    F64x4,
    wide::f64x4,
    4,
    "Four doubles side by side: [`Lanes`]."
);
lanes!(
    F64x8,
    wide::f64x8,
    8,
    "Eight doubles side by side: [`Lanes`]."
);
lanes!(
    WideF64x4,
    registers::f64x4,
    4,
    "As [`F64x4`], in a register of AVX2.",
    Avx2
);
lanes!(
    WideF64x8,
    registers::f64x8,
    8,
    "As [`F64x8`], in two registers of AVX2.",
    Avx2
);
lanes!(
    WidestF64x8,
    registers::eight_doubles,
    8,
    "As [`F64x8`], in a register of AVX-512.",
    Avx512
);

#[cfg(test)]
mod tests {
    use super::*;
    use core::marker::PhantomData;

    /// Checks all pairs of numbers, one per lane, starting from each pair.
    fn check<L: Lanes>(by_bits: fn(L, L) -> L, by_sums: fn(L, L) -> L) {
        // NaN as processors produce it, with a sign.
        let nan = core::hint::black_box(0.0) / core::hint::black_box(0.0);
        let numbers = [
            -0.0,
            f64::from_bits(1),
            1.0,
            1.5,
            f64::MAX,
            f64::INFINITY,
            nan,
        ];
        let count = numbers.len();
        for first in 0..count * count {
            let number = |lane: usize| {
                let pair = (first + lane) % (count * count);
                [numbers[pair / count], numbers[pair % count]]
            };
            let [a, b] = [0, 1].map(|side| L::from_fn(|lane| number(lane)[side]).abs());
            for found in [by_bits(a, b), by_sums(a, b), a.larger_or_nan(b)] {
                for (lane, &found) in found.to_array().as_ref().iter().enumerate() {
                    let [a, b] = number(lane).map(f64::abs);
                    let same = match a.is_nan() || b.is_nan() {
                        true => found.is_nan(),
                        false => found == a.max(b),
                    };
                    assert!(same, "{a} {b}: {found}");
                }
            }
        }
    }

    /// Compares all pairs of numbers, one per lane, and selects by the result.
    fn compare<L: Lanes>() {
        let numbers = [f64::NEG_INFINITY, -1.0, 0.0, 1.0, f64::INFINITY, f64::NAN];
        let count = numbers.len();
        for first in 0..count * count {
            let number = |side: usize, lane: usize| {
                let pair = (first + lane) % (count * count);
                numbers[[pair / count, pair % count][side]]
            };
            let [a, b] = [0, 1].map(|side| L::from_fn(|lane| number(side, lane)));
            let (at_most, below) = (a.at_most(b), a.below(b));
            let chosen = L::select(below, a, b).to_array();
            assert_eq!(at_most >> L::WIDTH | below >> L::WIDTH, 0);
            for lane in 0..L::WIDTH {
                let (a, b) = (number(0, lane), number(1, lane));
                assert_eq!(at_most >> lane & 1 == 1, a <= b, "{a} {b}");
                assert_eq!(below >> lane & 1 == 1, a < b, "{a} {b}");
                let expected = if a < b { a } else { b };
                assert_eq!(chosen.as_ref()[lane].to_bits(), expected.to_bits());
            }
        }
    }

    #[test]
    fn lanes_are_compared_one_by_one() {
        compare::<F64x2>();
        compare::<F64x4>();
        compare::<F64x8>();
        compare::<crate::number::F64x16>();
        if let Some(registers) = Avx2::detect() {
            registers.run(Comparisons::<WideF64x4>(PhantomData));
            registers.run(Comparisons::<WideF64x8>(PhantomData));
        }
        if let Some(registers) = Avx512::detect() {
            registers.run(Comparisons::<WidestF64x8>(PhantomData));
        }
    }

    struct Comparisons<L>(PhantomData<L>);

    impl<L: Lanes> Work for Comparisons<L> {
        type Output = ();

        fn run(self) {
            compare::<L>();
            check(L::larger_or_nan, L::larger_or_nan);
        }
    }

    #[test]
    fn the_larger_of_two_lanes_is_nan_if_one_is_nan() {
        check(F64x2::larger_by_bits, F64x2::larger_by_sums);
        check(F64x4::larger_by_bits, F64x4::larger_by_sums);
        check(F64x8::larger_by_bits, F64x8::larger_by_sums);
    }

    #[test]
    fn lanes_are_chosen_where_one_is_below_the_other() {
        let of = |numbers: [f64; 4]| F64x4::from_array(numbers);
        let (x, bound) = (of([1.0, 2.0, f64::NAN, 0.0]), of([2.0, 2.0, 1.0, f64::NAN]));
        let chosen = x.if_below(bound, of([1.0; 4]), of([f64::INFINITY; 4]));
        let no = f64::INFINITY;
        assert_eq!(chosen.to_array(), [1.0, no, no, no]);
    }
}
