//! Registers of the processor that are wider than those for which the program is compiled.
//!
//! A default build for x86-64 has registers of two doubles. Most processors have AVX2, with registers of four. A program finds that out
//! when it runs, and takes the steps of methods with coupled stages there.

#[cfg(target_arch = "x86_64")]
mod avx2;
#[cfg(not(target_arch = "x86_64"))]
mod none;

#[cfg(target_arch = "x86_64")]
pub use self::avx2::WideRegisters;
#[cfg(target_arch = "x86_64")]
pub(crate) use self::avx2::{f64x4, f64x8, u64x4, u64x8};
#[cfg(not(target_arch = "x86_64"))]
pub use self::none::WideRegisters;
#[cfg(not(target_arch = "x86_64"))]
pub(crate) use wide::{f64x4, f64x8, u64x4, u64x8};

/// Work to be compiled for wide registers. Its function has to be inlined, and so has everything that it calls: closures too, so it calls
/// none that computes with lanes.
pub(crate) trait Work {
    type Output;

    fn run(self) -> Self::Output;
}

/// Whether a program of this build may have to find wide registers when it runs.
pub(crate) const UNKNOWN: bool = cfg!(all(
    target_arch = "x86_64",
    feature = "std",
    // In such a build the lanes are in these registers anyway.
    not(target_feature = "avx2"),
    // Without the instruction, which comes with others, sums would be slower there.
    not(feature = "fma"),
));
