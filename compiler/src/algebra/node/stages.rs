//! The node algebra as an algebra of functions of the stages.

use std::borrow::Cow;

use num_rational::BigRational;

use super::{NodeAlgebra, NodeNumber, Tensor, closed_form};
use crate::algebra::stage_algebra::group_by;
use crate::algebra::{Number, Rationals, StageAlgebra, Zero};
use crate::arithmetic::polynomial::Polynomial;

impl StageAlgebra for NodeAlgebra {
    type Vector = Polynomial;
    type Matrix = Tensor;
    type Constants = Rationals;

    fn stages(&self) -> usize {
        self.dimension()
    }

    fn constant(&self, value: &BigRational) -> Polynomial {
        Polynomial::constant(value.clone())
    }

    fn add(&self, f: &Polynomial, g: &Polynomial) -> Polynomial {
        f + g
    }

    fn subtract(&self, f: &Polynomial, g: &Polynomial) -> Polynomial {
        f - g
    }

    fn multiply(&self, f: &Polynomial, g: &Polynomial) -> Polynomial {
        NodeAlgebra::multiply(self, f, g)
    }

    fn reciprocal(&self, f: &Polynomial) -> Result<Polynomial, (usize, Zero)> {
        self.inverse(f).map_err(|divisor| {
            let vanishes = |index: &usize| self.roots()[*index].is_root_of_divisor(&divisor);
            let first = (0..self.dimension()).find(vanishes).unwrap_or(0);
            (first, Zero::Yes)
        })
    }

    fn constants(&self) -> &Rationals {
        &Rationals
    }

    /// The coordinates in the basis of the powers of `x`.
    fn coordinates(&self, f: &Polynomial) -> Vec<BigRational> {
        let mut coordinates = f.coefficients();
        coordinates.resize(self.dimension(), BigRational::default());
        coordinates
    }

    fn functional(&self, f: &Polynomial) -> Vec<BigRational> {
        let power = |k| self.trace(&(&Polynomial::monomial(k) * f));
        (0..self.dimension()).map(power).collect()
    }

    fn operator(&self, m: &Tensor) -> Vec<Vec<BigRational>> {
        let image = |k| self.coordinates(&m.apply(self, &Polynomial::monomial(k)));
        let columns: Vec<_> = (0..self.dimension()).map(image).collect();
        let row = |i: usize| columns.iter().map(|column| column[i].clone()).collect();
        (0..self.dimension()).map(row).collect()
    }

