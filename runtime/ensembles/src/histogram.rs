//! Histograms.

use alloc::vec;
use alloc::vec::Vec;

use crate::EnsembleError;

/// A histogram with bins of equal width.
///
/// Bin `k` holds `low + k w ≤ x < low + (k + 1) w` with `w = (high − low)/bins`, up to rounding at its ends.
///
/// ```
/// use symplectic::ensemble::{EnsembleError, Histogram};
///
/// # fn main() -> Result<(), EnsembleError> {
/// let mut histogram = Histogram::new(0.0, 1.0, 4)?;
/// for x in [0.0, 0.1, 0.3, 0.999, 1.0, -5.0, f64::NAN] {
///     histogram.add(x);
/// }
/// assert_eq!(histogram.counts(), [2, 1, 0, 1]);
/// assert_eq!((histogram.below(), histogram.above(), histogram.nan()), (1, 1, 1));
/// assert_eq!(histogram.edge(1), 0.25);
/// # Ok(())
/// # }
/// ```
#[derive(Clone, Debug, PartialEq)]
#[cfg_attr(feature = "serde", derive(serde::Serialize, serde::Deserialize))]
#[cfg_attr(feature = "serde", serde(try_from = "Written"))]
pub struct Histogram {
    /// `low` and `high`.
    #[cfg_attr(feature = "serde", serde(with = "super::as_bits"))]
    range: Vec<f64>,
    counts: Vec<u64>,
    /// Counts below, above and NaN.
    outside: [u64; 3],
}

/// Largest number of bins.
const MAX_BINS: usize = 1 << 24;

/// A histogram as deserialized, before it is checked.
#[cfg(feature = "serde")]
#[derive(serde::Deserialize)]
#[serde(deny_unknown_fields)]
struct Written {
    #[serde(with = "super::as_bits")]
    range: Vec<f64>,
    counts: Vec<u64>,
    outside: [u64; 3],
}

#[cfg(feature = "serde")]
impl TryFrom<Written> for Histogram {
    type Error = EnsembleError;

    fn try_from(written: Written) -> Result<Self, EnsembleError> {
        let Written {
            range,
            counts,
            outside,
        } = written;
        let [low, high] = range[..] else {
            return Err(EnsembleError::Written("a histogram with two ends"));
        };
        check(low, high, counts.len())?;
        Ok(Self {
            range,
            counts,
            outside,
        })
    }
}

fn check(low: f64, high: f64, bins: usize) -> Result<(), EnsembleError> {
    match (1..=MAX_BINS).contains(&bins) && low < high && (high - low).is_finite() {
        true => Ok(()),
        false => Err(EnsembleError::Histogram { low, high, bins }),
    }
}

impl Histogram {
    /// Empty bins from `low` to `high`.
    ///
    /// # Errors
    ///
    /// [`EnsembleError::Histogram`] for no bins or more than 2²⁴ bins, or if not `low < high` with a finite difference.
    pub fn new(low: f64, high: f64, bins: usize) -> Result<Self, EnsembleError> {
        check(low, high, bins)?;
        Ok(Self {
            range: vec![low, high],
            counts: vec![0; bins],
            outside: [0; 3],
        })
    }

    /// Counts a number.
    pub fn add(&mut self, x: f64) {
        let [below, above, nan] = &mut self.outside;
        let (low, high) = (self.range[0], self.range[1]);
        *if x.is_nan() {
            nan
        } else if x < low {
            below
        } else if x >= high {
            above
        } else {
            let last = self.counts.len() - 1;
            let bin = (x - low) / (high - low) * self.counts.len() as f64;
            // Rounding may move the largest numbers to the upper edge.
            &mut self.counts[(bin as usize).min(last)]
        } += 1;
    }

    /// Adds the counts of another histogram, for example of another shard of an ensemble.
    ///
    /// # Errors
    ///
    /// [`EnsembleError::OtherBins`] if the bins differ.
    pub fn merge(&mut self, other: &Self) -> Result<(), EnsembleError> {
        if (&self.range, self.counts.len()) != (&other.range, other.counts.len()) {
            return Err(EnsembleError::OtherBins);
        }
        let pairs = self.counts.iter_mut().zip(&other.counts);
        let outside = self.outside.iter_mut().zip(&other.outside);
        pairs.chain(outside).for_each(|(own, other)| *own += other);
        Ok(())
    }

    /// The counts of the bins.
    pub fn counts(&self) -> &[u64] {
        &self.counts
    }

    /// The lower edge of a bin, from 0; for `bin` equal to the number of bins, the upper edge of the last bin.
    pub fn edge(&self, bin: usize) -> f64 {
        let part = bin as f64 / self.counts.len() as f64;
        self.range[0] + part * (self.range[1] - self.range[0])
    }

    /// Number of values below the first bin.
    pub const fn below(&self) -> u64 {
        self.outside[0]
    }

    /// Number of values above the last bin or at its upper edge.
    pub const fn above(&self) -> u64 {
        self.outside[1]
    }

    /// Number of NaNs.
    pub const fn nan(&self) -> u64 {
        self.outside[2]
    }
}
