//! The last step, for dense output, and the last event, from which the next search continues.

use crate::method::interpolation::Line;
use crate::number::words::{Visit, Words, words};

/// The last step of an integrator.
pub(crate) struct LastStep<'a, V> {
    pub(crate) start: f64,
    pub(crate) end: f64,
    pub(crate) size: f64,
    pub(crate) positions: Line<'a, V>,
    pub(crate) momenta: Line<'a, V>,
}

/// The last event found: a search that starts at its time starts on this event.
#[derive(Clone, Copy, Debug, Default)]
pub struct LastEvent {
    pub(crate) time: f64,
    pub(crate) index: usize,
    /// The sign of the function before the event.
    pub(crate) side: f64,
    /// Number of events in a row that ends here, each closely after the one before.
    pub(crate) count: u32,
}

impl Words for LastEvent {
    fn words(&mut self, visit: &mut Visit<'_>) {
        words!(visit: self.time, self.index, self.side, self.count);
    }
}
