//! Arrays filled by loops.
//!
//! [`core::array::from_fn`], `map` of arrays and `zip` call functions of the standard library that are not marked for
//! inlining. Until the optimiser works across codegen units, late in the compilation, they stay calls. Memory that a call may point to is
//! not kept in registers: for (q² + 1)(p² + 1)/2 and two stages this took a quarter of the time of a step. Sweeps, sums, kicks and drifts
//! therefore have loops over indices instead.

/// Returns `[make(0), make(1), …]`; each entry is `blank` until it is made.
#[cfg_attr(not(debug_assertions), inline(always))]
pub(crate) fn array<T: Copy, const N: usize>(blank: T, mut make: impl FnMut(usize) -> T) -> [T; N] {
    let mut all = [blank; N];
    for (index, entry) in all.iter_mut().enumerate() {
        *entry = make(index);
    }
    all
}
