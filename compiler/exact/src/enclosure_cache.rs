//! A cache for the finest enclosure of a number.

use std::sync::{Mutex, MutexGuard, PoisonError};

use super::interval::Interval;

/// Stores the finest enclosure of a number so far.
#[derive(Debug, Default)]
pub struct EnclosureCache(Mutex<Option<Interval>>);

impl EnclosureCache {
    fn lock(&self) -> MutexGuard<'_, Option<Interval>> {
        self.0.lock().unwrap_or_else(PoisonError::into_inner)
    }

    /// An enclosure with this number of binary places, computed only if the stored one is coarser.
    pub fn enclose(&self, bits: u32, compute: impl FnOnce(u32) -> Interval) -> Interval {
        let mut known = self.lock();
        match &*known {
            Some(interval) if interval.bits() >= bits => interval.with_bits(bits),
            _ => known.insert(compute(bits)).clone(),
        }
    }
}

impl Clone for EnclosureCache {
    fn clone(&self) -> Self {
        EnclosureCache(Mutex::new(self.lock().clone()))
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::rational::ratio;

    #[test]
    fn coarser_enclosures_come_from_the_finest() {
        let cache = EnclosureCache::default();
        let third = |bits| Interval::enclosing(&ratio(1, 3), bits);
        for bits in [8, 40, 8, 3] {
            let interval = cache.enclose(bits, third);
            assert_eq!(interval, third(bits));
        }
        let unused = cache.enclose(20, |_| Interval::enclosing(&ratio(7, 1), 20));
        assert_eq!(unused, third(20));
    }
}
