//! The inverse of a matrix of enclosures.

use std::cmp::Ordering;

use super::interval::Interval;
use super::rational::ratio;
use super::rounding::to_f64;

/// Binary places to try until the enclosure of the determinant excludes zero.
pub const BITS: [u32; 4] = [192, 384, 1024, 4096];

/// The inverse of a matrix, and its determinant.
pub struct Inverse {
    /// Enclosures of its entries.
    pub rows: Vec<Vec<Interval>>,
    /// The determinant of the matrix.
    pub determinant: Interval,
}

impl Inverse {
    /// Inverts a matrix; `None` if the enclosure of the determinant contains zero.
    pub fn of(mut rows: Vec<Vec<Interval>>) -> Option<Self> {
        let size = rows.len();
        let bits = rows.first()?.first()?.bits();
        let integer = |value| Interval::enclosing(&ratio(value, 1), bits);
        for (i, row) in rows.iter_mut().enumerate() {
            row.extend((0..size).map(|j| integer(i64::from(i == j))));
        }
        let mut determinant = integer(1);
        for column in 0..size {
            let pivot = (column..size)
                .filter(|&i| rows[i][column].sign().is_some_and(Ordering::is_ne))
                .max_by_key(|&i| rows[i][column].magnitude_bits())?;
            if pivot != column {
                rows.swap(column, pivot);
                determinant = determinant.negate();
            }
            determinant = determinant.multiply(&rows[column][column]);
            let divisor = rows[column][column].clone();
            let quotients = rows[column].iter().map(|x| x.divide(&divisor));
            let reference: Vec<Interval> = quotients.collect::<Option<_>>()?;
            for (i, row) in rows.iter_mut().enumerate() {
                if i == column {
                    row.clone_from(&reference);
                    continue;
                }
                let factor = row[column].clone();
                for (x, r) in row.iter_mut().zip(&reference) {
                    *x = x.subtract(&factor.multiply(r));
                }
            }
        }
        // The product of small pivots may underflow its binary places.
        determinant.sign().filter(|sign| sign.is_ne())?;
        let rows = rows.into_iter().map(|row| row[size..].to_vec()).collect();
        Some(Inverse { rows, determinant })
    }
}

/// The inverse of a matrix, rounded to doubles: correctly if [`BITS`] suffice. `None` if no enclosure proves the matrix
/// regular. `matrix(bits)` encloses the matrix with this number of binary places.
///
/// An entry whose enclosures all contain zero becomes zero.
pub fn rounded(matrix: impl Fn(u32) -> Vec<Vec<Interval>>) -> Option<Vec<Vec<f64>>> {
    let mut finest = None;
    for bits in BITS {
        let Some(Inverse { rows, .. }) = Inverse::of(matrix(bits)) else {
            continue;
        };
        let ends = |x: &Interval| (to_f64(&x.low()), to_f64(&x.high()));
        let decided = rows
            .iter()
            .flatten()
            .map(ends)
            .all(|(low, high)| low == high);
        let middle = |x: &Interval| match x.sign() {
            Some(_) => to_f64(&x.middle()),
            None => 0.0,
        };
        finest = Some(
            rows.iter()
                .map(|row| row.iter().map(middle).collect())
                .collect(),
        );
        if decided {
            break;
        }
    }
    finest
}

#[cfg(test)]
mod tests {
    use num_bigint::BigInt;
    use num_rational::BigRational;

    use super::*;

    fn enclosing(matrix: &[&[BigRational]], bits: u32) -> Vec<Vec<Interval>> {
        let row = |row: &&[BigRational]| row.iter().map(|x| Interval::enclosing(x, bits)).collect();
        matrix.iter().map(row).collect()
    }

    /// Hilbert's matrix of size 4: its inverse has the integers 16, −120, …, and its determinant is 1/6048000.
    #[test]
    fn the_inverse_of_the_hilbert_matrix_has_its_known_integers() {
        let entry = |i: i64, j: i64| ratio(1, i + j + 1);
        let rows = [0, 1, 2, 3].map(|i| [0, 1, 2, 3].map(|j| entry(i, j)));
        let rows: Vec<&[BigRational]> = rows.iter().map(|row| &row[..]).collect();
        let inverse = Inverse::of(enclosing(&rows, 192)).expect("regular");
        assert!(inverse.determinant.contains(&ratio(1, 6_048_000)));
        let expected = [
            [16, -120, 240, -140],
            [-120, 1200, -2700, 1680],
            [240, -2700, 6480, -4200],
            [-140, 1680, -4200, 2800],
        ];
        for (found, expected) in inverse.rows.iter().zip(expected) {
            for (found, expected) in found.iter().zip(expected) {
                assert!(found.contains(&ratio(expected, 1)));
                assert!(found.width() < power_of_half(100));
            }
        }
        let doubles = rounded(|bits| enclosing(&rows, bits)).expect("regular");
        assert_eq!(doubles, expected.map(|row| row.map(|x| x as f64).to_vec()));
    }

    fn power_of_half(bits: u32) -> BigRational {
        BigRational::new(BigInt::from(1), BigInt::from(1) << bits)
    }

    /// Rows are exchanged where a pivot vanishes, and the sign of the determinant follows.
    #[test]
    fn rows_are_exchanged_where_a_pivot_vanishes() {
        let [zero, two, three] = [0, 2, 3].map(|x| ratio(x, 1));
        let matrix: [&[BigRational]; 2] = [&[zero.clone(), two], &[three, zero]];
        let inverse = Inverse::of(enclosing(&matrix, 64)).expect("regular");
        assert!(inverse.determinant.contains(&ratio(-6, 1)));
        assert!(inverse.rows[0][1].contains(&ratio(1, 3)));
        assert!(inverse.rows[1][0].contains(&ratio(1, 2)));
    }

    /// No precision proves a singular matrix regular; a nearly singular one needs more places than the first that are tried.
    #[test]
    fn inverses_of_nearly_singular_matrices_need_more_places() {
        let [one, two, four] = [1, 2, 4].map(|x| ratio(x, 1));
        let singular: [&[BigRational]; 2] = [&[one.clone(), two.clone()], &[two.clone(), four]];
        assert!(Inverse::of(enclosing(&singular, 192)).is_none());
        assert_eq!(rounded(|bits| enclosing(&singular, bits)), None);
        // (1/3, 2/3; 1, 2 + ε): the rounding errors of 1/3 hide ε = 2⁻³⁰⁰ from 192 places.
        let (third, small) = (ratio(1, 3), power_of_half(300));
        let nearly: [&[BigRational]; 2] = [&[third.clone(), third * &two], &[one, two + small]];
        assert!(Inverse::of(enclosing(&nearly, 192)).is_none());
        let found = rounded(|bits| enclosing(&nearly, bits)).expect("regular");
        // (6/ε + 3, −2/ε; −3/ε, 1/ε)
        let large = 2.0_f64.powi(300);
        assert_eq!(found, [[6.0 * large, -2.0 * large], [-3.0 * large, large]]);
    }
}
