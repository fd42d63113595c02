//! SIMD lanes.

use std::array;
use std::ops::{Add, AddAssign, Div, Mul, Neg, Sub};

use wide::{f64x2, f64x4, f64x8};

/// One number, or as many as a register contains.
pub trait Lanes:
    Copy
    + Add<Output = Self>
    + AddAssign
    + Sub<Output = Self>
    + Mul<Output = Self>
    + Div<Output = Self>
    + Neg<Output = Self>
{
    /// Number of lanes.
    const COUNT: usize;
    /// The type with half as many lanes.
    type Half: Lanes;

    /// The number `value(i)` in lane i.
    fn from_fn(value: impl FnMut(usize) -> f64) -> Self;
    /// The same number in all lanes.
    fn splat(value: f64) -> Self;
    /// The number in lane `i`.
    fn lane(self, i: usize) -> f64;
    /// The lower and the upper lanes.
    fn halves(self) -> (Self::Half, Self::Half);
    /// √x.
    fn sqrt(self) -> Self;
    /// Sine and cosine of `wide`, or of the standard library for a single double. The library has its own
    /// implementation.
    fn sin_cos(self) -> (Self, Self);
    /// Sine, like [`sin_cos`](Self::sin_cos).
    fn sin(self) -> Self;
    /// `self * factor + term`, rounded once with the feature `fma` and twice elsewhere.
    fn fused(self, factor: Self, term: Self) -> Self;
    /// |x|.
    fn abs(self) -> Self;
    /// The maximum in each lane.
    fn max(self, other: Self) -> Self;
    /// The minimum in each lane.
    fn min(self, other: Self) -> Self;
    /// Whether any lane exceeds that of `bound`.
    fn exceeds(self, bound: Self) -> bool;
    /// Whether any lane is strictly between those of `low` and `high`.
    fn between(self, low: Self, high: Self) -> bool;

    /// Sum over the lanes.
    #[inline(always)]
    fn sum(self) -> f64 {
        if Self::COUNT == 1 {
            return self.lane(0);
        }
        let (a, b) = self.halves();
        (a + b).sum()
    }

    /// Sum over the lanes of `self + low`, with its rounding error.
    #[inline(always)]
    fn double_sum(self, low: Self) -> (f64, f64) {
        if Self::COUNT == 1 {
            return (self.lane(0), low.lane(0));
        }
        let ((a, b), (a_low, b_low)) = (self.halves(), low.halves());
        let (sum, rest) = two_sum(a, b);
        sum.double_sum(rest + (a_low + b_low))
    }
}

/// The rounded sum and its rounding error.
#[inline(always)]
pub fn two_sum<L: Lanes>(a: L, b: L) -> (L, L) {
    let sum = a + b;
    let part = sum - a;
    (sum, (a - (sum - part)) + (b - part))
}

/// [`two_sum`] for `|a| ≥ |b|` or `a = 0`.
#[inline(always)]
pub fn fast_two_sum<L: Lanes>(a: L, b: L) -> (L, L) {
    let sum = a + b;
    (sum, b - (sum - a))
}

impl Lanes for f64 {
    const COUNT: usize = 1;
    type Half = Self;

    #[inline(always)]
    fn from_fn(mut value: impl FnMut(usize) -> f64) -> Self {
        value(0)
    }

    #[inline(always)]
    fn splat(value: f64) -> Self {
        value
    }

    #[inline(always)]
    fn lane(self, _: usize) -> f64 {
        self
    }

    #[inline(always)]
    fn halves(self) -> (Self, Self) {
        (self, 0.0)
    }

    #[inline(always)]
    fn sqrt(self) -> Self {
        self.sqrt()
    }

    #[inline(always)]
    fn sin_cos(self) -> (Self, Self) {
        self.sin_cos()
    }

    #[inline(always)]
    fn sin(self) -> Self {
        self.sin()
    }

    #[inline(always)]
    fn fused(self, factor: Self, term: Self) -> Self {
        if cfg!(feature = "fma") {
            self.mul_add(factor, term)
        } else {
            self * factor + term
        }
    }

    #[inline(always)]
    fn abs(self) -> Self {
        self.abs()
    }

    #[inline(always)]
    fn max(self, other: Self) -> Self {
        self.max(other)
    }

    #[inline(always)]
    fn min(self, other: Self) -> Self {
        self.min(other)
    }

    #[inline(always)]
    fn exceeds(self, bound: Self) -> bool {
        self > bound
    }

    #[inline(always)]
    fn between(self, low: Self, high: Self) -> bool {
        self > low && self < high
    }
}

macro_rules! lanes {
    ($lanes:ident, $count:literal, $half:ty) => {
        impl Lanes for $lanes {
            const COUNT: usize = $count;
            type Half = $half;

            #[inline(always)]
            fn from_fn(value: impl FnMut(usize) -> f64) -> Self {
                Self::new(array::from_fn(value))
            }

            #[inline(always)]
            fn splat(value: f64) -> Self {
                Self::splat(value)
            }

            #[inline(always)]
            fn lane(self, i: usize) -> f64 {
                self.to_array()[i]
            }

            #[inline(always)]
            fn halves(self) -> ($half, $half) {
                let lanes = self.to_array();
                (
                    Lanes::from_fn(|i| lanes[i]),
                    Lanes::from_fn(|i| lanes[$count / 2 + i]),
                )
            }

            #[inline(always)]
            fn sqrt(self) -> Self {
                self.sqrt()
            }

            #[inline(always)]
            fn sin_cos(self) -> (Self, Self) {
                self.sin_cos()
            }

            #[inline(always)]
            fn sin(self) -> Self {
                self.sin()
            }

            #[inline(always)]
            fn fused(self, factor: Self, term: Self) -> Self {
                if cfg!(feature = "fma") {
                    self.mul_add(factor, term)
                } else {
                    self * factor + term
                }
            }

            #[inline(always)]
            fn abs(self) -> Self {
                self.abs()
            }

            #[inline(always)]
            fn max(self, other: Self) -> Self {
                self.fast_max(other)
            }

            #[inline(always)]
            fn min(self, other: Self) -> Self {
                self.fast_min(other)
            }

            #[inline(always)]
            fn exceeds(self, bound: Self) -> bool {
                self.simd_gt(bound).any()
            }

            #[inline(always)]
            fn between(self, low: Self, high: Self) -> bool {
                (self.simd_gt(low) & high.simd_gt(self)).any()
            }
        }
    };
}

lanes!(f64x2, 2, f64);
lanes!(f64x4, 4, f64x2);
lanes!(f64x8, 8, f64x4);
