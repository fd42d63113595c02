//! The coefficients of a step in Lagrangian form.

use crate::Error;
use alloc::vec;
use alloc::vec::Vec;

use num_traits::Float;

use symplectic_core::Method;
use symplectic_core::solver::Coefficient;

/// A step with r stages whose velocities are sums of s unknowns `V_k`:
///
/// ```text
/// Q_i = q0 + h Σ_k positions_ik V_k        Q̇_i = Σ_k velocities_ik V_k
/// 0 = h Σ_i forces_ki P'_i + Σ_i momenta_ki P_i − start_k p0
/// q1 = q0 + h Σ_k end_k V_k                p1 = p0 + h Σ_i weights_i P'_i
/// ```
///
/// with `P = ∂L/∂v` and `P' = ∂L/∂q + f` at `(t0 + nodes_i h, Q_i, Q̇_i)`.
#[derive(Clone)]
pub(super) struct StageCoefficients {
    pub(super) positions: Vec<Vec<f64>>,
    pub(super) velocities: Vec<Vec<f64>>,
    pub(super) forces: Vec<Vec<f64>>,
    pub(super) momenta: Vec<Vec<f64>>,
    pub(super) start: Vec<f64>,
    pub(super) end: Vec<f64>,
    pub(super) weights: Vec<f64>,
    pub(super) nodes: Vec<f64>,
    /// The unknowns of a velocity that is 1 at all stages.
    pub(super) constant: Vec<f64>,
    /// The matrix that extrapolates the unknowns to the next step, for its starting values.
    pub(super) next: Vec<Vec<f64>>,
}

impl StageCoefficients {
    /// The coefficients of a partitioned Runge–Kutta method, `P_i = p0 + h Σ_j ã_ij P'_j`: the unknowns are the velocities at the stages.
    pub(super) fn of<M: Method>() -> Self {
        let tableau = &M::COEFFICIENTS;
        let stages = tableau.b.len();
        let nodes = doubles(tableau.c);
        let negative = |row: &&[Coefficient]| row.iter().map(|a| -a.double()).collect();
        Self {
            positions: tableau.a.iter().map(|row| doubles(row)).collect(),
            velocities: identity(stages),
            forces: tableau.a_tilde.iter().map(negative).collect(),
            momenta: identity(stages),
            start: vec![1.0; stages],
            end: doubles(tableau.b),
            weights: doubles(tableau.b_tilde),
            constant: vec![1.0; stages],
            next: extrapolation(&nodes).unwrap_or_else(|| identity(stages)),
            nodes,
        }
    }

    /// The coefficients of the Galerkin method with the same basis and quadrature formula (Leok & Zhang, 38). The unknowns are coordinates
    /// of the velocity in the space of the basis:
    ///
    /// ```text
    /// 0 = h Σ_i b_i (∫_0^{c_i} ψ_k − ∫_0^1 ψ_k) P'_i + Σ_i b_i ψ_k(c_i) P_i − ∫_0^1 ψ_k p0
    /// ```
    ///
    /// At the nodes, the velocities of that space are those `Q̇` for which the position `q0 + h Σ_j a_ij Q̇_j` is exact. They are spanned
    /// by the rows of `a_ij/b_j` and the row of ones. The basis used here spans the same space and is orthonormal for the quadrature
    /// formula.
    ///
    /// # Errors
    /// [`Error::NoConstants`] if that span is larger than the space of the basis.
    pub(super) fn galerkin<M: Method>() -> Result<Self, Error> {
        if M::FUNCTIONS == M::STAGES {
            return Ok(Self::of::<M>());
        }
        let tableau = &M::COEFFICIENTS;
        let weights = doubles(tableau.b);
        let rows: Vec<Vec<f64>> = tableau.a.iter().map(|row| doubles(row)).collect();
        let basis = orthonormal(&rows, &weights, M::FUNCTIONS)
            .ok_or(Error::NoConstants { method: M::NAME })?;
        let along = |row: &[f64]| -> Vec<f64> {
            let sum = |function: &Vec<f64>| row.iter().zip(function).map(|(a, psi)| a * psi).sum();
            basis.iter().map(sum).collect()
        };
        let end = along(&weights);
        let positions: Vec<Vec<f64>> = rows.iter().map(|row| along(row)).collect();
        let forces = (0..basis.len()).map(|k| {
            let nodes = positions.iter().zip(&weights);
            nodes.map(|(row, b)| b * (row[k] - end[k])).collect()
        });
        let momenta = basis.iter().map(|function| {
            let nodes = function.iter().zip(&weights);
            nodes.map(|(psi, b)| b * psi).collect()
        });
        let constant = basis.iter().map(|function| {
            let nodes = || function.iter().zip(&weights);
            let square: f64 = nodes().map(|(psi, b)| b * psi * psi).sum();
            nodes().map(|(psi, b)| b * psi).sum::<f64>() / square
        });
        Ok(Self {
            constant: constant.collect(),
            forces: forces.collect(),
            momenta: momenta.collect(),
            velocities: (0..weights.len())
                .map(|i| basis.iter().map(|function| function[i]).collect())
                .collect(),
            start: end.clone(),
            next: identity(end.len()),
            positions,
            end,
            weights,
            nodes: doubles(tableau.c),
        })
    }

