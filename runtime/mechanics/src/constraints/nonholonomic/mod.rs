//! Steps of systems with non-holonomic constraints `w(q)·q' = 0`: discrete Lagrange–d'Alembert–Pontryagin (Leok & Ohsawa,
//! arXiv:0810.0740v1, 4.28).
//!
//! ```text
//! p = p0 − w(q0)ᵀλ      Q_i = q0 + h Σ_j a_ij velocity_j    P_i = p + h Σ_j ã_ij force_j
//! Σ_i b_i w(Q_i)·(q1 − q0) = 0    q1 = q0 + h Σ_i b_i velocity_i    p1 = p + h Σ_i b_i force_i − w(q1)ᵀμ,   w(q1) ∂H/∂p(q1, p1) = 0
//! ```
//!
//! For Gauss with one stage the discrete constraint is imposed at the midpoint. For Lobatto IIIA–IIIB with two stages it is the mean of
//! both ends. For the Euler methods it is imposed at one end. A step is its own adjoint if its tableau is; the two Euler steps are adjoints
//! of each other. So a symmetric tableau gives a symmetric step of order 2, which can be composed as such. Positions do not depend on μ:
//! the next step finds λ for any momentum in `p1 + span wᵀ`.
//!
//! The stages need only H, so H may be degenerate as long as `w H_pp wᵀ` is invertible. Let `H_d^±` be the generating functions of the same
//! tableau without constraints, `P = p1 + w(q1)ᵀμ` and `p = p0 − w(q0)ᵀλ`. A step then satisfies the implicit discrete Hamilton's equations
//! (Leok & Ohsawa 4.35 and 4.52):
//!
//! ```text
//! (+)  p0 − D1 H_d⁺(q0, P) ∈ span w(q0)ᵀ     q1 = D2 H_d⁺(q0, P)                     P − p1 ∈ span w(q1)ᵀ
//! (−)  q0 = −D1 H_d⁻(p, q1)                  p1 + D2 H_d⁻(p, q1) ∈ span w(q1)ᵀ       p − p0 ∈ span w(q0)ᵀ
//! ```

mod memory;
mod start;
mod step;

pub use memory::NonholonomicStages;
pub use start::consistent_momentum;

use core::marker::PhantomData;

use crate::constraints::holonomic::{add_to_force, show_stages, taken_once_more};
use crate::constraints::{Nonholonomic, NonholonomicConstraints, WithConstraints};
use memory::Workspace;
use symplectic_core::inside::{ConstrainedStep, Plan, StageView, in_turn, named};
use symplectic_core::solver::{
    Failure, Outcome, Solver, Step, StepStatistics, Stopping, WarmStart,
};
use symplectic_core::system::{Class, Unconstrained};
use symplectic_core::{Error, Method, Scalar, Summation, System, Vector};

/// The plan of the method `M` for systems with non-holonomic constraints.
#[derive(Debug)]
pub struct NonholonomicPlan<M, C>(PhantomData<(M, C)>);

impl<C: Class + Unconstrained> Class for Nonholonomic<C> {
    type Plan<M: Method> = NonholonomicPlan<M, C>;
    type Extra<'a, V: Vector> = &'a (dyn NonholonomicConstraints<V> + 'a);
    const CONSTRAINED: bool = true;
    const SEPARABLE: bool = C::SEPARABLE;

    fn memory<M: Method, V: Vector, S: System<V>, N: Solver<V, S>>(
        method: &M,
        prototype: &V,
    ) -> NonholonomicStages<V> {
        NonholonomicStages::new(method.nonholonomic(), prototype)
    }

    fn check_steps<M: Method>(method: &M) -> Result<(), Error> {
        match method.nonholonomic().is_empty() {
            true => Err(Error::NoConstrainedSteps),
            false => Ok(()),
        }
    }

    fn numbers<V: Vector, S: System<V, Class = Self>>(
        system: &S,
        q: &V,
        show: &mut dyn FnMut(V::Scalar),
    ) {
        let system = WithConstraints::nonholonomic(system, q.dimension());
        system.numbers(q).into_iter().for_each(show);
    }

    fn explain<V: Vector, S: System<V, Class = Self>>(system: &S, error: Error) -> Error {
        let constraints = system.extra();
        named(error, |constraint| constraints?.constraint_name(constraint))
    }
}

impl<M: Method, C: Class + Unconstrained> Plan for NonholonomicPlan<M, C> {
    type Class = Nonholonomic<C>;
    type Memory<V: Vector, S: System<V>, N: Solver<V, S>> = NonholonomicStages<V>;

    fn prepare<V, S, N>(memory: &mut NonholonomicStages<V>, system: &S, time: f64, q: &V, p: &V)
    where
        V: Vector,
        S: System<V, Class = Self::Class>,
        N: Solver<V, S>,
    {
        let system = &WithConstraints::nonholonomic(system, q.dimension());
        let steps = memory.steps;
        memory.workspace = Some(Workspace::new(steps, system, time, q, p));
    }

    fn check<V, S>(system: &S, time: f64, q: &V, p: &V) -> Result<(), Error>
    where
        V: Vector,
        S: System<V, Class = Self::Class>,
    {
        let system = &WithConstraints::nonholonomic(system, q.dimension());
        start::check_start(system, time, q, p)
    }

    fn take<R: Summation, V: Vector, S: System<V, Class = Self::Class>, N: Solver<V, S>>(
        step: &Step<'_, V>,
        system: &S,
        memory: &mut NonholonomicStages<V>,
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
        let mut memory = NonholonomicStages::new(M::NONHOLONOMIC, step.q);
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
        let system = &WithConstraints::nonholonomic(system, q.dimension());
        add_to_force(system, time, (q, p), rate);
    }
}

impl<V: Vector> NonholonomicStages<V> {
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
        S: System<V, Class = Nonholonomic<C>>,
        C: Class + Unconstrained,
    {
        let NonholonomicStages {
            steps,
            workspace,
            resized,
            between: [q, q_low, p, p_low],
        } = self;
        let system = &WithConstraints::nonholonomic(system, step.q.dimension());
        let workspace = workspace
            .get_or_insert_with(|| Workspace::new(steps, system, step.time, step.q, step.p));
        let between = Outcome { q, q_low, p, p_low };
        let take = |(_, substep): (usize, &ConstrainedStep),
                    part: &Step<'_, V>,
                    kept: WarmStart,
                    here: &mut Outcome<'_, V>| {
            let tableau = substep.tableau;
            let taken =
                workspace.take::<R, _>(tableau, part, system, kept.evaluation, stopping, here);
            let places = (&workspace.q[..], &workspace.p[..]);
            // The impulses are at the ends of the step.
            show_stages::<V, S>(tableau, part, places, |_| &[], &mut show);
            taken
        };
        let place = |substep: &ConstrainedStep| (substep.start, substep.fraction);
        let taken = in_turn(steps, place, step, kept, between, outcome, take);
        *resized = system.resized();
        taken
    }
}
