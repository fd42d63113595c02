//! What the vectors of all registers have in common, with the names of the crate [`wide`].

/// Types that consist of registers.
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

/// Instructions on one register.
macro_rules! instructions {
    ($name:ident: $($function:ident $instruction:expr),*) => {
        impl $name {
            $(
                #[cfg_attr(not(debug_assertions), inline(always))]
                pub(crate) fn $function(self, other: Self) -> Self {
                    // SAFETY: see the module above.
                    unsafe { Self($instruction(self.0, other.0)) }
                }
            )*
        }
    };
}

/// Operators by functions.
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

/// The functions of doubles and of their bits that are the same for all registers.
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

            /// One by one: steps with fused products are taken in the registers of the build.
            #[cfg_attr(not(debug_assertions), inline(always))]
            pub(crate) fn mul_add(self, factor: Self, term: Self) -> Self {
                let (x, y, z) = (self.to_array(), factor.to_array(), term.to_array());
                Self::new(array(0.0, |lane| x[lane].fused(y[lane], z[lane])))
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

pub(super) use {instructions, operators, plain_data, vectors};
