//! Doubles for elementary functions: numbers and their bits.

use core::hint;
use core::ops::{BitAnd, BitOr, BitXor, Shl, Shr};

use bytemuck::cast;

use crate::number::registers;
use crate::number::{F64x2, F64x4, F64x8, Lanes, Scalar, WideF64x4, WideF64x8, WidestF64x8};

/// The sign of a double.
const SIGN: u64 = 1 << 63;

/// Two expressions for a function, for [`Doubles::choose`].
pub(crate) trait Branches<D>: Copy {
    fn odd(self) -> D;
    fn even(self) -> D;
}

/// One double, or several side by side.
pub(crate) trait Doubles: Scalar {
    /// The bits of each double.
    type Bits: Copy
        + BitAnd<Output = Self::Bits>
        + BitOr<Output = Self::Bits>
        + BitXor<Output = Self::Bits>
        + Shl<u32, Output = Self::Bits>
        + Shr<u32, Output = Self::Bits>;

    /// The bits.
    fn to_bits(self) -> Self::Bits;

    /// The doubles with these bits.
    fn from_bits(bits: Self::Bits) -> Self;

    /// The same bits for each double.
    fn bits(bits: u64) -> Self::Bits;

    /// The sum of integers modulo 2⁶⁴.
    fn sum(a: Self::Bits, b: Self::Bits) -> Self::Bits;

    /// Whether all doubles are below `bound`; false for NaN.
    fn all_below(self, bound: f64) -> bool;

    /// The odd branch where the last bit is one, the even branch elsewhere. A branch that is not chosen may not be computed.
    fn choose<B: Branches<Self>>(bits: Self::Bits, branches: B) -> Self;

    /// Applies `function` to one double after the other, in a function that is not inlined.
    #[cfg_attr(not(debug_assertions), inline(always))]
    fn one_by_one(self, function: impl Fn(f64) -> f64) -> Self {
        // `black_box` makes a copy. Without it the compiler may pass a pointer to the original and keep everything next to it in memory.
        hint::black_box(self).apart(function)
    }

    /// [`one_by_one`](Self::one_by_one).
    fn apart(self, function: impl Fn(f64) -> f64) -> Self;

    /// The double, with its sign changed where that bit of `other` is one.
    #[cfg_attr(not(debug_assertions), inline(always))]
    fn with_sign_of_bit(self, bit: u32, other: Self) -> Self {
        let sign = (other.to_bits() << (63 - bit)) & Self::bits(SIGN);
        Self::from_bits(self.to_bits() ^ sign)
    }
}

impl Doubles for f64 {
    type Bits = u64;

    #[cfg_attr(not(debug_assertions), inline(always))]
    fn to_bits(self) -> u64 {
        self.to_bits()
    }

    #[cfg_attr(not(debug_assertions), inline(always))]
    fn from_bits(bits: u64) -> Self {
        Self::from_bits(bits)
    }

    #[cfg_attr(not(debug_assertions), inline(always))]
    fn bits(bits: u64) -> u64 {
        bits
    }

    #[cfg_attr(not(debug_assertions), inline(always))]
    fn sum(a: u64, b: u64) -> u64 {
        a.wrapping_add(b)
    }

    #[cfg_attr(not(debug_assertions), inline(always))]
    fn all_below(self, bound: f64) -> bool {
        self < bound
    }

    #[cfg_attr(not(debug_assertions), inline(always))]
    fn choose<B: Branches<Self>>(bits: u64, branches: B) -> Self {
        if bits & 1 == 1 {
            branches.odd()
        } else {
            branches.even()
        }
    }

    #[cold]
    #[inline(never)]
    fn apart(self, function: impl Fn(f64) -> f64) -> Self {
        function(self)
    }
}

macro_rules! doubles {
    ($($name:ident $bits:ty),*) => {
        $(
            impl Doubles for $name {
                type Bits = $bits;

                #[cfg_attr(not(debug_assertions), inline(always))]
                fn to_bits(self) -> Self::Bits {
                    cast(self.0)
                }

                #[cfg_attr(not(debug_assertions), inline(always))]
                fn from_bits(bits: Self::Bits) -> Self {
                    Self(cast(bits))
                }

                #[cfg_attr(not(debug_assertions), inline(always))]
                fn bits(bits: u64) -> Self::Bits {
                    <$bits>::splat(bits)
                }

                #[cfg_attr(not(debug_assertions), inline(always))]
                fn sum(a: Self::Bits, b: Self::Bits) -> Self::Bits {
                    a + b
                }

                #[cfg_attr(not(debug_assertions), inline(always))]
                fn all_below(self, bound: f64) -> bool {
                    Lanes::all_below(self, bound)
                }

                #[cfg_attr(not(debug_assertions), inline(always))]
                fn choose<B: Branches<Self>>(bits: Self::Bits, branches: B) -> Self {
                    let one = <$bits>::splat(1);
                    Self((bits & one).simd_eq(one).select(branches.odd().0, branches.even().0))
                }

                #[cold]
                #[inline(never)]
                fn apart(self, function: impl Fn(f64) -> f64) -> Self {
                    let lanes = self.to_array();
                    Self::from_fn(|lane| function(lanes[lane]))
                }
            }
        )*
    };
}

doubles! {
    F64x2 wide::u64x2,
    F64x4 wide::u64x4,
    F64x8 wide::u64x8,
    WideF64x4 registers::u64x4,
    WideF64x8 registers::u64x8,
    WidestF64x8 registers::eight_integers
}
