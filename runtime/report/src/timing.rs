//! CPU times of many runs, measured in turn.

use std::time::Duration;

use cpu_time::ThreadTime;

/// Shorter runs are repeated between readings of the clock, which itself takes a microsecond.
const SHORTEST: f64 = 2e-3;

/// CPU time of `work` on this thread, in seconds.
pub(super) fn clock(work: impl FnOnce()) -> f64 {
    let start = ThreadTime::now();
    work();
    start.elapsed().as_secs_f64()
}

/// Number of timed repetitions.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Repetitions {
    /// Smallest number of repetitions.
    pub least: usize,
    /// Largest number of repetitions.
    pub most: usize,
    /// Total time per point after which no further repetition is made.
    pub enough: Duration,
}

impl Default for Repetitions {
    fn default() -> Self {
        Self {
            least: 3,
            most: 15,
            enough: Duration::from_millis(100),
        }
    }
}

/// The times of the runs of a point.
#[derive(Clone, Debug)]
pub(super) struct Samples {
    /// Number of runs between readings of the clock.
    batch: u32,
    seconds: Vec<f64>,
}

impl Samples {
    /// An empty sample of a run that takes about `estimate` seconds.
    pub fn new(estimate: f64) -> Self {
        let batch = (SHORTEST / estimate.max(1e-9)).ceil();
        Self {
            batch: batch.clamp(1.0, 1e5) as u32,
            seconds: Vec::new(),
        }
    }

    pub fn count(&self) -> usize {
        self.seconds.len()
    }

    /// Whether there are enough samples.
    pub fn suffice(&self, wanted: &Repetitions) -> bool {
        let spent: f64 = self.seconds.iter().sum::<f64>() * f64::from(self.batch);
        self.count() >= wanted.most.max(wanted.least)
            || self.count() >= wanted.least && spent >= wanted.enough.as_secs_f64()
    }

    /// Takes another sample.
    pub fn take(&mut self, run: &mut dyn FnMut()) {
        let seconds = clock(|| (0..self.batch).for_each(|_| run()));
        self.seconds.push(seconds / f64::from(self.batch));
    }

    /// The median; for an even number of samples the mean of the middle two.
    pub fn median(&self) -> Option<f64> {
        median(&self.seconds)
    }
}

fn median(values: &[f64]) -> Option<f64> {
    let mut sorted = values.to_vec();
    sorted.sort_by(f64::total_cmp);
    let middle = sorted.len() / 2;
    let upper = *sorted.get(middle)?;
    Some(if sorted.len().is_multiple_of(2) {
        (sorted[middle - 1] + upper) / 2.0
    } else {
        upper
    })
}

/// The order of one round over the points of several curves, as `(curve, point)`: the first points of all curves, then
/// the second ones, and so on. Neighbours belong to different methods, so that changes in the speed of the machine
/// affect all alike.
pub(super) fn round(lengths: &[usize]) -> Vec<(usize, usize)> {
    let longest = lengths.iter().copied().max().unwrap_or(0);
    let turn = |point| {
        let curves = lengths.iter().enumerate();
        curves.filter_map(move |(curve, &length)| (point < length).then_some((curve, point)))
    };
    (0..longest).flat_map(turn).collect()
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn repetitions_of_methods_alternate() {
        let order = round(&[2, 0, 3]);
        assert_eq!(order, [(0, 0), (2, 0), (0, 1), (2, 1), (2, 2)]);
        assert_eq!(round(&[]), []);
    }

    #[test]
    fn one_slow_run_does_not_move_the_median() {
        assert_eq!(median(&[3.0, 1.0, 100.0]), Some(3.0));
        assert_eq!(median(&[4.0, 1.0, 2.0, 100.0]), Some(3.0));
        assert_eq!(median(&[]), None);
    }

    #[test]
    fn short_runs_are_batched_and_there_are_enough_samples() {
        let wanted = Repetitions {
            least: 2,
            most: 4,
            enough: Duration::from_secs(1),
        };
        let mut samples = Samples::new(1.5e-3);
        let mut runs = 0;
        samples.take(&mut || runs += 1);
        assert_eq!((runs, samples.count()), (2, 1));
        assert!(!samples.suffice(&wanted));
        samples.seconds = vec![0.4, 0.4];
        assert!(
            !Samples {
                batch: 1,
                ..samples.clone()
            }
            .suffice(&wanted)
        );
        assert!(
            Samples {
                batch: 2,
                ..samples.clone()
            }
            .suffice(&wanted)
        );
        samples.seconds = vec![0.0; 4];
        assert!(samples.suffice(&wanted));
    }
}
