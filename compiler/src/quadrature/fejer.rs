//! Fejér's first rule: the zeros of a Chebyshev polynomial.

use super::Family;
use crate::arithmetic::polynomial::Polynomial;

pub(super) const FAMILY: Family = Family {
    name: "fejer",
    description: "Fejér's first rule, the zeros (1 − cos((2k − 1)π/(2s)))/2, k = 1, …, s",
    minimum: 1,
    node_polynomial: first_kind,
    real_for: "every s",
    #[cfg(test)]
    degree_of_precision: |s| if s % 2 == 1 { s } else { s - 1 },
};

/// `T_n(2x − 1)`.
fn first_kind(n: usize) -> Polynomial {
    chebyshev(n, Polynomial::from_integers(&[-1, 2]))
}

/// `U_n(2x − 1)`.
pub(super) fn second_kind(n: usize) -> Polynomial {
    chebyshev(n, Polynomial::from_integers(&[-2, 4]))
}

/// The three-term recurrence `p_{n+1} = 2z p_n − p_{n−1}` with `z = 2x − 1` from 1 and a first member.
fn chebyshev(n: usize, first: Polynomial) -> Polynomial {
    let twice = Polynomial::from_integers(&[-2, 4]);
    let (mut previous, mut current) = (Polynomial::one(), first);
    for _ in 0..n {
        (previous, current) = (current.clone(), &(&twice * &current) - &previous);
    }
    previous
}
