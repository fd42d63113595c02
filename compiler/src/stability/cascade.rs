//! A composition of several steps: its matrix is the product of theirs.
//!
//! The stages of a composition are those of its steps, and each contains all weights of the previous steps:
//!
//! ```text
//!     ⎛ A₁                ⎞
//! A = ⎜ 1b₁ᵀ  A₂          ⎟      bᵀ = (b₁ᵀ b₂ᵀ b₃ᵀ) ,
//!     ⎝ 1b₁ᵀ  1b₂ᵀ  A₃    ⎠
//! ```
//!
//! and the same for momenta. The inverse of `1 + xÃA` for all stages takes `s⁴` products; the inverses for the steps take far fewer.

use std::ops::Range;

use num_rational::BigRational;
use num_traits::{One, Zero};

use super::oscillator::Parts;
use crate::algebra::{Field, StageAlgebra};
use crate::partitioned::Partitioned;

/// The stages of each of the steps; the whole range if there is only one.
pub(super) fn steps<A: StageAlgebra>(pair: &Partitioned<A>) -> Vec<Range<usize>> {
    let algebra = &*pair.algebra;
    let ends = algebra.ends_of_steps(&pair.a, &pair.b);
    let others = match pair.equal_halves() {
        (true, true) => None,
        _ => Some(algebra.ends_of_steps(&pair.a_tilde, &pair.b_tilde)),
    };
    let both = |end: &usize| others.as_ref().is_none_or(|others| others.contains(end));
    let mut start = 0;
    let mut steps = Vec::new();
    for end in ends.into_iter().filter(both).chain([algebra.stages()]) {
        if end > start {
            steps.push(start..end);
            start = end;
        }
    }
    steps
}

/// Some rows and columns of a matrix.
pub(super) fn block<T: Clone>(matrix: &[Vec<T>], stages: &Range<usize>) -> Vec<Vec<T>> {
    let rows = matrix[stages.clone()].iter();
    rows.map(|row| row[stages.clone()].to_vec()).collect()
}

/// Polynomials over a field, as lists of their coefficients with the constant first.
struct Lists<'a, F: Field> {
    field: &'a F,
}

impl<F: Field> Lists<'_, F> {
    fn zero(&self) -> F::Element {
        self.field.rational(&BigRational::zero())
    }

    fn one(&self) -> Vec<F::Element> {
        vec![self.field.rational(&BigRational::one())]
    }

    fn add(&self, x: &[F::Element], y: &[F::Element]) -> Vec<F::Element> {
        let (long, short) = if x.len() < y.len() { (y, x) } else { (x, y) };
        let mut sum = long.to_vec();
        for (sum, y) in sum.iter_mut().zip(short) {
            *sum = self.field.add(sum, y);
        }
        sum
    }

    fn negate(&self, list: &[F::Element]) -> Vec<F::Element> {
        let zero = self.zero();
        list.iter().map(|x| self.field.subtract(&zero, x)).collect()
    }

    fn multiply(&self, x: &[F::Element], y: &[F::Element]) -> Vec<F::Element> {
        if x.is_empty() || y.is_empty() {
            return Vec::new();
        }
        let mut product = vec![self.zero(); x.len() + y.len() - 1];
        for (i, x) in x.iter().enumerate() {
            for (sum, y) in product[i..].iter_mut().zip(y) {
                *sum = self.field.add(sum, &self.field.multiply(x, y));
            }
        }
        product
    }

    /// The product with the variable.
    fn shift(&self, list: &[F::Element]) -> Vec<F::Element> {
        let mut shifted = vec![self.zero()];
        shifted.extend_from_slice(list);
        shifted
    }

    /// `(x − y)/X` for lists with the same constant coefficient.
    fn difference_over_variable(&self, x: &[F::Element], y: &[F::Element]) -> Vec<F::Element> {
        let rest = |list: &[F::Element]| list.get(1..).unwrap_or_default().to_vec();
        self.add(&rest(x), &self.negate(&rest(y)))
    }
}

/// The parts of the composition from those of its steps, in the order of the steps.
pub(super) fn joined<F: Field>(
    field: &F,
    steps: &[Parts<Vec<F::Element>>],
) -> Parts<Vec<F::Element>> {
    let lists = Lists { field };
    // D M as M11, M12/ν, M21/ν and M22.
    let mut all = [lists.one(), Vec::new(), Vec::new(), lists.one()];
    let mut determinant = lists.one();
    let mut b_sum = vec![lists.zero()];
    for step in steps {
        let d = &step.determinant;
        let less = |x: &[F::Element]| lists.add(d, &lists.negate(&lists.shift(x)));
        let (s11, s12, s22) = (less(&step.b_c), &step.b_one, less(&step.ab_one));
        let drift = lists.negate(&lists.multiply(d, &step.b_sum));
        let s21 = lists.add(&lists.shift(&step.ab_c), &drift);
        let [m11, m12, m21, m22] = &all;
        let sum = |a: &[F::Element], m: &[F::Element], b: &[F::Element], n: &[F::Element]| {
            lists.add(&lists.multiply(a, m), &lists.multiply(b, n))
        };
        all = [
            sum(&s11, m11, &lists.shift(s12), m21),
            sum(&s11, m12, s12, m22),
            sum(&s21, m11, &s22, m21),
            sum(&lists.shift(&s21), m12, &s22, m22),
        ];
        determinant = lists.multiply(&determinant, d);
        b_sum = lists.add(&b_sum, &step.b_sum);
    }
    let [m11, m12, m21, m22] = all;
    let drift = lists.multiply(&determinant, &b_sum);
    Parts {
        b_c: lists.difference_over_variable(&determinant, &m11),
        ab_one: lists.difference_over_variable(&determinant, &m22),
        ab_c: lists.difference_over_variable(&m21, &lists.negate(&drift)),
        b_one: m12,
        b_sum,
        determinant,
    }
}

