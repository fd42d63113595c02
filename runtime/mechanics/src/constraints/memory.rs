//! The memory of a step with constraints of either kind.

use alloc::vec;
use alloc::vec::Vec;
use core::array;

use super::last_impulse::LastImpulse;
use super::metric::{Metric, Point};
use super::momentum_terms::MomentumTerms;
use super::{Terms, WithConstraints};
use symplectic_core::inside::{
    ConstrainedStep, ConstrainedTableau, first_non_finite, first_non_finite_of, is_finite,
};
use symplectic_core::solver::{
    Failure, Outcome, StageStorage, Step, StepStatistics, Stopping, Visit,
};
use symplectic_core::{Quantity, Scalar, Summation, System, Vector};

/// Everything that depends on the numbers of constraints and stages.
#[derive(Clone, Debug)]
pub struct Workspace<V: Vector, O> {
    pub(super) metric: Metric<V::Scalar>,
    /// The point at the start of the step, once it has begun.
    pub(super) start: Point<V>,
    /// The point at its end, which is the start of the next one.
    pub(super) end: Point<V>,
    /// Stage positions Q_i and momenta P_i.
    pub(super) q: Vec<V>,
    pub(super) p: Vec<V>,
    /// The increments `h b_i velocity_i` of the position.
    pub(super) drift: Vec<V>,
    /// The increments of the momentum: `h b_i force_i`, with the forces of holonomic constraints; after those of the stages, the
    /// [impulses](OwnPart::IMPULSES) at the ends of a step with non-holonomic ones.
    pub(super) kick: Vec<V>,
    /// Non-holonomic: λ of this step. Holonomic: the multipliers at the end of the previous step, with which a step without history starts.
    pub(super) multipliers: Vec<V::Scalar>,
    /// The terms of the momentum of a stage.
    pub(super) momentum: MomentumTerms,
    pub(super) last_impulse: LastImpulse<V::Scalar>,
    /// The sizes that the residuals of every constraint are compared with.
    pub(super) terms: Vec<Terms>,
    /// A velocity, a force, a momentum or position.
    pub(super) scratch: [V; 3],
    /// What only steps with this kind of constraints need.
    pub(super) own: O,
}

/// The part of a [`Workspace`] that only steps with one kind of constraints need, and how such steps are taken.
pub trait OwnPart<V: Vector>: Clone {
    /// Number of increments of the momentum after those of the stages.
    const IMPULSES: usize;

    /// Memory for these steps of a method, with up to `stages` stages, for a system, with its metric and gradients at the position `q`.
    fn for_steps<S: System<V>>(
        steps: &[ConstrainedStep],
        stages: usize,
        system: &WithConstraints<'_, V, S>,
        q: &V,
        at: (&Metric<V::Scalar>, &Point<V>),
    ) -> Self;

    /// Takes the substep of this number and tableau; `carried` means that the previous step ended where this one starts.
    fn take_substep<R: Summation, S: System<V>>(
        workspace: &mut Workspace<V, Self>,
        substep: (usize, &ConstrainedTableau),
        step: &Step<'_, V>,
        system: &WithConstraints<'_, V, S>,
        carried: bool,
        stopping: Stopping,
        outcome: &mut Outcome<'_, V>,
    ) -> Result<StepStatistics, Failure>;

    /// The impulses of the constraints at a stage of the last step; empty if they act at the ends of the step only.
    fn impulses_at<'w>(
        workspace: &'w Workspace<V, Self>,
        tableau: &ConstrainedTableau,
        stage: usize,
    ) -> &'w [V::Scalar];

    /// Passes the numbers that a step leaves for the next one to `visit`.
    fn own_words(workspace: &mut Workspace<V, Self>, visit: &mut Visit<'_>);
}

impl<V: Vector, O: OwnPart<V>> Workspace<V, O> {
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
        let stages = steps.iter().map(|step| step.tableau.weights.len());
        let stages = stages.max().unwrap_or(0);
        let vectors = |count: usize| -> Vec<V> { (0..count).map(|_| q.zeros_like()).collect() };
        Self {
            own: O::for_steps(steps, stages, system, q, (&metric, &point)),
            metric,
            start: point.clone(),
            end: point,
            q: vectors(stages),
            p: vectors(stages),
            drift: vectors(stages),
            kick: vectors(stages + O::IMPULSES),
            multipliers: vec![V::Scalar::from_f64(0.0); constraints],
            momentum: MomentumTerms::new(q.dimension()),
            last_impulse: LastImpulse::new(constraints, q.dimension()),
            terms: vec![Terms::default(); constraints],
            scratch: array::from_fn(|_| q.zeros_like()),
        }
    }
}

impl<V: Vector, O> Workspace<V, O> {
    /// `h b_i force_i` of the stages.
    fn stage_kicks(&self) -> &[V] {
        &self.kick[..self.q.len()]
    }

    /// The failure for increments that are not finite.
    pub(super) fn non_finite_increment(&self) -> Failure {
        let kicks = self.stage_kicks().iter().position(|kick| !is_finite(kick));
        let drifts = self.drift.iter().position(|drift| !is_finite(drift));
        let (what, stage) = match (kicks, drifts) {
            (Some(stage), _) => (Quantity::Force, Some(stage + 1)),
            (None, Some(stage)) => (Quantity::Velocity, Some(stage + 1)),
            (None, None) => (Quantity::Constraint, None),
        };
        Failure::NonFinite { what, stage }
    }
}

/// The memory of a step with constraints, or of a composition of such steps.
#[derive(Clone, Debug)]
pub struct ConstrainedStages<V: Vector, O> {
    /// The steps of the method.
    pub(super) steps: &'static [ConstrainedStep],
    /// None until the system is known.
    pub(super) workspace: Option<Workspace<V, O>>,
    /// The first evaluation of a wrong dimension in the last step, and its dimension.
    pub(super) resized: Option<(Quantity, usize)>,
    /// The result of a substep: position and momentum, each with its compensation.
    pub(super) between: [V; 4],
}

impl<V: Vector, O> ConstrainedStages<V, O> {
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

impl<V: Vector, O: OwnPart<V>> StageStorage<V> for ConstrainedStages<V, O> {
    fn like(prototype: &V) -> Self {
        Self::new(&[], prototype)
    }

    fn anew(&self, prototype: &V) -> Self {
        Self::new(self.steps, prototype)
    }

    fn words(&mut self, visit: &mut Visit<'_>) {
        if let Some(workspace) = &mut self.workspace {
            O::own_words(workspace, visit);
        }
    }

    fn non_finite(&self) -> Option<(Quantity, usize)> {
        let workspace = self.workspace.as_ref()?;
        first_non_finite(
            (&workspace.q, workspace.stage_kicks()),
            (&workspace.p, &workspace.drift),
        )
    }

    /// NaN replaced an evaluation of a wrong dimension, so its stage is the first with an increment that is not finite.
    fn mismatch(&self, _dimension: usize) -> Option<(Quantity, usize, usize)> {
        let (workspace, (what, found)) = (self.workspace.as_ref()?, self.resized?);
        let increments = match what {
            Quantity::Force => workspace.stage_kicks(),
            _ => &workspace.drift,
        };
        Some((what, first_non_finite_of(increments).unwrap_or(0), found))
    }

    fn forget(&mut self, _prototype: &V) {}
}
