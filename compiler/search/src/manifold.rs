//! The manifold of solutions of the order conditions: projection onto it, and minimisation on it.

use nalgebra::{DMatrix, DVector};

use crate::figure::Figure;
use crate::polynomials::Polynomials;
use crate::structure::{Model, Product};

/// The problem of a search in doubles.
#[derive(Debug, Clone)]
pub(crate) struct Manifold {
    pub(crate) model: Model,
    /// The equations, each with the product that they are about; first the order conditions.
    pub(crate) equations: Vec<(Polynomials, Product)>,
    pub(crate) figure: Figure,
    /// The largest size of an unknown; beyond it the figure is penalised.
    pub(crate) largest: f64,
}

/// A point of the manifold with what is known there.
#[derive(Debug, Clone)]
pub(crate) struct Point {
    pub(crate) unknowns: DVector<f64>,
    /// The logarithm of the squared norm, with the penalty.
    pub(crate) value: f64,
    /// The number of free directions.
    pub(crate) free: usize,
    pub(crate) converged: bool,
}

/// The residual of a point of the manifold.
const SOLVED: f64 = 1e-13;
/// The largest step of a projection, and of a minimisation.
const PROJECTION: f64 = 0.5;
const DESCENT: f64 = 0.2;
/// Points farther away are given up.
const FAR: f64 = 5.0;
/// The figure of a method of higher order: the square of its leading error vanishes.
const VANISHED: f64 = 1e-26;
/// Singular values below this share of the largest are zero.
const RANK: f64 = 1e-9;
/// The weight of the squared excess of an unknown over the largest one.
const PENALTY: f64 = 300.0;

impl Manifold {
    /// The residuals of all equations, and their derivatives.
    pub(crate) fn constraints(&self, unknowns: &DVector<f64>) -> (DVector<f64>, DMatrix<f64>) {
        let found: Vec<_> = self
            .equations
            .iter()
            .map(|(polynomials, product)| polynomials.derivatives(product, unknowns))
            .collect();
        if let [(values, slopes)] = &*found {
            return (values.clone(), slopes.clone());
        }
        let values = found.iter().flat_map(|(values, _)| values.iter().copied());
        let rows: Vec<_> = found
            .iter()
            .flat_map(|(_, slopes)| slopes.row_iter())
            .collect();
        (
            DVector::from_vec(values.collect()),
            DMatrix::from_rows(&rows),
        )
    }

    /// The nearest solution of the conditions, by steps of least norm.
    pub(crate) fn project(&self, start: &DVector<f64>, steps: usize) -> Option<DVector<f64>> {
        let mut unknowns = start.clone();
        let (mut residuals, mut slopes) = self.constraints(&unknowns);
        for _ in 0..steps {
            let size = residuals.norm();
            let mut step = least_norm(&slopes, &residuals)?;
            let length = step.norm();
            if size < SOLVED && length < 1e-12 {
                return Some(unknowns);
            }
            if length > PROJECTION {
                step *= PROJECTION / length;
            }
            let mut accepted = None;
            for _ in 0..8 {
                let next = &unknowns - &step;
                let (values, next_slopes) = self.constraints(&next);
                // Near the solution rounding decides.
                if values.norm() < size || size < SOLVED {
                    accepted = Some((next, values, next_slopes));
                    break;
                }
                step *= 0.5;
            }
            (unknowns, residuals, slopes) = accepted?;
            if unknowns.amax() > FAR {
                return None;
            }
        }
        (residuals.norm() < 1e-11).then_some(unknowns)
    }

    /// The nearest solution in which some unknowns have given values.
    pub(crate) fn project_with(
        &self,
        start: &DVector<f64>,
        fixed: &[(usize, f64)],
    ) -> Option<DVector<f64>> {
        let mut unknowns = start.clone();
        for (index, value) in fixed {
            unknowns[*index] = *value;
        }
        for _ in 0..30 {
            let (residuals, mut slopes) = self.constraints(&unknowns);
            for (index, _) in fixed {
                slopes.column_mut(*index).fill(0.0);
            }
            let step = least_norm(&slopes, &residuals)?;
            if residuals.norm() < SOLVED && step.norm() < 1e-14 {
                return Some(unknowns);
            }
            unknowns -= step;
            if unknowns.amax() > FAR {
                return None;
            }
        }
        let (residuals, _) = self.constraints(&unknowns);
        (residuals.norm() < SOLVED).then_some(unknowns)
    }

    /// The objective and its gradient.
    fn objective(&self, unknowns: &DVector<f64>) -> (f64, DVector<f64>) {
        let (square, gradient) = self.figure.gradient(&self.model, unknowns);
        let square = square.max(f64::MIN_POSITIVE);
        let excess = unknowns.map(|x| x.signum() * (x.abs() - self.largest).max(0.0));
        (
            square.ln() + PENALTY * excess.norm_squared(),
            gradient / square + excess * (2.0 * PENALTY),
        )
    }

    /// Whether an unknown is at the bound, so that a minimum is one of the box.
    pub(crate) fn is_at_bound(&self, unknowns: &DVector<f64>) -> bool {
        unknowns.amax() > self.largest
    }

