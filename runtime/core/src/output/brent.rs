//! Zeros and minima of a function of time, by Brent's methods (*Algorithms for Minimization without Derivatives*,
//! 1973).

/// The last time before a zero of a function with opposite signs at two times, by Brent's method (ch. 4): inverse
/// quadratic interpolation and secants, with bisection where they converge badly.
///
/// At the returned time the function is zero or has the sign of its value at the first time. The sign change lies within two units in the
/// last place of the time. Returns `None` if the signs agree.
pub(crate) fn before_zero<E>(
    (mut a, mut b): (f64, f64),
    mut function: impl FnMut(f64) -> Result<f64, E>,
) -> Result<Option<f64>, E> {
    // b is the best estimate, a the previous one; the zero lies between b and c.
    let (mut at_a, mut at_b) = (function(a)?, function(b)?);
    let (mut c, mut at_c) = (a, at_a);
    if at_a == 0.0 || at_b == 0.0 {
        return Ok(Some(if at_b == 0.0 { b } else { a }));
    }
    if (at_a > 0.0) == (at_b > 0.0) {
        return Ok(None);
    }
    let first_is_positive = at_a > 0.0;
    // The one of b and c that lies on the side of the first time.
    let side_of_first = |b: f64, at_b: f64, c: f64| {
        let first = at_b == 0.0 || (at_b > 0.0) == first_is_positive;
        Ok(Some(if first { b } else { c }))
    };
    let (mut step, mut before) = (b - a, b - a);
    loop {
        if at_c.abs() < at_b.abs() {
            (a, b, c) = (b, c, b);
            (at_a, at_b, at_c) = (at_b, at_c, at_b);
        }
        let tolerance = f64::EPSILON * b.abs();
        let half = 0.5 * (c - b);
        if at_b == 0.0 || half.abs() <= tolerance {
            return side_of_first(b, at_b, c);
        }
        if before.abs() < tolerance || at_a.abs() <= at_b.abs() {
            (step, before) = (half, half);
        } else {
            let s = at_b / at_a;
            let (numerator, denominator) = if a == c {
                (2.0 * half * s, 1.0 - s)
            } else {
                let (q, r) = (at_a / at_c, at_b / at_c);
                let numerator = s * (2.0 * half * q * (q - r) - (b - a) * (r - 1.0));
                (numerator, (q - 1.0) * (r - 1.0) * (s - 1.0))
            };
            let (numerator, denominator) = if numerator > 0.0 {
                (numerator, -denominator)
            } else {
                (-numerator, denominator)
            };
            let inside = 3.0 * half * denominator - (tolerance * denominator).abs();
            if 2.0 * numerator < inside.min((before * denominator).abs()) {
                (before, step) = (step, numerator / denominator);
            } else {
                (step, before) = (half, half);
            }
        }
        (a, at_a) = (b, at_b);
        let moved = b + if step.abs() > tolerance {
            step
        } else {
            tolerance.copysign(half)
        };
        // At b = 0 or nearby the tolerance underflows.
        b = if moved == b { b + half } else { moved };
        if b == a {
            return side_of_first(b, at_b, c);
        }
        at_b = function(b)?;
        if (at_b > 0.0) == (at_c > 0.0) {
            (c, at_c) = (a, at_a);
            (step, before) = (b - a, b - a);
        }
    }
}

/// A time between two others at which a function is negative. Brent's minimisation (ch. 5), by golden sections and
/// parabolas, stops at the first negative value.
///
/// The minimum is located to about 1e-8 of the distance between the times. Returns `None` if the function is not
/// negative there.
pub(crate) fn negative_near_minimum<E>(
    (from, to): (f64, f64),
    mut function: impl FnMut(f64) -> Result<f64, E>,
) -> Result<Option<f64>, E> {
    const GOLDEN: f64 = 0.381_966_011_250_105_1;
    let (mut low, mut high) = (from.min(to), from.max(to));
    let tolerance = 1e-8 * (high - low) + f64::EPSILON * low.abs().max(high.abs());
    // x is the best estimate, w the second best, v the previous w.
    let mut x = low + GOLDEN * (high - low);
    let mut at_x = function(x)?;
    let (mut w, mut v, mut at_w, mut at_v) = (x, x, at_x, at_x);
    let (mut step, mut before) = (0.0_f64, 0.0_f64);
    for _ in 0..MAX_STEPS_TO_MINIMUM {
        if at_x < 0.0 {
            return Ok(Some(x));
        }
        let middle = 0.5 * (low + high);
        if (x - middle).abs() + 0.5 * (high - low) <= 2.0 * tolerance {
            break;
        }
        let (r, q) = ((x - w) * (at_x - at_v), (x - v) * (at_x - at_w));
        let (numerator, denominator) = ((x - v) * q - (x - w) * r, 2.0 * (q - r));
        let parabola = -numerator / denominator;
        let good = parabola.abs() < 0.5 * before.abs() && low < x + parabola && x + parabola < high;
        if good {
            (before, step) = (step, parabola);
        } else {
            before = if x < middle { high - x } else { low - x };
            step = GOLDEN * before;
        }
        let u = x + if step.abs() >= tolerance {
            step
        } else {
            tolerance.copysign(step)
        };
        let at_u = function(u)?;
        if at_u <= at_x {
            *(if u < x { &mut high } else { &mut low }) = x;
            (v, w, x) = (w, x, u);
            (at_v, at_w, at_x) = (at_w, at_x, at_u);
        } else {
            *(if u < x { &mut low } else { &mut high }) = u;
            if at_u <= at_w || w == x {
                (v, w) = (w, u);
                (at_v, at_w) = (at_w, at_u);
            } else if at_u <= at_v || v == x || v == w {
                (v, at_v) = (u, at_u);
            }
        }
    }
    Ok(None)
}

