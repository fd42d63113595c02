//! The inverse of `1 + xP` as a rational function of `x`.

use num_rational::BigRational;
use num_traits::{One, Zero};

use crate::algebra::Field;

/// `det(1 + xP)` and the data to compute `uᵀ adj(1 + xP) v`, for a square matrix `P` over a field.
///
/// Faddeev and Le Verrier: with `B_0 = 1`, `c_k = tr(P B_{k−1})/k` and `B_k = c_k − P B_{k−1}`,
///
/// ```text
/// det(1 + xP) = Σ_{k≤s} c_k xᵏ      adj(1 + xP) = Σ_{k<s} B_k xᵏ
/// ```
///
/// and `B_s = 0` (Cayley–Hamilton). Both are polynomial identities, so their consequences are exact,
/// not approximations. The only divisors are integers, so no element has to be distinguished from zero.
pub(super) struct Resolvent<'a, F: Field> {
    field: &'a F,
    matrix: Cleared<F>,
    /// The `c_k` of the integral multiple of `P`.
    determinant: Vec<F::Element>,
}

/// Elements multiplied by a common denominator, so that most arithmetic is with integers.
struct Cleared<F: Field> {
    rows: Vec<Vec<F::Element>>,
    denominator: BigRational,
}

impl<F: Field> Cleared<F> {
    fn new(field: &F, rows: &[Vec<F::Element>]) -> Self {
        let denominator = field.common_denominator(rows.iter().flatten());
        let factor = field.rational(&denominator);
        let scaled = |x| field.multiply(x, &factor);
        let rows = rows.iter().map(|row| row.iter().map(scaled).collect());
        Cleared {
            rows: rows.collect(),
            denominator,
        }
    }
}

/// `Σ_i u_i v_i`.
pub(super) fn dot<'a, F: Field>(
    field: &F,
    u: impl IntoIterator<Item = &'a F::Element>,
    v: impl IntoIterator<Item = &'a F::Element>,
) -> F::Element
where
    F::Element: 'a,
{
    let products = u.into_iter().zip(v).map(|(x, y)| field.multiply(x, y));
    products
        .reduce(|sum, product| field.add(&sum, &product))
        .unwrap_or_else(|| field.rational(&BigRational::zero()))
}

/// `M v`.
pub(super) fn apply<F: Field>(
    field: &F,
    matrix: &[Vec<F::Element>],
    vector: &[F::Element],
) -> Vec<F::Element> {
    matrix.iter().map(|row| dot(field, row, vector)).collect()
}

/// `uᵀ M`.
pub(super) fn apply_left<F: Field>(
    field: &F,
    vector: &[F::Element],
    matrix: &[Vec<F::Element>],
) -> Vec<F::Element> {
    let column = |j: usize| dot(field, vector, matrix.iter().map(move |row| &row[j]));
    (0..vector.len()).map(column).collect()
}

fn product<F: Field>(
    field: &F,
    left: &[Vec<F::Element>],
    right: &[Vec<F::Element>],
) -> Vec<Vec<F::Element>> {
    let row = |row: &Vec<F::Element>| apply_left(field, row, right);
    left.iter().map(row).collect()
}

impl<'a, F: Field> Resolvent<'a, F> {
    /// The resolvent of the matrix `P`.
    pub(super) fn new(field: &'a F, matrix: &[Vec<F::Element>]) -> Self {
        Resolvent::of_cleared(field, Cleared::new(field, matrix))
    }

    /// The resolvent of the product `P = LR`.
    pub(super) fn of_product(
        field: &'a F,
        left: &[Vec<F::Element>],
        right: &[Vec<F::Element>],
    ) -> Self {
        let (left, right) = (Cleared::new(field, left), Cleared::new(field, right));
        let matrix = Cleared {
            rows: product(field, &left.rows, &right.rows),
            denominator: left.denominator * right.denominator,
        };
        Resolvent::of_cleared(field, matrix)
    }

