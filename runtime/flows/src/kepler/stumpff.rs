//! Stumpff's functions without cancellation.

use symplectic_core::Scalar;

/// `1/(2k + 2)!`
const SECOND: [f64; 9] = reciprocals(2);
/// `1/(2k + 3)!`
const THIRD: [f64; 9] = reciprocals(3);
/// The rounding error of 1/6: without it the error of `c_3` has the same sign in all steps, and the energy drifts.
const REST: f64 = ((1.0 - 4.0 * THIRD[0]) - 2.0 * THIRD[0]) / 6.0;

const fn reciprocals(first: u32) -> [f64; 9] {
    let mut all = [0.0; 9];
    let (mut factorial, mut number, mut k) = (1.0, 1, 0);
    while k < 9 {
        while number <= first + 2 * k as u32 {
            // Exact below 18!, and with one rounding above.
            factorial *= number as f64;
            number += 1;
        }
        all[k] = 1.0 / factorial;
        k += 1;
    }
    all
}

/// `c_2 = (1 − cos √ψ)/ψ` and `c_3 = (√ψ − sin √ψ)/√ψ³` for `|ψ| ≤ 1` (Stumpff 1959; hyperbolic functions for `ψ < 0`). The remainder of
/// the series is below 10⁻¹⁷ of the sum.
#[cfg_attr(not(debug_assertions), inline(always))]
pub(super) fn small<T: Scalar>(psi: T) -> (T, T) {
    let x = -psi;
    let (x2, x4) = (x * x, (x * x) * (x * x));
    // Estrin's scheme, so that few operations depend on one another; the first coefficient comes last.
    let sum = |coefficients: &[f64; 9], rest: f64| {
        let of = |k: usize| T::from_f64(coefficients[k]);
        let pair = |k: usize| of(k + 1).fused(x, of(k));
        let four = |k: usize| pair(k + 2).fused(x2, pair(k));
        let others = four(5).fused(x4, four(1));
        others.fused(x, T::from_f64(rest)) + of(0)
    };
    (sum(&SECOND, 0.0), sum(&THIRD, REST))
}

/// The functions of `4ψ` from those of `ψ`: `c_2(4ψ) = c_1²/2`, `c_3(4ψ) = (c_2 + c_0 c_3)/4`, with `c_0 = 1 − ψc_2` and `c_1 = 1 − ψc_3`.
#[cfg_attr(not(debug_assertions), inline(always))]
pub(super) fn quadruple<T: Scalar>(psi: T, (c2, c3): (T, T)) -> (T, T) {
    let (one, half) = (T::one(), T::from_f64(0.5));
    let (c0, c1) = (one - psi * c2, one - psi * c3);
    (half * c1 * c1, half * half * (c2 + c0 * c3))
}

/// The functions of any argument; infinite if they overflow.
pub(super) fn any(psi: f64) -> (f64, f64) {
    let (mut scaled, mut levels) = (psi, 0_u32);
    while scaled.abs() > 0.5 && levels < 1100 {
        scaled /= 4.0;
        levels += 1;
    }
    let mut values = small(scaled);
    for _ in 0..levels {
        values = quadruple(scaled, values);
        scaled *= 4.0;
    }
    values
}

#[cfg(test)]
mod tests {
    use super::*;

    /// Compares with closed forms where they do not cancel, and with the series near 0.
    #[test]
    fn stumpff_functions_agree_with_their_closed_forms() {
        for k in 1..400 {
            let x = 0.05 * f64::from(k);
            let (c2, c3) = any(x * x);
            let (sine, cosine) = x.sin_cos();
            let half = (x / 2.0).sin();
            let bound = 4e-15 * (1.0 + x);
            assert!((c2 - 2.0 * half * half / (x * x)).abs() < bound * c2.max(1.0 / (x * x)));
            if x > 1.0 {
                assert!((c3 / ((x - sine) / x.powi(3)) - 1.0).abs() < bound, "{x}");
            }
            let (c2, c3) = any(-x * x);
            let half = (x / 2.0).sinh();
            assert!((c2 / (2.0 * half * half / (x * x)) - 1.0).abs() < bound);
            if x > 1.0 {
                assert!((c3 / ((x.sinh() - x) / x.powi(3)) - 1.0).abs() < bound);
            }
            assert!(cosine.is_finite());
        }
        assert_eq!(any(0.0), (0.5, 1.0 / 6.0));
        let tiny = 1e-9;
        assert!((any(tiny).1 - (1.0 / 6.0 - tiny / 120.0)).abs() < 1e-16);
    }
}
