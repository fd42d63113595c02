//! Distribution of trajectories over threads.

#[cfg(feature = "parallel")]
use alloc::boxed::Box;
use alloc::vec::Vec;

/// Number of threads that run trajectories.
pub(super) fn threads() -> usize {
    #[cfg(feature = "parallel")]
    return rayon::current_num_threads();
    #[cfg(not(feature = "parallel"))]
    return 1;
}

/// Number of groups of trajectories to run before their rows are passed on; adapted so that a batch takes about a second.
#[cfg(feature = "parallel")]
pub(super) struct Batch {
    groups: usize,
}

#[cfg(feature = "parallel")]
impl Batch {
    /// Largest number of groups per thread.
    const MOST: usize = 1 << 6;
    /// Intended duration of a batch, in seconds.
    const SECONDS: f64 = 1.0;

    /// Starts with one group per thread.
    pub(super) fn new() -> Self {
        Self {
            groups: rayon::current_num_threads(),
        }
    }

    /// The number of groups.
    pub(super) const fn groups(&self) -> usize {
        self.groups
    }

    /// Applies `work` to the items on the threads of `rayon`, in order, and adapts the size of the next batch.
    pub(super) fn map<T: Send, U: Send>(
        &mut self,
        items: Vec<T>,
        work: impl Fn(T) -> U + Sync,
    ) -> Vec<U> {
        let began = std::time::Instant::now();
        let mut all: Vec<Option<U>> = items.iter().map(|_| None).collect();
        let work = &work;
        let jobs = items.into_iter().zip(&mut all);
        let jobs = jobs.map(|(item, done)| -> Job<'_> { Box::new(|| *done = Some(work(item))) });
        do_all(jobs.collect());
        let all = all.into_iter().flatten().collect();
        let threads = rayon::current_num_threads();
        self.groups = match began.elapsed().as_secs_f64() < Self::SECONDS {
            true => (2 * self.groups).min(Self::MOST * threads),
            false => (self.groups / 2).max(threads),
        };
        all
    }
}

#[cfg(feature = "parallel")]
type Job<'a> = Box<dyn FnOnce() + Send + 'a>;

/// Runs all jobs on the threads of `rayon`. Independent of the types of the jobs, so it is compiled only once.
#[cfg(feature = "parallel")]
#[inline(never)]
fn do_all(jobs: Vec<Job<'_>>) {
    use rayon::iter::{IntoParallelIterator, ParallelIterator};
    jobs.into_par_iter().for_each(|job| job());
}

/// Runs one group after another.
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

    /// Applies `work` to the items, in order.
    pub(super) fn map<T: Send, U: Send>(
        &mut self,
        items: Vec<T>,
        work: impl Fn(T) -> U + Sync,
    ) -> Vec<U> {
        items.into_iter().map(work).collect()
    }
}