    /// The point, before any minimisation.
    pub(crate) fn point(&self, unknowns: DVector<f64>) -> Point {
        let value = self.objective(&unknowns).0;
        let (_, slopes) = self.constraints(&unknowns);
        let free = tangents(&slopes).ncols();
        Point {
            unknowns,
            value,
            free,
            converged: free == 0,
        }
    }

    /// Newton's iteration along the manifold with the Hessian of the Lagrangian, its eigenvalues made positive.
    pub(crate) fn minimise(&self, mut point: Point, iterations: usize) -> Point {
        let mut damping: f64 = 1e-3;
        for _ in 0..iterations {
            if point.converged || point.value < VANISHED.ln() {
                break;
            }
            let (value, gradient) = self.objective(&point.unknowns);
            let (_, slopes) = self.constraints(&point.unknowns);
            let basis = tangents(&slopes);
            point.free = basis.ncols();
            let reduced = basis.tr_mul(&gradient);
            if point.free == 0 || reduced.norm() < 1e-8 {
                point.converged = true;
                break;
            }
            let multipliers = least_squares(&slopes, &gradient);
            let hessian = self.reduced_hessian(&point.unknowns, &basis, &multipliers);
            let eigen = hessian.symmetric_eigen();
            let along = eigen.eigenvectors.tr_mul(&reduced);
            let mut moved = None;
            for _ in 0..12 {
                let scaled = along.zip_map(&eigen.eigenvalues, |g, e| g / (e.abs() + damping));
                let mut step = &basis * (&eigen.eigenvectors * scaled);
                let length = step.norm();
                if length > DESCENT {
                    step *= DESCENT / length;
                }
                let next = self.project(&(&point.unknowns - step), 12);
                let next = next.map(|unknowns| (self.objective(&unknowns).0, unknowns));
                if let Some((lower, unknowns)) = next.filter(|(lower, _)| *lower < value) {
                    damping = (damping * 0.2).max(1e-12);
                    moved = Some((lower, unknowns));
                    break;
                }
                damping = damping.max(1e-8) * 8.0;
            }
            let Some((lower, unknowns)) = moved else {
                // No descent within the rounding errors.
                point.converged = reduced.norm() < 1e-4;
                break;
            };
            (point.value, point.unknowns) = (lower, unknowns);
        }
        point
    }

    /// The Hessian of the objective minus the conditions times their multipliers, in the tangent directions, by central differences.
    fn reduced_hessian(
        &self,
        at: &DVector<f64>,
        basis: &DMatrix<f64>,
        multipliers: &DVector<f64>,
    ) -> DMatrix<f64> {
        const DIFFERENCE: f64 = 1e-5;
        let lagrangian = |unknowns: &DVector<f64>| {
            let (_, gradient) = self.objective(unknowns);
            let (_, slopes) = self.constraints(unknowns);
            basis.tr_mul(&(gradient - slopes.tr_mul(multipliers)))
        };
        let columns = basis.column_iter().map(|direction| {
            let step = direction * DIFFERENCE;
            (lagrangian(&(at + &step)) - lagrangian(&(at - &step))) / (2.0 * DIFFERENCE)
        });
        let hessian = DMatrix::from_columns(&columns.collect::<Vec<_>>());
        (&hessian + hessian.transpose()) * 0.5
    }
}

/// The step of least norm that solves the linear equations, as far as they can be solved.
fn least_norm(slopes: &DMatrix<f64>, residuals: &DVector<f64>) -> Option<DVector<f64>> {
    let svd = slopes.clone().svd(true, true);
    let bound = RANK * svd.singular_values.max();
    let step = svd.solve(residuals, bound).ok()?;
    step.iter().all(|x| x.is_finite()).then_some(step)
}

/// The multipliers with which the conditions give the gradient best.
fn least_squares(slopes: &DMatrix<f64>, gradient: &DVector<f64>) -> DVector<f64> {
    let svd = slopes.transpose().svd(true, true);
    let bound = RANK * svd.singular_values.max();
    svd.solve(gradient, bound)
        .unwrap_or_else(|_| DVector::zeros(slopes.nrows()))
}

/// An orthonormal basis of the directions in which the conditions do not change to first order.
pub(crate) fn tangents(slopes: &DMatrix<f64>) -> DMatrix<f64> {
    let (rows, columns) = slopes.shape();
    // With zeros below, all right singular vectors are found.
    let square = slopes.clone().resize_vertically(rows.max(columns), 0.0);
    let svd = square.svd(false, true);
    let bound = RANK * svd.singular_values.max();
    let vectors = svd.v_t.unwrap_or_else(|| DMatrix::zeros(0, columns));
    let zero: Vec<DVector<f64>> = vectors
        .row_iter()
        .zip(svd.singular_values.iter())
        .filter(|(_, value)| **value <= bound)
        .map(|(row, _)| row.transpose())
        .collect();
    match zero.is_empty() {
        true => DMatrix::zeros(columns, 0),
        false => DMatrix::from_columns(&zero),
    }
}
