//! Order conditions as polynomials in the unknowns, in doubles.

use nalgebra::{DMatrix, DVector};
use symplectic_compiler::arithmetic::rounding::to_f64;
use symplectic_compiler::certify::{Conditions, Word};

use crate::lie::{Combination, logarithm};
use crate::structure::Product;
use crate::words::Words;

/// `Σ_w c_w [w] − wanted` for each condition.
#[derive(Debug, Clone)]
pub(crate) struct Polynomials {
    words: Words,
    /// `c_w`: one row a condition, one column a word.
    forms: DMatrix<f64>,
    wanted: DVector<f64>,
}

impl Polynomials {
    pub(crate) fn new(conditions: &Conditions) -> Self {
        let all = conditions.conditions();
        let mut forms = DMatrix::zeros(all.len(), conditions.words().len());
        for (row, condition) in all.iter().enumerate() {
            for (word, factor) in &condition.terms {
                forms[(row, *word)] = to_f64(factor);
            }
        }
        Polynomials {
            words: Words::new(conditions.words(), conditions.alphabet()),
            wanted: DVector::from_iterator(all.len(), all.iter().map(|c| to_f64(&c.wanted))),
            forms,
        }
    }

    /// The same forms, which are to vanish.
    pub(crate) fn vanishing(conditions: &Conditions) -> Self {
        let mut found = Polynomials::new(conditions);
        found.wanted.fill(0.0);
        found
    }

    /// The values of the forms of conditions for a combination of words.
    pub(crate) fn coordinates(
        &self,
        conditions: &Conditions,
        element: &Combination,
    ) -> DVector<f64> {
        let words = conditions.words().iter();
        let values = words.map(|word| element.get(word).copied().unwrap_or(0.0));
        &self.forms * DVector::from_iterator(conditions.words().len(), values)
    }

    /// The forms of conditions for the logarithm instead of the product. That of the exact flow is zero in degrees above 1.
    pub(crate) fn of_logarithm(&self, conditions: &Conditions) -> Self {
        let logarithms: Vec<Combination> = conditions
            .words()
            .iter()
            .map(|word| logarithm(word))
            .collect();
        let mut words: Vec<Word> = logarithms
            .iter()
            .flat_map(|combination| combination.keys().cloned())
            .collect();
        words.sort();
        words.dedup();
        let of_products = DMatrix::from_fn(logarithms.len(), words.len(), |row, column| {
            logarithms[row].get(&words[column]).copied().unwrap_or(0.0)
        });
        Polynomials {
            words: Words::new(&words, conditions.alphabet()),
            forms: &self.forms * of_products,
            wanted: DVector::zeros(self.wanted.len()),
        }
    }

    /// Combinations of the conditions, one a row.
    pub(crate) fn combined(&self, factors: &DMatrix<f64>) -> Self {
        Polynomials {
            words: self.words.clone(),
            forms: factors * &self.forms,
            wanted: factors * &self.wanted,
        }
    }

    /// The number of conditions.
    pub(crate) fn len(&self) -> usize {
        self.wanted.len()
    }

    /// The residuals.
    pub(crate) fn values(&self, product: &Product, unknowns: &DVector<f64>) -> DVector<f64> {
        let words = self.words.values(&product.exponents, &product.at(unknowns));
        &self.forms * DVector::from_vec(words) - &self.wanted
    }

    /// The residuals and their derivatives: one column an unknown.
    pub(crate) fn derivatives(
        &self,
        product: &Product,
        unknowns: &DVector<f64>,
    ) -> (DVector<f64>, DMatrix<f64>) {
        let (words, slopes) = self
            .words
            .derivatives(&product.exponents, &product.at(unknowns));
        let values = &self.forms * DVector::from_vec(words) - &self.wanted;
        (values, &self.forms * (slopes * &product.arguments))
    }
}
