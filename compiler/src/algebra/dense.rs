//! Vectors and matrices as lists of numbers in a field.

use std::borrow::Cow;
use std::fmt::Debug;

use num_rational::BigRational;

use super::stage_algebra::group_by;
use super::{Ball, Image, Number, StageAlgebra, Zero};
use crate::symbolic::Constant;

/// A field of real numbers.
pub trait Field: Debug + PartialEq + Send + Sync {
    /// Its elements. Equal elements are equal numbers. If equal numbers may be different elements,
    /// [`Field::zero`] decides as far as possible.
    type Element: Clone + Debug + PartialEq + Send + Sync;

    /// A rational number.
    fn rational(&self, value: &BigRational) -> Self::Element;
    /// A constant, if it is an element.
    fn constant(&self, value: &Constant) -> Option<Self::Element>;
    /// An expression, if these are elements.
    fn real(&self, _value: &super::Real) -> Option<Self::Element> {
        None
    }
    /// The sum.
    fn add(&self, x: &Self::Element, y: &Self::Element) -> Self::Element;
    /// The difference.
    fn subtract(&self, x: &Self::Element, y: &Self::Element) -> Self::Element;
    /// The product.
    fn multiply(&self, x: &Self::Element, y: &Self::Element) -> Self::Element;
    /// The inverse; `None` for zero and for numbers that cannot be distinguished from it.
    fn inverse(&self, x: &Self::Element) -> Option<Self::Element>;
    /// The binary places to which equations are verified; `None` if they are decided.
    fn verified_bits(&self) -> Option<u32>;
    /// Whether an element is zero.
    fn zero(&self, x: &Self::Element) -> Zero;
    /// The best divisor among elements: the index of an element that is known to be nonzero.
    fn pivot(&self, candidates: &[&Self::Element]) -> Option<usize>;
    /// A positive rational whose products with these elements are cheaper to compute with: a common
    /// denominator. It may always be 1.
    fn common_denominator<'a>(
        &self,
        _elements: impl Iterator<Item = &'a Self::Element>,
    ) -> BigRational
    where
        Self::Element: 'a,
    {
        BigRational::from_integer(1.into())
    }
    /// An element as a number.
    fn number(&self, x: &Self::Element) -> Number<'_>;
    /// A readable exact form, if there is one.
    fn exact(&self, x: &Self::Element) -> Option<String>;
    /// An enclosure with this many bits.
    fn enclose(&self, x: &Self::Element, bits: u32) -> Ball {
        self.number(x).ball(bits)
    }
    /// Homomorphisms to finite fields, if there are any.
    fn images(&self) -> &[Image] {
        &[]
    }
    /// The image of an element under a homomorphism; `None` if a denominator is mapped to zero.
    fn image(&self, _x: &Self::Element, _image: &Image) -> Option<u64> {
        None
    }
    /// Whether arithmetic reduces long elements to lowest terms, so that its cost must be bounded.
    fn is_costly(&self) -> bool {
        false
    }
    /// Whether arithmetic keeps its operands in an expression that is evaluated later.
    fn keeps_operands(&self) -> bool {
        false
    }
    /// The approximate number of machine words of an element, if arithmetic is costly.
    fn length(&self, _x: &Self::Element) -> u64 {
        0
    }
    /// The bits beyond which enclosures do not get narrower; `None` if numbers can be enclosed to any precision.
    fn finest_bits(&self) -> Option<u32> {
        None
    }
    /// Records that a question was left undecided.
    fn doubt(&self) {}
}

/// The algebra of functions of `stages` stages with values in a field, computed value by value.
#[derive(Debug, Clone, PartialEq)]
pub struct Dense<F> {
    field: F,
    stages: usize,
}

impl<F: Field> Dense<F> {
    /// The functions of this many stages with values in a field.
    pub fn new(field: F, stages: usize) -> Self {
        Dense { field, stages }
    }

    /// The field of the values.
    pub fn field(&self) -> &F {
        &self.field
    }

    fn total<'a>(&self, values: impl Iterator<Item = &'a F::Element>) -> F::Element
    where
        F::Element: 'a,
    {
        values
            .cloned()
            .reduce(|sum, value| self.field.add(&sum, &value))
            .unwrap_or_else(|| self.field.rational(&BigRational::default()))
    }
}

type Vector<F> = Vec<<F as Field>::Element>;
type Matrix<F> = Vec<Vector<F>>;

fn zip<T>(x: &[T], y: &[T], operation: impl Fn(&T, &T) -> T) -> Vec<T> {
    x.iter().zip(y).map(|(x, y)| operation(x, y)).collect()
}

