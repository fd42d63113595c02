//! Registers of eight doubles: processors with AVX-512.

use core::arch::x86_64::*;
use core::ops::{Add, BitAnd, BitOr, BitXor, Div, Mul, Neg, Shl, Shr, Sub};

use bytemuck::{Pod, Zeroable, cast};

use super::Work;
use super::vectors::{instructions, operators, plain_data, vectors};
use crate::number::Scalar;
use crate::number::array::array;

/// Eight doubles. The result of a comparison has all bits set where it holds.
#[derive(Clone, Copy, Debug)]
#[repr(transparent)]
pub struct f64x8(__m512d);

/// The bits of eight doubles.
#[derive(Clone, Copy)]
#[repr(transparent)]
pub struct u64x8(__m512i);

plain_data! { f64x8 u64x8 }

instructions! { f64x8:
    plus _mm512_add_pd, minus _mm512_sub_pd, times _mm512_mul_pd, over _mm512_div_pd, or _mm512_or_pd, fast_max _mm512_max_pd
}

instructions! { u64x8:
    plus _mm512_add_epi64, and _mm512_and_si512, or _mm512_or_si512, xor _mm512_xor_si512, and_not _mm512_andnot_si512
}

/// Comparisons, whose result is a mask.
macro_rules! comparisons {
    ($name:ident: $($function:ident $instruction:expr),*) => {
        impl $name {
            $(
                #[cfg_attr(not(debug_assertions), inline(always))]
                pub(crate) fn $function(self, other: Self) -> Self {
                    // SAFETY: see the module above.
                    unsafe { cast(u64x8(_mm512_movm_epi64($instruction(self.0, other.0)))) }
                }
            )*
        }
    };
}

comparisons! { f64x8:
    simd_lt _mm512_cmp_pd_mask::<_CMP_LT_OQ>, simd_gt _mm512_cmp_pd_mask::<_CMP_GT_OQ>, simd_le _mm512_cmp_pd_mask::<_CMP_LE_OQ>,
    unordered _mm512_cmp_pd_mask::<_CMP_UNORD_Q>
}

comparisons! { u64x8: simd_eq _mm512_cmpeq_epi64_mask }

impl f64x8 {
    #[cfg_attr(not(debug_assertions), inline(always))]
    pub(crate) fn sqrt(self) -> Self {
        // SAFETY: see the module above.
        unsafe { Self(_mm512_sqrt_pd(self.0)) }
    }

    /// The signs, as bits.
    #[cfg_attr(not(debug_assertions), inline(always))]
    pub(crate) fn to_bitmask(self) -> u32 {
        // SAFETY: see the module above.
        unsafe { _mm512_movepi64_mask(cast::<_, u64x8>(self).0).into() }
    }
}

impl u64x8 {
    #[cfg_attr(not(debug_assertions), inline(always))]
    fn shifted_left(self, count: u32) -> Self {
        // SAFETY: see the module above.
        unsafe {
            Self(_mm512_sll_epi64(
                self.0,
                _mm_cvtsi32_si128(count.cast_signed()),
            ))
        }
    }

    #[cfg_attr(not(debug_assertions), inline(always))]
    fn shifted_right(self, count: u32) -> Self {
        // SAFETY: see the module above.
        unsafe {
            Self(_mm512_srl_epi64(
                self.0,
                _mm_cvtsi32_si128(count.cast_signed()),
            ))
        }
    }
}

vectors! { f64x8 u64x8 8 }

/// Shows that this processor has AVX-512: the parts F, DQ and VL.
#[derive(Clone, Copy, Debug)]
pub struct Avx512(());

impl Avx512 {
    /// `None` if the processor does not have it.
    #[cfg_attr(not(debug_assertions), inline(always))]
    pub fn detect() -> Option<Self> {
        #[cfg(feature = "std")]
        if std::arch::is_x86_feature_detected!("avx512f")
            && std::arch::is_x86_feature_detected!("avx512dq")
            && std::arch::is_x86_feature_detected!("avx512vl")
        {
            return Some(Self(()));
        }
        None
    }

    /// Runs work in a function that is compiled for AVX-512.
    #[cfg_attr(not(debug_assertions), inline(always))]
    pub(crate) fn run<W: Work>(self, work: W) -> W::Output {
        #[target_feature(enable = "avx512f,avx512dq,avx512vl")]
        fn compiled<W: Work>(work: W) -> W::Output {
            work.run()
        }
        // SAFETY: `detect` has found all of them.
        unsafe { compiled(work) }
    }
}
