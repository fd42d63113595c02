//! Distribution of trajectories over threads.

use alloc::vec::Vec;
use core::ops::{ControlFlow, Range};

/// Number of threads that run trajectories.
pub(super) fn threads() -> usize {
    #[cfg(feature = "parallel")]
    return rayon::current_num_threads();
    #[cfg(not(feature = "parallel"))]
    return 1;
}

/// Calls `fill` with `whole` and shares of at most `share` places, on one thread, and `show` with the rows of each share.
///
/// `fill` appends a row for each place to the list; fewer rows end the run. So does `show`, which returns the number of rows shown.
#[cfg(not(feature = "parallel"))]
pub(super) fn in_order<E, T>(
    (whole, _part): (&E, impl Fn(&Range<usize>, Option<E>) -> E),
    places: Range<usize>,
    share: usize,
    fill: impl Fn(&E, Range<usize>, &mut Vec<T>),
    mut show: impl FnMut(&mut Vec<T>) -> ControlFlow<()>,
) {
    let mut rows = Vec::new();
    let mut next = places.start;
    while next < places.end {
        let end = places.end.min(next.saturating_add(share));
        fill(whole, next..end, &mut rows);
        let count = rows.len();
        if show(&mut rows).is_break() || count < end - next {
            return;
        }
        next = end;
    }
}

#[cfg(feature = "parallel")]
pub(super) use by_threads::in_order;

#[cfg(feature = "parallel")]
mod by_threads {
    use core::sync::atomic::{AtomicBool, Ordering};
    use std::sync::{Mutex, PoisonError};
    use std::time::{Duration, Instant};

    use super::*;

    /// Intended duration of a batch.
    const BATCH: Duration = Duration::from_secs(1);
    /// Duration up to which the next batch runs while rows are shown: if these end the run, it is wasted.
    const SHORT: Duration = Duration::from_millis(100);
    /// Largest number of places in a batch, for each thread; one share is always allowed.
    const MAX_PLACES: usize = 1 << 12;
    /// Largest number of shares in a batch, for each thread.
    const MAX_SHARES: usize = 1 << 6;

    /// Shares that run at the same time, in order; the lists are reused.
    struct Batch<E, T> {
        shares: Vec<Mutex<Share<E, T>>>,
        /// The number of shares in use.
        count: usize,
    }

    /// What the thread that runs a share has to itself.
    struct Share<E, T> {
        places: Range<usize>,
        part: Option<E>,
        rows: Vec<T>,
    }

    impl<E, T> Batch<E, T> {
        /// Takes shares from the beginning of the places.
        fn take(
            &mut self,
            places: &mut Range<usize>,
            share: usize,
            most: usize,
            part: impl Fn(&Range<usize>, Option<E>) -> E,
        ) {
            self.count = 0;
            while places.start < places.end && self.count < most {
                let end = places.end.min(places.start.saturating_add(share));
                let own = places.start..end;
                places.start = end;
                match self.shares.get_mut(self.count) {
                    Some(held) => {
                        let held = held.get_mut().unwrap_or_else(PoisonError::into_inner);
                        held.part = Some(part(&own, held.part.take()));
                        held.places = own;
                    }
                    None => self.shares.push(Mutex::new(Share {
                        part: Some(part(&own, None)),
                        places: own,
                        rows: Vec::new(),
                    })),
                }
                self.count += 1;
            }
        }
    }

    /// Calls `fill` with shares of at most `share` places, on the threads of `rayon`, and `show` with the rows of each share in order, on
    /// this thread.
    ///
    /// The first argument of `fill` is what `part` makes of the whole for the share, on this thread; its second argument is an earlier part
    /// that is no longer in use.
    ///
    /// `fill` appends a row for each place to the list; fewer rows end the run. So does `show`.
    pub(crate) fn in_order<E: Send, T: Send>(
        (_whole, part): (&E, impl Fn(&Range<usize>, Option<E>) -> E),
        mut places: Range<usize>,
        share: usize,
        fill: impl Fn(&E, Range<usize>, &mut Vec<T>) + Sync,
        mut show: impl FnMut(&mut Vec<T>) -> ControlFlow<()>,
    ) {
        let threads = rayon::current_num_threads();
        let largest = threads * (MAX_PLACES / share.max(1)).clamp(1, MAX_SHARES);
        let ended = AtomicBool::new(false);
        let mut show_batch = |batch: &mut Batch<E, T>| {
            for held in &mut batch.shares[..batch.count] {
                let held = held.get_mut().unwrap_or_else(PoisonError::into_inner);
                let count = held.rows.len();
                if show(&mut held.rows).is_break() || count < held.places.len() {
                    return ControlFlow::Break(());
                }
            }
            ControlFlow::Continue(())
        };
        let run = |batch: &Batch<E, T>, meanwhile: &mut dyn FnMut()| {
            let job = |number: usize| {
                let held = &batch.shares[number];
                if !ended.load(Ordering::Relaxed) {
                    let mut held = held.lock().unwrap_or_else(PoisonError::into_inner);
                    let Share { places, part, rows } = &mut *held;
                    if let Some(part) = part {
                        fill(part, places.clone(), rows);
                    }
                }
            };
            do_all(batch.count, &job, meanwhile);
        };
        let batch = || Batch {
            shares: Vec::new(),
            count: 0,
        };
        let (mut shown, mut next) = (batch(), batch());
        let mut most = threads.min(largest);
        let mut is_short = false;
        loop {
            next.take(&mut places, share, most, &part);
            let is_last = next.count == 0;
            let is_shown_now = !is_short || is_last;
            if is_shown_now && show_batch(&mut shown).is_break() {
                return;
            }
            if is_last {
                return;
            }
            let began = Instant::now();
            run(&next, &mut || {
                if is_short && show_batch(&mut shown).is_break() {
                    ended.store(true, Ordering::Relaxed);
                }
            });
            if ended.load(Ordering::Relaxed) {
                return;
            }
            let time = began.elapsed();
            is_short = time < SHORT;
            most = match time {
                // Few batches are needed to find the right size.
                _ if time < BATCH / 1000 => (8 * most).min(largest),
                _ if time < BATCH => (2 * most).min(largest),
                _ => (most / 2).max(threads),
            };
            core::mem::swap(&mut shown, &mut next);
        }
    }

    /// Runs jobs with the numbers below `count` on the threads of `rayon`, and `meanwhile` on this one; a single job also on this one, which
    /// then waits for no other work of those threads. Independent of the types of the rows, so it is compiled only once.
    #[inline(never)]
    fn do_all(count: usize, job: &(dyn Fn(usize) + Sync), meanwhile: &mut dyn FnMut()) {
        if count == 1 {
            job(0);
            return meanwhile();
        }
        rayon::in_place_scope(|scope| {
            for number in 0..count {
                scope.spawn(move |_| job(number));
            }
            meanwhile();
        });
    }
}
