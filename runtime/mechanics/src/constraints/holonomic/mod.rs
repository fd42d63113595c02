//! Steps of systems with holonomic constraints `φ(q) = 0` (Jay, 1996; Marsden & West, 2001, 3.5.6).
//!
//! ```text
//! Q_i = q0 + h Σ_j a_ij velocity_j    P_i = p0 + h Σ_j ã_ij force_j    force_j = −∂H/∂q(Q_j, P_j) − G(Q_j)ᵀ Λ_j
//! φ(Q_i) = 0, i = 2..s                q1 = Q_s    p1 = p0 + h Σ_i b_i force_i,   G(q1) ∂H/∂p(q1, p1) = 0
//! ```
//!
//! With two stages of Lobatto IIIA–IIIB this is RATTLE.

mod force;
mod history;
mod newton;
mod resolution;
mod start;
mod step;

pub(super) use force::add_to_force;
pub use force::{ConstraintForce, constraint_force};
pub use start::consistent;
pub(super) use start::{CONSISTENT, Examined, check_numbers};

use alloc::vec;
use alloc::vec::Vec;
use core::array;

use crate::constraints::kind::Kind;
use crate::constraints::memory::OwnPart;
use crate::constraints::metric::{Metric, Point};
use crate::constraints::with_constraints::Constraints;
use crate::constraints::{Constrained, Gradients, WithConstraints, Workspace};
use history::History;
use newton::StageJacobian;
use resolution::Resolution;
use step::depends_on_the_start;
use symplectic_core::inside::{ConstrainedStep, ConstrainedTableau};
use symplectic_core::solver::{
    Failure, Outcome, Step, StepStatistics, Stopping, Visit, scalar_words, vector_words,
};
use symplectic_core::system::{Class, Unconstrained};
use symplectic_core::{Error, Method, Scalar, Summation, System, Vector};

impl<C: Class + Unconstrained> Kind for Constrained<C> {
    type Part<V: Vector> = HolonomicPart<V>;

    const GIVEN_BY: &'static str = "HolonomicConstraints";

    fn constraints_of<'a, V: Vector>(given: Self::Extra<'a, V>) -> Constraints<'a, V> {
        Constraints::Holonomic(given)
    }

    fn steps_of<M: Method>(method: &M) -> &'static [ConstrainedStep] {
        method.holonomic()
    }

    fn known_steps<M: Method>() -> &'static [ConstrainedStep] {
        M::CONSTRAINED
    }

    fn check_start<V: Vector, S: System<V>>(
        system: &WithConstraints<'_, V, S>,
        time: f64,
        q: &V,
        p: &V,
    ) -> Result<(), Error> {
        start::check_start(system, time, q, p)
    }
}

/// The part of the memory that only steps with holonomic constraints need.
#[derive(Clone, Debug)]
pub struct HolonomicPart<V: Vector> {
    /// How well the values of the constraints resolve positions.
    resolution: Resolution,
    /// The gradients at Q_2 … Q_{s−1}.
    gradients: Vec<Gradients<V::Scalar>>,
    /// `h b_k Λ_k`, stage by stage.
    impulses: Vec<V::Scalar>,
    /// Their last changes.
    changes: Vec<V::Scalar>,
    /// One for each number of stages; a costly one is made when it is first needed.
    jacobians: Vec<StageJacobian<V::Scalar>>,
    /// `φ(Q_i)`, then `S⁻¹ φ(Q_i)`, i = 2..s, stage by stage.
    defects: Vec<V::Scalar>,
    /// The previous steps of every part of a composition.
    histories: Vec<History<V>>,
    /// Whether the stages of this step start from extrapolated ones.
    extrapolated: bool,
}

impl<V: Vector> OwnPart<V> for HolonomicPart<V> {
    const IMPULSES: usize = 0;

