//! The plan of steps with constraints of either kind.

use core::array;
use core::marker::PhantomData;

use super::holonomic::add_to_force;
use super::increments::same_momentum;
use super::kind::{Kind, with_constraints};
use super::memory::{ConstrainedStages, OwnPart, Workspace};
use super::with_constraints::WithConstraints;
use super::{Constrained, HolonomicConstraints, Nonholonomic, NonholonomicConstraints};
use symplectic_core::inside::{
    ConstrainedStep, ConstrainedTableau, Plan, StageView, in_turn, named,
};
use symplectic_core::solver::{
    Failure, Outcome, Solver, Step, StepStatistics, Stopping, WarmStart,
};
use symplectic_core::system::{Class, Unconstrained};
use symplectic_core::{Error, Method, Scalar, Summation, System, Vector};

macro_rules! classes {
    ($($class:ident by $constraints:ident;)*) => {$(
        impl<C: Class + Unconstrained> Class for $class<C> {
            type Plan<M: Method> = ConstrainedPlan<M, Self>;
            type Extra<'a, V: Vector> = &'a (dyn $constraints<V> + 'a);
            const CONSTRAINED: bool = true;
            const SEPARABLE: bool = C::SEPARABLE;

            fn memory<M: Method, V: Vector, S: System<V>, N: Solver<V, S>>(
                method: &M,
                prototype: &V,
            ) -> ConstrainedStages<V, <Self as Kind>::Part<V>> {
                ConstrainedStages::new(Self::steps_of(method), prototype)
            }

            fn check_steps<M: Method>(method: &M) -> Result<(), Error> {
                match Self::steps_of(method).is_empty() {
                    true => Err(Error::NoConstrainedSteps),
                    false => Ok(()),
                }
            }

            fn numbers<V: Vector, S: System<V, Class = Self>>(
                system: &S,
                q: &V,
                show: &mut dyn FnMut(V::Scalar),
            ) {
                let system = with_constraints(system, q.dimension());
                system.numbers(q).into_iter().for_each(show);
            }

            fn explain<V: Vector, S: System<V, Class = Self>>(system: &S, error: Error) -> Error {
                let constraints = system.extra();
                named(error, |constraint| constraints?.constraint_name(constraint))
            }
        }
    )*};
}

classes! {
    Constrained by HolonomicConstraints;
    Nonholonomic by NonholonomicConstraints;
}

/// The plan of the method `M` for systems with constraints of the kind `K`.
#[derive(Debug)]
pub struct ConstrainedPlan<M, K>(PhantomData<(M, K)>);

impl<M: Method, K: Kind> Plan for ConstrainedPlan<M, K> {
    type Class = K;
    type Memory<V: Vector, S: System<V>, N: Solver<V, S>> = ConstrainedStages<V, K::Part<V>>;

    fn prepare<V, S, N>(
        memory: &mut ConstrainedStages<V, K::Part<V>>,
        system: &S,
        time: f64,
        q: &V,
        p: &V,
    ) where
        V: Vector,
        S: System<V, Class = K>,
        N: Solver<V, S>,
    {
        let system = &with_constraints(system, q.dimension());
        memory.workspace = Some(Workspace::new(memory.steps, system, time, q, p));
    }

    fn check<V, S>(system: &S, time: f64, q: &V, p: &V) -> Result<(), Error>
    where
        V: Vector,
        S: System<V, Class = K>,
    {
        K::check_start(&with_constraints(system, q.dimension()), time, q, p)
    }

    fn take<R: Summation, V: Vector, S: System<V, Class = K>, N: Solver<V, S>>(
        step: &Step<'_, V>,
        system: &S,
        memory: &mut ConstrainedStages<V, K::Part<V>>,
        kept: WarmStart,
        stopping: Stopping,
        outcome: Outcome<'_, V>,
    ) -> Result<StepStatistics, Failure> {
        let system = &with_constraints(system, step.q.dimension());
        memory.take::<R, S>(step, system, kept, stopping, outcome, |_| {})
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
        S: System<V, Class = K>,
    {
        // The step once more, without what the run has kept; its result is discarded.
        let mut memory = ConstrainedStages::<V, K::Part<V>>::new(K::known_steps::<M>(), step.q);
        let system = &with_constraints(system, step.q.dimension());
        let [mut q, mut q_low, mut p, mut p_low] = array::from_fn(|_| step.q.zeros_like());
        let outcome = Outcome {
            q: &mut q,
            q_low: &mut q_low,
            p: &mut p,
            p_low: &mut p_low,
        };
        let kept = WarmStart::default();
        let taken = memory.take::<R, S>(step, system, kept, stopping, outcome, show);
        Some(taken.map(|_| ()))
    }

    fn momentum_rate<V, S>(system: &S, time: f64, q: &V, p: &V, rate: &mut V)
    where
        V: Vector,
        S: System<V, Class = K>,
    {
        system.force(V::Scalar::from_f64(time), q, p, rate);
        let system = &with_constraints(system, q.dimension());
        add_to_force(system, time, (q, p), rate);
    }
}

impl<V: Vector, O: OwnPart<V>> ConstrainedStages<V, O> {
    /// Takes a step, of one tableau or of several, and shows their stages.
    fn take<R: Summation, S: System<V>>(
        &mut self,
        step: &Step<'_, V>,
        system: &WithConstraints<'_, V, S>,
        kept: WarmStart,
        stopping: Stopping,
        outcome: Outcome<'_, V>,
        mut show: impl FnMut(StageView<'_, V>),
    ) -> Result<StepStatistics, Failure> {
        let [q, q_low, p, p_low] = &mut self.between;
        let between = Outcome { q, q_low, p, p_low };
        let steps = self.steps;
        let workspace = (self.workspace)
            .get_or_insert_with(|| Workspace::new(steps, system, step.time, step.q, step.p));
        let take = |(number, substep): (usize, &ConstrainedStep),
                    part: &Step<'_, V>,
                    kept: WarmStart,
                    here: &mut Outcome<'_, V>| {
            let (tableau, carried) = (substep.tableau, kept.evaluation);
            let numbered = (number, tableau);
            let taken =
                O::take_substep::<R, S>(workspace, numbered, part, system, carried, stopping, here);
            workspace.show_stages::<S>(tableau, part, &mut show);
            taken
        };
        let place = |substep: &ConstrainedStep| (substep.start, substep.fraction);
        let taken = in_turn(steps, place, step, kept, between, outcome, take);
        self.resized = system.resized();
        taken
    }
}

impl<V: Vector, O: OwnPart<V>> Workspace<V, O> {
    /// Shows the stages of a completed step, with the impulses of the constraints at each.
    #[inline]
    fn show_stages<S: System<V>>(
        &self,
        tableau: &ConstrainedTableau,
        step: &Step<'_, V>,
        show: &mut impl FnMut(StageView<'_, V>),
    ) {
        let mut last = 0;
        for (i, (q, &weight)) in self.q.iter().zip(tableau.weights).enumerate() {
            if !same_momentum::<V, S>(tableau, i) {
                last = i;
            }
            show(StageView {
                weight: step.size * weight.double(),
                force_weight: step.size * weight.double(),
                time: step.at(tableau.nodes[i]),
                momentum_time: step.at(tableau.momentum_nodes[i]),
                q,
                p: &self.p[last],
                impulses: O::impulses_at(self, tableau, i),
                impulse_weight: match weight.double() {
                    0.0 => step.size,
                    weight => step.size * weight,
                },
            });
        }
    }
}
