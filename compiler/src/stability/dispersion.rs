//! The phase error of the numerical oscillation.

use num_rational::BigRational;
use num_traits::One;

use super::Coefficient;
use super::oscillator::Step;
use super::polynomial::RealPolynomial;
use crate::arithmetic::rational::ratio;

/// The leading term of the phase error: the eigenvalues of one step are `ρ e^{±iθ}` with
/// `θ(ν) = ν + d ν^{k+1} + …`.
#[derive(Debug, Clone, PartialEq)]
pub struct Dispersion {
    /// The order `k`, which is even.
    pub order: usize,
    /// The coefficient `d`, which is nonzero.
    pub coefficient: Coefficient,
}

/// Compares `cos 2θ = tr²/(2 det) − 1`, a rational function of `x = ν²`, with `cos 2ν`.
///
/// If `cos 2θ − cos 2ν = e xᵐ + …` with `m > 1`, then `−2 sin(2ν) (θ − ν) = e ν²ᵐ + …`, and so
/// `θ − ν = −(e/4) ν²ᵐ⁻¹ + …`. Returns `None` if `m = 1`: the method is not even of order 1.
pub(super) fn leading<P: RealPolynomial>(step: &Step<P>) -> Option<Dispersion> {
    let (t, d) = (&step.trace, &step.determinant);
    let two = ratio(2, 1);
    // Both denominators are 1 at zero, and so is det M.
    let denominator = t
        .denominator
        .multiply(&t.denominator)
        .multiply(&d.numerator)
        .scale(&two);
    let square = t.numerator.multiply(&t.numerator).multiply(&d.denominator);
    let numerator = square.subtract(&denominator);
    let degrees = numerator.degree().unwrap_or(0) + denominator.degree().unwrap_or(0);
    // A rational function with these degrees agrees with a cosine in at most as many terms as it has
    // coefficients.
    let mut cosine = numerator.constant(&BigRational::one());
    let mut power = cosine.clone();
    for k in 1..degrees + 4 {
        // (2ν)^{2k}/(2k)! with the sign (−1)ᵏ
        let factors = BigRational::from_integer((2 * k * (2 * k - 1)).into());
        power = power.shift().scale(&(ratio(-4, 1) / factors));
        cosine = cosine.add(&power);
    }
    let difference = numerator.subtract(&denominator.multiply(&cosine));
    let coefficients = difference.scale(&ratio(-1, 8)).coefficients();
    let (m, coefficient) = coefficients
        .into_iter()
        .enumerate()
        .take(degrees + 4)
        .find(|(_, c)| !c.is_zero())?;
    (m > 1).then(|| Dispersion {
        order: 2 * m - 2,
        coefficient,
    })
}