/// `det(1 − zA)` and `bᵀ adj(1 − zA) 1` of the composition from those of its steps: the stability function is the product.
pub(super) fn joined_functions<F: Field>(
    field: &F,
    steps: &[[Vec<F::Element>; 2]],
) -> [Vec<F::Element>; 2] {
    let lists = Lists { field };
    let (mut below, mut above) = (lists.one(), lists.one());
    for [determinant, numerator] in steps {
        let step = lists.add(determinant, &lists.shift(numerator));
        (below, above) = (
            lists.multiply(&below, determinant),
            lists.multiply(&above, &step),
        );
    }
    let numerator = lists.difference_over_variable(&above, &below);
    [below, numerator]
}

#[cfg(test)]
mod tests {
    use super::super::oscillator::{parts_by_steps, parts_of_stages};
    use super::super::runge_kutta;
    use super::*;
    use crate::algebra::{Dense, Rationals};
    use crate::arithmetic::rational::ratio;
    use std::sync::Arc;

    /// Two steps of two stages and a step of one stage: `[[1/3, 1/5], [2/7, −1]]`, `[[2, 1], [0, 1/2]]` and `[[3/2]]`, with other
    /// matrices for momenta.
    fn composition() -> Partitioned<Dense<Rationals>> {
        let b = [(1, 2), (1, 3), (-1, 4), (2, 1), (1, 7)].map(|(n, d)| ratio(n, d));
        let b_tilde = [(1, 5), (-2, 3), (1, 1), (1, 6), (3, 2)].map(|(n, d)| ratio(n, d));
        let rows = |b: &[BigRational], seed: i64| -> Vec<Vec<BigRational>> {
            let step = |i: usize| i / 2;
            let entry = |i: usize, j: usize| match step(i).cmp(&step(j)) {
                std::cmp::Ordering::Greater => b[j].clone(),
                std::cmp::Ordering::Less => ratio(0, 1),
                std::cmp::Ordering::Equal => ratio(seed - 3 * (i as i64), 2 + j as i64),
            };
            let row = |i: usize| (0..b.len()).map(|j| entry(i, j)).collect();
            (0..b.len()).map(row).collect()
        };
        Partitioned {
            algebra: Arc::new(Dense::new(Rationals, 5)),
            a: rows(&b, 1),
            a_tilde: rows(&b_tilde, 5),
            b: b.to_vec(),
            b_tilde: b_tilde.to_vec(),
            gradient: None,
        }
    }

    fn trimmed(mut list: Vec<BigRational>) -> Vec<BigRational> {
        while list.last().is_some_and(Zero::is_zero) {
            list.pop();
        }
        list
    }

    #[test]
    fn the_steps_together_are_the_whole() {
        let pair = composition();
        assert_eq!(steps(&pair), [0..2, 2..4, 4..5]);
        let each = |list: &Vec<BigRational>| Some(trimmed(list.clone()));
        let by_steps = parts_by_steps(&pair, &steps(&pair)).map(each).expect("all");
        let whole = parts_of_stages(&pair).map(each).expect("all");
        assert_eq!(by_steps.determinant, whole.determinant);
        assert_eq!(by_steps.b_one, whole.b_one);
        assert_eq!(by_steps.b_c, whole.b_c);
        assert_eq!(by_steps.ab_one, whole.ab_one);
        assert_eq!(by_steps.ab_c, whole.ab_c);
        assert_eq!(by_steps.b_sum, whole.b_sum);
        let by_steps = runge_kutta::parts(&pair).map(trimmed);
        let whole = runge_kutta::parts_of_stages(
            &Rationals,
            &pair.a,
            &pair.b,
            &vec![ratio(1, 1); pair.b.len()],
        );
        assert_eq!(by_steps, whole.map(trimmed));
    }

    #[test]
    fn a_changed_coefficient_joins_two_steps() {
        let mut pair = composition();
        pair.a_tilde[2][1] += ratio(1, 1000);
        assert_eq!(steps(&pair), [0..4, 4..5]);
        pair.a[0][4] = ratio(1, 9);
        assert_eq!(steps(&pair), std::slice::from_ref(&(0..5)));
    }
}
