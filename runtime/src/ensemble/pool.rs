//! Threads.

use alloc::vec::Vec;

/// `work` of each item, in their order: by the threads of `rayon`.
#[cfg(feature = "parallel")]
pub(super) fn map<T: Send, U: Send>(items: Vec<T>, work: impl Fn(T) -> U + Sync) -> Vec<U> {
    use rayon::iter::{IntoParallelIterator, ParallelIterator};
    items.into_par_iter().map(&work).collect()
}

/// `work` of each item, in their order.
#[cfg(not(feature = "parallel"))]
pub(super) fn map<T: Send, U: Send>(items: Vec<T>, work: impl Fn(T) -> U + Sync) -> Vec<U> {
    items.into_iter().map(work).collect()
}

/// The number of threads.
#[cfg(feature = "parallel")]
pub(super) fn threads() -> usize {
    rayon::current_num_threads()
}

/// The number of threads.
#[cfg(not(feature = "parallel"))]
pub(super) const fn threads() -> usize {
    1
}
