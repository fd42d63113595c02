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
//! * the **error of perturbed systems** `H_A + εH_B`: the error constant with the factor `ε^{j−1}` at trees with `j` kicks.
//! * the **error of long runs**: the error modulo conjugation and, as the rest of the error does not grow, a tenth of the error constant.
//!
//! Where order `p + 2` is in reach, `C_p` can vanish, and says nothing. Then the **cost** counts: with the two leading terms of the error the
//! step `h` for an error `ε` solves `C_p² h^{2p} + C_{p+2}² h^{2p+4} = ε²`. The term of degree `p + 3` of the Lie element is a sum over all
//! ways to cut a word into `k` parts, `(−1)^{k−1}/k` times the coefficient of the shuffle of the parts: the logarithm. The figure is `ε/h^p`,
//! the error constant of a method with one term of the same cost.
//!
//! $$ C^2 = \sum_\tau \Bigl(\frac{\varphi_\tau(Z)}{\sigma(\tau)}\Bigr)^2 = |L r|^2 $$

use nalgebra::{DMatrix, DVector, Matrix2};
use num_traits::ToPrimitive;
use symplectic_compiler::certify::{CertifyError, Conditions, DRIFT, KICK};
use symplectic_compiler::order::{BicolouredTree, Colour, HamiltonianClass, TreeRule, Trees};

use crate::lie::{Combination, basis, bracket, pair, shuffle};
use crate::polynomials::Polynomials;
use crate::structure::Model;

/// A figure of the leading error.
#[derive(Debug, Clone, Copy, PartialEq)]
pub enum Norm {
    /// The error constant.
    Error,
    /// The smallest error constant over all changes of variables.
    ModuloConjugation,
    /// The root of the sum of the squares of the error modulo conjugation and of a tenth of the error constant.
    LongRuns,
    /// The error constant for a system `H_A + εH_B`, divided by `ε`.
    Perturbed {
        /// `ε`.
        epsilon: f64,
    },
    /// The cost at an error, with the two leading terms; for orders up to 4.
    Cost {
        /// The error.
        tolerance: f64,
    },
}

/// The share of the error that does not grow, in a long run.
const BOUNDED: f64 = 0.1;
/// The highest degree in which logarithms are taken.
const LOGARITHMS: usize = 7;

/// A figure as a function of the unknowns: the square of an error constant.
#[derive(Debug, Clone)]
pub(crate) enum Figure {
    Norm(Box<Form>),
    Cost(Box<Cost>),
}

impl Figure {
    /// The figure of methods of an order for a class; `step` is the difference of the degrees of the two leading terms.
    pub(crate) fn new(
        class: HamiltonianClass,
        order: usize,
        step: usize,
        norm: Norm,
    ) -> Result<Self, CertifyError> {
        let near = Form::of_residuals(class, order, norm)?;
        Ok(match norm {
            Norm::Cost { tolerance } => Figure::Cost(Box::new(Cost {
                near,
                far: Form::of_logarithm(class, order + 1 + step)?,
                tolerance,
                order: order as f64,
                step: step as f64,
            })),
            _ => Figure::Norm(Box::new(near)),
        })
    }

    /// The figure.
    pub(crate) fn value(&self, model: &Model, unknowns: &DVector<f64>) -> f64 {
        match self {
            Figure::Norm(form) => form.value(model, unknowns),
            Figure::Cost(cost) => {
                cost.step_size(
                    cost.near.value(model, unknowns),
                    cost.far.value(model, unknowns),
                )
                .0
            }
        }
    }

    /// The figure and its gradient.
    pub(crate) fn gradient(&self, model: &Model, unknowns: &DVector<f64>) -> (f64, DVector<f64>) {
        match self {
            Figure::Norm(form) => form.gradient(model, unknowns),
            Figure::Cost(cost) => {
                let (near, near_slope) = cost.near.gradient(model, unknowns);
                let (far, far_slope) = cost.far.gradient(model, unknowns);
                let (value, by_near, by_far) = cost.step_size(near, far);
                (value, near_slope * by_near + far_slope * by_far)
            }
        }
    }
}

