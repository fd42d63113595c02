//! The sequence of step sizes of a method.

use super::Parameter;

/// The step sizes or tolerances of the runs of a method.
#[derive(Clone, Debug, PartialEq)]
pub enum Ladder {
    /// Decreasing step sizes from `first`, each for about a tenth of the previous error. The sequence ends when the
    /// error is below the finest target, when it no longer decreases, or when a run would exceed the budget.
    Descend {
        /// The first step size.
        first: f64,
    },
    /// `first`, `first/2`, `first/4`, …, with `halvings` halvings.
    Halve {
        /// The first step size.
        first: f64,
        /// Number of halvings.
        halvings: u32,
    },
    /// The given tolerances, from coarse to fine.
    Tolerances(Vec<f64>),
}

impl Ladder {
    /// The tolerances 10^−`coarse`, …, 10^−`fine`.
    ///
    /// ```
    /// use symplectic_report::Ladder;
    ///
    /// assert_eq!(Ladder::decades(2, 4), Ladder::Tolerances(vec![1e-2, 1e-3, 1e-4]));
    /// ```
    pub fn decades(coarse: u32, fine: u32) -> Self {
        // Parsing yields the nearest doubles.
        let power = |exponent| format!("1e-{exponent}").parse().unwrap_or(f64::NAN);
        Self::Tolerances((coarse..=fine).map(power).collect())
    }

    pub(super) const fn parameter(&self) -> Parameter {
        match self {
            Self::Descend { .. } | Self::Halve { .. } => Parameter::StepSize,
            Self::Tolerances(_) => Parameter::Tolerance,
        }
    }

    /// Starts a descent to errors below `target`.
    pub(super) fn descent(&self, target: f64) -> Descent {
        let listed = match self {
            Self::Descend { .. } => Vec::new(),
            Self::Halve { first, halvings } => {
                let size = |k| first / f64::from(k).exp2();
                (0..=*halvings).map(size).collect()
            }
            Self::Tolerances(listed) => listed.clone(),
        };
        let next = match self {
            Self::Descend { first } => Some(*first),
            Self::Halve { .. } | Self::Tolerances(_) => listed.first().copied(),
        };
        Descent {
            listed: matches!(self, Self::Halve { .. } | Self::Tolerances(_)).then_some(listed),
            target,
            next,
            tried: 0,
            failures: 0,
            last: None,
            best: f64::INFINITY,
            in_vain: 0,
        }
    }
}

/// The state of a descent along a [`Ladder`].
#[derive(Clone, Debug)]
pub(super) struct Descent {
    listed: Option<Vec<f64>>,
    target: f64,
    next: Option<f64>,
    tried: usize,
    /// Number of consecutive failures.
    failures: u32,
    /// The parameter and the error of the last successful run.
    last: Option<(f64, f64)>,
    best: f64,
    /// Number of consecutive runs that did not improve the best error.
    in_vain: u32,
}

/// Largest number of points of a curve.
const POINTS: usize = 48;
/// Errors from here on carry no information about the order.
const LOST: f64 = 0.1;

impl Descent {
    /// The parameter to try next.
    pub const fn next(&self) -> Option<f64> {
        self.next
    }

    /// Records the result of the run with the parameter [`next`](Self::next): its error, or `None` if it failed.
    pub fn take(&mut self, error: Option<f64>) {
        let Some(present) = self.next else { return };
        self.tried += 1;
        self.failures = if error.is_none() {
            self.failures + 1
        } else {
            0
        };
        self.next = match &self.listed {
            Some(listed) => listed.get(self.tried).copied(),
            None => self.step(present, error),
        };
        if let Some(error) = error {
            self.last = Some((present, error));
            self.best = self.best.min(error);
        }
    }

    /// The next step size.
    fn step(&mut self, present: f64, error: Option<f64>) -> Option<f64> {
        if self.tried == POINTS || self.failures == 12 {
            return None;
        }
        let Some(error) = error.filter(|error| *error < LOST) else {
            return Some(present / 2.0);
        };
        self.in_vain = if error < 0.7 * self.best {
            0
        } else {
            self.in_vain + 1
        };
        // Small errors that stagnate are rounding errors; large errors may still decrease.
        let patience = if self.best < 1e-8 { 2 } else { 5 };
        // Continue beyond the target, so that the plot shows the trend.
        if error < self.target / 3.0 || self.in_vain == patience {
            return None;
        }
        let order = self
            .last
            .map(|(size, before)| (before / error).ln() / (size / present).ln());
        // Aim at a tenth of the error. Halve the step size if the order is unknown; reduce by at most 2 without
        // progress.
        let factor = match order {
            Some(order) if order > 0.0 => 10_f64.powf(order.recip()).clamp(1.1, 4.0),
            _ => 2.0,
        };
        Some(
            present
                / if self.in_vain > 0 {
                    factor.min(2.0)
                } else {
                    factor
                },
        )
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    /// The step sizes and errors of a method with errors `error(h)`.
    fn walk(error: impl Fn(f64) -> Option<f64>) -> Vec<(f64, Option<f64>)> {
        let mut descent = Ladder::Descend { first: 1.0 }.descent(1e-12);
        let mut points = Vec::new();
        while let Some(size) = descent.next() {
            points.push((size, error(size)));
            descent.take(error(size));
        }
        points
    }

    #[test]
    fn the_ladder_reduces_the_error_tenfold_for_any_order() {
        for order in [2, 4, 8, 16] {
            let points = walk(|h| Some(0.05 * h.powi(order)));
            let errors: Vec<f64> = points.iter().filter_map(|point| point.1).collect();
            // Error ratios, except for the first two, where the order is unknown; limited by the clamp on a step.
            let limits = (
                9.9_f64.min(4_f64.powi(order)),
                10.1_f64.max(1.1_f64.powi(order)),
            );
            for pair in errors[1..].windows(2) {
                let ratio = pair[0] / pair[1];
                assert!(
                    ratio >= limits.0 && ratio <= limits.1,
                    "order {order}: {ratio}"
                );
            }
            let last = errors[errors.len() - 1];
            assert!(
                last < 1e-12 / 3.0 && last > 1e-14,
                "order {order}: {last:e}"
            );
        }
    }

    #[test]
    fn the_ladder_ends_where_rounding_dominates() {
        let points = walk(|h| Some(h.powi(4) + 1e-10));
        let finest = points[points.len() - 1].0;
        assert!(
            points.len() < 16 && finest < 3e-3 && finest > 1e-4,
            "{points:?}"
        );
    }

    #[test]
    fn the_ladder_continues_below_failed_and_inaccurate_runs() {
        let points = walk(|h| (h < 0.3).then_some(if h < 0.1 { h * h * h } else { 7.0 }));
        assert_eq!(points[0], (1.0, None));
        assert_eq!(points[2], (0.25, Some(7.0)));
        assert!(
            points[points.len() - 1]
                .1
                .is_some_and(|error| error < 1e-12 / 3.0)
        );
        // The descent also ends if every run fails.
        assert_eq!(walk(|_| None).len(), 12);
        assert_eq!(walk(|_| Some(5.0)).len(), POINTS);
    }

    #[test]
    fn a_listed_ladder_has_the_given_step_sizes() {
        let mut descent = Ladder::Halve {
            first: 1.0,
            halvings: 2,
        }
        .descent(1e-12);
        let mut sizes = Vec::new();
        while let Some(size) = descent.next() {
            sizes.push(size);
            descent.take(None);
        }
        assert_eq!(sizes, [1.0, 0.5, 0.25]);
        assert_eq!(Ladder::Tolerances(Vec::new()).descent(1e-12).next(), None);
    }
}