    fn for_steps<S: System<V>>(
        steps: &[ConstrainedStep],
        stages: usize,
        system: &WithConstraints<'_, V, S>,
        q: &V,
        (metric, point): (&Metric<V::Scalar>, &Point<V>),
    ) -> Self {
        let (constraints, half) = (system.constraints(), metric.half_bandwidth());
        let mut jacobians: Vec<StageJacobian<V::Scalar>> = Vec::new();
        for step in steps {
            let own = step.tableau.weights.len().saturating_sub(1);
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
        let numbers = || vec![V::Scalar::from_f64(0.0); stages.saturating_sub(1) * constraints];
        Self {
            resolution: Resolution::new(system, q, &point.gradients),
            gradients: vec![point.gradients.clone(); stages.saturating_sub(2)],
            impulses: numbers(),
            changes: numbers(),
            jacobians,
            defects: numbers(),
            histories: histories.collect(),
            extrapolated: false,
        }
    }

    /// Takes the step with this number in the composition; `carried` means that the previous step ended where this one starts.
    ///
    /// Stages and multipliers start from those of the last five steps if these had the same size. A sweep evaluates the forces at the
    /// stages, computes the stages with the present multipliers, and corrects the multipliers by a Newton step. In the first sweep without
    /// previous steps it corrects them by
    ///
    /// ```text
    /// h b_k Λ_k += (b_k/h) Σ_i (X⁻¹)_ki S⁻¹ φ(Q_i)      S = G M⁻¹ Gᵀ at q0
    /// ```
    ///
    /// with 1 in place of a weight `b_k = 0`, until the residuals are rounding errors. Stages between start and end follow the new
    /// multipliers at once. Then `Q_s = q1`, and the last multiplier follows from `G velocity(q1, p1) = 0`.
    fn take_substep<R: Summation, S: System<V>>(
        workspace: &mut Workspace<V, Self>,
        (number, tableau): (usize, &ConstrainedTableau),
        step: &Step<'_, V>,
        system: &WithConstraints<'_, V, S>,
        carried: bool,
        stopping: Stopping,
        outcome: &mut Outcome<'_, V>,
    ) -> Result<StepStatistics, Failure> {
        let separable = S::Class::SEPARABLE;
        let mut work = StepStatistics::default();
        if !carried {
            // The multipliers of another state, or of a step that failed, are not used as starting values.
            workspace.multipliers.fill(V::Scalar::from_f64(0.0));
            workspace.own.histories.iter_mut().for_each(History::forget);
            let (end, scratch) = (&mut workspace.end, &mut workspace.scratch);
            (workspace.metric).evaluate(system, step.time, (step.q, step.p), end, scratch)?;
            if separable {
                let at = V::Scalar::from_f64(step.time);
                system.force(at, step.q, step.p, &mut workspace.end.force);
                work.evaluations += 1;
            }
        }
        core::mem::swap(&mut workspace.start, &mut workspace.end);
        workspace.begin((number, tableau), step, system, &mut work);
        let mut iterated =
            workspace.iterate::<R, S>(tableau, step, system, stopping, outcome, &mut work);
        if workspace.own.extrapolated
            && matches!(iterated, Err(ref failure) if depends_on_the_start(failure))
        {
            workspace.own.histories[number].forget();
            workspace.begin((number, tableau), step, system, &mut work);
            iterated =
                workspace.iterate::<R, S>(tableau, step, system, stopping, outcome, &mut work);
        }
        iterated?;
        let momenta = if separable {
            &[]
        } else {
            &workspace.p[..tableau.weights.len()]
        };
        let stages = workspace.q[1..tableau.weights.len()].iter().chain(momenta);
        workspace.own.histories[number].end(stages, &workspace.own.impulses);
        workspace.finish::<R, S>(tableau, step, system, stopping, outcome, &mut work)?;
        Ok(work)
    }

    fn impulses_at<'w>(
        workspace: &'w Workspace<V, Self>,
        tableau: &ConstrainedTableau,
        stage: usize,
    ) -> &'w [V::Scalar] {
        if stage + 1 == tableau.weights.len() {
            return &workspace.last_impulse.multipliers;
        }
        let constraints = workspace.multipliers.len();
        &workspace.own.impulses[stage * constraints..][..constraints]
    }

    fn own_words(workspace: &mut Workspace<V, Self>, visit: &mut Visit<'_>) {
        let Workspace {
            end,
            multipliers,
            own,
            ..
        } = workspace;
        vector_words(array::from_mut(&mut end.force), visit);
        end.gradients.words(visit);
        end.normal.words(visit);
        scalar_words(multipliers, visit);
        own.resolution.words(visit);
        for history in &mut own.histories {
            history.words(visit);
        }
    }
}
