//! The free step along a geodesic.

use nalgebra::{Matrix3, Vector3};

use symplectic_core::Scalar;

/// Why a free step failed.
#[derive(Clone, Copy, Debug)]
pub(super) enum NoRotation {
    /// Newton's iteration did not converge.
    NotFound { residual: f64, iterations: u32 },
    /// The angle of the rotation is π or more.
    HalfTurn { angle: f64 },
}

/// Maximum number of Newton iterations; typical are 3 to 6.
const MAX_ITERATIONS: u32 = 40;

/// Relative change after which the iterate is exact to rounding, by quadratic convergence.
const LAST_CHANGE: f64 = 1e-9;

/// The rotation vector `w = hξ` of a free step, from the angular momentum at its start:
///
/// ```text
/// hΠ0 = Iw + w×Iw/2 + κ w×(w×Iw)
/// ```
pub(super) fn rotation(
    moments: &Vector3<f64>,
    momentum: &Vector3<f64>,
    size: f64,
) -> Result<Vector3<f64>, NoRotation> {
    let known = momentum * size;
    let mut w = known.component_div(moments);
    let mut residual = f64::INFINITY;
    for _ in 0..MAX_ITERATIONS {
        let (value, slope) = equation(moments, &w);
        let change = solved(&slope, &(known - value));
        w += change;
        let (changed, length) = (length(&change), length(&w));
        residual = if length > 0.0 { changed / length } else { 0.0 };
        if !residual.is_finite() {
            break;
        }
        if residual <= LAST_CHANGE {
            return if length < core::f64::consts::PI {
                Ok(w)
            } else {
                Err(NoRotation::HalfTurn { angle: length })
            };
        }
    }
    Err(NoRotation::NotFound {
        residual,
        iterations: MAX_ITERATIONS,
    })
}

/// The right-hand side of the equation of a step and its derivative with respect to `w`.
fn equation(moments: &Vector3<f64>, w: &Vector3<f64>) -> (Vector3<f64>, Matrix3<f64>) {
    let (kappa, slope) = kappa(w.dot(w));
    let momentum = moments.component_mul(w);
    let once = w.cross(&momentum);
    let twice = w.cross(&once);
    let value = momentum + once / 2.0 + twice * kappa;
    let column = |axis: usize| {
        let mut v = Vector3::zeros();
        v[axis] = 1.0;
        let inertia = v * moments[axis];
        let by_once = v.cross(&momentum) + w.cross(&inertia);
        let by_twice = v.cross(&once) + w.cross(&by_once);
        inertia + by_once / 2.0 + by_twice * kappa + twice * (2.0 * slope * w[axis])
    };
    (value, Matrix3::from_columns(&[0, 1, 2].map(column)))
}

/// The coefficients `|B_2k|/(2k)!` of the power series of κ in θ².
const SERIES: [f64; 11] = [
    1.0 / 12.0,
    1.0 / 720.0,
    1.0 / 30240.0,
    1.0 / 1209600.0,
    1.0 / 47900160.0,
    691.0 / 1307674368000.0,
    1.0 / 74724249600.0,
    3617.0 / 10670622842880000.0,
    43867.0 / 5109094217170944000.0,
    174611.0 / 802857662698291200000.0,
    77683.0 / 14101100039391805440000.0,
];

/// `κ = (1 − (θ/2) cot(θ/2))/θ²` and its derivative with respect to θ², as functions of θ².
fn kappa(square: f64) -> (f64, f64) {
    if square < 1.0 {
        let step = |(value, slope): (f64, f64), &term: &f64| {
            (value * square + term, slope * square + value)
        };
        return SERIES.iter().rev().fold((0.0, 0.0), step);
    }
    let half: f64 = Scalar::sqrt(square) / 2.0;
    let (sine, cosine) = Scalar::sin_cos(half);
    let cotangent = cosine / sine;
    let kappa = (1.0 - half * cotangent) / square;
    let by_square = (cotangent / half - 1.0 / (sine * sine)) / 8.0;
    (kappa, -(by_square + kappa) / square)
}

/// Solves three linear equations by Cramer's rule; the result of a singular system is not finite.
fn solved(matrix: &Matrix3<f64>, right: &Vector3<f64>) -> Vector3<f64> {
    let [a, b, c] = [0, 1, 2].map(|k| matrix.column(k).into_owned());
    let normal = b.cross(&c);
    let determinant = a.dot(&normal);
    let numerators = [
        right.dot(&normal),
        a.dot(&right.cross(&c)),
        a.dot(&b.cross(right)),
    ];
    Vector3::from(numerators) / determinant
}

fn length(vector: &Vector3<f64>) -> f64 {
    Scalar::sqrt(vector.dot(vector))
}

#[cfg(test)]
mod tests {
    use super::*;

    /// Compares both formulas of κ, and its derivative with difference quotients.
    #[test]
    fn kappa_has_its_closed_form_and_derivative() {
        let closed = |square: f64| {
            let half: f64 = Scalar::sqrt(square) / 2.0;
            (1.0 - half / Scalar::tan(half)) / square
        };
        assert_eq!(kappa(0.0), (1.0 / 12.0, 1.0 / 720.0));
        for square in [0.25, 0.99, 1.01, 4.0, 9.0] {
            let (value, slope) = kappa(square);
            assert!((value - closed(square)).abs() < 4e-16, "{square}");
            let step = 1e-4;
            let difference = (closed(square + step) - closed(square - step)) / (2.0 * step);
            assert!((slope - difference).abs() < 1e-9, "{square}");
        }
    }

    /// The equation holds, and its derivative agrees with difference quotients.
    #[test]
    fn the_step_equation_is_solved_and_differentiated() {
        let moments = Vector3::new(1.0, 2.0, 0.7);
        let w = Vector3::new(0.5, -1.1, 0.8);
        let (_, slope) = equation(&moments, &w);
        for axis in 0..3 {
            let at = |by: f64| {
                let mut moved = w;
                moved[axis] += by;
                equation(&moments, &moved).0
            };
            let difference = (at(1e-5) - at(-1e-5)) / 2e-5;
            assert!((difference - slope.column(axis)).norm() < 1e-9);
        }
        let momentum = Vector3::new(1.0, -2.0, 0.5);
        let w = rotation(&moments, &momentum, 0.5).expect("a rotation");
        assert!((equation(&moments, &w).0 - momentum * 0.5).norm() < 1e-15);
    }
}
