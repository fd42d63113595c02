//! The figures that a search minimises: norms of the leading error of a method.
//!
//! A method of order `p` is `exp(A + B + Z + …)` with a Lie element `Z` of degree `p + 1`. Its coordinates are the residuals `r` of the order
//! conditions of that degree. So every norm of the leading error is a quadratic form in `r`, `|L r|²`:
//!
//! * the **error constant** of `symplectic list`: the coefficient of the elementary differential of a tree `τ` is `φ_τ(Z)/σ(τ)`. Here `φ_τ` is
//!   a sum over the words that `τ` gives when its vertices are taken one by one, children before parents: the shuffle of the words of the
//!   children, and then the letter of the root.
//! * the **error modulo conjugation**: `exp(h^p P)` changes the variables, and `Z` to `Z + [P, A + B]`. In a long run only the part of `Z`
//!   grows that no such `P` removes, since the change of variables acts at both ends only. The figure is the smallest norm over all `P`. It
//!   vanishes for the kernel of a processed method of higher order.
//! * the **error of long runs**: the error modulo conjugation and, as the rest of the error does not grow, a tenth of the error constant.
//!
//! $$ C^2 = \sum_\tau \Bigl(\frac{\varphi_\tau(Z)}{\sigma(\tau)}\Bigr)^2 = |L r|^2 $$

use nalgebra::{DMatrix, DVector};
use num_traits::ToPrimitive;
use symplectic_compiler::certify::{CertifyError, Conditions, DRIFT, KICK};
use symplectic_compiler::order::{BicolouredTree, Colour, HamiltonianClass, TreeRule, Trees};

use crate::lie::{Combination, basis, bracket, pair, shuffle};
use crate::polynomials::Polynomials;
use crate::structure::Model;

/// A norm of the leading error.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum Norm {
    /// The error constant.
    Error,
    /// The smallest error constant over all changes of variables.
    ModuloConjugation,
    /// The root of the sum of the squares of the error modulo conjugation and of a tenth of the error constant.
    LongRuns,
}

/// The share of the error that does not grow, in a long run.
const BOUNDED: f64 = 0.1;

/// The squared norm of the leading error as a function of the unknowns.
#[derive(Debug, Clone)]
pub(crate) struct Figure {
    residuals: Polynomials,
    /// `L`.
    norm: DMatrix<f64>,
}

impl Figure {
    /// The figure of methods of an order for a class.
    pub(crate) fn new(
        class: HamiltonianClass,
        order: usize,
        norm: Norm,
    ) -> Result<Self, CertifyError> {
        let degree = order + 1;
        let conditions = Conditions::of_degree(class, degree)?;
        let residuals = Polynomials::new(&conditions);
        // The residuals of a combination of words.
        let coordinates = |element: &Combination| -> DVector<f64> {
            let words = conditions.words().iter();
            let values = words.map(|word| element.get(word).copied().unwrap_or(0.0));
            &residuals.forms * DVector::from_iterator(conditions.words().len(), values)
        };
        let lie = basis(degree);
        let columns: Vec<DVector<f64>> = lie.iter().map(coordinates).collect();
        let elements = DMatrix::from_columns(&columns);
        let trees = Trees::up_to(TreeRule::Class(class), degree);
        let trees: Vec<BicolouredTree> = trees.of_order(degree).collect();
        let mut errors = DMatrix::zeros(trees.len(), lie.len());
        for (row, tree) in trees.iter().enumerate() {
            let words = words_of(tree);
            let symmetry = tree.symmetry().to_f64().unwrap_or(f64::INFINITY);
            for (column, element) in lie.iter().enumerate() {
                errors[(row, column)] = pair(&words, element) / symmetry;
            }
        }
        // The errors vanish where all coordinates do, so they are a function R of these: errors = R elements.
        let gram = &elements * elements.transpose();
        let inverse = pseudo_inverse(gram);
        let of_residuals = errors * elements.transpose() * inverse;
        let mut form = of_residuals.transpose() * of_residuals;
        if norm != Norm::Error {
            let bounded = &form * (BOUNDED * BOUNDED);
            let flow: Combination = [DRIFT, KICK].map(|letter| (vec![letter], 1.0)).into();
            let changes: Vec<DVector<f64>> = basis(order)
                .iter()
                .map(|p| coordinates(&bracket(p, &flow)))
                .collect();
            let changes = DMatrix::from_columns(&changes);
            let along = &form * &changes;
            let inverse = pseudo_inverse(changes.transpose() * &along);
            form -= &along * inverse * along.transpose();
            if norm == Norm::LongRuns {
                form += bounded;
            }
        }
        Ok(Figure {
            residuals,
            norm: root(form),
        })
    }

    /// The square of the norm.
    pub(crate) fn value(&self, model: &Model, unknowns: &DVector<f64>) -> f64 {
        (&self.norm * self.residuals.values(&model.letters, unknowns)).norm_squared()
    }

    /// The square of the norm and its gradient.
    pub(crate) fn gradient(&self, model: &Model, unknowns: &DVector<f64>) -> (f64, DVector<f64>) {
        let (residuals, slopes) = self.residuals.derivatives(&model.letters, unknowns);
        let error = &self.norm * residuals;
        let gradient = slopes.tr_mul(&self.norm.tr_mul(&error)) * 2.0;
        (error.norm_squared(), gradient)
    }
}

/// The words of the orders in which the vertices of a tree can be taken, children before parents.
fn words_of(tree: &BicolouredTree) -> Combination {
    let letter = match tree.colour() {
        Colour::Q => DRIFT,
        Colour::P => KICK,
    };
    let empty = Combination::from([(Vec::new(), 1.0)]);
    let children = tree.children().iter().map(words_of);
    let before = children.fold(empty, |product, child| shuffle(&product, &child));
    let with_root = |(mut word, factor): (Vec<u8>, f64)| {
        word.push(letter);
        (word, factor)
    };
    before.into_iter().map(with_root).collect()
}

/// Eigenvalues below this share of the largest are zero.
const NEGLIGIBLE: f64 = 1e-11;

/// The eigenvectors of a symmetric matrix that is nowhere negative, with its eigenvalues that are not zero.
fn eigenvectors(form: DMatrix<f64>) -> impl Iterator<Item = (f64, DVector<f64>)> {
    let eigen = form.symmetric_eigen();
    let largest = eigen.eigenvalues.amax();
    let vectors: Vec<_> = eigen
        .eigenvectors
        .column_iter()
        .map(|v| v.into_owned())
        .collect();
    let values: Vec<f64> = eigen.eigenvalues.iter().copied().collect();
    values
        .into_iter()
        .zip(vectors)
        .filter(move |(value, _)| *value > NEGLIGIBLE * largest)
}

fn pseudo_inverse(form: DMatrix<f64>) -> DMatrix<f64> {
    let size = form.nrows();
    let zero = DMatrix::zeros(size, size);
    eigenvectors(form).fold(zero, |sum, (value, v)| sum + &v * v.transpose() / value)
}

/// `L` with `Lᵀ L = form`.
fn root(form: DMatrix<f64>) -> DMatrix<f64> {
    let size = form.nrows();
    let rows: Vec<_> = eigenvectors(form)
        .map(|(value, v)| (v * value.sqrt()).transpose())
        .collect();
    match rows.is_empty() {
        true => DMatrix::zeros(0, size),
        false => DMatrix::from_rows(&rows),
    }
}
