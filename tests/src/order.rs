//! The observed order of a method.

use std::fmt;

/// The line through the points `(log h, log error)` of several runs.
#[derive(Clone, Debug)]
pub struct ObservedOrder {
    /// Its slope, by least squares over all runs.
    pub slope: f64,
    /// The correlation coefficient of the points, 1 on a straight line.
    pub correlation: f64,
    /// The largest distance of a point from the line, as a factor of the error; 1 on the line.
    pub residual: f64,
    /// The slopes between consecutive runs.
    pub pairs: Vec<f64>,
}

impl ObservedOrder {
    /// The observed order of runs `(step size, error)`, with monotone step sizes.
    ///
    /// NaN for fewer than two different step sizes, or if an error is not positive.
    pub fn of(runs: &[(f64, f64)]) -> Self {
        let points: Vec<(f64, f64)> = runs.iter().map(|(h, error)| (h.ln(), error.ln())).collect();
        let count = points.len() as f64;
        let mean_x = points.iter().map(|point| point.0).sum::<f64>() / count;
        let mean_y = points.iter().map(|point| point.1).sum::<f64>() / count;
        let sum = |product: fn(f64, f64) -> f64| -> f64 {
            let products = points.iter().map(|(x, y)| product(x - mean_x, y - mean_y));
            products.sum()
        };
        let (xx, xy, yy) = (sum(|x, _| x * x), sum(|x, y| x * y), sum(|_, y| y * y));
        let slope = xy / xx;
        let distances = points
            .iter()
            .map(|(x, y)| (y - mean_y - slope * (x - mean_x)).abs());
        Self {
            slope,
            correlation: xy / (xx * yy).sqrt(),
            residual: distances
                .fold(0.0_f64, |a, b| if b.is_nan() { b } else { a.max(b) })
                .exp(),
            pairs: points
                .windows(2)
                .map(|pair| (pair[1].1 - pair[0].1) / (pair[1].0 - pair[0].0))
                .collect(),
        }
    }

    /// Whether the runs show exactly `order`: the fitted slope and the slope of *every* pair of neighbours (hence of
    /// every pair of runs) are within `tolerance` of it, and the correlation is at least 0.9999.
    ///
    /// A higher order than expected does not pass, either.
    pub fn shows(&self, order: f64, tolerance: f64) -> bool {
        let near = |slope: &f64| (slope - order).abs() <= tolerance;
        !self.pairs.is_empty()
            && near(&self.slope)
            && self.pairs.iter().all(near)
            && self.correlation >= 0.9999
    }
}

impl fmt::Display for ObservedOrder {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        write!(f, "slope {:.3} (", self.slope)?;
        for (index, pair) in self.pairs.iter().enumerate() {
            write!(f, "{}{pair:.3}", if index == 0 { "" } else { ", " })?;
        }
        write!(
            f,
            " between neighbours), correlation {:.6}, off the line by a factor {:.3}",
            self.correlation, self.residual
        )
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_power_has_its_exponent() {
        let order = ObservedOrder::of(&[(0.4, 0.4_f64.powi(3)), (0.2, 0.008), (0.1, 0.001)]);
        assert!(order.shows(3.0, 1e-12), "{order}");
        assert!(order.residual < 1.0 + 1e-12);
    }

    #[test]
    fn one_pair_off_the_line_is_not_an_order() {
        let error = |i: i32| 4.0_f64.powi(-i) * if i == 5 { 2.0_f64.powf(0.15) } else { 1.0 };
        let runs: Vec<(f64, f64)> = (0..6).map(|i| (2.0_f64.powi(-i), error(i))).collect();
        let order = ObservedOrder::of(&runs);
        // The fit alone would pass: one pair of five has slope 1.85.
        assert!(
            (order.slope - 2.0).abs() < 0.1 && order.correlation > 0.9999,
            "{order}"
        );
        assert!(!order.shows(2.0, 0.1) && order.shows(2.0, 0.2), "{order}");
    }

    #[test]
    fn scattered_points_are_not_an_order() {
        let order = ObservedOrder::of(&[(0.4, 0.16), (0.2, 0.06), (0.1, 0.01)]);
        assert!((order.slope - 2.0).abs() < 0.1, "{order}");
        assert!(
            order.correlation < 0.9999 && !order.shows(2.0, 1.0),
            "{order}"
        );
    }

    #[test]
    fn another_order_or_a_broken_run_does_not_pass() {
        let cubic = ObservedOrder::of(&[(0.4, 0.064), (0.2, 0.008)]);
        assert!(!cubic.shows(2.0, 0.5) && !cubic.shows(4.0, 0.5));
        for error in [0.0, f64::NAN, f64::INFINITY] {
            assert!(
                !ObservedOrder::of(&[(0.4, 0.16), (0.2, 0.04), (0.1, error)]).shows(2.0, 100.0)
            );
        }
        assert!(!ObservedOrder::of(&[(0.4, 0.16)]).shows(2.0, 100.0));
    }
}
