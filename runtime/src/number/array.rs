//! Arrays, made in loops.
//!
//! [`core::array::from_fn`], `map` of arrays, `zip` and [`core::mem::swap`] go through functions of the standard library that
//! are not marked for inlining. Until the optimiser looks across codegen units, which comes late, they are calls, and what a
//! call may point to stays in memory: for (q² + 1)(p² + 1)/2 and two stages that took a quarter of the time of a step. So sweeps,
//! sums, kicks and drifts have loops over indices instead.

/// `[make(0), make(1), …]`, of which every entry is `blank` first.
#[inline(always)]
pub(crate) fn array<T: Copy, const N: usize>(blank: T, mut make: impl FnMut(usize) -> T) -> [T; N] {
    let mut all = [blank; N];
    for (index, entry) in all.iter_mut().enumerate() {
        *entry = make(index);
    }
    all
}
