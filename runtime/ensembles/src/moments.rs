//! Mean and variance over trajectories.

use alloc::vec;
use alloc::vec::Vec;

use symplectic_core::Error;

/// Running mean and variance of the components of vectors, by Welford's recurrence (Technometrics 4, 1962, 419–420):
///
/// ```text
/// m_k = m_{k−1} + (x_k − m_{k−1})/k      s_k = s_{k−1} + (x_k − m_{k−1})(x_k − m_k)      variance = s_n/(n − 1)
/// ```
///
/// The rows of an ensemble arrive in a fixed order, so the sums have the same bits for any number of threads. With the
/// feature `serde` the moments can be stored, bit for bit, and resumed after an interruption.
///
/// ```
/// use symplectic::Error;
/// use symplectic::ensemble::Moments;
///
/// # fn main() -> Result<(), Error> {
/// let mut moments = Moments::new(2);
/// for vector in [[1.0, 4.0], [2.0, 4.0], [3.0, 4.0]] {
///     moments.add(&vector)?;
/// }
/// assert_eq!((moments.count(), moments.mean()), (3, &[2.0, 4.0][..]));
/// assert_eq!(moments.variance(), [1.0, 0.0]);
/// # Ok(())
/// # }
/// ```
#[derive(Clone, Debug, PartialEq)]
#[cfg_attr(feature = "serde", derive(serde::Serialize, serde::Deserialize))]
#[cfg_attr(feature = "serde", serde(try_from = "Written"))]
pub struct Moments {
    count: u64,
    #[cfg_attr(feature = "serde", serde(with = "super::as_bits"))]
    mean: Vec<f64>,
    #[cfg_attr(feature = "serde", serde(with = "super::as_bits"))]
    squares: Vec<f64>,
}

/// Moments as deserialized, before they are checked.
#[cfg(feature = "serde")]
#[derive(serde::Deserialize)]
#[serde(deny_unknown_fields)]
struct Written {
    count: u64,
    #[serde(with = "super::as_bits")]
    mean: Vec<f64>,
    #[serde(with = "super::as_bits")]
    squares: Vec<f64>,
}

#[cfg(feature = "serde")]
impl TryFrom<Written> for Moments {
    type Error = super::EnsembleError;

    fn try_from(written: Written) -> Result<Self, super::EnsembleError> {
        let Written {
            count,
            mean,
            squares,
        } = written;
        if mean.len() != squares.len() {
            return Err(super::EnsembleError::Written(
                "a mean and a variance of each component",
            ));
        }
        Ok(Self {
            count,
            mean,
            squares,
        })
    }
}

impl Moments {
    /// The moments of an empty set of vectors of this dimension.
    pub fn new(dimension: usize) -> Self {
        Self {
            count: 0,
            mean: vec![0.0; dimension],
            squares: vec![0.0; dimension],
        }
    }

    /// Adds a vector.
    ///
    /// # Errors
    ///
    /// [`Error::Length`] if the vector has a different dimension.
    pub fn add(&mut self, vector: &[f64]) -> Result<(), Error> {
        let (expected, found) = (self.mean.len(), vector.len());
        if expected != found {
            return Err(Error::Length { expected, found });
        }
        self.count += 1;
        let count = self.count as f64;
        for ((mean, squares), &x) in self.mean.iter_mut().zip(&mut self.squares).zip(vector) {
            let before = x - *mean;
            *mean += before / count;
            *squares += before * (x - *mean);
        }
        Ok(())
    }

    /// Adds other moments, for example of another shard of an ensemble (Chan, Golub & LeVeque, Am. Stat. 37, 1983,
    /// 242).
    ///
    /// ```text
    /// m = m₁ + d n₂/n      s = s₁ + s₂ + d² n₁n₂/n      d = m₂ − m₁      n = n₁ + n₂
    /// ```
    ///
    /// The rounding differs from that of adding single vectors. For the same bits, merge the same parts in the same
    /// order.
    ///
    /// # Errors
    ///
    /// [`Error::Length`] if they have a different dimension.
    pub fn merge(&mut self, other: &Self) -> Result<(), Error> {
        let (expected, found) = (self.mean.len(), other.mean.len());
        if expected != found {
            return Err(Error::Length { expected, found });
        }
        if self.count == 0 || other.count == 0 {
            if self.count == 0 {
                self.clone_from(other);
            }
            return Ok(());
        }
        let (own, others) = (self.count as f64, other.count as f64);
        let part = others / (own + others);
        let sums = self.mean.iter_mut().zip(&mut self.squares);
        let theirs = other.mean.iter().zip(&other.squares);
        for ((mean, squares), (their_mean, their_squares)) in sums.zip(theirs) {
            let apart = their_mean - *mean;
            *mean += apart * part;
            *squares += their_squares + apart * apart * own * part;
        }
        self.count += other.count;
        Ok(())
    }

    /// The number of vectors.
    pub const fn count(&self) -> u64 {
        self.count
    }

    /// The mean of each component; 0 before the first vector.
    pub fn mean(&self) -> &[f64] {
        &self.mean
    }

    /// The variance of each component, from `n − 1` degrees of freedom; NaN before the second vector.
    pub fn variance(&self) -> Vec<f64> {
        let freedom = match self.count {
            0 | 1 => f64::NAN,
            count => (count - 1) as f64,
        };
        self.squares
            .iter()
            .map(|squares| squares / freedom)
            .collect()
    }
}