    /// The number of unknown velocities.
    pub(super) fn unknowns(&self) -> usize {
        self.start.len()
    }

    /// The number of stages.
    pub(super) fn stages(&self) -> usize {
        self.nodes.len()
    }
}

/// `count` functions on the nodes that span `a_ij/b_j` and the constant 1, orthonormal for the weights up to their sign. Gram–Schmidt, with
/// each function orthogonalised twice, the largest remainder first. `None` if the span is larger.
fn orthonormal(rows: &[Vec<f64>], weights: &[f64], count: usize) -> Option<Vec<Vec<f64>>> {
    /// Norms below this are rounding errors relative to 1, for functions as smooth as those of a method.
    const NOTHING: f64 = 1e-8;
    let product = |x: &[f64], y: &[f64]| -> f64 {
        let terms = x.iter().zip(y).zip(weights);
        terms.map(|((x, y), b)| b * x * y).sum()
    };
    let mut candidates: Vec<Vec<f64>> = vec![vec![1.0; weights.len()]];
    candidates.extend(rows.iter().map(|row| {
        let entries = row.iter().zip(weights);
        entries.map(|(a, b)| a / b).collect()
    }));
    let mut basis: Vec<(Vec<f64>, f64)> = Vec::new();
    let norm = |candidate: &Vec<f64>| {
        let squares = candidate.iter().zip(weights);
        let square: f64 = squares.map(|(x, b)| Float::abs(*b) * x * x).sum();
        Float::sqrt(square)
    };
    while basis.len() < count {
        let norms = candidates.iter().map(norm).enumerate();
        let (place, _) = norms.max_by(|x, y| x.1.total_cmp(&y.1))?;
        let mut function = candidates.swap_remove(place);
        let square = product(&function, &function);
        let size = Float::sqrt(Float::abs(square));
        function.iter_mut().for_each(|x| *x /= size);
        basis.push((function, if square < 0.0 { -1.0 } else { 1.0 }));
        for candidate in &mut candidates {
            for (function, sign) in basis.iter().chain(&basis) {
                let overlap = sign * product(candidate, function);
                let pairs = candidate.iter_mut().zip(function);
                pairs.for_each(|(x, y)| *x -= overlap * y);
            }
        }
    }
    let spanned = candidates.iter().all(|candidate| norm(candidate) < NOTHING);
    spanned.then(|| basis.into_iter().map(|(function, _)| function).collect())
}

fn identity(size: usize) -> Vec<Vec<f64>> {
    let row = |i| (0..size).map(|j| f64::from(u8::from(i == j))).collect();
    (0..size).map(row).collect()
}

/// The values at `1 + c_i` of the polynomials that are 1 at one node and 0 at the others; `None` if two nodes are equal.
fn extrapolation(nodes: &[f64]) -> Option<Vec<Vec<f64>>> {
    let polynomial = |j: usize, at: f64| -> f64 {
        let others = nodes.iter().enumerate().filter(|&(k, _)| k != j);
        others.map(|(_, c)| (at - c) / (nodes[j] - c)).product()
    };
    let row = |at: f64| (0..nodes.len()).map(|j| polynomial(j, at)).collect();
    let rows: Vec<Vec<f64>> = nodes.iter().map(|c| row(1.0 + c)).collect();
    let finite = rows.iter().flatten().all(|entry| entry.is_finite());
    finite.then_some(rows)
}

fn doubles(row: &[Coefficient]) -> Vec<f64> {
    row.iter().map(|entry| entry.double()).collect()
}