/// Golden sections alone need 40 steps.
const MAX_STEPS_TO_MINIMUM: u32 = 100;

#[cfg(test)]
mod tests {
    use super::{before_zero, negative_near_minimum};

    fn zero(between: (f64, f64), function: impl Fn(f64) -> f64) -> (f64, u32) {
        let mut count = 0;
        let found = before_zero(between, |t| {
            count += 1;
            Ok::<f64, ()>(function(t))
        });
        let found = found.expect("no error");
        (found.expect("a change of sign"), count)
    }

    #[test]
    fn zeros_are_found_to_rounding() {
        let near =
            |found: f64, wanted: f64| (found - wanted).abs() <= 4.0 * f64::EPSILON * wanted.abs();
        let (root, count) = zero((1.0, 2.0), |t| t * t - 2.0);
        assert!(near(root, 2.0_f64.sqrt()) && count < 12, "{root} {count}");
        // Reversed interval, falling function.
        let (root, count) = zero((2.0, 1.0), |t| 2.0 - t * t);
        assert!(near(root, 2.0_f64.sqrt()) && count < 12, "{root} {count}");
        let (root, count) = zero((1e6, 1e6 + 1.0), |t| (t - 1e6 - 0.3).sin());
        assert!(near(root, 1e6 + 0.3) && count < 12, "{root} {count}");
        // Zeros at the ends of the interval.
        assert_eq!(zero((0.0, 1.0), |t| t).0, 0.0);
        assert_eq!(zero((0.0, 1.0), |t| t - 1.0).0, 1.0);
    }

    /// Where interpolation fails, bisection takes over and the search terminates.
    #[test]
    fn the_search_for_a_zero_ends_for_ill_behaved_functions() {
        let (root, count) = zero((-1.0, 2.0), |t| if t < 1.0 / 3.0 { -1.0 } else { 1.0 });
        assert!(
            (root - 1.0 / 3.0).abs() < 1e-15 && count < 120,
            "{root} {count}"
        );
        let (root, count) = zero((-1.0, 1.5), |t| t.powi(9));
        assert!(root.abs() < 1e-6 && count < 1500, "{root} {count}");
        let (root, count) = zero((-1.0, 4.0), |t| t * (1.0 + t * t));
        assert!(root.abs() < 1e-15 && count < 50, "{root} {count}");
        assert_eq!(before_zero((1.0, 2.0), Ok::<f64, ()>), Ok(None));
    }

    /// The function has still its first sign there, whichever end is the later one.
    #[test]
    fn the_side_is_that_before_the_zero() {
        for k in 1..1000 {
            let place = 1.0 + f64::from(k) * 1e-3 * core::f64::consts::FRAC_1_PI;
            let function = |t: f64| (t - place) * (1.0 + t * t) + 1e-9 * (t - place).powi(2);
            for between in [(1.0, 2.0), (2.0, 1.0)] {
                let (found, _) = zero(between, function);
                assert!(function(found) * function(between.0) >= 0.0);
                assert!((found - place).abs() <= 4.0 * f64::EPSILON * place);
            }
        }
    }

    #[test]
    fn minima_below_zero_are_found() {
        type Shape = fn(f64) -> f64;
        // The minimum is found to 1e-8, so a sharp one has to be deeper than a round one.
        let shapes: [(Shape, f64); 3] = [
            (|x| x * x, 1e-14),
            (|x| x.abs(), 1e-7),
            (|x| x * x * (2.0 + x), 1e-14),
        ];
        for (shape, smallest) in shapes {
            for bottom in [0.01, 0.3, 0.9999] {
                for depth in [1e-2, 1e-6, smallest] {
                    let mut count = 0;
                    let mut function = |t: f64| {
                        count += 1;
                        Ok::<f64, ()>(shape(t - bottom) - depth)
                    };
                    let found = negative_near_minimum((1.0, 0.0), &mut function);
                    let found = found.expect("no error").expect("a minimum below zero");
                    assert!(shape(found - bottom) < depth && count < 80, "{count}");
                }
            }
        }
        let above = negative_near_minimum((0.0, 1.0), |t| Ok::<f64, ()>(t * t + 1e-9));
        assert_eq!(above, Ok(None));
    }
}
