//! A copy of the memory of a flow between calls.

#[cfg(feature = "alloc")]
use alloc::vec::Vec;

use super::Flow;
use symplectic_core::Vector;
#[cfg(feature = "alloc")]
use symplectic_core::solver::{Visit, Words};

/// The words of the [memory](Flow::memory) of a flow at one moment; none without the feature `alloc`.
#[derive(Clone, Debug, Default)]
pub struct Memory(#[cfg(feature = "alloc")] Vec<u64>);

#[cfg(feature = "alloc")]
impl Memory {
    /// Copies the words of a flow.
    pub(super) fn keep<V: Vector, F: Flow<V>>(&mut self, flow: &mut F) {
        self.0.clear();
        flow.memory(&mut |word| self.0.push(*word));
    }

    /// Number of words.
    pub(super) const fn len(&self) -> usize {
        self.0.len()
    }

    /// Writes the words back into the flow.
    pub(super) fn put_back<V: Vector, F: Flow<V>>(&self, flow: &mut F) {
        let mut words = self.0.iter();
        flow.memory(&mut |word| *word = words.next().copied().unwrap_or(*word));
    }
}

#[cfg(feature = "alloc")]
impl Words for Memory {
    fn words(&mut self, visit: &mut Visit<'_>) {
        self.0.words(visit);
    }
}

#[cfg(not(feature = "alloc"))]
impl Memory {
    pub(super) fn keep<V: Vector, F: Flow<V>>(&mut self, _flow: &mut F) {}

    pub(super) fn put_back<V: Vector, F: Flow<V>>(&self, _flow: &mut F) {}
}
