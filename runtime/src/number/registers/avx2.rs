//! Registers of four doubles, for processors with AVX2. The types have the functions of those of the crate [`wide`] that lanes need.
//!
//! # Safety
//!
//! Instructions of AVX2 are sound only on a processor that has them. Vectors exist only there: code outside this crate cannot name their
//! types, and this crate computes with them only in work that [`WideRegisters::run`] runs, after [`WideRegisters::detect`] has found AVX2.
//!
//! They are fast only where they are inlined into a function that is compiled for AVX2, as in that work. Elsewhere every operation is a call.

#![allow(unsafe_code, non_camel_case_types)]

use core::arch::x86_64::*;
use core::ops::{Add, BitAnd, BitOr, BitXor, Div, Mul, Neg, Shl, Shr, Sub};

use bytemuck::{Pod, Zeroable, cast};

use super::Work;

/// Four doubles. The result of a comparison has all bits set where it holds.
#[derive(Clone, Copy, Debug)]
#[repr(transparent)]
pub struct f64x4(__m256d);

/// The bits of four doubles.
#[derive(Clone, Copy)]
#[repr(transparent)]
pub struct u64x4(__m256i);

/// Eight doubles.
#[derive(Clone, Copy, Debug)]
#[repr(C)]
pub struct f64x8(f64x4, f64x4);

/// The bits of eight doubles.
#[derive(Clone, Copy)]
#[repr(C)]
pub struct u64x8(u64x4, u64x4);

macro_rules! plain_data {
    ($($name:ident)*) => {
        $(
            // SAFETY: it consists of registers without padding, which have these properties.
            unsafe impl Zeroable for $name {}
            // SAFETY: as above.
            unsafe impl Pod for $name {}
        )*
    };
}

plain_data! { f64x4 u64x4 f64x8 u64x8 }

/// Instructions on one register.
macro_rules! instructions {
    ($name:ident: $($function:ident $instruction:expr),*) => {
        impl $name {
            $(
                #[cfg_attr(not(debug_assertions), inline(always))]
                pub(crate) fn $function(self, other: Self) -> Self {
                    // SAFETY: see the module.
                    unsafe { Self($instruction(self.0, other.0)) }
                }
            )*
        }
    };
}

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
        // SAFETY: see the module.
        unsafe { Self(_mm256_sqrt_pd(self.0)) }
    }

    /// The signs, as bits.
    #[cfg_attr(not(debug_assertions), inline(always))]
    pub(crate) fn to_bitmask(self) -> u32 {
        // SAFETY: see the module.
        unsafe { _mm256_movemask_pd(self.0).cast_unsigned() }
    }
}

impl u64x4 {
    #[cfg_attr(not(debug_assertions), inline(always))]
    fn shifted_left(self, count: u32) -> Self {
        // SAFETY: see the module.
        unsafe {
            Self(_mm256_sll_epi64(
                self.0,
                _mm_cvtsi32_si128(count.cast_signed()),
            ))
        }
    }

    #[cfg_attr(not(debug_assertions), inline(always))]
    fn shifted_right(self, count: u32) -> Self {
        // SAFETY: see the module.
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

macro_rules! operators {
    ($name:ident $other:ty: $($operator:ident $function:ident $named:ident),*) => {
        $(
            impl $operator<$other> for $name {
                type Output = Self;

                #[cfg_attr(not(debug_assertions), inline(always))]
                fn $function(self, other: $other) -> Self {
                    self.$named(other)
                }
            }
        )*
    };
}

macro_rules! vectors {
    ($doubles:ident $bits:ident $width:literal) => {
        operators! { $doubles Self: Add add plus, Sub sub minus, Mul mul times, Div div over, BitOr bitor or }
        operators! { $bits Self: Add add plus, BitAnd bitand and, BitOr bitor or, BitXor bitxor xor }
        operators! { $bits u32: Shl shl shifted_left, Shr shr shifted_right }

        impl Neg for $doubles {
            type Output = Self;

            #[cfg_attr(not(debug_assertions), inline(always))]
            fn neg(self) -> Self {
                cast(cast::<_, $bits>(self) ^ $bits::splat(1 << 63))
            }
        }

        impl $doubles {
            #[cfg_attr(not(debug_assertions), inline(always))]
            pub(crate) fn new(doubles: [f64; $width]) -> Self {
                cast(doubles)
            }

            #[cfg_attr(not(debug_assertions), inline(always))]
            pub(crate) fn to_array(self) -> [f64; $width] {
                cast(self)
            }

            #[cfg_attr(not(debug_assertions), inline(always))]
            pub(crate) fn splat(double: f64) -> Self {
                Self::new([double; $width])
            }

            #[cfg_attr(not(debug_assertions), inline(always))]
            pub(crate) fn is_nan(self) -> Self {
                self.unordered(self)
            }

            #[cfg_attr(not(debug_assertions), inline(always))]
            pub(crate) fn abs(self) -> Self {
                cast(cast::<_, $bits>(self) & $bits::splat(!(1 << 63)))
            }

            /// Never used: lanes are not fused in a program for any x86-64 processor.
            #[cfg_attr(not(debug_assertions), inline(always))]
            pub(crate) fn mul_add(self, factor: Self, term: Self) -> Self {
                self * factor + term
            }

            /// `yes` where this comparison holds, `no` elsewhere.
            #[cfg_attr(not(debug_assertions), inline(always))]
            pub(crate) fn bitselect(self, yes: Self, no: Self) -> Self {
                cast::<_, $bits>(self).select(yes, no)
            }

            #[cfg_attr(not(debug_assertions), inline(always))]
            pub(crate) fn any(self) -> bool {
                self.to_bitmask() != 0
            }

            #[cfg_attr(not(debug_assertions), inline(always))]
            pub(crate) fn all(self) -> bool {
                self.to_bitmask() == (1 << $width) - 1
            }
        }

        impl PartialEq for $doubles {
            fn eq(&self, other: &Self) -> bool {
                self.to_array() == other.to_array()
            }
        }

        impl $bits {
            #[cfg_attr(not(debug_assertions), inline(always))]
            pub(crate) fn splat(bits: u64) -> Self {
                cast([bits; $width])
            }

            /// `yes` where all bits are set, `no` where none is.
            #[cfg_attr(not(debug_assertions), inline(always))]
            pub(crate) fn select(self, yes: $doubles, no: $doubles) -> $doubles {
                cast(cast::<_, Self>(yes).and(self).or(self.and_not(cast(no))))
            }
        }
    };
}

vectors! { f64x4 u64x4 4 }
vectors! { f64x8 u64x8 8 }

/// Shows that this processor has AVX2.
#[derive(Clone, Copy, Debug)]
pub struct WideRegisters(());

impl WideRegisters {
    /// `None` if the processor does not have it, or if nobody can ask.
    #[cfg_attr(not(debug_assertions), inline(always))]
    pub(crate) fn detect() -> Option<Self> {
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
