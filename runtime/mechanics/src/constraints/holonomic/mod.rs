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
mod last_impulse;
mod memory;
mod metric;
mod momentum_terms;
mod newton;
mod normal_matrix;
mod resolution;
mod start;
mod step;

pub(super) use force::add_to_force;
pub use force::{ConstraintForce, constraint_force};
pub(super) use last_impulse::LastImpulse;
pub use memory::ConstrainedStages;
pub(super) use metric::{Metric, Point};
pub(super) use momentum_terms::MomentumTerms;
pub use start::consistent;
pub(super) use start::{CONSISTENT, Examined, check_numbers};
pub(super) use step::{NOISE, PATIENCE, ROUNDING, result, same_momentum, show_stages, stage};

use core::marker::PhantomData;

use crate::constraints::{Constrained, HolonomicConstraints, WithConstraints};
use memory::Workspace;
use symplectic_core::inside::{ConstrainedStep, Plan, StageView, in_turn, named};
use symplectic_core::solver::{
    Failure, Outcome, Solver, Step, StepStatistics, Stopping, WarmStart,
};
use symplectic_core::system::{Class, Unconstrained};
use symplectic_core::{Error, Method, Scalar, Summation, System, Vector};

/// The plan of the method `M` for systems with holonomic constraints.
#[derive(Debug)]
pub struct ConstrainedPlan<M, C>(PhantomData<(M, C)>);

impl<C: Class + Unconstrained> Class for Constrained<C> {
    type Plan<M: Method> = ConstrainedPlan<M, C>;
    type Extra<'a, V: Vector> = &'a (dyn HolonomicConstraints<V> + 'a);
    const CONSTRAINED: bool = true;
    const SEPARABLE: bool = C::SEPARABLE;

    fn memory<M: Method, V: Vector, S: System<V>, N: Solver<V, S>>(
        method: &M,
        prototype: &V,
    ) -> ConstrainedStages<V> {
        ConstrainedStages::new(method.holonomic(), prototype)
    }

    fn check_steps<M: Method>(method: &M) -> Result<(), Error> {
        match method.holonomic().is_empty() {
            true => Err(Error::NoConstrainedSteps),
            false => Ok(()),
        }
    }

    fn numbers<V: Vector, S: System<V, Class = Self>>(
        system: &S,
        q: &V,
        show: &mut dyn FnMut(V::Scalar),
    ) {
        let system = WithConstraints::holonomic(system, q.dimension());
        system.numbers(q).into_iter().for_each(show);
    }

    fn explain<V: Vector, S: System<V, Class = Self>>(system: &S, error: Error) -> Error {
        let constraints = system.extra();
        named(error, |constraint| constraints?.constraint_name(constraint))
    }
}

impl<M: Method, C: Class + Unconstrained> Plan for ConstrainedPlan<M, C> {
    type Class = Constrained<C>;
    type Memory<V: Vector, S: System<V>, N: Solver<V, S>> = ConstrainedStages<V>;

    fn prepare<V, S, N>(memory: &mut ConstrainedStages<V>, system: &S, time: f64, q: &V, p: &V)
    where
        V: Vector,
        S: System<V, Class = Self::Class>,
        N: Solver<V, S>,
    {
        let system = &WithConstraints::holonomic(system, q.dimension());
        let steps = memory.steps;
        memory.workspace = Some(Workspace::new(steps, system, time, q, p));
    }

    fn check<V, S>(system: &S, time: f64, q: &V, p: &V) -> Result<(), Error>
    where
        V: Vector,
        S: System<V, Class = Self::Class>,
    {
        let system = &WithConstraints::holonomic(system, q.dimension());
        start::check_start(system, time, q, p)
    }

    fn take<R: Summation, V: Vector, S: System<V, Class = Self::Class>, N: Solver<V, S>>(
        step: &Step<'_, V>,
        system: &S,
        memory: &mut ConstrainedStages<V>,
        kept: WarmStart,
        stopping: Stopping,
        outcome: Outcome<'_, V>,
    ) -> Result<StepStatistics, Failure> {
        memory.take::<R, S, C>(step, system, kept, stopping, outcome, |_| {})
    }

    fn show_stages<R, V, S>(
        step: &Step<'_, V>,
        system: &S,
        stopping: Stopping,
        show: &mut dyn FnMut(StageView<'_, V>),
    ) -> Option<Result<(), Failure>>
    where
        R: Summation,
        V: Vector,
        S: System<V, Class = Self::Class>,
    {
        let mut memory = ConstrainedStages::new(M::CONSTRAINED, step.q);
        Some(taken_once_more(step, |kept, outcome| {
            memory.take::<R, S, C>(step, system, kept, stopping, outcome, show)
        }))
    }

    fn momentum_rate<V, S>(system: &S, time: f64, q: &V, p: &V, rate: &mut V)
    where
        V: Vector,
        S: System<V, Class = Self::Class>,
    {
        system.force(V::Scalar::from_f64(time), q, p, rate);
        let system = &WithConstraints::holonomic(system, q.dimension());
        add_to_force(system, time, (q, p), rate);
    }
}

impl<V: Vector> ConstrainedStages<V> {
    /// Takes a step, of one tableau or of several, and shows their stages.
    fn take<R, S, C>(
        &mut self,
        step: &Step<'_, V>,
        system: &S,
        kept: WarmStart,
        stopping: Stopping,
        outcome: Outcome<'_, V>,
        mut show: impl FnMut(StageView<'_, V>),
    ) -> Result<StepStatistics, Failure>
    where
        R: Summation,
        S: System<V, Class = Constrained<C>>,
        C: Class + Unconstrained,
    {
        let ConstrainedStages {
            steps,
            workspace,
            resized,
            between: [q, q_low, p, p_low],
        } = self;
        let system = &WithConstraints::holonomic(system, step.q.dimension());
        let workspace = workspace
            .get_or_insert_with(|| Workspace::new(steps, system, step.time, step.q, step.p));
        let between = Outcome { q, q_low, p, p_low };
        let take = |(number, substep): (usize, &ConstrainedStep),
                    part: &Step<'_, V>,
                    kept: WarmStart,
                    here: &mut Outcome<'_, V>| {
            let tableau = substep.tableau;
            let taken = workspace.take::<R, _>(
                (number, tableau),
                part,
                system,
                kept.evaluation,
                stopping,
                here,
            );
            let places = (&workspace.q[..], &workspace.p[..]);
            let impulses = |stage| workspace.impulses_at(tableau, stage);
            show_stages::<V, S>(tableau, part, places, impulses, &mut show);
            taken
        };
        let place = |substep: &ConstrainedStep| (substep.start, substep.fraction);
        let taken = in_turn(steps, place, step, kept, between, outcome, take);
        *resized = system.resized();
        taken
    }
}

/// Repeats a step, with nothing kept from the previous one, to show its stages by `take`; discards its result.
pub(super) fn taken_once_more<V: Vector>(
    step: &Step<'_, V>,
    take: impl FnOnce(WarmStart, Outcome<'_, V>) -> Result<StepStatistics, Failure>,
) -> Result<(), Failure> {
    let [mut q, mut q_low, mut p, mut p_low] = core::array::from_fn(|_| step.q.zeros_like());
    let outcome = Outcome {
        q: &mut q,
        q_low: &mut q_low,
        p: &mut p,
        p_low: &mut p_low,
    };
    take(WarmStart::default(), outcome).map(|_| ())
}
