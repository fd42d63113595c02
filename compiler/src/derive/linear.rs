//! Linear systems over a field.

use num_rational::BigRational;
use num_traits::One;

use crate::algebra::{Field, Zero};

/// The reason why a system has no unique solution, or is not known to have one.
pub struct Singular<T> {
    /// Coefficients of a combination of the rows that vanishes.
    pub combination: Vec<T>,
    /// Whether the combination is proved to vanish, rather than just not known to be nonzero.
    pub proved: bool,
}

/// Solves `Σ_j m_ij x_j = y_i` for several right-hand sides at once, by elimination.
///
/// The right-hand sides and the solutions are the rows of `right` and of the result.
///
/// # Errors
/// If the rows of the matrix are linearly dependent, or not known to be independent: a combination.
pub fn solve<F: Field>(
    field: &F,
    matrix: &[Vec<F::Element>],
    right: &[Vec<F::Element>],
) -> Result<Vec<Vec<F::Element>>, Singular<F::Element>> {
    let size = matrix.len();
    let [zero, one] = [BigRational::default(), BigRational::one()].map(|q| field.rational(&q));
    // Each row with its coefficients in terms of the given rows, and with its right-hand sides.
    let mut rows: Vec<Row<F>> = (0..size)
        .map(|i| Row {
            entries: matrix[i].clone(),
            origin: (0..size)
                .map(|k| if k == i { one.clone() } else { zero.clone() })
                .collect(),
            right: right.iter().map(|y| y[i].clone()).collect(),
        })
        .collect();
    for column in 0..size {
        let candidates: Vec<&F::Element> = rows[column..]
            .iter()
            .map(|row| &row.entries[column])
            .collect();
        let Some(pivot) = field.pivot(&candidates) else {
            let rest = &rows[column];
            let entries = rest.entries[column..].iter();
            return Err(Singular {
                combination: rest.origin.clone(),
                proved: entries.map(|x| field.zero(x)).all(|zero| zero == Zero::Yes),
            });
        };
        rows.swap(column, column + pivot);
        // Pivots are known to be nonzero.
        let Some(inverse) = field.inverse(&rows[column].entries[column]) else {
            continue;
        };
        let reference = rows[column].map(|x| field.multiply(x, &inverse));
        for (i, row) in rows.iter_mut().enumerate() {
            if i != column && field.zero(&row.entries[column]) != Zero::Yes {
                let factor = row.entries[column].clone();
                *row = row.zip(&reference, |x, y| {
                    field.subtract(x, &field.multiply(&factor, y))
                });
            }
        }
        rows[column] = reference;
    }
    let solution = |k: usize| rows.iter().map(|row| row.right[k].clone()).collect();
    Ok((0..right.len()).map(solution).collect())
}

struct Row<F: Field> {
    entries: Vec<F::Element>,
    origin: Vec<F::Element>,
    right: Vec<F::Element>,
}

impl<F: Field> Row<F> {
    fn map(&self, each: impl Fn(&F::Element) -> F::Element) -> Self {
        let all = |row: &[F::Element]| row.iter().map(&each).collect();
        Row {
            entries: all(&self.entries),
            origin: all(&self.origin),
            right: all(&self.right),
        }
    }

    fn zip(&self, other: &Self, each: impl Fn(&F::Element, &F::Element) -> F::Element) -> Self {
        let all = |row: &[F::Element], other: &[F::Element]| {
            row.iter().zip(other).map(|(x, y)| each(x, y)).collect()
        };
        Row {
            entries: all(&self.entries, &other.entries),
            origin: all(&self.origin, &other.origin),
            right: all(&self.right, &other.right),
        }
    }
}
