//! The largest of residuals.

/// The larger of two numbers, or NaN if either is NaN. (`f64::max` skips NaN.)
#[cfg_attr(not(debug_assertions), inline(always))]
pub(in crate::method) const fn maximum(a: f64, b: f64) -> f64 {
    if a < b || b.is_nan() { b } else { a }
}

#[cfg(test)]
mod tests {
    use super::maximum;

    #[test]
    fn not_a_number_is_the_largest() {
        assert_eq!([maximum(1.0, 2.0), maximum(2.0, 1.0)], [2.0; 2]);
        assert_eq!(maximum(1.0, f64::INFINITY), f64::INFINITY);
        for other in [0.0, 1.0, f64::INFINITY, f64::NAN] {
            assert!(maximum(other, f64::NAN).is_nan(), "{other}");
            assert!(maximum(f64::NAN, other).is_nan(), "{other}");
        }
    }
}
