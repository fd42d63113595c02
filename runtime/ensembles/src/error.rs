//! Errors of ensembles.

use core::fmt;

use symplectic_core::Error;

/// The error type of ensembles and their statistics.
#[derive(Clone, PartialEq, thiserror::Error)]
#[non_exhaustive]
pub enum EnsembleError {
    /// There are no starts.
    #[error("there are no starts: an ensemble needs at least one")]
    Empty,

    /// A start has a different dimension from the first.
    #[error(
        "trajectory {trajectory} starts with {found} components, and trajectory 0 with {expected}: all must have the same number"
    )]
    Dimension {
        /// Number of the trajectory, from 0.
        trajectory: usize,
        /// Its dimension.
        found: usize,
        /// The dimension of the first start.
        expected: usize,
    },

    /// A trajectory cannot start.
    #[error("trajectory {trajectory}: {error}")]
    Start {
        /// Number of the trajectory, from 0.
        trajectory: usize,
        /// Why.
        error: Error,
    },

    /// An error of all trajectories.
    #[error(transparent)]
    All(Error),

    /// The ends or the number of bins of a histogram are invalid.
    #[error(
        "a histogram of {bins} bins from {low} to {high}: the number of bins must be from 1 to 2^24, and low < high, both finite"
    )]
    Histogram {
        /// The lower end.
        low: f64,
        /// The upper end.
        high: f64,
        /// The number of bins.
        bins: usize,
    },

    /// Histograms that cannot be merged.
    #[error("the histograms have different ends or numbers of bins: only equal bins can be merged")]
    OtherBins,

    /// A file does not have the expected contents.
    #[error("expected {0} in the file; it is damaged or has other contents")]
    Written(&'static str),

    /// There is no such part.
    #[error(
        "there is no part {part} of {count}: there must be at least one part, and parts are numbered from 0"
    )]
    Shard {
        /// The requested part.
        part: usize,
        /// The number of parts.
        count: usize,
    },
}

/// The message, as `unwrap` and a `main` that returns the error print it.
impl fmt::Debug for EnsembleError {
    fn fmt(&self, formatter: &mut fmt::Formatter<'_>) -> fmt::Result {
        fmt::Display::fmt(self, formatter)
    }
}
