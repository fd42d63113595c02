//! The memory of a constrained step.

use alloc::vec;
use alloc::vec::Vec;
use core::array;

use super::history::History;
use super::last_impulse::LastImpulse;
use super::metric::{Metric, Point};
use super::momentum_terms::MomentumTerms;
use super::newton::StageJacobian;
use super::resolution::Resolution;
use crate::constraints::{Gradients, Terms, WithConstraints, place_of_resized};
use symplectic_core::inside::{ConstrainedStep, ConstrainedTableau, first_non_finite};
use symplectic_core::solver::{StageStorage, Visit, scalar_words, vector_words};
use symplectic_core::system::Class;
use symplectic_core::{Quantity, Scalar, System, Vector};

/// Everything that depends on the numbers of constraints and stages.
#[derive(Clone, Debug)]
pub(super) struct Workspace<V: Vector> {
    pub(super) metric: Metric<V::Scalar>,
    /// How well the values of the constraints resolve positions.
    pub(super) resolution: Resolution,
    /// At the start of the step, once it has begun.
    pub(super) start: Point<V>,
    /// At its end; at the start of the next one.
    pub(super) end: Point<V>,
    /// Stage positions Q_i and momenta P_i.
    pub(super) q: Vec<V>,
    pub(super) p: Vec<V>,
    /// The increments `h b_i velocity_i` of positions and `h b_i force_i` of momenta, constraint forces included.
    pub(super) drift: Vec<V>,
    pub(super) kick: Vec<V>,
    /// The gradients at Q_2 … Q_{s−1}.
    pub(super) gradients: Vec<Gradients<V::Scalar>>,
    /// `h b_k Λ_k`, stage by stage.
    pub(super) impulses: Vec<V::Scalar>,
    /// Their last changes.
    pub(super) changes: Vec<V::Scalar>,
    /// One for each number of stages; a costly one is made when it is first needed.
    pub(super) jacobians: Vec<StageJacobian<V::Scalar>>,
    /// `φ(Q_i)`, then `S⁻¹ φ(Q_i)`, i = 2..s, stage by stage.
    pub(super) defects: Vec<V::Scalar>,
    /// The previous steps of every part of a composition.
    pub(super) histories: Vec<History<V>>,
    /// Whether the stages of this step start from extrapolated ones.
    pub(super) extrapolated: bool,
    /// The multipliers at the end of the previous step, which are the starting values of the next without a history.
    pub(super) multipliers: Vec<V::Scalar>,
    /// The terms of the momentum of a stage.
    pub(super) momentum: MomentumTerms,
    pub(super) last_impulse: LastImpulse<V::Scalar>,
    /// The sizes that the residuals of every constraint are compared with.
    pub(super) terms: Vec<Terms>,
    /// A velocity, a force, a momentum.
    pub(super) scratch: [V; 3],
}

/// The memory of a constrained step.
#[derive(Clone, Debug)]
pub struct ConstrainedStages<V: Vector> {
    /// The steps of the method.
    pub(super) steps: &'static [ConstrainedStep],
    /// None until the system is known.
    pub(super) workspace: Option<Workspace<V>>,
    /// The first evaluation of a wrong dimension in the last step, and its dimension.
    pub(super) resized: Option<(Quantity, usize)>,
    /// The result of a substep: position and momentum, each with its compensation.
    pub(super) between: [V; 4],
}

impl<V: Vector> Workspace<V> {
    /// Memory for these steps of a method and of a system at this state.
    pub(super) fn new<S: System<V>>(
        steps: &[ConstrainedStep],
        system: &WithConstraints<'_, V, S>,
        time: f64,
        q: &V,
        p: &V,
    ) -> Self {
        let constraints = system.constraints();
        let (metric, point) = Metric::new(system, time, q, p);
        let mut jacobians: Vec<StageJacobian<V::Scalar>> = Vec::new();
        let mut stages = 0;
        for step in steps {
            let count = step.tableau.weights.len();
            stages = stages.max(count);
            let (own, half) = (count.saturating_sub(1), metric.half_bandwidth());
            let known = jacobians.iter().any(|known| known.fits(own));
            if !known && !metric.is_full() {
                jacobians.push(StageJacobian::new(constraints, own, half));
            }
        }
        let histories = steps.iter().map(|step| {
            let stages = step.tableau.weights.len();
            let momenta = if S::Class::SEPARABLE { 0 } else { stages };
            let own = stages.saturating_sub(1);
            History::new(q, own + momenta, own * constraints)
        });
        let vectors = |count: usize| -> Vec<V> { (0..count).map(|_| q.zeros_like()).collect() };
        let numbers = |count: usize| vec![V::Scalar::from_f64(0.0); count];
        let gradients = point.gradients.clone();
        Self {
            resolution: Resolution::new(system, q, &gradients),
            metric,
            histories: histories.collect(),
            extrapolated: false,
            start: point.clone(),
            end: point,
            q: vectors(stages),
            p: vectors(stages),
            drift: vectors(stages),
            kick: vectors(stages),
            gradients: vec![gradients; stages.saturating_sub(2)],
            impulses: numbers(stages.saturating_sub(1) * constraints),
            changes: numbers(stages.saturating_sub(1) * constraints),
            jacobians,
            defects: numbers(stages.saturating_sub(1) * constraints),
            multipliers: numbers(constraints),
            momentum: MomentumTerms::new(q.dimension()),
            last_impulse: LastImpulse::new(constraints, q.dimension()),
            terms: vec![Terms::default(); constraints],
            scratch: array::from_fn(|_| q.zeros_like()),
        }
    }
}

impl<V: Vector> Workspace<V> {
    /// The impulses of the constraints at a stage of the last step.
    pub(super) fn impulses_at(&self, tableau: &ConstrainedTableau, stage: usize) -> &[V::Scalar] {
        if stage + 1 == tableau.weights.len() {
            return &self.last_impulse.multipliers;
        }
        let constraints = self.multipliers.len();
        &self.impulses[stage * constraints..][..constraints]
    }
}

impl<V: Vector> ConstrainedStages<V> {
    /// Memory for these steps of a method.
    pub(super) fn new(steps: &'static [ConstrainedStep], prototype: &V) -> Self {
        Self {
            steps,
            workspace: None,
            resized: None,
            between: array::from_fn(|_| prototype.zeros_like()),
        }
    }
}

impl<V: Vector> StageStorage<V> for ConstrainedStages<V> {
    fn like(prototype: &V) -> Self {
        Self::new(&[], prototype)
    }

    fn anew(&self, prototype: &V) -> Self {
        Self::new(self.steps, prototype)
    }

    fn words(&mut self, visit: &mut Visit<'_>) {
        let Some(Workspace {
            resolution,
            end,
            multipliers,
            histories,
            ..
        }) = &mut self.workspace
        else {
            return;
        };
        vector_words(array::from_mut(&mut end.force), visit);
        end.gradients.words(visit);
        end.normal.words(visit);
        scalar_words(multipliers, visit);
        resolution.words(visit);
        for history in histories {
            history.words(visit);
        }
    }

    fn non_finite(&self) -> Option<(Quantity, usize)> {
        let workspace = self.workspace.as_ref()?;
        first_non_finite(
            (&workspace.q, &workspace.kick),
            (&workspace.p, &workspace.drift),
        )
    }

    fn mismatch(&self, _dimension: usize) -> Option<(Quantity, usize, usize)> {
        let workspace = self.workspace.as_ref()?;
        place_of_resized(self.resized?, &workspace.kick, &workspace.drift)
    }

    fn forget(&mut self, _prototype: &V) {}
}
