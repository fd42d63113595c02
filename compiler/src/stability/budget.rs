//! A bound on the work of exact arithmetic.

use std::sync::atomic::{AtomicU64, Ordering};

/// Products of machine words that may be spent.
///
/// The budget counts operations, not time, so that the same input has the same outcome everywhere. Once it is spent,
/// results are meaningless, and the caller that created the budget must discard them.
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

    /// Removes the bound: results that are decided already are printed to any number of digits.
    pub(super) fn lift(&self) {
        self.0.store(u64::MAX, Ordering::Relaxed);
    }

    pub(super) fn is_spent(&self) -> bool {
        self.0.load(Ordering::Relaxed) == 0
    }
}
