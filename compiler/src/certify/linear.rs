//! Linear algebra with approximate dyadic numbers; its results are verified elsewhere.

use num_bigint::BigInt;
use num_traits::{One, Signed, Zero};

use crate::arithmetic::interval::Interval;

/// Rows of numbers `n·2⁻ᵇⁱᵗˢ`.
pub type Dyadics = Vec<Vec<BigInt>>;

/// The middle of an interval.
pub fn middle(interval: &Interval) -> BigInt {
    (&interval.low + &interval.high) >> 1u32
}

/// The interval with one number.
pub fn point(value: &BigInt, bits: u32) -> Interval {
    Interval {
        low: value.clone(),
        high: value.clone(),
        bits,
    }
}

/// All numbers at most `radius` away from `value`.
pub fn ball(value: &BigInt, radius: &BigInt, bits: u32) -> Interval {
    Interval {
        low: value - radius,
        high: value + radius,
        bits,
    }
}

/// The largest absolute value in an interval, in units of `2⁻ᵇⁱᵗˢ`.
pub fn magnitude(interval: &Interval) -> BigInt {
    interval.low.abs().max(interval.high.abs())
}

/// The same number with a different number of binary places.
pub fn rescaled(value: &BigInt, from: u32, to: u32) -> BigInt {
    if to >= from {
        value << (to - from)
    } else {
        value >> (from - to)
    }
}

/// The inverse of a matrix by Gauss–Jordan elimination, rounded; `None` if a pivot is zero.
pub fn inverse(matrix: &[Vec<Interval>], bits: u32) -> Option<Dyadics> {
    let size = matrix.len();
    let one = BigInt::one() << bits;
    let mut rows: Dyadics = Vec::with_capacity(size);
    for (i, row) in matrix.iter().enumerate() {
        let mut entries: Vec<BigInt> = row.iter().map(middle).collect();
        entries.extend((0..size).map(|j| if i == j { one.clone() } else { BigInt::zero() }));
        rows.push(entries);
    }
    for column in 0..size {
        let pivot = (column..size).max_by_key(|&i| rows[i][column].abs())?;
        rows.swap(column, pivot);
        let divisor = rows[column][column].clone();
        if divisor.is_zero() {
            return None;
        }
        for entry in &mut rows[column] {
            *entry = (&*entry << bits) / &divisor;
        }
        let reference = rows[column].clone();
        for (i, row) in rows.iter_mut().enumerate() {
            if i != column && !row[column].is_zero() {
                let factor = row[column].clone();
                for (entry, r) in row.iter_mut().zip(&reference) {
                    *entry -= (&factor * r) >> bits;
                }
            }
        }
    }
    Some(rows.into_iter().map(|row| row[size..].to_vec()).collect())
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::arithmetic::rational::ratio;

    #[test]
    fn inverses_are_inverse_to_the_last_places() {
        let bits = 120;
        let entries = [[2, -1, 0], [3, 0, 5], [0, 7, 1]];
        let interval = |&n: &i64| Interval::enclosing(&ratio(n, 3), bits);
        let matrix: Vec<Vec<Interval>> = entries
            .iter()
            .map(|row| row.iter().map(interval).collect())
            .collect();
        let inverse = inverse(&matrix, bits).expect("regular");
        for (i, row) in inverse.iter().enumerate() {
            for j in 0..3 {
                let sum: BigInt = row
                    .iter()
                    .zip(&matrix)
                    .map(|(x, r)| x * middle(&r[j]))
                    .sum();
                let wanted = if i == j {
                    BigInt::one() << bits
                } else {
                    BigInt::zero()
                };
                assert!(((sum >> bits) - wanted).bits() < 12);
            }
        }
        let singular = vec![matrix[0].clone(), matrix[0].clone(), matrix[1].clone()];
        assert!(super::inverse(&singular, bits).is_none());
    }
}
