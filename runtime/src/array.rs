//! Arrays, made in loops.
//!
//! [`core::array::from_fn`], `map` of arrays, `zip` and [`core::mem::swap`] go through functions of the standard library that
//! are not marked for inlining. Until the optimiser looks across codegen units, which comes late, they are calls, and what a
//! call may point to stays in memory: in steps of tens of nanoseconds up to a third of the time. So code that runs in a step
//! has loops over indices instead.

/// `[make(0), make(1), …]`, of which every entry is `blank` first.
#[inline(always)]
pub(crate) fn array<T: Copy, const N: usize>(blank: T, mut make: impl FnMut(usize) -> T) -> [T; N] {
    let mut all = [blank; N];
    for (index, entry) in all.iter_mut().enumerate() {
        *entry = make(index);
    }
    all
}
