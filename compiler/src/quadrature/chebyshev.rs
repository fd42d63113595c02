//! Chebyshev's quadrature with equal weights (LZ Example 5).

use num_bigint::BigInt;
use num_rational::BigRational;
use num_traits::One;

use super::{Family, moment};
use crate::arithmetic::polynomial::Polynomial;

pub(super) const FAMILY: Family = Family {
    name: "chebyshev",
    description: "equal weights 1/s, degree of precision s (odd s) or s + 1 (even s)",
    minimum: 1,
    node_polynomial,
    real_for: "s = 1, …, 7 and 9 (Bernstein 1937)",
    #[cfg(test)]
    degree_of_precision: |s| if s % 2 == 1 { s } else { s + 1 },
};

/// Equal weights are exact up to degree `s` iff `Σ_i c_iᵏ = s/(k + 1)` for `k ≤ s`; Newton's
/// identities turn these power sums into the coefficients.
fn node_polynomial(s: usize) -> Polynomial {
    let integer = |n: usize| BigRational::from_integer(BigInt::from(n));
    let power_sum = |k: usize| integer(s) * moment(k);
    // e[k]: the coefficient of x^(s − k) of the monic polynomial.
    let mut e = vec![BigRational::one()];
    for k in 1..=s {
        let sum: BigRational = (1..=k).map(|j| &e[k - j] * power_sum(j)).sum();
        e.push(-sum / integer(k));
    }
    e.reverse();
    Polynomial::from_rationals(&e)
}