    fn of_cleared(field: &'a F, matrix: Cleared<F>) -> Self {
        let size = matrix.rows.len();
        let mut determinant = vec![field.rational(&BigRational::one())];
        // B_0 = 1, and P B_0.
        let mut image = matrix.rows.clone();
        for k in 1..=size {
            let diagonal: Vec<_> = (0..size).map(|i| image[i][i].clone()).collect();
            let ones = vec![field.rational(&BigRational::one()); size];
            let inverse = field.rational(&BigRational::new(One::one(), k.into()));
            let c = field.multiply(&dot(field, &diagonal, &ones), &inverse);
            if k < size {
                let zero = field.rational(&BigRational::zero());
                for (i, row) in image.iter_mut().enumerate() {
                    for (j, x) in row.iter_mut().enumerate() {
                        *x = field.subtract(if i == j { &c } else { &zero }, x);
                    }
                }
                image = product(field, &matrix.rows, &image);
            }
            determinant.push(c);
        }
        Resolvent {
            field,
            matrix,
            determinant,
        }
    }

    /// The coefficients of `det(1 + xP)`, the constant first.
    pub(super) fn determinant(&self) -> Vec<F::Element> {
        self.scaled(&self.determinant, &BigRational::one())
    }

    /// The coefficients of `uᵀ adj(1 + xP) v` for a vector `v` and several `u`.
    pub(super) fn adjugate(
        &self,
        lefts: &[&[F::Element]],
        right: &[F::Element],
    ) -> Vec<Vec<F::Element>> {
        let field = self.field;
        let lefts: Vec<_> = lefts
            .iter()
            .map(|u| Cleared::new(field, &[u.to_vec()]))
            .collect();
        let mut right = Cleared::new(field, &[right.to_vec()]);
        let start = right.rows.pop().unwrap_or_default();
        let mut values = vec![Vec::new(); lefts.len()];
        // B_k v = c_k v − P B_{k−1} v
        let mut vector = start.clone();
        for k in 0..start.len() {
            if k > 0 {
                let image = apply(field, &self.matrix.rows, &vector);
                let next =
                    |(v, image)| field.subtract(&field.multiply(&self.determinant[k], v), image);
                vector = start.iter().zip(&image).map(next).collect();
            }
            for (values, left) in values.iter_mut().zip(&lefts) {
                values.push(dot(field, left.rows.iter().flatten(), &vector));
            }
        }
        let both = lefts
            .iter()
            .map(|left| &left.denominator * &right.denominator);
        let scaled = both.zip(&values).map(|(d, values)| self.scaled(values, &d));
        scaled.collect()
    }

    /// Coefficients for the matrix itself, from those for its integral multiple, divided by a number.
    fn scaled(&self, coefficients: &[F::Element], divisor: &BigRational) -> Vec<F::Element> {
        let mut factor = divisor.recip();
        let mut scaled = Vec::with_capacity(coefficients.len());
        for x in coefficients {
            scaled.push(self.field.multiply(x, &self.field.rational(&factor)));
            factor /= &self.matrix.denominator;
        }
        scaled
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::algebra::Rationals;
    use crate::arithmetic::polynomial::Polynomial;
    use crate::arithmetic::rational::ratio;
    use proptest::prelude::*;

    proptest! {
        /// `(1 + xP) adj(1 + xP) = det(1 + xP)`, entry by entry.
        #[test]
        fn the_adjugate_inverts(entries in prop::collection::vec((-5i64..6, 1i64..4), 9)) {
            let rows: Vec<Vec<BigRational>> =
                entries.chunks(3).map(|row| row.iter().map(|&(n, d)| ratio(n, d)).collect()).collect();
            let resolvent = Resolvent::new(&Rationals, &rows);
            let determinant = Polynomial::from_rationals(&resolvent.determinant());
            let unit = |i: usize| -> Vec<BigRational> { (0..3).map(|j| ratio(i64::from(i == j), 1)).collect() };
            for j in 0..3 {
                let column: Vec<Polynomial> = (0..3)
                    .map(|i| Polynomial::from_rationals(&resolvent.adjugate(&[&unit(i)], &unit(j))[0]))
                    .collect();
                for (i, row) in rows.iter().enumerate() {
                    let product = (0..3).fold(Polynomial::zero(), |sum, k| {
                        let entry = Polynomial::from_rationals(&[ratio(i64::from(i == k), 1), row[k].clone()]);
                        &sum + &(&entry * &column[k])
                    });
                    let expected = if i == j { determinant.clone() } else { Polynomial::zero() };
                    prop_assert_eq!(product, expected);
                }
            }
        }
    }
}
