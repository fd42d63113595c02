//! Newton's method for the multipliers.

use alloc::vec;
use alloc::vec::Vec;

use super::HolonomicPart;
use crate::constraints::{Gradients, WithConstraints, Workspace};
use symplectic_core::inside::ConstrainedTableau;
use symplectic_core::solver::{Failure, Step};
use symplectic_core::{Scalar, System, Vector};
use symplectic_linearisation::Elimination;

/// The Jacobian of the constraints at the stage positions with respect to the impulses of the constraints, at the present stages:
///
/// ```text
/// ∂φ(Q_i)/∂(h b_k Λ_k) = −h Z_ik G(Q_i) M⁻¹ G(Q_k)ᵀ      Z_ik = Σ_j b_j μ_ij μ̃_jk
/// ```
///
/// The change of the forces with the positions is left out: it is smaller by a factor of h².
#[derive(Clone, Debug)]
pub(super) struct StageJacobian<T> {
    /// Ordered by constraint, then by stage.
    elimination: Elimination<T>,
    stages: usize,
    /// `G(Q_i) M⁻¹ G(Q_k)ᵀ` of two stages, as a band by rows.
    block: Vec<T>,
}

impl<T: Scalar> StageJacobian<T> {
    /// Memory for the given numbers of constraints and of stages with multipliers.
    pub(super) fn new(constraints: usize, stages: usize, half_bandwidth: usize) -> Self {
        let half = (half_bandwidth + 1) * stages - 1;
        Self {
            elimination: Elimination::new(constraints * stages, half),
            stages,
            block: vec![T::zero(); constraints * (2 * half_bandwidth + 1)],
        }
    }

    /// Whether the memory has the size for this number of stages with multipliers.
    pub(super) const fn fits(&self, stages: usize) -> bool {
        self.stages == stages
    }
}

impl<V: Vector> Workspace<V, HolonomicPart<V>> {
    /// Whether the matrix needs many evaluations of the velocity.
    pub(super) fn jacobian_is_costly(&self) -> bool {
        self.metric.is_full()
    }

    /// Changes of the impulses of the constraints from the defects, by a Newton step. Uses the matrix of an earlier sweep unless `renew` is
    /// set.
    ///
    /// # Errors
    /// [`Failure::SingularMatrix`]
    pub(super) fn correct_by_newton<S: System<V>>(
        &mut self,
        tableau: &ConstrainedTableau,
        step: &Step<'_, V>,
        system: &WithConstraints<'_, V, S>,
        renew: bool,
    ) -> Result<(), Failure> {
        let (stages, constraints) = (tableau.weights.len() - 1, self.multipliers.len());
        let jacobians = &mut self.own.jacobians;
        let place = jacobians.iter().position(|known| known.fits(stages));
        let mut jacobian = match place {
            Some(place) => jacobians.swap_remove(place),
            None => StageJacobian::new(constraints, stages, self.metric.half_bandwidth()),
        };
        let regular = !renew || self.renew(tableau, step, system, &mut jacobian)?;
        let elimination = &mut jacobian.elimination;
        for c in 0..constraints {
            for i in 0..stages {
                elimination.right[c * stages + i] = self.own.defects[i * constraints + c];
            }
        }
        elimination.solve();
        for c in 0..constraints {
            for k in 0..stages {
                self.own.changes[k * constraints + c] = elimination.right[c * stages + k];
            }
        }
        self.own.jacobians.push(jacobian);
        regular.then_some(()).ok_or(Failure::SingularMatrix)
    }

    /// Computes and factors the matrix at the present stages; returns whether it is regular.
    fn renew<S: System<V>>(
        &mut self,
        tableau: &ConstrainedTableau,
        step: &Step<'_, V>,
        system: &WithConstraints<'_, V, S>,
        jacobian: &mut StageJacobian<V::Scalar>,
    ) -> Result<bool, Failure> {
        let (stages, constraints) = (tableau.weights.len() - 1, self.multipliers.len());
        let half = self.metric.half_bandwidth();
        // The gradients at Q_1 … Q_{s−1} are known from the sweep.
        let q = &self.q[stages];
        let last = &mut self.end.gradients;
        if !last.evaluate(|gradients| system.constraint_gradients(q, gradients)) {
            return Err(Failure::MovingGradients);
        }
        let at = |stage: usize| -> &Gradients<V::Scalar> {
            match stage {
                0 => &self.start.gradients,
                _ if stage == stages => &self.end.gradients,
                _ => &self.own.gradients[stage - 1],
            }
        };
        let factor = |i: usize, k: usize| {
            let products = (0..=stages).map(|j| {
                let positions = tableau.positions[i + 1][j].double();
                tableau.weights[j].double() * positions * tableau.momenta[j][k].double()
            });
            V::Scalar::from_f64(step.size * products.sum::<f64>())
        };
        let StageJacobian {
            elimination, block, ..
        } = jacobian;
        elimination.clear();
        for k in 0..stages {
            let place = (step.at(tableau.momentum_nodes[k]), &self.q[k], &self.p[k]);
            for i in 0..stages {
                let scratch = &mut self.scratch;
                (self.metric).cross(system, place, at(i + 1), at(k), block, scratch);
                let factor = factor(i, k);
                for (c, row) in block.chunks_exact(2 * half + 1).enumerate() {
                    let columns = c.saturating_sub(half)..constraints.min(c + half + 1);
                    for d in columns {
                        let entry = factor * row[d + half - c];
                        elimination.set(c * stages + i, d * stages + k, entry);
                    }
                }
            }
        }
        Ok(elimination.eliminate_all().is_none())
    }
}