    fn sum(&self, f: &Polynomial) -> Number<'_> {
        Number::Rational(self.trace(f))
    }

    fn inner(&self, f: &Polynomial, g: &Polynomial) -> Number<'_> {
        Number::Rational(self.trace_of_product(f, g))
    }

    fn outer(&self, f: &Polynomial, g: &Polynomial) -> Tensor {
        Tensor::from_products(self, &[(f.clone(), g.clone())])
    }

    fn add_matrices(&self, m: &Tensor, n: &Tensor) -> Tensor {
        m.add(n)
    }

    fn subtract_matrices(&self, m: &Tensor, n: &Tensor) -> Tensor {
        m.subtract(n)
    }

    fn transpose(&self, m: &Tensor) -> Tensor {
        m.transpose()
    }

    fn scale_rows(&self, m: &Tensor, f: &Polynomial) -> Tensor {
        m.scale_rows(self, f)
    }

    fn apply(&self, m: &Tensor, f: &Polynomial) -> Polynomial {
        m.apply(self, f)
    }

    fn values<'a>(&'a self, f: Cow<'a, Polynomial>) -> Vec<Number<'a>> {
        if let Some(value) = f.as_constant() {
            return vec![Number::Rational(value); self.dimension()];
        }
        let values = NodeNumber::of_element(self, f);
        values.into_iter().map(Number::Node).collect()
    }

    fn entries<'a>(&'a self, m: &'a Tensor) -> Vec<Vec<Number<'a>>> {
        (0..self.dimension()).map(|row| self.row(m, row)).collect()
    }

    fn row<'a>(&'a self, m: &'a Tensor, row: usize) -> Vec<Number<'a>> {
        if m.is_zero() {
            return vec![Number::Rational(BigRational::default()); self.dimension()];
        }
        let entries = NodeNumber::of_row(self, m, row);
        entries.into_iter().map(Number::Node).collect()
    }

    fn exact_sum(&self, f: &Polynomial) -> Option<String> {
        Some(self.trace(f).to_string())
    }

    fn exact_values(&self, f: &Polynomial) -> Vec<Option<String>> {
        let forms = closed_form::of_element(self, f).into_iter();
        forms
            .map(|form| form.map(|form| form.to_string()))
            .collect()
    }

    fn exact_entries(&self, m: &Tensor) -> Vec<Vec<Option<String>>> {
        let text = |row: Vec<Option<super::ClosedForm>>| {
            let forms = row.into_iter();
            forms
                .map(|form| form.map(|form| form.to_string()))
                .collect()
        };
        let mut rows: Vec<Vec<Option<String>>> = closed_form::of_tensor(self, m)
            .into_iter()
            .map(text)
            .collect();
        if rows.iter().flatten().any(Option::is_none) {
            // Rational entries at two nodes of higher degree, especially zeros.
            let numbers = self.entries(m).into_iter().flatten();
            let missing = rows.iter_mut().flatten().zip(numbers);
            for (text, number) in missing.filter(|(text, _)| text.is_none()) {
                *text = number.short_rational().map(|value| value.to_string());
            }
        }
        rows
    }

    fn verified_bits(&self) -> Option<u32> {
        None
    }

    /// Stages at irrational nodes are not grouped, unless all rows are equal.
    fn equal_rows(&self, m: &Tensor, columns: &[Vec<usize>]) -> Vec<Vec<usize>> {
        if m.columns()
            .iter()
            .all(|column| column.as_constant().is_some())
        {
            return vec![(0..self.dimension()).collect()];
        }
        // The factor of the node polynomial whose roots are the irrational nodes.
        let linear = |node: &BigRational| {
            Polynomial::from_rationals(&[-node, BigRational::from_integer(1.into())])
        };
        let rational_nodes = (0..self.dimension()).filter_map(|stage| self.rational_node(stage));
        let irrational = rational_nodes.fold(self.modulus().clone(), |rest, node| {
            rest.div_rem(&linear(node))
                .map_or(Polynomial::zero(), |(quotient, _)| quotient)
        });
        let key = |stage| {
            let row = m.row_at(self.rational_node(stage)?);
            if let [_] = columns {
                return Some((Polynomial::zero(), vec![self.trace(&row)]));
            }
            let value = |j: &usize| self.rational_node(*j).map(|node| row.evaluate(node));
            let sums: Vec<BigRational> = columns
                .iter()
                .map(|group| group.iter().filter_map(value).sum())
                .collect();
            Some((row.remainder(&irrational), sums))
        };
        group_by(self.dimension(), key, |a, b| a == b)
    }

    fn sees_coincidences_of(&self, stage: usize) -> bool {
        self.rational_node(stage).is_some()
    }

    fn merged_entry(&self, m: &Tensor, row: usize, group: &[usize]) -> Number<'_> {
        if group.len() == self.dimension() {
            return Number::Node(NodeNumber::at(self, m.apply(self, &Polynomial::one()), row));
        }
        let columns = group.iter().filter_map(|&j| self.rational_node(j));
        let sum = columns.fold(Polynomial::zero(), |sum, node| &sum + &m.column_at(node));
        Number::Node(NodeNumber::at(self, sum, row))
    }

    fn merged_value(&self, f: &Polynomial, group: &[usize]) -> Number<'_> {
        if group.len() == self.dimension() {
            return Number::Rational(self.trace(f));
        }
        let nodes = group.iter().filter_map(|&j| self.rational_node(j));
        Number::Rational(nodes.map(|node| f.evaluate(node)).sum())
    }
}

impl NodeAlgebra {
    fn rational_node(&self, stage: usize) -> Option<&BigRational> {
        self.roots()[stage].rational()
    }
}
