//! Starts on an energy surface.

/// The largest, or the smallest, p with H = `energy`; `None` if there is none. `at` gives H and ∂H/∂p. H is convex in p, as a kinetic
/// energy is; Newton's iteration from outside then approaches the root from one side.
pub(super) fn outer_root(
    at: impl Fn(f64) -> [f64; 2],
    energy: f64,
    is_largest: bool,
) -> Option<f64> {
    let side = if is_largest { 1.0 } else { -1.0 };
    let at = |x: f64| {
        let [value, slope] = at(side * x);
        [value - energy, side * slope]
    };
    let mut x = outside(&at)?;
    let [mut value, mut slope] = at(x);
    // A double root halves the distance only.
    for _ in 0..5000 {
        let next = x - value / slope;
        if next >= x || next.is_nan() {
            break;
        }
        let [next_value, next_slope] = at(next);
        if next_value < 0.0 {
            return Some(side * between(&at, [next, x]));
        }
        if !(next_slope > 0.0 && next_value < value) {
            // The least H is above the energy, or the energy except for rounding.
            break;
        }
        (x, value, slope) = (next, next_value, next_slope);
    }
    let noise = 16.0 * f64::EPSILON * (energy.abs() + (value + energy).abs());
    let is_near = value <= noise || value <= 4.0 * f64::EPSILON * x * slope;
    is_near.then_some(side * x)
}

/// A point where the function is finite, not negative, and grows outward. A function that is not defined far out, such as
/// `-√(1 - p²)`, is followed to its end.
fn outside(at: &impl Fn(f64) -> [f64; 2]) -> Option<f64> {
    let (mut inner, mut end) = (0.0, None);
    let mut x = 1.0;
    loop {
        let [value, slope] = at(x);
        let next = match value.is_finite() && slope.is_finite() {
            true if value >= 0.0 && slope > 0.0 => return Some(x),
            true => {
                inner = x;
                end.map_or(2.0 * x, |end| 0.5 * (x + end))
            }
            false => {
                end = Some(x);
                0.5 * (inner + x)
            }
        };
        if !next.is_finite() || next <= inner || end.is_some_and(|end| next >= end) {
            return None;
        }
        x = next;
    }
}

/// The point where a sign changes, of the two neighbours the one with the smaller value.
fn between(at: &impl Fn(f64) -> [f64; 2], [mut low, mut high]: [f64; 2]) -> f64 {
    loop {
        let middle = 0.5 * (low + high);
        if !(low < middle && middle < high) {
            let smaller = at(low)[0].abs() < at(high)[0].abs();
            return if smaller { low } else { high };
        }
        match at(middle)[0] < 0.0 {
            true => low = middle,
            false => high = middle,
        }
    }
}

#[cfg(test)]
mod tests {
    use super::outer_root;

    #[test]
    fn roots_of_convex_functions_are_found() {
        let square = |p: f64| [p * p / 2.0, p];
        let shifted = |p: f64| [(p - 3.0) * (p - 3.0) / 2.0 - 1.0, p - 3.0];
        let relativistic = |p: f64| [(1.0 + p * p).sqrt(), p / (1.0 + p * p).sqrt()];
        let quartic = |p: f64| [p.powi(4), 4.0 * p.powi(3)];
        let close = |found: Option<f64>, expected: f64| {
            let found = found.expect("a root");
            // An error of H by rounding is divided by the slope; of a double root it is the root of it.
            assert!(
                (found - expected).abs() <= 1e-15 * expected.abs(),
                "{found} {expected}"
            );
        };
        close(outer_root(square, 2.0, true), 2.0);
        close(outer_root(square, 2.0, false), -2.0);
        close(outer_root(square, 2e-300, true), 2e-150);
        close(outer_root(square, 2e200, true), 2e100);
        close(outer_root(shifted, 1.0, true), 5.0);
        close(outer_root(shifted, 1.0, false), 1.0);
        close(outer_root(relativistic, 1.25, true), 0.75);
        close(outer_root(quartic, 16.0, false), -2.0);
        // The least value is a root of rounded numbers.
        let rounded = outer_root(|p| [p * p / 2.0 + 0.1 + 0.2, p], 0.3, true);
        assert!(rounded.expect("a root").abs() < 1e-7, "{rounded:?}");
        for energy in [-1e-3, f64::NAN, f64::INFINITY] {
            assert_eq!(outer_root(square, energy, true), None);
        }
        // Bounded above, and without momentum.
        assert_eq!(
            outer_root(|p| [p.tanh(), 1.0 - p.tanh().powi(2)], 2.0, true),
            None
        );
        assert_eq!(outer_root(|_| [1.0, 0.0], 0.5, true), None);
        // Not defined beyond a momentum.
        for largest in [1.0, 1.5, 0.01, 40.0] {
            let beam = |p: f64| {
                let root = (largest * largest - p * p).sqrt();
                [-root, p / root]
            };
            for part in [0.9, 0.5, 1e-3] {
                let energy = -part * largest;
                let expected = largest * (1.0 - part * part).sqrt();
                let found = outer_root(beam, energy, true).expect("a root");
                assert!((found / expected - 1.0).abs() < 1e-14, "{found} {expected}");
                assert_eq!(outer_root(beam, energy, false), Some(-found));
            }
            for energy in [0.5, -2.0 * largest] {
                assert_eq!(outer_root(beam, energy, true), None);
            }
        }
    }
}
