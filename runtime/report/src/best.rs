//! The CPU time of a method for a given error.

use std::vec::Vec;

use super::{Curve, Kind, Measured, Measurements, Outcome, ProblemRecord};

/// The CPU time of a method for a given error on a problem.
#[derive(Clone, Copy, Debug, PartialEq)]
pub enum Cost {
    /// Interpolated between a run with a larger error and a run with a smaller error, linearly in the logarithms of
    /// times and errors.
    Between {
        /// Seconds of CPU time.
        seconds: f64,
    },
    /// The time of the first run that reaches the error. No less accurate run precedes it, and times are not
    /// extrapolated.
    AtMost {
        /// Seconds of CPU time.
        seconds: f64,
    },
    /// No run reaches the error.
    NotReached {
        /// The smallest error of all runs.
        best: f64,
    },
    /// No run reached the end.
    NoRun,
}

impl Cost {
    /// Seconds of CPU time, if the error is reached.
    pub const fn seconds(&self) -> Option<f64> {
        match self {
            Self::Between { seconds } | Self::AtMost { seconds } => Some(*seconds),
            Self::NotReached { .. } | Self::NoRun => None,
        }
    }
}

impl Curve {
    /// The CPU time for an error of `target`.
    ///
    /// A run reaches the target if neither its error nor that of the next finer run is larger. So an accidental zero of
    /// the error does not count.
    pub fn cost(&self, target: f64) -> Cost {
        let reaches = |run: &Measured| run.error <= target;
        let measured: Vec<&Measured> = self.measured().map(|(_, run)| run).collect();
        let best = measured.iter().map(|run| run.error).reduce(f64::min);
        let Some(best) = best else {
            return Cost::NoRun;
        };
        let stays = |index: &usize| {
            reaches(measured[*index]) && measured.get(index + 1).is_none_or(|next| reaches(next))
        };
        let Some(first) = (0..measured.len()).find(stays) else {
            return Cost::NotReached { best };
        };
        let run = measured[first];
        let before = first.checked_sub(1).map(|index| measured[index]);
        match before.filter(|before| !reaches(before)) {
            Some(before) => Cost::Between {
                seconds: interpolate(
                    (before.error, before.seconds),
                    (run.error, run.seconds),
                    target,
                ),
            },
            None => Cost::AtMost {
                seconds: run.seconds,
            },
        }
    }

    /// Whether finer runs were skipped.
    pub fn is_cut(&self) -> bool {
        let last = self.points.last();
        last.is_some_and(|point| matches!(point.outcome, Outcome::Skipped { .. }))
    }
}

/// Log-log interpolation between two points.
fn interpolate((x0, y0): (f64, f64), (x1, y1): (f64, f64), x: f64) -> f64 {
    if x1 <= 0.0 || y0 <= 0.0 || y1 <= 0.0 {
        return y1;
    }
    let part = (x / x0).ln() / (x1 / x0).ln();
    y0 * (y1 / y0).powf(part)
}

impl ProblemRecord {
    /// All methods that reach an error, with their times, the fastest first.
    pub fn fastest(&self, target: f64) -> Vec<(&Curve, Cost)> {
        let mut found: Vec<_> = self
            .curves
            .iter()
            .map(|curve| (curve, curve.cost(target)))
            .filter(|(_, cost)| cost.seconds().is_some())
            .collect();
        let seconds = |cost: &Cost| cost.seconds().unwrap_or(f64::INFINITY);
        found.sort_by(|a, b| seconds(&a.1).total_cmp(&seconds(&b.1)));
        found
    }
}

impl Measurements {
    /// The fastest method of a kind on a problem for a given error.
    pub fn fastest_of<'a>(
        &self,
        kind: Kind,
        problem: &'a ProblemRecord,
        target: f64,
    ) -> Option<(&'a Curve, Cost)> {
        let fastest = problem.fastest(target).into_iter();
        let is_kind = |curve: &Curve| self.method(&curve.method).is_some_and(|m| m.kind == kind);
        fastest.into_iter().find(|(curve, _)| is_kind(curve))
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::tests::curve;

    #[test]
    fn a_time_lies_between_two_runs() {
        // Error = seconds⁻².
        let curve = curve("a", &[(1e-2, 10.0), (1e-6, 1e3)]);
        let Cost::Between { seconds } = curve.cost(1e-4) else {
            panic!("{:?}", curve.cost(1e-4));
        };
        assert!((seconds / 100.0 - 1.0).abs() < 1e-14);
        // Exact at a run.
        assert_eq!(curve.cost(1e-6), Cost::Between { seconds: 1e3 });
    }

    #[test]
    fn the_cost_is_not_extrapolated() {
        let curve = curve("a", &[(1e-4, 10.0), (1e-6, 1e3)]);
        assert_eq!(curve.cost(1e-3), Cost::AtMost { seconds: 10.0 });
        assert_eq!(curve.cost(1e-7), Cost::NotReached { best: 1e-6 });
        assert_eq!(empty().cost(1.0), Cost::NoRun);
    }

    #[test]
    fn an_accidentally_small_error_does_not_count() {
        let curve = curve("a", &[(1e-2, 1.0), (1e-9, 2.0), (1e-3, 3.0), (1e-4, 10.0)]);
        let Cost::Between { seconds } = curve.cost(3e-4) else {
            panic!("{:?}", curve.cost(3e-4));
        };
        assert!(seconds > 3.0 && seconds < 10.0);
        // No run follows the last run.
        assert_eq!(curve.cost(1e-4).seconds(), Some(10.0));
    }

    fn empty() -> Curve {
        curve("a", &[])
    }

    #[test]
    fn the_fastest_is_first_and_of_its_kind() {
        let measurements = crate::tests::measurements();
        let problem = &measurements.problems[0];
        let names: Vec<&str> = problem
            .fastest(1e-3)
            .iter()
            .map(|(curve, _)| curve.method.as_str())
            .collect();
        assert_eq!(names, ["Gauss 4", "DOP853", "Verlet"]);
        let of = |kind, target| {
            let found = measurements.fastest_of(kind, problem, target);
            found.map(|(curve, _)| curve.method.as_str())
        };
        assert_eq!(of(Kind::Explicit, 1e-3), Some("Verlet"));
        assert_eq!(of(Kind::Explicit, 1e-9), None);
        assert_eq!(of(Kind::Peer, 1e-3), Some("DOP853"));
    }
}
