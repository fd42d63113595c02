//! Order conditions as polynomials in the unknowns, in doubles.

use nalgebra::{DMatrix, DVector};
use symplectic_compiler::arithmetic::rounding::to_f64;
use symplectic_compiler::certify::Conditions;

use crate::structure::Product;
use crate::words::Words;

/// `Σ_w c_w [w] − wanted` for each condition.
#[derive(Debug, Clone)]
pub(crate) struct Polynomials {
    words: Words,
    /// `c_w`: one row a condition, one column a word.
    pub(crate) forms: DMatrix<f64>,
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
