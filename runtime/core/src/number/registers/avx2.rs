//! Registers of four doubles: processors with AVX2.

use core::arch::x86_64::*;
use core::ops::{Add, BitAnd, BitOr, BitXor, Div, Mul, Neg, Shl, Shr, Sub};

use bytemuck::{Pod, Zeroable, cast};

use super::Work;
use super::vectors::{instructions, operators, plain_data, vectors};
use crate::number::Scalar;
use crate::number::array::array;

/// Four doubles. The result of a comparison has all bits set where it holds.
#[derive(Clone, Copy, Debug)]
#[repr(transparent)]
pub struct f64x4(__m256d);

/// The bits of four doubles.
#[derive(Clone, Copy)]
#[repr(transparent)]
pub struct u64x4(__m256i);

/// Eight doubles in two registers.
#[derive(Clone, Copy, Debug)]
#[repr(C)]
pub struct f64x8(f64x4, f64x4);

/// The bits of eight doubles.
#[derive(Clone, Copy)]
#[repr(C)]
pub struct u64x8(u64x4, u64x4);

plain_data! { f64x4 u64x4 f64x8 u64x8 }

instructions! { f64x4:
    plus _mm256_add_pd, minus _mm256_sub_pd, times _mm256_mul_pd, over _mm256_div_pd, or _mm256_or_pd, fast_max _mm256_max_pd,
    simd_lt _mm256_cmp_pd::<_CMP_LT_OQ>, simd_gt _mm256_cmp_pd::<_CMP_GT_OQ>, simd_le _mm256_cmp_pd::<_CMP_LE_OQ>,
    unordered _mm256_cmp_pd::<_CMP_UNORD_Q>
}

instructions! { u64x4:
    plus _mm256_add_epi64, and _mm256_and_si256, or _mm256_or_si256, xor _mm256_xor_si256, and_not _mm256_andnot_si256,
    simd_eq _mm256_cmpeq_epi64
}

impl f64x4 {
    #[cfg_attr(not(debug_assertions), inline(always))]
    pub(crate) fn sqrt(self) -> Self {
        // SAFETY: see the module above.
        unsafe { Self(_mm256_sqrt_pd(self.0)) }
    }

    /// The signs, as bits.
    #[cfg_attr(not(debug_assertions), inline(always))]
    pub(crate) fn to_bitmask(self) -> u32 {
        // SAFETY: see the module above.
        unsafe { _mm256_movemask_pd(self.0).cast_unsigned() }
    }
}

impl u64x4 {
    #[cfg_attr(not(debug_assertions), inline(always))]
    fn shifted_left(self, count: u32) -> Self {
        // SAFETY: see the module above.
        unsafe {
            Self(_mm256_sll_epi64(
                self.0,
                _mm_cvtsi32_si128(count.cast_signed()),
            ))
        }
    }

    #[cfg_attr(not(debug_assertions), inline(always))]
    fn shifted_right(self, count: u32) -> Self {
        // SAFETY: see the module above.
        unsafe {
            Self(_mm256_srl_epi64(
                self.0,
                _mm_cvtsi32_si128(count.cast_signed()),
            ))
        }
    }
}

/// Functions of both halves.
macro_rules! by_halves {
    ($name:ident: $($function:ident)*) => {
        impl $name {
            $(
                #[cfg_attr(not(debug_assertions), inline(always))]
                pub(crate) fn $function(self, other: Self) -> Self {
                    Self(self.0.$function(other.0), self.1.$function(other.1))
                }
            )*
        }
    };
}

by_halves! { f64x8: plus minus times over or fast_max simd_lt simd_gt simd_le unordered }
by_halves! { u64x8: plus and or xor and_not simd_eq }

impl f64x8 {
    #[cfg_attr(not(debug_assertions), inline(always))]
    pub(crate) fn sqrt(self) -> Self {
        Self(self.0.sqrt(), self.1.sqrt())
    }

    /// The signs, as bits.
    #[cfg_attr(not(debug_assertions), inline(always))]
    pub(crate) fn to_bitmask(self) -> u32 {
        self.1.to_bitmask() << 4 | self.0.to_bitmask()
    }
}

impl u64x8 {
    #[cfg_attr(not(debug_assertions), inline(always))]
    fn shifted_left(self, count: u32) -> Self {
        Self(self.0.shifted_left(count), self.1.shifted_left(count))
    }

    #[cfg_attr(not(debug_assertions), inline(always))]
    fn shifted_right(self, count: u32) -> Self {
        Self(self.0.shifted_right(count), self.1.shifted_right(count))
    }
}

vectors! { f64x4 u64x4 4 }
vectors! { f64x8 u64x8 8 }

/// Shows that this processor has AVX2.
#[derive(Clone, Copy, Debug)]
pub struct Avx2(());

impl Avx2 {
    /// `None` if the processor does not have it.
    #[cfg_attr(not(debug_assertions), inline(always))]
    pub fn detect() -> Option<Self> {
        #[cfg(feature = "std")]
        if std::arch::is_x86_feature_detected!("avx2") {
            return Some(Self(()));
        }
        None
    }

    /// Runs work in a function that is compiled for AVX2.
    #[cfg_attr(not(debug_assertions), inline(always))]
    pub(crate) fn run<W: Work>(self, work: W) -> W::Output {
        #[target_feature(enable = "avx2")]
        fn compiled<W: Work>(work: W) -> W::Output {
            work.run()
        }
        // SAFETY: `detect` has found AVX2.
        unsafe { compiled(work) }
    }
}
