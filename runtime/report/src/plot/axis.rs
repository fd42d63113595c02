//! Axes: mapping of values to positions, and ticks.

use crate::text;

/// The scale of an axis.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Scale {
    Linear,
    Logarithmic,
}

/// An axis from a value to another, which may be smaller.
#[derive(Clone, Debug, PartialEq)]
pub struct Axis {
    pub label: String,
    pub scale: Scale,
    /// The value at the start; `to` is the value at the end.
    pub from: f64,
    pub to: f64,
}

impl Axis {
    /// A logarithmic axis over the decades that contain the positive values, at least one decade; `None` if no value is
    /// positive.
    pub fn decades(label: &str, values: impl Iterator<Item = f64>) -> Option<Self> {
        let (low, high) = range(values.filter(|value| *value > 0.0))?;
        // Tolerate rounding errors at powers of ten.
        let (low, high) = ((low.log10() + 1e-9).floor(), (high.log10() - 1e-9).ceil());
        let high = if high <= low { low + 1.0 } else { high };
        Some(Self {
            label: label.into(),
            scale: Scale::Logarithmic,
            from: 10_f64.powf(low),
            to: 10_f64.powf(high),
        })
    }

    /// A linear axis over the values with a margin; `None` without values.
    pub fn linear(label: &str, values: impl Iterator<Item = f64>) -> Option<Self> {
        let (low, high) = range(values)?;
        let margin = if high > low { 0.06 * (high - low) } else { 1.0 };
        Some(Self {
            label: label.into(),
            scale: Scale::Linear,
            from: low - margin,
            to: high + margin,
        })
    }

    /// The axis with its ends exchanged.
    pub fn reversed(self) -> Self {
        Self {
            from: self.to,
            to: self.from,
            ..self
        }
    }

    /// The position of a value: 0 at the start, 1 at the end.
    pub fn place(&self, value: f64) -> f64 {
        match self.scale {
            Scale::Linear => (value - self.from) / (self.to - self.from),
            Scale::Logarithmic => (value / self.from).log10() / (self.to / self.from).log10(),
        }
    }

    /// The labelled ticks.
    pub fn ticks(&self) -> Vec<(f64, String)> {
        match self.scale {
            Scale::Linear => self.round_ticks(),
            Scale::Logarithmic => {
                let (low, high) = self.exponents();
                let every = (1..).find(|every| (high - low) / every <= 9).unwrap_or(1);
                let labelled = (low..=high).filter(|exponent| exponent % every == 0);
                labelled
                    .map(|k| (10_f64.powi(k), text::power_of_ten(k)))
                    .collect()
            }
        }
    }

    /// The short ticks without labels: 2, …, 9 times the powers of ten, or on long axes the powers of ten themselves.
    pub fn minor_ticks(&self) -> Vec<f64> {
        if self.scale == Scale::Linear {
            return Vec::new();
        }
        let (low, high) = self.exponents();
        if high - low > 9 {
            return (low..=high).map(|k| 10_f64.powi(k)).collect();
        }
        let decade = |k| (2..10).map(move |digit| f64::from(digit) * 10_f64.powi(k));
        (low..high).flat_map(decade).collect()
    }

    fn exponents(&self) -> (i32, i32) {
        let (from, to) = (
            self.from.log10().round() as i32,
            self.to.log10().round() as i32,
        );
        (from.min(to), from.max(to))
    }

    /// About five multiples of 1, 2 or 5 times a power of ten.
    fn round_ticks(&self) -> Vec<(f64, String)> {
        let (low, high) = (self.from.min(self.to), self.from.max(self.to));
        let raw = (high - low) / 5.0;
        let power = 10_f64.powf(raw.log10().floor());
        let step = [1.0, 2.0, 5.0, 10.0]
            .map(|digit| digit * power)
            .into_iter()
            .find(|step| *step >= raw * (1.0 - 1e-9))
            .unwrap_or(10.0 * power);
        let exponent = step.log10().floor() as i32;
        let (first, last) = ((low / step).ceil() as i64, (high / step).floor() as i64);
        (first..=last)
            .map(|k| {
                let value = k as f64 * step;
                let label = match exponent {
                    _ if k == 0 => "0".into(),
                    -3..=5 => format!("{value:.*}", (-exponent).max(0) as usize).replace('-', "−"),
                    _ => {
                        let digits = value / 10_f64.powi(exponent);
                        let power = text::power_of_ten(exponent);
                        format!("{digits:.0}·{power}").replace('-', "−")
                    }
                };
                (value, label)
            })
            .collect()
    }
}

/// The smallest and the largest finite value.
fn range(values: impl Iterator<Item = f64>) -> Option<(f64, f64)> {
    values
        .filter(|value| value.is_finite())
        .fold(None, |range, value| {
            let (low, high) = range.unwrap_or((value, value));
            Some((value.min(low), value.max(high)))
        })
}

#[cfg(test)]
mod tests {
    use super::*;

    fn labels(axis: &Axis) -> Vec<String> {
        axis.ticks().into_iter().map(|(_, label)| label).collect()
    }

    #[test]
    fn decades_hold_the_values() {
        let axis = Axis::decades("s", [0.0, 3e-4, 0.1].into_iter()).expect("positive values");
        assert!((axis.from / 1e-4 - 1.0).abs() < 1e-12 && (axis.to / 0.1 - 1.0).abs() < 1e-12);
        assert_eq!(labels(&axis), ["10⁻⁴", "10⁻³", "10⁻²", "10⁻¹"]);
        assert_eq!(axis.minor_ticks().len(), 24);
        assert!((axis.place(1e-2) - 2.0 / 3.0).abs() < 1e-12);
        assert!((axis.reversed().place(1e-2) - 1.0 / 3.0).abs() < 1e-12);
        assert_eq!(Axis::decades("s", [0.0, f64::NAN].into_iter()), None);
        let one = Axis::decades("s", [10.0].into_iter()).expect("a positive value");
        assert_eq!(labels(&one), ["10", "10²"]);
    }

    #[test]
    fn long_ranges_have_fewer_labels() {
        let axis = Axis::decades("error", [1e-14, 1.0].into_iter()).expect("positive values");
        assert_eq!(labels(&axis)[..3], ["10⁻¹⁴", "10⁻¹²", "10⁻¹⁰"]);
        assert_eq!(axis.minor_ticks().len(), 15);
    }

    #[test]
    fn a_linear_axis_has_round_labels() {
        let axis = Axis::linear("t", [0.0, 100.0].into_iter()).expect("values");
        assert_eq!(labels(&axis), ["0", "50", "100"]);
        let axis = Axis::linear("t", [-0.012, 0.03].into_iter()).expect("values");
        assert_eq!(labels(&axis), ["−0.01", "0", "0.01", "0.02", "0.03"]);
        let axis = Axis::linear("t", [0.0, 5e-8].into_iter()).expect("values");
        assert_eq!(labels(&axis)[2], "4·10⁻⁸");
        assert!(Axis::linear("t", [1.0].into_iter()).is_some());
    }
}
