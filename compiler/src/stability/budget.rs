//! A bound on the work that exact arithmetic may take.

use std::sync::atomic::{AtomicU64, Ordering};

/// Products of machine words that may be spent.
///
/// It counts operations, not time, so that the same input has the same outcome everywhere. Once it is spent,
/// results mean nothing, and whoever made the budget has to throw them away.
#[derive(Debug)]
pub(super) struct Budget(AtomicU64);

impl Budget {
    pub(super) fn new(products: u64) -> Self {
        Budget(AtomicU64::new(products))
    }

    #[cfg(test)]
    pub(super) fn unlimited() -> Self {
        Budget::new(u64::MAX)
    }

    pub(super) fn spend(&self, products: u64) {
        let left = self.0.load(Ordering::Relaxed);
        self.0
            .store(left.saturating_sub(products), Ordering::Relaxed);
    }

    /// Takes the bound away: what is decided is printed to as many digits as are asked for.
    pub(super) fn lift(&self) {
        self.0.store(u64::MAX, Ordering::Relaxed);
    }

    pub(super) fn is_spent(&self) -> bool {
        self.0.load(Ordering::Relaxed) == 0
    }
}
