//! The elementary functions of doubles, against 71 digits.
//!
//! The runtime promises an error below one unit in the last place. Worst of these arguments, without the feature `fma`: sine 0.75,
//! cosine 0.75, exponential function 0.82, logarithm 0.73.

use std::f64::consts::{FRAC_PI_2, LN_2};

use symplectic::Scalar;
use symplectic_tests::references::Wide;

/// Numbers spread evenly over (−1, 1), the same in every run.
fn even(count: u32) -> impl Iterator<Item = f64> {
    (1..=count).map(|k| 2.0 * (f64::from(k) * 0.618_033_988_749_894_9).fract() - 1.0)
}

/// The largest error of `found` over `arguments`, in units in the last place of what is right, and where it is.
fn worst(
    found: fn(f64) -> f64,
    right: fn(Wide) -> Wide,
    arguments: impl IntoIterator<Item = f64>,
) -> (f64, f64) {
    let mut worst = (0.0, f64::NAN);
    for x in arguments {
        let right = right(Wide::from_f64(x));
        let size = right.magnitude();
        let unit = (size.next_up() - size).max(f64::from_bits(1));
        let error = (Wide::from_f64(found(x)) - right).magnitude() / unit;
        assert!(error.is_finite(), "at {x:e}");
        if error > worst.0 {
            worst = (error, x);
        }
    }
    worst
}

/// Where the doubles come closest to multiples of π/2, up to 8·10⁵: all others are further away, in units of themselves.
fn next_to_multiples() -> impl Iterator<Item = f64> {
    let closest = (0..7).map(|k| 45.553_093_477_052_f64 * 2.0_f64.powi(k));
    let spread = (1..2000).map(|k| f64::from(k * 254) * FRAC_PI_2);
    closest.chain([321_307.959_442_222_9]).chain(spread)
}

/// What sines and cosines are asked for.
fn angles() -> impl Iterator<Item = f64> {
    let ranges = [1e-9, 0.1, 1.0, 10.0, 1e3, 7.99e5, 1e15];
    let spread = ranges
        .into_iter()
        .flat_map(|range| even(1500).map(move |x| range * x));
    // Where n π/2 + y has the largest y, and where n changes.
    let changes = (0..200).map(|n| (f64::from(n) + 0.5) * FRAC_PI_2);
    let beside = changes.flat_map(|x| [x, x + 1e-9, x - 1e-9]);
    spread.chain(beside).chain(next_to_multiples())
}

#[test]
fn sine_and_cosine_are_within_a_unit() {
    let (sine, at) = worst(Scalar::sin, Scalar::sin, angles());
    assert!((0.6..0.8).contains(&sine), "{sine} at {at:e}");
    let (cosine, at) = worst(Scalar::cos, Scalar::cos, angles());
    assert!((0.6..0.8).contains(&cosine), "{cosine} at {at:e}");
}

#[test]
fn the_exponential_function_is_within_a_unit() {
    let ranges = [1e-12, 0.4, 2.0, 707.9];
    let spread = ranges
        .into_iter()
        .flat_map(|range| even(2500).map(move |x| range * x));
    let changes = (-1020..1020).map(|k| (f64::from(k) + 0.5) * LN_2);
    let beyond = [708.5, 709.7, -708.3, -720.0, -745.0];
    let (error, at) = worst(
        Scalar::exp,
        Scalar::exp,
        spread.chain(changes).chain(beyond),
    );
    assert!((0.6..0.95).contains(&error), "{error} at {at:e}");
}

#[test]
fn the_logarithm_is_within_a_unit() {
    let near_one = even(5000).flat_map(|x| [1.0 + 0.5 * x, 1.0 + 1e-5 * x]);
    let powers = (-1020..1020).map(|k| 1.3 * 2.0_f64.powi(k));
    let changes = (-300..300).map(|k| std::f64::consts::SQRT_2 * 2.0_f64.powi(k));
    let beyond = [5e-324, 1e-310];
    let all = near_one.chain(powers).chain(changes).chain(beyond);
    let (error, at) = worst(Scalar::ln, Scalar::ln, all);
    assert!((0.6..0.95).contains(&error), "{error} at {at:e}");
}
