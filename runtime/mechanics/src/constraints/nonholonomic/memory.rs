//! The memory of a step with non-holonomic constraints.

use crate::constraints::holonomic::{LastImpulse, Metric, MomentumTerms, Point};
use crate::constraints::{Gradients, Terms, WithConstraints, place_of_resized};
use alloc::vec;
use alloc::vec::Vec;
use core::array;
use symplectic_core::inside::{ConstrainedStep, first_non_finite};
use symplectic_core::solver::{StageStorage, Visit};
use symplectic_core::{Quantity, Scalar, System, Vector};

/// Everything that depends on the numbers of constraints and stages.
#[derive(Clone, Debug)]
pub(super) struct Workspace<V: Vector> {
    pub(super) metric: Metric<V::Scalar>,
    /// At the start of the step, once it has begun.
    pub(super) start: Point<V>,
    /// At its end; at the start of the next one.
    pub(super) end: Point<V>,
    /// Stage positions Q_i and momenta P_i.
    pub(super) q: Vec<V>,
    pub(super) p: Vec<V>,
    /// Whether the last sweep moved a position.
    pub(super) moved: Vec<bool>,
    /// The increments `h b_i velocity_i` of the position.
    pub(super) drift: Vec<V>,
    /// The increments of the momentum: `h b_i force_i`, then `−w(q0)ᵀλ` and `−w(q1)ᵀμ`.
    pub(super) kick: Vec<V>,
    /// λ
    pub(super) multipliers: Vec<V::Scalar>,
    /// The terms of the momentum of a stage.
    pub(super) momentum: MomentumTerms,
    pub(super) last_impulse: LastImpulse<V::Scalar>,
    /// w(Q_i) of one stage.
    pub(super) rows: Gradients<V::Scalar>,
    /// `w(Q_i)·(q1 − q0)` of one stage, and the weighted mean over all stages.
    pub(super) part: Vec<V::Scalar>,
    pub(super) defects: Vec<V::Scalar>,
    /// The sizes that the defects are compared with.
    pub(super) terms: Vec<Terms>,
    /// `q1 − q0`
    pub(super) displacement: V,
    /// The largest displacement of every component over all sweeps of a step.
    pub(super) reach: V,
    /// A velocity, a force, a momentum or position.
    pub(super) scratch: [V; 3],
}

/// The memory of a step with non-holonomic constraints.
#[derive(Clone, Debug)]
pub struct NonholonomicStages<V: Vector> {
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
        let stages = steps.iter().map(|step| step.tableau.weights.len());
        let stages = stages.max().unwrap_or(0);
        let vectors = |count: usize| -> Vec<V> { (0..count).map(|_| q.zeros_like()).collect() };
        let numbers = |count: usize| vec![V::Scalar::from_f64(0.0); count];
        Self {
            metric,
            rows: point.gradients.clone(),
            start: point.clone(),
            end: point,
            q: vectors(stages),
            p: vectors(stages),
            moved: vec![true; stages],
            drift: vectors(stages),
            kick: vectors(stages + 2),
            multipliers: numbers(constraints),
            momentum: MomentumTerms::new(q.dimension()),
            last_impulse: LastImpulse::new(constraints, q.dimension()),
            part: numbers(constraints),
            defects: numbers(constraints),
            terms: vec![Terms::default(); constraints],
            displacement: q.zeros_like(),
            reach: q.zeros_like(),
            scratch: array::from_fn(|_| q.zeros_like()),
        }
    }
}

impl<V: Vector> NonholonomicStages<V> {
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

impl<V: Vector> StageStorage<V> for NonholonomicStages<V> {
    fn like(prototype: &V) -> Self {
        Self::new(&[], prototype)
    }

    fn anew(&self, prototype: &V) -> Self {
        Self::new(self.steps, prototype)
    }

    fn words(&mut self, visit: &mut Visit<'_>) {
        if let Some(Workspace { end, .. }) = &mut self.workspace {
            end.gradients.words(visit);
            end.normal.words(visit);
        }
    }

    fn non_finite(&self) -> Option<(Quantity, usize)> {
        let workspace = self.workspace.as_ref()?;
        first_non_finite(
            (&workspace.q, &workspace.kick[..workspace.q.len()]),
            (&workspace.p, &workspace.drift),
        )
    }

    fn mismatch(&self, _dimension: usize) -> Option<(Quantity, usize, usize)> {
        let workspace = self.workspace.as_ref()?;
        let kick = &workspace.kick[..workspace.q.len()];
        place_of_resized(self.resized?, kick, &workspace.drift)
    }

    fn forget(&mut self, _prototype: &V) {}
}
