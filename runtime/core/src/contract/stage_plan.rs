//! How the stages of a method are computed.

use crate::contract::{
    Class, EvaluationCounts, Outcome, StageChange, StageStorage, StageSums, Step, Sweep, System,
    WarmStart,
};
use crate::number::{Summation, Vector};

/// How the stages of a [`Method`](crate::Method) are computed for systems of one [`Class`].
///
/// A step is `begin`, then `sweep` until the stages have converged (never in an [`Explicit`](crate::emitted::Explicit) plan), then
/// `increments` with plain sums, then `finish`.
///
/// Stage `i` evaluates the force at `t0 + c_i h` and the velocity at `t0 + c̃_i h`: see [`Hamiltonian`](crate::Hamiltonian#time). Plans of
/// the class [`Separable`](crate::Separable) pass an arbitrary vector for the argument that the system does not read.
///
/// If the method is symplectic and no weight is zero, coupled stages are sums of increments `h b_j velocity_j` and `h b̃_j force_j`. Their
/// coefficients are `μ_ij = a_ij/b_j` and `μ̃_ij = ã_ij/b̃_j`, rounded so that `μ̃_ij + μ_ji = 1` exactly. So the rounded method is
/// symplectic too.
pub trait StagePlan {
    /// The class of systems that it steps.
    type Class: Class;
    /// The stage values and the evaluations.
    type Stages<V: Vector>: StageStorage<V>;

    /// How many evaluations it makes.
    const EVALUATIONS: EvaluationCounts;

    /// How many evaluations it makes with these stages: [`EVALUATIONS`](Self::EVALUATIONS), unless their number is known only at run time.
    #[cfg_attr(not(debug_assertions), inline(always))]
    fn evaluations<V: Vector>(_stages: &Self::Stages<V>) -> EvaluationCounts {
        Self::EVALUATIONS
    }

    /// The stages of a plan that is a value.
    fn stages<V: Vector>(&self, prototype: &V) -> Self::Stages<V> {
        Self::Stages::like(prototype)
    }

    /// Evaluates the explicit stages before the coupled ones, and sets the starting values of the coupled stages. These are extrapolated
    /// from the stages of the previous step if they are [kept](WarmStart::stages); otherwise they are the start of the step.
    fn begin<R: Summation, V: Vector, S: System<V, Class = Self::Class>>(
        step: &Step<'_, V>,
        system: &S,
        stages: &mut Self::Stages<V>,
        kept: WarmStart,
    );

    /// The forces at the coupled stages.
    #[inline]
    fn forces<R: Summation, V: Vector, S: System<V, Class = Self::Class>>(
        _step: &Step<'_, V>,
        _system: &S,
        _stages: &mut Self::Stages<V>,
    ) {
    }

    /// The momenta of the coupled stages, from the forces.
    #[inline]
    fn momenta<V: Vector, A: StageSums>(
        _step: &Step<'_, V>,
        _stages: &mut Self::Stages<V>,
        _sums: &mut A,
    ) {
    }

    /// The velocities at the coupled stages.
    #[inline]
    fn velocities<R: Summation, V: Vector, S: System<V, Class = Self::Class>>(
        _step: &Step<'_, V>,
        _system: &S,
        _stages: &mut Self::Stages<V>,
    ) {
    }

    /// The positions of the coupled stages, from the velocities.
    #[inline]
    fn positions<V: Vector, A: StageSums>(
        _step: &Step<'_, V>,
        _stages: &mut Self::Stages<V>,
        _sums: &mut A,
    ) {
    }

    /// One fixed-point sweep over the coupled stages: new forces, the momenta that follow from them, new velocities, and the
    /// positions that follow from those. Returns how much the stage values changed.
    ///
    /// Each kind uses the newest values of the previous one (Gauss–Seidel). This converges in fewer sweeps than computing all stage values
    /// from old evaluations. The positions come last: their change measures the effect of the next sweep. The stopping criterion of
    /// [`FixedPoint`](crate::solver::FixedPoint) relies on this order.
    #[inline]
    fn sweep<R: Summation, V: Vector, S: System<V, Class = Self::Class>>(
        step: &Step<'_, V>,
        system: &S,
        stages: &mut Self::Stages<V>,
    ) -> StageChange {
        let mut change = StageChange::default();
        Self::forces::<R, V, S>(step, system, stages);
        Self::momenta(step, stages, &mut Sweep::<R>::new(&mut change.p));
        Self::velocities::<R, V, S>(step, system, stages);
        Self::positions(step, stages, &mut Sweep::<R>::new(&mut change.q));
        change
    }

    /// Turns the evaluations of the coupled stages into increments after the last sweep, if the plan uses increments. With
    /// [compensated](Summation::COMPENSATED) sums every sweep does this. With plain sums the evaluations stay unscaled until here, and the
    /// factors of the sums contain the weights.
    #[cfg_attr(not(debug_assertions), inline(always))]
    fn increments<V: Vector>(_step: &Step<'_, V>, _stages: &mut Self::Stages<V>) {}

    /// Makes the evaluations after the coupled stages, and writes the result of the step.
    fn finish<R: Summation, V: Vector, S: System<V, Class = Self::Class>>(
        step: &Step<'_, V>,
        system: &S,
        stages: &mut Self::Stages<V>,
        kept: WarmStart,
        outcome: Outcome<'_, V>,
    );
}