/// The cost at an error, from the two leading terms of the error.
#[derive(Debug, Clone)]
pub(crate) struct Cost {
    near: Form,
    far: Form,
    tolerance: f64,
    order: f64,
    step: f64,
}

impl Cost {
    /// `(ε/h^p)²` with `a h^{2p} + b h^{2p+2k} = ε²`, and its derivatives by `a` and `b`.
    fn step_size(&self, a: f64, b: f64) -> (f64, f64, f64) {
        let Cost {
            tolerance,
            order,
            step,
            ..
        } = self;
        let square = tolerance * tolerance;
        // x = h^2; of the two terms alone, the smaller step is too large by at most a factor of √2.
        let alone = |c: f64, power: f64| {
            if c > 0.0 {
                (square / c).powf(1.0 / power)
            } else {
                f64::INFINITY
            }
        };
        let mut x = alone(a, *order).min(alone(b, order + step));
        for _ in 0..60 {
            let (first, second) = (a * x.powf(*order), b * x.powf(order + step));
            let change = (square - first - second) / (order * first + (order + step) * second);
            // Newton's iteration in ln x.
            x *= change.clamp(-0.5, 0.5).exp();
            if change.abs() < 1e-15 {
                break;
            }
        }
        let (first, second) = (x.powf(*order), x.powf(order + step));
        let value = square / first;
        // d ln x = −(x^p da + x^{p+k} db)/(p a x^p + (p + k) b x^{p+k})
        let slope = order * value / (order * a * first + (order + step) * b * second);
        (value, slope * first, slope * second)
    }
}

/// `|L r|²` for polynomials `r`.
#[derive(Debug, Clone)]
pub(crate) struct Form {
    residuals: Polynomials,
    /// `L`.
    norm: DMatrix<f64>,
}

impl Form {
    /// The norm of the term of degree `order + 1`, from the residuals of the conditions.
    fn of_residuals(
        class: HamiltonianClass,
        order: usize,
        norm: Norm,
    ) -> Result<Self, CertifyError> {
        let degree = order + 1;
        let conditions = Conditions::of_degree(class, degree)?;
        let residuals = Polynomials::new(&conditions);
        let epsilon = match norm {
            Norm::Perturbed { epsilon } => epsilon,
            _ => 1.0,
        };
        let mut form = error_form(class, &conditions, &residuals, degree, epsilon);
        if matches!(norm, Norm::ModuloConjugation | Norm::LongRuns) {
            let bounded = &form * (BOUNDED * BOUNDED);
            let flow: Combination = [DRIFT, KICK].map(|letter| (vec![letter], 1.0)).into();
            let changes = basis(order);
            let changes = changes
                .iter()
                .map(|p| residuals.coordinates(&conditions, &bracket(p, &flow)));
            let changes = DMatrix::from_columns(&changes.collect::<Vec<_>>());
            let along = &form * &changes;
            let inverse = pseudo_inverse(changes.transpose() * &along);
            form -= &along * inverse * along.transpose();
            if norm == Norm::LongRuns {
                form += bounded;
            }
        }
        Ok(Form {
            residuals,
            norm: root(form),
        })
    }

    /// The norm of the term of a degree of the logarithm.
    fn of_logarithm(class: HamiltonianClass, degree: usize) -> Result<Self, CertifyError> {
        if degree > LOGARITHMS {
            return Err(CertifyError::Order {
                order: degree - 1,
                limit: LOGARITHMS - 1,
            });
        }
        let conditions = Conditions::of_degree(class, degree)?;
        let residuals = Polynomials::new(&conditions);
        let norm = root(error_form(class, &conditions, &residuals, degree, 1.0));
        Ok(Form {
            residuals: residuals.of_logarithm(&conditions),
            norm,
        })
    }

