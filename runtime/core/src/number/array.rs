//! Arrays filled by loops.
//!
//! [`core::array::from_fn`], `map` of arrays and `zip` call functions of the standard library that are not marked for inlining. They are
//! inlined late in the compilation only, across codegen units. Until then the compiler does not keep memory in registers if a call may know
//! its address. For (q² + 1)(p² + 1)/2 and two stages this took a quarter of the time of a step. So sweeps, sums, kicks and drifts loop
//! over indices.

/// Returns `[make(0), make(1), …]`; entries that are not yet computed are `blank`.
#[cfg_attr(not(debug_assertions), inline(always))]
pub fn array<T: Copy, const N: usize>(blank: T, mut make: impl FnMut(usize) -> T) -> [T; N] {
    let mut all = [blank; N];
    for (index, entry) in all.iter_mut().enumerate() {
        *entry = make(index);
    }
    all
}
