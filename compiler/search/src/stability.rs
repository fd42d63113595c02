//! The stable steps of a splitting for the harmonic oscillator, in doubles.

use symplectic_compiler::certify::DRIFT;

use crate::words::Exponent;

/// Steps of the scan in hω, as a share of the kicks.
const GRID: f64 = 1e-3;
/// |trace|/2 may exceed 1 by this much, from rounding.
const SLACK: f64 = 1e-9;

/// The end of the first interval of stable `hω`, divided by the number of kicks: `q″ = −ω²q` is stable where the trace of a step is between −2 and 2.
pub(crate) fn stable_per_kick(exponents: &[Exponent], arguments: &[f64], kicks: usize) -> f64 {
    let half_trace = |h: f64| -> f64 {
        let (mut a, mut b, mut c, mut d) = (1.0, 0.0, 0.0, 1.0);
        for (exponent, x) in exponents.iter().zip(arguments) {
            match exponent {
                // q += x h p
                Exponent::Letter(DRIFT) => (a, b) = (a + x * h * c, b + x * h * d),
                // p += 2 x h³ q, for the force −q and its derivative −1
                Exponent::Gradient => {
                    (c, d) = (c + 2.0 * x * h.powi(3) * a, d + 2.0 * x * h.powi(3) * b)
                }
                // p −= x h q
                _ => (c, d) = (c - x * h * a, d - x * h * b),
            }
        }
        0.5 * (a + d)
    };
    let is_stable = |h: f64| half_trace(h).abs() <= 1.0 + SLACK;
    let step = GRID * kicks as f64;
    // No method is stable beyond hω = 2 a kick.
    let (mut low, mut high) = (0.0, step);
    while is_stable(high) {
        if high > 2.0 * kicks as f64 + 1.0 {
            return high / kicks as f64;
        }
        (low, high) = (high, high + step);
    }
    for _ in 0..50 {
        let middle = 0.5 * (low + high);
        if is_stable(middle) {
            low = middle;
        } else {
            high = middle;
        }
    }
    low / kicks as f64
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::structure::{Model, Structure};

    #[test]
    fn verlet_is_stable_up_to_two() {
        let model = Model::new(Structure::Aba, 1, 0);
        let arguments = model
            .letters
            .at(&nalgebra::DVector::from_vec(vec![0.5, 1.0]));
        let stable = stable_per_kick(&model.letters.exponents, &arguments, 1);
        assert!((stable - 2.0).abs() < 1e-4, "{stable}");
    }
}