    fn value(&self, model: &Model, unknowns: &DVector<f64>) -> f64 {
        (&self.norm * self.residuals.values(&model.letters, unknowns)).norm_squared()
    }

    fn gradient(&self, model: &Model, unknowns: &DVector<f64>) -> (f64, DVector<f64>) {
        let (residuals, slopes) = self.residuals.derivatives(&model.letters, unknowns);
        let error = &self.norm * residuals;
        let gradient = slopes.tr_mul(&self.norm.tr_mul(&error)) * 2.0;
        (error.norm_squared(), gradient)
    }
}

/// The matrix of the squared error constant of a Lie element of a degree, in its coordinates.
fn error_form(
    class: HamiltonianClass,
    conditions: &Conditions,
    residuals: &Polynomials,
    degree: usize,
    epsilon: f64,
) -> DMatrix<f64> {
    let lie = basis(degree);
    let trees = Trees::up_to(TreeRule::Class(class), degree);
    let trees: Vec<BicolouredTree> = trees.of_order(degree).collect();
    let mut errors = DMatrix::zeros(trees.len(), lie.len());
    for (row, tree) in trees.iter().enumerate() {
        let words = words_of(tree);
        let kicks = words.keys().next().map_or(0, |word| {
            word.iter().filter(|letter| **letter == KICK).count()
        });
        let small = epsilon.powf(kicks as f64 - 1.0);
        let symmetry = tree.symmetry().to_f64().unwrap_or(f64::INFINITY);
        for (column, element) in lie.iter().enumerate() {
            errors[(row, column)] = small * pair(&words, element) / symmetry;
        }
    }
    let of_residuals = on_residuals(&errors, conditions, residuals, &lie);
    of_residuals.transpose() * of_residuals
}

/// The part of the leading error by which the harmonic oscillator is too fast, as a function of the residuals: one row.
///
/// For `H = (p² + q²)/2` the letters are matrices, `A = (0 1; 0 0)` and `B = (0 0; −1 0)`. A step turns by `h tr(Z (A + B))/2` too much.
pub(crate) fn dispersion(
    class: HamiltonianClass,
    order: usize,
) -> Result<Polynomials, CertifyError> {
    let conditions = Conditions::of_degree(class, order + 1)?;
    let residuals = Polynomials::new(&conditions);
    let lie = basis(order + 1);
    let letters = [
        Matrix2::new(0.0, 1.0, 0.0, 0.0),
        Matrix2::new(0.0, 0.0, -1.0, 0.0),
    ];
    let flow = letters[0] + letters[1];
    let turn = |element: &Combination| -> f64 {
        let words = element.iter();
        let matrices = words.map(|(word, factor)| {
            let product = word.iter().map(|letter| letters[usize::from(*letter)]);
            product.fold(Matrix2::identity(), |product, letter| product * letter) * *factor
        });
        0.5 * (matrices.sum::<Matrix2<f64>>() * flow).trace()
    };
    let turns = DMatrix::from_iterator(1, lie.len(), lie.iter().map(turn));
    let of_residuals = on_residuals(&turns, &conditions, &residuals, &lie);
    Ok(residuals.combined(&of_residuals))
}

/// Linear functions of Lie elements as functions of the residuals. They are given on a basis, one column an element, and vanish where all
/// residuals do: `functions = R elements`.
fn on_residuals(
    functions: &DMatrix<f64>,
    conditions: &Conditions,
    residuals: &Polynomials,
    lie: &[Combination],
) -> DMatrix<f64> {
    let columns = lie
        .iter()
        .map(|element| residuals.coordinates(conditions, element));
    let elements = DMatrix::from_columns(&columns.collect::<Vec<_>>());
    let inverse = pseudo_inverse(&elements * elements.transpose());
    functions * elements.transpose() * inverse
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
