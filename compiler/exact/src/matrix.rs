//! Linear algebra over the rationals, for the small matrices of a basis.

use num_rational::BigRational;
use num_traits::{One, Zero};

/// The rows of a square rational matrix.
pub type Rows = Vec<Vec<BigRational>>;

/// A vector `v ≠ 0` with `vᵀ M = 0`, if the rows of `M` are linearly dependent.
pub fn left_kernel(matrix: &[Vec<BigRational>]) -> Option<Vec<BigRational>> {
    let width = matrix.iter().map(Vec::len).max().unwrap_or(0);
    // Elimination on [M | 1]: the right half records the row operations. If the left half of a row vanishes, the right
    // half contains the coefficients of a vanishing combination of rows.
    let mut rows = augmented(matrix, width);
    let mut done = 0;
    for column in 0..width {
        if let Some(pivot) = (done..rows.len()).find(|&i| !rows[i][column].is_zero()) {
            rows.swap(done, pivot);
            let reference = rows[done].clone();
            for row in rows
                .iter_mut()
                .skip(done + 1)
                .filter(|row| !row[column].is_zero())
            {
                let factor = &row[column] / &reference[column];
                subtract(row, &factor, &reference);
            }
            done += 1;
        }
    }
    rows.get_mut(done).map(|row| row.split_off(width))
}

/// The inverse of a square matrix.
///
/// # Errors
/// For a singular matrix, a vector `v ≠ 0` with `vᵀ M = 0`.
pub fn inverse(matrix: &[Vec<BigRational>]) -> Result<Rows, Vec<BigRational>> {
    if let Some(combination) = left_kernel(matrix) {
        return Err(combination);
    }
    let size = matrix.len();
    let mut rows = augmented(matrix, size);
    for column in 0..size {
        // The matrix is regular, so there is a pivot.
        let pivot = (column..size)
            .find(|&i| !rows[i][column].is_zero())
            .unwrap_or(column);
        rows.swap(column, pivot);
        let scale = rows[column][column].recip();
        rows[column].iter_mut().for_each(|x| *x *= &scale);
        let reference = rows[column].clone();
        for (i, row) in rows.iter_mut().enumerate() {
            if i != column && !row[column].is_zero() {
                let factor = row[column].clone();
                subtract(row, &factor, &reference);
            }
        }
    }
    Ok(rows.into_iter().map(|row| row[size..].to_vec()).collect())
}

/// `[M | 1]` with `M` padded with zeros to a width.
fn augmented(matrix: &[Vec<BigRational>], width: usize) -> Rows {
    let identity = |i: usize| {
        (0..matrix.len()).map(move |j| {
            if i == j {
                BigRational::one()
            } else {
                BigRational::zero()
            }
        })
    };
    let augment = |(i, row): (usize, &Vec<BigRational>)| {
        let mut row = row.clone();
        row.resize(width, BigRational::zero());
        row.extend(identity(i));
        row
    };
    matrix.iter().enumerate().map(augment).collect()
}

fn subtract(row: &mut [BigRational], factor: &BigRational, reference: &[BigRational]) {
    for (x, r) in row.iter_mut().zip(reference).filter(|(_, r)| !r.is_zero()) {
        *x -= factor * r;
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::rational::ratio;
    use proptest::prelude::*;

    proptest! {
        #[test]
        fn elimination_returns_an_inverse_or_a_null_vector(entries in prop::collection::vec(-3i64..4, 16)) {
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