impl<F: Field> StageAlgebra for Dense<F> {
    type Vector = Vector<F>;
    type Matrix = Matrix<F>;
    type Constants = F;

    fn stages(&self) -> usize {
        self.stages
    }

    fn constant(&self, value: &BigRational) -> Vector<F> {
        vec![self.field.rational(value); self.stages]
    }

    fn add(&self, f: &Vector<F>, g: &Vector<F>) -> Vector<F> {
        zip(f, g, |x, y| self.field.add(x, y))
    }

    fn subtract(&self, f: &Vector<F>, g: &Vector<F>) -> Vector<F> {
        zip(f, g, |x, y| self.field.subtract(x, y))
    }

    fn multiply(&self, f: &Vector<F>, g: &Vector<F>) -> Vector<F> {
        zip(f, g, |x, y| self.field.multiply(x, y))
    }

    fn reciprocal(&self, f: &Vector<F>) -> Result<Vector<F>, (usize, Zero)> {
        let inverse = |(i, x)| {
            let inverse = self.field.inverse(x);
            inverse.ok_or_else(|| (i, self.field.zero(x)))
        };
        f.iter().enumerate().map(inverse).collect()
    }

    fn constants(&self) -> &F {
        &self.field
    }

    fn coordinates(&self, f: &Vector<F>) -> Vector<F> {
        f.clone()
    }

    fn functional(&self, f: &Vector<F>) -> Vector<F> {
        f.clone()
    }

    fn operator(&self, m: &Matrix<F>) -> Matrix<F> {
        m.clone()
    }

