//! Linear algebra over the rationals, for the small matrices of a basis.

use num_rational::BigRational;
use num_traits::{One, Zero};

/// The rows of a square rational matrix.
pub type Rows = Vec<Vec<BigRational>>;

/// The inverse of a square matrix, or a vector `v ≠ 0` with `vᵀ M = 0`.
pub fn inverse(matrix: &Rows) -> Result<Rows, Vec<BigRational>> {
    let size = matrix.len();
    // Gauss–Jordan on [M | 1]: the right half records the row operations, so a row that vanishes on
    // the left is, on the right, a combination of rows that vanishes.
    let mut rows: Rows = matrix
        .iter()
        .enumerate()
        .map(|(i, row)| {
            let mut row = row.clone();
            row.resize(size, BigRational::zero());
            row.extend((0..size).map(|j| {
                if i == j {
                    BigRational::one()
                } else {
                    BigRational::zero()
                }
            }));
            row
        })
        .collect();
    for column in 0..size {
        let Some(pivot) = (column..size).find(|&i| !rows[i][column].is_zero()) else {
            return Err(vanishing_combination(rows, column, size));
        };
        rows.swap(column, pivot);
        let scale = rows[column][column].recip();
        rows[column].iter_mut().for_each(|x| *x *= &scale);
        let reference = rows[column].clone();
        for (i, row) in rows.iter_mut().enumerate() {
            if i != column && !row[column].is_zero() {
                let factor = row[column].clone();
                for (x, r) in row.iter_mut().zip(&reference).filter(|(_, r)| !r.is_zero()) {
                    *x -= &factor * r;
                }
            }
        }
    }
    Ok(rows.into_iter().map(|row| row[size..].to_vec()).collect())
}

/// Goes on eliminating the later columns of a singular matrix until a row has vanished.
fn vanishing_combination(mut rows: Rows, rank: usize, size: usize) -> Vec<BigRational> {
    let mut done = rank;
    for column in rank + 1..size {
        if let Some(pivot) = (done..size).find(|&i| !rows[i][column].is_zero()) {
            rows.swap(done, pivot);
            let reference = rows[done].clone();
            for row in rows
                .iter_mut()
                .skip(done + 1)
                .filter(|row| !row[column].is_zero())
            {
                let factor = &row[column] / &reference[column];
                for (x, r) in row.iter_mut().zip(&reference) {
                    *x -= &factor * r;
                }
            }
            done += 1;
        }
    }
    rows.swap_remove(done).split_off(size)
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::arithmetic::rational::ratio;
    use proptest::prelude::*;

    proptest! {
        #[test]
        fn an_inverse_or_a_vanishing_combination(entries in prop::collection::vec(-3i64..4, 16)) {
            let matrix: Rows = entries.chunks(4).map(|row| row.iter().map(|&x| ratio(x, 1)).collect()).collect();
            let dot = |i: usize, v: &[BigRational]| -> BigRational { (0..4).map(|k| &v[k] * &matrix[k][i]).sum() };
            match inverse(&matrix) {
                Ok(inverse) => for (i, row) in inverse.iter().enumerate() {
                    for j in 0..4 {
                        prop_assert_eq!(dot(j, row), ratio(i64::from(i == j), 1));
                    }
                },
                Err(v) => {
                    prop_assert!(v.iter().any(|x| !x.is_zero()));
                    for j in 0..4 {
                        prop_assert!(dot(j, &v).is_zero());
                    }
                }
            }
        }
    }
}
