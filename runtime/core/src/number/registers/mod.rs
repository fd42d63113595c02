//! Registers of the processor that are wider than those for which the program is compiled.
//!
//! A default build for x86-64 has registers of two doubles. Most processors have AVX2 with registers of four, some AVX-512 with registers
//! of eight. A program detects them at run time.
//!
//! # Safety
//!
//! An instruction of AVX2 or AVX-512 is sound only on a processor that has it. Code for vectors runs only in [`Work`] that a token starts,
//! [`Avx2`] or [`Avx512`], or where a token is available. A token is created only after a check of the processor. Code outside this crate
//! cannot access the types. They occur in bounds of public traits, but no public item has one as an associated type, a field or an
//! argument. Such code gets them only as the scalar `T` of a function that is called there.
//!
//! # Speed
//!
//! An instruction is fast only if it is inlined into a function that is compiled for it: the function that runs the work. Elsewhere every
//! operation is a call. Storing vectors, copying them and reading single numbers need no such instruction.

#![allow(unsafe_code, non_camel_case_types)]

#[cfg(target_arch = "x86_64")]
mod avx2;
#[cfg(target_arch = "x86_64")]
mod avx512;
#[cfg(not(target_arch = "x86_64"))]
mod none;
#[cfg(target_arch = "x86_64")]
mod vectors;

#[cfg(target_arch = "x86_64")]
pub use self::avx2::Avx2;
#[cfg(target_arch = "x86_64")]
pub(crate) use self::avx2::{f64x4, f64x8, u64x4, u64x8};
#[cfg(target_arch = "x86_64")]
pub use self::avx512::Avx512;
#[cfg(target_arch = "x86_64")]
pub(crate) use self::avx512::{f64x8 as eight_doubles, u64x8 as eight_integers};
#[cfg(not(target_arch = "x86_64"))]
pub use self::none::{Avx2, Avx512};
#[cfg(not(target_arch = "x86_64"))]
pub(crate) use wide::{
    f64x4, f64x8, f64x8 as eight_doubles, u64x4, u64x8, u64x8 as eight_integers,
};

#[cfg(test)]
mod tests;

use core::marker::PhantomData;

use crate::number::{F64x8, Lanes, Scalar, WideF64x8, WidestF64x8};

/// Work to be compiled for wide registers. Its function and everything that it calls have to be inlined. Closures may not be inlined, so it
/// calls none that computes with vectors.
pub trait Work {
    /// The result of the work.
    type Output;

    /// Does the work.
    fn run(self) -> Self::Output;
}

/// Whether a program of this build may have to detect wide registers at run time.
pub(crate) const UNKNOWN: bool = cfg!(all(
    target_arch = "x86_64",
    feature = "std",
    // In such a build the lanes are in these registers anyway.
    not(target_feature = "avx2"),
    // The instruction for it comes with others: without them all products and sums would be slower.
    not(feature = "fma"),
));

/// Whether long loops run in functions of their own, in the widest registers of the processor. So they also do in a build for AVX-512, where
/// the compiler otherwise joins them with the code around.
pub(crate) const APART: bool = UNKNOWN
    || cfg!(all(
        target_arch = "x86_64",
        feature = "std",
        target_feature = "avx512f",
        target_feature = "avx512dq",
        target_feature = "avx512vl",
        not(feature = "fma"),
    ));

/// The widest registers of a processor.
#[derive(Clone, Copy, Debug)]
pub enum Widest {
    /// Those for which the program is compiled.
    Build,
    /// Four doubles.
    Avx2(Avx2),
    /// Eight doubles.
    Avx512(Avx512),
}

impl Widest {
    /// Those of this processor.
    #[cfg_attr(not(debug_assertions), inline(always))]
    pub fn find() -> Self {
        if !APART {
            Self::Build
        } else if let Some(avx512) = Avx512::detect() {
            Self::Avx512(avx512)
        } else if let Some(avx2) = Avx2::detect() {
            Self::Avx2(avx2)
        } else {
            Self::Build
        }
    }
}

/// Number of components of the shortest vector of doubles for which wide registers save more time than their detection takes.
pub(crate) const LONG: usize = 32;

/// Runs work on `count` numbers of type `T` in the widest registers of the processor, if the numbers are doubles and `count` is large. Its
/// loops are plain: the compiler translates them for each kind of registers.
#[cfg_attr(not(debug_assertions), inline(always))]
pub(crate) fn in_widest<T: Scalar, W: Work>(count: usize, work: W) -> W::Output {
    // Constant conditions first: other numbers compile without this code.
    if APART && T::IS_DOUBLE && count >= LONG {
        match Widest::find() {
            Widest::Build => work.run(),
            Widest::Avx2(avx2) => avx2.run(work),
            Widest::Avx512(avx512) => avx512.run(work),
        }
    } else {
        work.run()
    }
}

/// Work on eight doubles at a time, in any lanes. As for [`Work`], everything that it calls has to be inlined.
pub trait EightLanes {
    /// The result of the work.
    type Output;

    /// Does the work.
    fn run<L: Lanes<Array = [f64; 8]>>(self) -> Self::Output;
}

/// [`EightLanes`] in lanes `L`.
struct InLanes<W, L>(W, PhantomData<L>);

impl<W: EightLanes, L: Lanes<Array = [f64; 8]>> Work for InLanes<W, L> {
    type Output = W::Output;

    #[cfg_attr(not(debug_assertions), inline(always))]
    fn run(self) -> W::Output {
        self.0.run::<L>()
    }
}

/// Runs work in the widest registers of the processor.
#[cfg_attr(not(debug_assertions), inline(always))]
pub fn in_eight_lanes<W: EightLanes>(work: W) -> W::Output {
    // A constant condition: other builds compile without code for registers that are found.
    let registers = match UNKNOWN {
        true => Widest::find(),
        false => Widest::Build,
    };
    in_eight_lanes_of(registers, work)
}

/// Runs work in these registers.
#[cfg_attr(not(debug_assertions), inline(always))]
pub fn in_eight_lanes_of<W: EightLanes>(registers: Widest, work: W) -> W::Output {
    match registers {
        Widest::Build => work.run::<F64x8>(),
        Widest::Avx2(avx2) => avx2.run(InLanes::<W, WideF64x8>(work, PhantomData)),
        Widest::Avx512(avx512) => avx512.run(InLanes::<W, WidestF64x8>(work, PhantomData)),
    }
}
