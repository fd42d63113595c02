//! What a search for events leaves behind for the next one.

/// The event that was found last: a search that starts at its time starts on it.
#[derive(Clone, Copy, Debug)]
pub(crate) struct LastEvent {
    pub(crate) time: f64,
    pub(crate) index: usize,
    /// The sign that the function had before.
    pub(crate) side: f64,
    /// How many events have been found at this time.
    pub(crate) count: u32,
}
