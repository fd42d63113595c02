//! Power sums of the roots of a polynomial, which are traces.

use num_rational::BigRational;
use num_traits::{One, Zero};

use super::polynomial::Polynomial;

/// `Σ_i c_iᵏ` over the roots of a polynomial, for `k < count` (Newton's identities).
pub fn power_sums(polynomial: &Polynomial, count: usize) -> Vec<BigRational> {
    let degree = polynomial.degree().unwrap_or(0);
    let leading = polynomial.leading();
    // (−1)ᵏ e_k, with the elementary symmetric polynomial e_k: the coefficient of x^(degree − k) of the monic
    // polynomial.
    let e: Vec<BigRational> = (0..=degree)
        .map(|k| polynomial.coefficient(degree - k) / &leading)
        .collect();
    let integer = |n: usize| BigRational::from_integer(n.into());
    let mut sums = vec![integer(degree)];
    for k in 1..count {
        let products: BigRational = (1..k.min(degree + 1)).map(|j| &e[j] * &sums[k - j]).sum();
        let last = e.get(k).map_or_else(BigRational::zero, |e| integer(k) * e);
        sums.push(-(products + last));
    }
    sums
}

/// The monic polynomial of a degree whose roots have these power sums, from the exponent 0 on.
pub fn from_power_sums(sums: &[BigRational], degree: usize) -> Polynomial {
    let mut e = vec![BigRational::one()];
    for k in 1..=degree {
        let products: BigRational = (1..=k).map(|j| &e[k - j] * &sums[j]).sum();
        e.push(-products / BigRational::from_integer(k.into()));
    }
    e.reverse();
    Polynomial::from_rationals(&e)
}

/// The polynomial `Σ_i v_i Π_{j≠i} (x − c_j)` from the roots `c_i` of a monic polynomial and the traces `Σ_i v_i c_iᵏ`.
/// Its value at `c_i` is `v_i` times the derivative of the monic polynomial.
pub fn interpolate_traces(monic: &Polynomial, traces: &[BigRational]) -> Polynomial {
    // Π_{j≠i} (x − c_j) = m(x)/(x − c_i) = Σ_{l<k} m_k c_iᵏ⁻¹⁻ˡ xˡ.
    let m = monic.coefficients();
    let coefficient =
        |l: usize| -> BigRational { m[l + 1..].iter().zip(traces).map(|(m, t)| m * t).sum() };
    let coefficients: Vec<_> = (0..m.len().saturating_sub(1)).map(coefficient).collect();
    Polynomial::from_rationals(&coefficients)
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::rational::ratio;
    use proptest::prelude::*;

    proptest! {
        #[test]
        fn power_sums_and_polynomials_determine_each_other(roots in prop::collection::vec(-9i64..9, 1..6)) {
            let polynomial = roots.iter().fold(Polynomial::one(), |p, &c| &p * &Polynomial::from_integers(&[-c, 1]));
            let sums = power_sums(&polynomial.scale(&ratio(3, 7)), 8);
            for (k, sum) in (0..).zip(&sums) {
                prop_assert_eq!(sum, &ratio(roots.iter().map(|c| c.pow(k)).sum(), 1));
            }
            prop_assert_eq!(from_power_sums(&sums, roots.len()), polynomial.clone());
            // The function v(c) = c² + 1.
            let traces: Vec<BigRational> = (0..roots.len()).map(|k| &sums[k + 2] + &sums[k]).collect();
            let interpolant = interpolate_traces(&polynomial, &traces);
            for &c in &roots {
                let expected = polynomial.derivative().evaluate(&ratio(c, 1)) * ratio(c * c + 1, 1);
                prop_assert_eq!(interpolant.evaluate(&ratio(c, 1)), expected);
            }
        }
    }
}
