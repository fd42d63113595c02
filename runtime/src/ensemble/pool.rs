//! Threads.

use alloc::vec::Vec;

/// How many groups of trajectories are taken before rows are shown: few where they take long.
#[cfg(feature = "parallel")]
pub(super) struct Batch {
    groups: usize,
}

#[cfg(feature = "parallel")]
impl Batch {
    /// The most groups for each thread.
    const MOST: usize = 1 << 6;
    /// Seconds after which rows should be shown.
    const SECONDS: f64 = 1.0;

    /// A group for each thread.
    pub(super) fn new() -> Self {
        Self {
            groups: rayon::current_num_threads(),
        }
    }

    /// The number of groups.
    pub(super) const fn groups(&self) -> usize {
        self.groups
    }

    /// `work` of each item, in their order: by the threads of `rayon`. The next batch is larger if they were quick.
    pub(super) fn map<T: Send, U: Send>(
        &mut self,
        items: Vec<T>,
        work: impl Fn(T) -> U + Sync,
    ) -> Vec<U> {
        use rayon::iter::{IntoParallelIterator, ParallelIterator};
        let began = std::time::Instant::now();
        let all = items.into_par_iter().map(&work).collect();
        let threads = rayon::current_num_threads();
        self.groups = match began.elapsed().as_secs_f64() < Self::SECONDS {
            true => (2 * self.groups).min(Self::MOST * threads),
            false => (self.groups / 2).max(threads),
        };
        all
    }
}

/// One group after another.
#[cfg(not(feature = "parallel"))]
pub(super) struct Batch;

#[cfg(not(feature = "parallel"))]
impl Batch {
    pub(super) const fn new() -> Self {
        Self
    }

    /// The number of groups.
    pub(super) const fn groups(&self) -> usize {
        1
    }

    /// `work` of each item, in their order.
    pub(super) fn map<T: Send, U: Send>(
        &mut self,
        items: Vec<T>,
        work: impl Fn(T) -> U + Sync,
    ) -> Vec<U> {
        items.into_iter().map(work).collect()
    }
}
