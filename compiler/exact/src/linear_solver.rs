//! Rational linear systems with one matrix and many right-hand sides (Dixon 1982).

use num_bigint::BigInt;
use num_integer::Integer;
use num_rational::BigRational;
use num_traits::{One, Zero};

use super::polynomial::Polynomial;
use super::prime_field::{PrimeField, large_primes};
use super::residues::Residues;

/// Solves `Σ_k x_k r_k = v` for `n` linearly independent rows `r_k` of length `n`.
///
/// Rows and right-hand sides are the coefficients of polynomials. The matrix is inverted modulo a prime `p` only. A
/// solution is then computed digit by digit in base `p`, so the time depends on the length of the solution, not on that
/// of the inverse matrix.
#[derive(Debug, Clone)]
pub struct LinearSolver {
    /// The rows without their denominators.
    rows: Vec<Vec<BigInt>>,
    denominators: Vec<BigInt>,
    field: PrimeField,
    /// The inverse modulo `p`, row by row.
    inverse: Vec<Vec<u64>>,
}

impl LinearSolver {
    /// The solver for these rows; `None` if they are linearly dependent.
    pub fn new(rows: &[Polynomial]) -> Option<Self> {
        let size = rows.len();
        let numerators: Vec<Vec<BigInt>> = rows
            .iter()
            .map(|row| {
                let mut row = row.numerators().to_vec();
                row.resize(size, BigInt::zero());
                row
            })
            .collect();
        // A regular matrix is singular only modulo divisors of its determinant. By Hadamard's bound there are fewer
        // 30-bit prime divisors than `attempts`.
        let bits: u64 = numerators
            .iter()
            .flatten()
            .map(|n| n.bits() + 1)
            .max()
            .unwrap_or(1);
        let attempts = size * (bits as usize + size) / 30 + 1;
        let (field, inverse) = large_primes().take(attempts).find_map(|prime| {
            let field = PrimeField::new(prime);
            let residues = numerators
                .iter()
                .map(|row| row.iter().map(|n| field.integer(n)).collect())
                .collect();
            Some((field, inverse_modulo(field, residues)?))
        })?;
        Some(LinearSolver {
            rows: numerators,
            denominators: rows.iter().map(|row| row.denominator().clone()).collect(),
            field,
            inverse,
        })
    }

    /// The solution for a right-hand side of at most the length of the rows.
    pub fn solve(&self, right: &Polynomial) -> Vec<BigRational> {
        let size = self.rows.len();
        let mut goal = right.numerators().to_vec();
        goal.resize(size, BigInt::zero());
        let prime = self.field.prime();
        let mut residual = goal.clone();
        let mut solution = vec![BigInt::zero(); size];
        let mut modulus = BigInt::one();
        let (mut digits, mut attempt) = (0u32, 1);
        loop {
            let residues: Vec<u64> = residual.iter().map(|r| self.field.integer(r)).collect();
            let mut digit = vec![0u64; size];
            for (r, row) in residues.iter().zip(&self.inverse).filter(|(r, _)| **r != 0) {
                for (x, i) in digit.iter_mut().zip(row) {
                    *x = (*x + r * i) % prime;
                }
            }
            for ((x, row), total) in digit.iter().zip(&self.rows).zip(&mut solution) {
                if *x != 0 {
                    *total += &modulus * x;
                    residual.iter_mut().zip(row).for_each(|(r, n)| *r -= n * x);
                }
            }
            residual.iter_mut().for_each(|r| *r /= prime);
            modulus *= prime;
            digits += 1;
            if digits >= attempt {
                attempt = digits + digits / 2 + 1;
                let ring = Residues::new(modulus.clone());
                let found: Option<Vec<BigRational>> =
                    solution.iter().map(|x| ring.rational(x)).collect();
                if let Some(found) = found.filter(|found| self.solves(found, &goal)) {
                    let scale = |(x, d): (BigRational, &BigInt)| {
                        x * BigRational::new(d.clone(), right.denominator().clone())
                    };
                    return found
                        .into_iter()
                        .zip(&self.denominators)
                        .map(scale)
                        .collect();
                }
            }
        }
    }

    fn solves(&self, solution: &[BigRational], goal: &[BigInt]) -> bool {
        let common = solution
            .iter()
            .fold(BigInt::one(), |lcm, x| lcm.lcm(x.denom()));
        let numerators: Vec<BigInt> = solution
            .iter()
            .map(|x| x.numer() * (&common / x.denom()))
            .collect();
        (0..goal.len()).all(|column| {
            let sum: BigInt = numerators
                .iter()
                .zip(&self.rows)
                .map(|(n, row)| n * &row[column])
                .sum();
            sum == &goal[column] * &common
        })
    }
}

/// The inverse of a matrix over a prime field; `None` if it is singular.
fn inverse_modulo(field: PrimeField, mut rows: Vec<Vec<u64>>) -> Option<Vec<Vec<u64>>> {
    let size = rows.len();
    for (i, row) in rows.iter_mut().enumerate() {
        row.extend((0..size).map(|j| u64::from(i == j)));
    }
    for column in 0..size {
        let pivot = (column..size).find(|&i| rows[i][column] != 0)?;
        rows.swap(column, pivot);
        let reference = field.scale(&rows[column], field.inverse(rows[column][column]));
        for row in &mut rows {
            let negative = field.minus(0, row[column]) % field.prime();
            if negative != 0 {
                for (x, r) in row.iter_mut().zip(&reference) {
                    *x = (*x + negative * r) % field.prime();
                }
            }
        }
        rows[column] = reference;
    }
    Some(rows.into_iter().map(|row| row[size..].to_vec()).collect())
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::matrix::left_kernel;
    use crate::rational::ratio;
    use proptest::prelude::*;

    proptest! {
        #[test]
        fn the_linear_solver_satisfies_the_equations(entries in prop::collection::vec((-9i64..10, 1i64..5), 20)) {
            let rationals: Vec<BigRational> = entries.iter().map(|&(n, d)| ratio(n, d)).collect();
            let rows: Vec<Polynomial> = rationals[..16].chunks(4).map(Polynomial::from_rationals).collect();
            let right = Polynomial::from_rationals(&rationals[16..]);
            match LinearSolver::new(&rows) {
                None => prop_assert!(left_kernel(&rationals[..16].chunks(4).map(<[_]>::to_vec).collect::<Vec<_>>()).is_some()),
                Some(solver) => {
                    let sum = solver.solve(&right).iter().zip(&rows).fold(Polynomial::zero(), |sum, (x, row)| &sum + &row.scale(x));
                    prop_assert_eq!(sum, right);
                }
            }
        }
    }
}
