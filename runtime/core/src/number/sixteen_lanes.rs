//! Sixteen doubles side by side.

#[cfg(feature = "alloc")]
use crate::number::WidestF64x8;
use crate::number::array::array;
use crate::number::lanes::operators;
use crate::number::registers::Work;
use crate::number::words::{Visit, words};
use crate::number::{F64x8, Lanes, MAX_LANES, Scalar, larger_or_nan};

// Functions of halves are called by name: a closure or a function item of more than one instruction may not be inlined.
macro_rules! by_halves {
    ($($function:ident)*) => {
        $(
            #[cfg_attr(not(debug_assertions), inline(always))]
            fn $function(self) -> Self {
                let Self([a, b]) = self;
                Self([a.$function(), b.$function()])
            }
        )*
    };
}

macro_rules! sixteen {
    ($name:ident, $half:ident, $text:literal) => {
        #[doc = $text]
        ///
        /// An operation takes several cycles until its result can be used. With two groups in wide registers the processor works on one of
        /// them while it waits for the other.
        #[derive(Clone, Copy, Debug, PartialEq)]
        pub struct $name([$half; 2]);

        impl $name {
            #[cfg_attr(not(debug_assertions), inline(always))]
            fn map(self, function: impl Fn($half) -> $half) -> Self {
                let Self([a, b]) = self;
                Self([function(a), function(b)])
            }

            #[cfg_attr(not(debug_assertions), inline(always))]
            fn zip(self, other: Self, function: impl Fn($half, $half) -> $half) -> Self {
                let (Self([a, b]), Self([c, d])) = (self, other);
                Self([function(a, c), function(b, d)])
            }
        }

        operators!($name);

        impl Scalar for $name {
            const EPSILON: f64 = f64::EPSILON;
            const FOUND: bool = $half::FOUND;

            #[cfg_attr(not(debug_assertions), inline(always))]
            fn from_lanes(numbers: &[f64; MAX_LANES]) -> Self {
                Self::from_fn(|lane| numbers[lane])
            }

            fn as_words(&mut self, visit: &mut Visit<'_>) {
                let mut lanes = self.to_array();
                words!(visit: lanes);
                *self = Self::from_array(lanes);
            }

            #[cfg_attr(not(debug_assertions), inline(always))]
            fn from_f64(value: f64) -> Self {
                Self([$half::from_f64(value); 2])
            }

            #[inline]
            fn magnitude(self) -> f64 {
                let Self([a, b]) = self;
                larger_or_nan(a.magnitude(), b.magnitude())
            }

            #[cfg_attr(not(debug_assertions), inline(always))]
            fn in_registers<W: Work>(work: W) -> W::Output {
                $half::in_registers(work)
            }

            #[cfg_attr(not(debug_assertions), inline(always))]
            fn fused(self, factor: Self, term: Self) -> Self {
                let (Self([a, b]), Self([c, d]), Self([e, f])) = (self, factor, term);
                Self([a.fused(c, e), b.fused(d, f)])
            }

            by_halves! { sqrt recip abs sign exp ln sin cos tan asin acos atan sinh cosh tanh }

            #[cfg_attr(not(debug_assertions), inline(always))]
            fn or_zero(self, base: Self) -> Self {
                let (Self([a, b]), Self([c, d])) = (self, base);
                Self([a.or_zero(c), b.or_zero(d)])
            }

            #[cfg_attr(not(debug_assertions), inline(always))]
            fn atan2(self, x: Self) -> Self {
                let (Self([a, b]), Self([c, d])) = (self, x);
                Self([a.atan2(c), b.atan2(d)])
            }

            #[cfg_attr(not(debug_assertions), inline(always))]
            fn sin_cos(self) -> (Self, Self) {
                let Self([a, b]) = self;
                let ((a, c), (b, d)) = (a.sin_cos(), b.sin_cos());
                (Self([a, b]), Self([c, d]))
            }
        }

        impl Lanes for $name {
            type Array = [f64; 16];

            const WIDTH: usize = 16;

            #[cfg_attr(not(debug_assertions), inline(always))]
            fn from_fn(mut lane: impl FnMut(usize) -> f64) -> Self {
                let first = $half::from_fn(&mut lane);
                Self([first, $half::from_fn(|k| lane(8 + k))])
            }

            #[cfg_attr(not(debug_assertions), inline(always))]
            fn from_array(doubles: [f64; 16]) -> Self {
                Self::from_fn(|lane| doubles[lane])
            }

            #[cfg_attr(not(debug_assertions), inline(always))]
            fn to_array(self) -> [f64; 16] {
                let Self([a, b]) = self;
                let halves = [a.to_array(), b.to_array()];
                array(0.0, |lane| halves[lane / 8][lane % 8])
            }

            #[cfg_attr(not(debug_assertions), inline(always))]
            fn get(self, lane: usize) -> f64 {
                self.0[lane / 8].get(lane % 8)
            }

            #[cfg_attr(not(debug_assertions), inline(always))]
            fn set(&mut self, lane: usize, number: f64) {
                if let Some(half) = self.0.get_mut(lane / 8) {
                    half.set(lane % 8, number);
                }
            }

            #[cfg_attr(not(debug_assertions), inline(always))]
            fn larger(self, other: Self) -> Self {
                let (Self([a, b]), Self([c, d])) = (self, other);
                Self([a.larger(c), b.larger(d)])
            }

            #[cfg_attr(not(debug_assertions), inline(always))]
            fn larger_or_nan(self, other: Self) -> Self {
                let (Self([a, b]), Self([c, d])) = (self, other);
                Self([a.larger_or_nan(c), b.larger_or_nan(d)])
            }

            #[cfg_attr(not(debug_assertions), inline(always))]
            fn broadcast(self, lane: usize) -> Self {
                let half = self.0[lane / 8].broadcast(lane % 8);
                Self([half; 2])
            }

            #[cfg_attr(not(debug_assertions), inline(always))]
            fn largest(self) -> f64 {
                let Self([a, b]) = self;
                let (a, b) = (a.largest(), b.largest());
                if a > b { a } else { b }
            }

            #[cfg_attr(not(debug_assertions), inline(always))]
            fn any_above(self, bound: f64) -> bool {
                let Self([a, b]) = self;
                a.any_above(bound) | b.any_above(bound)
            }

            #[cfg_attr(not(debug_assertions), inline(always))]
            fn all_below(self, bound: f64) -> bool {
                let Self([a, b]) = self;
                a.all_below(bound) & b.all_below(bound)
            }

            #[cfg_attr(not(debug_assertions), inline(always))]
            fn any_nan(self) -> bool {
                let Self([a, b]) = self;
                a.any_nan() | b.any_nan()
            }

            #[cfg_attr(not(debug_assertions), inline(always))]
            fn if_below(self, bound: Self, yes: Self, no: Self) -> Self {
                let (Self([a, b]), Self([c, d])) = (self, bound);
                let (Self([e, f]), Self([g, h])) = (yes, no);
                Self([a.if_below(c, e, g), b.if_below(d, f, h)])
            }

            #[cfg_attr(not(debug_assertions), inline(always))]
            fn at_most(self, other: Self) -> u32 {
                let (Self([a, b]), Self([c, d])) = (self, other);
                a.at_most(c) | b.at_most(d) << $half::WIDTH
            }

            #[cfg_attr(not(debug_assertions), inline(always))]
            fn below(self, other: Self) -> u32 {
                let (Self([a, b]), Self([c, d])) = (self, other);
                a.below(c) | b.below(d) << $half::WIDTH
            }
        }
    };
}

sixteen!(
    F64x16,
    F64x8,
    "Sixteen doubles side by side, [`Lanes`], as two groups of eight."
);
#[cfg(feature = "alloc")]
sixteen!(
    WidestF64x16,
    WidestF64x8,
    "As [`F64x16`], in two registers of AVX-512."
);

#[cfg(not(target_feature = "avx512f"))]
use F64x8 as Fastest;
#[cfg(target_feature = "avx512f")]
use F64x16 as Fastest;

/// The lanes of the trajectories of an ensemble in the registers of the build: sixteen if the target has AVX-512, otherwise eight. These
/// are several registers, so that their chains of dependent operations overlap.
pub type DefaultLanes = Fastest;
