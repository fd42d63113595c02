//! Zeros of a function of time.

/// A zero of a function between two times at which its signs differ, by Brent's method: inverse quadratic interpolation and
/// secants where they are good, bisection where they are not (Brent, *Algorithms for Minimization without Derivatives*,
/// 1973, ch. 4). Found to two units in the last place of the time; `None` where the signs do not
/// differ.
pub(crate) fn brent<E>(
    (mut a, mut b): (f64, f64),
    mut function: impl FnMut(f64) -> Result<f64, E>,
) -> Result<Option<f64>, E> {
    // b is the best place so far, c is on the other side of the zero, a is the best one before.
    let (mut at_a, mut at_b) = (function(a)?, function(b)?);
    let (mut c, mut at_c) = (a, at_a);
    if at_a == 0.0 || at_b == 0.0 {
        return Ok(Some(if at_b == 0.0 { b } else { a }));
    }
    if (at_a > 0.0) == (at_b > 0.0) {
        return Ok(None);
    }
    let (mut step, mut before) = (b - a, b - a);
    loop {
        if at_c.abs() < at_b.abs() {
            (a, b, c) = (b, c, b);
            (at_a, at_b, at_c) = (at_b, at_c, at_b);
        }
        let tolerance = f64::EPSILON * b.abs();
        let half = 0.5 * (c - b);
        if at_b == 0.0 || half.abs() <= tolerance {
            return Ok(Some(b));
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
        // Where b is zero, or so near that the tolerance underflows.
        b = if moved == b { b + half } else { moved };
        if b == a {
            return Ok(Some(b));
        }
        at_b = function(b)?;
        if (at_b > 0.0) == (at_c > 0.0) {
            (c, at_c) = (a, at_a);
            (step, before) = (b - a, b - a);
        }
    }
}

#[cfg(test)]
mod tests {
    use super::brent;

    fn zero(between: (f64, f64), function: impl Fn(f64) -> f64) -> (f64, u32) {
        let mut count = 0;
        let found = brent(between, |t| {
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
        // From the other side, and falling.
        let (root, count) = zero((2.0, 1.0), |t| 2.0 - t * t);
        assert!(near(root, 2.0_f64.sqrt()) && count < 12, "{root} {count}");
        let (root, count) = zero((1e6, 1e6 + 1.0), |t| (t - 1e6 - 0.3).sin());
        assert!(near(root, 1e6 + 0.3) && count < 12, "{root} {count}");
        // At the ends.
        assert_eq!(zero((0.0, 1.0), |t| t).0, 0.0);
        assert_eq!(zero((0.0, 1.0), |t| t - 1.0).0, 1.0);
    }

    /// Where interpolation is of no use it is bisection, and it ends.
    #[test]
    fn ugly_functions_end() {
        let (root, count) = zero((-1.0, 2.0), |t| if t < 1.0 / 3.0 { -1.0 } else { 1.0 });
        assert!(
            (root - 1.0 / 3.0).abs() < 1e-15 && count < 120,
            "{root} {count}"
        );
        let (root, count) = zero((-1.0, 1.5), |t| t.powi(9));
        assert!(root.abs() < 1e-6 && count < 1500, "{root} {count}");
        let (root, count) = zero((-1.0, 4.0), |t| t * (1.0 + t * t));
        assert!(root.abs() < 1e-15 && count < 50, "{root} {count}");
        assert_eq!(brent((1.0, 2.0), Ok::<f64, ()>), Ok(None));
    }
}
