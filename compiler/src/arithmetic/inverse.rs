//! The inverse of a matrix of enclosures.

use std::cmp::Ordering;

use super::interval::Interval;
use super::rational::ratio;
use super::rounding::to_f64;

/// Binary places to try until the enclosure of the determinant excludes zero.
pub const BITS: [u32; 4] = [192, 384, 1024, 4096];

/// The inverse of a matrix, and its determinant.
pub struct Inverse {
    pub rows: Vec<Vec<Interval>>,
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