    fn sum(&self, f: &Vector<F>) -> Number<'_> {
        self.field.number(&self.total(f.iter()))
    }

    fn outer(&self, f: &Vector<F>, g: &Vector<F>) -> Matrix<F> {
        let row = |x| g.iter().map(|y| self.field.multiply(x, y)).collect();
        f.iter().map(row).collect()
    }

    fn add_matrices(&self, m: &Matrix<F>, n: &Matrix<F>) -> Matrix<F> {
        let rows = m.iter().zip(n);
        rows.map(|(x, y)| StageAlgebra::add(self, x, y)).collect()
    }

    fn subtract_matrices(&self, m: &Matrix<F>, n: &Matrix<F>) -> Matrix<F> {
        let rows = m.iter().zip(n);
        rows.map(|(x, y)| StageAlgebra::subtract(self, x, y))
            .collect()
    }

    fn transpose(&self, m: &Matrix<F>) -> Matrix<F> {
        let column = |j: usize| m.iter().map(|row| row[j].clone()).collect();
        (0..self.stages).map(column).collect()
    }

    fn scale_rows(&self, m: &Matrix<F>, f: &Vector<F>) -> Matrix<F> {
        let scaled = |(row, x): (&Vector<F>, &F::Element)| {
            row.iter().map(|y| self.field.multiply(x, y)).collect()
        };
        m.iter().zip(f).map(scaled).collect()
    }

    /// A row that extends the previous row by one entry, as in a splitting, takes one product.
    fn apply(&self, m: &Matrix<F>, f: &Vector<F>) -> Vector<F> {
        let zero = self.field.rational(&BigRational::default());
        let end = |row: &Vector<F>| row.iter().rposition(|x| *x != zero).map_or(0, |j| j + 1);
        let sum = |start: Option<&F::Element>, row: &[F::Element], f: &[F::Element]| {
            let products = zip(row, f, |x, y| self.field.multiply(x, y));
            self.total(start.into_iter().chain(&products))
        };
        let mut sums: Vector<F> = Vec::with_capacity(m.len());
        let mut before: &[F::Element] = &[];
        for row in m {
            let (known, length) = (before.len(), end(row));
            let start = sums.last().filter(|_| known > 0 && row.starts_with(before));
            let next = match start {
                Some(start) => sum(Some(start), &row[known..length.max(known)], &f[known..]),
                None => sum(None, &row[..length], f),
            };
            sums.push(next);
            before = &row[..length];
        }
        sums
    }

    fn values<'a>(&'a self, f: Cow<'a, Vector<F>>) -> Vec<Number<'a>> {
        f.iter().map(|x| self.field.number(x)).collect()
    }

    fn entries<'a>(&'a self, m: &'a Matrix<F>) -> Vec<Vec<Number<'a>>> {
        (0..m.len()).map(|row| self.row(m, row)).collect()
    }

    fn row<'a>(&'a self, m: &'a Matrix<F>, row: usize) -> Vec<Number<'a>> {
        self.values(Cow::Borrowed(&m[row]))
    }

    fn exact_sum(&self, f: &Vector<F>) -> Option<String> {
        self.field.exact(&self.total(f.iter()))
    }

    fn exact_values(&self, f: &Vector<F>) -> Vec<Option<String>> {
        f.iter().map(|x| self.field.exact(x)).collect()
    }

    fn exact_entries(&self, m: &Matrix<F>) -> Vec<Vec<Option<String>>> {
        m.iter().map(|row| self.exact_values(row)).collect()
    }

    fn verified_bits(&self) -> Option<u32> {
        self.field.verified_bits()
    }

    fn is_lower_triangular(&self, m: &Matrix<F>, b: &Vector<F>, filled: bool) -> bool {
        let zero = self.field.rational(&BigRational::default());
        m.iter().enumerate().all(|(i, row)| {
            let steps = i + usize::from(filled);
            row[..steps] == b[..steps] && row[steps..].iter().all(|x| *x == zero)
        })
    }

    fn ends_of_steps(&self, m: &Matrix<F>, b: &Vector<F>) -> Vec<usize> {
        let zero = self.field.rational(&BigRational::default());
        let is_end = |end: &usize| {
            let (before, after) = m.split_at(*end);
            before
                .iter()
                .all(|row| row[*end..].iter().all(|x| *x == zero))
                && after.iter().all(|row| row[..*end] == b[..*end])
        };
        (1..self.stages).filter(is_end).collect()
    }

    fn partial_sums(&self, f: &Vector<F>, own: bool) -> Option<Vector<F>> {
        let mut sum = self.field.rational(&BigRational::default());
        let step = |x: &F::Element| {
            let next = self.field.add(&sum, x);
            let before = std::mem::replace(&mut sum, next);
            if own { sum.clone() } else { before }
        };
        Some(f.iter().map(step).collect())
    }

    fn equal_rows(&self, m: &Matrix<F>, columns: &[Vec<usize>]) -> Vec<Vec<usize>> {
        let key = |stage: usize| {
            let row = &m[stage];
            let sum = |group: &Vec<usize>| self.total(group.iter().map(|&j| &row[j]));
            Some(columns.iter().map(sum).collect::<Vec<_>>())
        };
        let equal = |f: &Vector<F>, g: &Vector<F>| {
            let mut pairs = f.iter().zip(g);
            pairs.all(|(x, y)| x == y || self.field.zero(&self.field.subtract(x, y)).may_be())
        };
        group_by(self.stages, key, equal)
    }

    fn sees_coincidences_of(&self, _stage: usize) -> bool {
        true
    }

    fn merged_entry(&self, m: &Matrix<F>, row: usize, group: &[usize]) -> Number<'_> {
        let entries = group.iter().map(|&j| &m[row][j]);
        self.field.number(&self.total(entries))
    }

    fn merged_value(&self, f: &Vector<F>, group: &[usize]) -> Number<'_> {
        self.field.number(&self.total(group.iter().map(|&j| &f[j])))
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::algebra::Rationals;
    use crate::arithmetic::rational::ratio;

    /// A row that extends the previous one, one that repeats it, one that does neither, and a row of zeros.
    #[test]
    fn row_sums_reuse_the_sum_of_the_row_that_they_extend() {
        let algebra = Dense::new(Rationals, 6);
        let rows = [
            [1, 0, 0, 0, 0, 0],
            [1, 2, 3, 0, 0, 0],
            [1, 2, 3, 0, 0, 0],
            [1, 2, 0, 4, 0, 0],
            [0, 0, 0, 0, 0, 0],
            [0, 2, 0, 0, 0, 5],
        ];
        let whole = |x: &i64| ratio(*x, 1);
        let matrix: Vec<Vec<BigRational>> =
            rows.iter().map(|r| r.iter().map(whole).collect()).collect();
        let vector: Vec<BigRational> = [7, 1, 1, 2, 9, 10].iter().map(whole).collect();
        let sums: Vec<BigRational> = [7, 12, 12, 17, 0, 52].iter().map(whole).collect();
        assert_eq!(algebra.apply(&matrix, &vector), sums);
        let partial = |own| algebra.partial_sums(&vector, own).expect("dense");
        let whole = |list: [i64; 6]| -> Vec<BigRational> { list.iter().map(whole).collect() };
        assert_eq!(partial(true), whole([7, 8, 9, 11, 20, 30]));
        assert_eq!(partial(false), whole([0, 7, 8, 9, 11, 20]));
    }
}
