//! What a search for events leaves behind for the next one.

use crate::number::words::{Visit, Words, words};

/// The event that was found last: a search that starts at its time starts on it.
#[derive(Clone, Copy, Debug, Default)]
pub(crate) struct LastEvent {
    pub(crate) time: f64,
    pub(crate) index: usize,
    /// The sign that the function had before.
    pub(crate) side: f64,
    /// How many events have been found at this time.
    pub(crate) count: u32,
}

impl Words for LastEvent {
    fn words(&mut self, visit: &mut Visit<'_>) {
        words!(visit: self.time, self.index, self.side, self.count);
    }
}
