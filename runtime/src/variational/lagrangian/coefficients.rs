//! The coefficients of a step in Lagrangian form.

use alloc::vec::Vec;

use crate::method::Method;
use crate::number::Coefficient;

/// A step with r stages whose velocities are sums of s unknowns `V_k`:
///
/// ```text
/// Q_i = q0 + h Σ_k positions_ik V_k        Q̇_i = Σ_k velocities_ik V_k
/// 0 = h Σ_i forces_ki P'_i + Σ_i momenta_ki P_i − start_k p0
/// q1 = q0 + h Σ_k end_k V_k                p1 = p0 + h Σ_i weights_i P'_i
/// ```
///
/// with `P = ∂L/∂v` and `P' = ∂L/∂q + f` at `(t0 + nodes_i h, Q_i, Q̇_i)`.
pub(super) struct StageCoefficients {
    pub(super) positions: Vec<Vec<f64>>,
    pub(super) velocities: Vec<Vec<f64>>,
    pub(super) forces: Vec<Vec<f64>>,
    pub(super) momenta: Vec<Vec<f64>>,
    pub(super) start: Vec<f64>,
    pub(super) end: Vec<f64>,
    pub(super) weights: Vec<f64>,
    pub(super) nodes: Vec<f64>,
}

impl StageCoefficients {
    /// Those of a partitioned Runge–Kutta method, `P_i = p0 + h Σ_j ã_ij P'_j`: the unknowns are the velocities at the stages.
    pub(super) fn of<M: Method>() -> Self {
        let tableau = &M::COEFFICIENTS;
        let stages = tableau.b.len();
        let identity = || {
            let row = |i| (0..stages).map(|j| f64::from(u8::from(i == j))).collect();
            (0..stages).map(row).collect()
        };
        let negative = |row: &&[Coefficient]| row.iter().map(|a| -a.double()).collect();
        Self {
            positions: tableau.a.iter().map(|row| doubles(row)).collect(),
            velocities: identity(),
            forces: tableau.a_tilde.iter().map(negative).collect(),
            momenta: identity(),
            start: alloc::vec![1.0; stages],
            end: doubles(tableau.b),
            weights: doubles(tableau.b_tilde),
            nodes: doubles(tableau.c),
        }
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

fn doubles(row: &[Coefficient]) -> Vec<f64> {
    row.iter().map(|entry| entry.double()).collect()
}
