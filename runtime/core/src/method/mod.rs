//! Methods as the macros emit them, and their plans for one step.

pub(crate) mod change;
pub(crate) mod composition;
#[cfg(feature = "alloc")]
pub(crate) mod constrained;
pub(crate) mod constrained_tableau;
pub(crate) mod coupled;
pub(crate) mod damped;
pub(crate) mod diagnosis;
pub(crate) mod explicit;
pub(crate) mod interpolation;
#[cfg(feature = "alloc")]
pub(crate) mod lane_stages;
#[cfg(feature = "alloc")]
pub(crate) mod nonholonomic;
pub(crate) mod proved;
pub(crate) mod relax;
#[cfg(feature = "alloc")]
pub(crate) mod run_time;
pub(crate) mod separable_only;
pub(crate) mod solver;
pub(crate) mod splitting;
pub(crate) mod splitting_macros;
mod stage_sums;
pub(crate) mod step;
pub(crate) mod stopping;
pub(crate) mod storage;
pub(crate) mod symmetric_steps;
pub(crate) mod tableau;
pub(crate) mod tableau_macro;
pub(crate) mod work;

pub use change::{HalfChange, StageChange};
pub use composition::{Composition, CompositionMemory, Substep, Substeps};
#[cfg(feature = "alloc")]
pub use constrained::{
    ConstrainedPlan, ConstrainedStages, ConstraintForce, consistent, constraint_force,
};
pub use constrained_tableau::{ConstrainedStep, ConstrainedTableau};
pub use coupled::Coupled;
pub use damped::{DampedMemory, DampedPlan, friction_growth};
pub use explicit::Explicit;
pub use interpolation::{Inside, Interpolation};
#[cfg(feature = "alloc")]
pub use lane_stages::{
    LaneMemory, LaneOutcome, LaneStages, LaneStep, StagePart, StageVisit, StepInLanes,
};
#[cfg(feature = "alloc")]
pub use nonholonomic::{NonholonomicPlan, NonholonomicStages, consistent_momentum};
pub use proved::{
    LowerOrder, Orders, Possible, ProvedFor, Splits, StoermerVerletSteps, SymmetricFor, Symmetry,
};
#[cfg(feature = "alloc")]
pub use run_time::{
    AtRunTime, RunTimeCoefficients, RunTimePlan, RunTimeStages, RunTimeTableau, TableauError,
};
pub use separable_only::{SeparableOnly, lower_triangular, rows};
pub use solver::Solver;
pub use splitting::{KickDrift, Splitting, SplittingPlan, SplittingStep};
pub use splitting_macros::{composition, splitting};
pub use stage_sums::{StageSums, StartingValues, Sweep};
pub use step::{EvaluationCounts, EvaluationObserver, Outcome, Span, StageView, Step, WarmStart};
pub use stopping::Stopping;
pub use storage::{Evaluations, StageStorage, Stages};
pub use tableau::{
    Decoupling, HalfTableau, SecondOrderTableau, StagePolynomial, StageTableau, StoredEvaluations,
};
pub use tableau_macro::tableau;
pub use work::{Failure, StepStatistics};

use core::fmt::Debug;

use crate::error::Error;
#[cfg(feature = "alloc")]
use crate::number::Lanes;
use crate::number::{Coefficients, Scalar, Summation, Vector};
use crate::system::{Class, General, Separable, System};

/// A symplectic partitioned Runge–Kutta method: a type without fields, emitted from a proved tableau.
///
/// It can be run on separable systems, and on general systems if it is [`ProvedFor`] them.
pub trait Method: ProvedFor<Separable> + ProvedFor<()> + Copy + Debug + 'static {
    /// Name of the method.
    const NAME: &'static str;
    /// Number of stages s of the tableau; a plan may store fewer.
    const STAGES: usize;
    /// Its definition: `basis: polynomial(3), nodes: lobatto(3)`. The compiler derives the exact tableau from it again.
    const DEFINITION: &'static str;
    /// The coefficients, for computations outside the step; the plans have theirs in their code.
    const COEFFICIENTS: Coefficients;
    /// Its order for each class of Hamiltonians.
    const ORDERS: Orders;
    /// The Hamiltonians for which it is symmetric.
    const SYMMETRY: Symmetry = Symmetry::NONE;
    /// Whether it is refused for separable systems whose kinetic energy is not quadratic, because its order is lower there.
    const NEEDS_QUADRATIC_KINETIC: bool = Self::ORDERS.nystrom > Self::ORDERS.separable;

    /// Number of basis functions of the velocity inside a step. It is the number of stages, or less if the quadrature formula has more
    /// nodes than the basis has functions.
    const FUNCTIONS: usize = Self::STAGES;

    /// Its steps for systems with holonomic constraints: one step, or those of a composition. Empty if it has none.
    const CONSTRAINED: &'static [ConstrainedStep] = &[];

    /// Its steps for systems with non-holonomic constraints: one step, or those of a composition. Empty if it has none.
    const NONHOLONOMIC: &'static [ConstrainedStep] = &[];

    /// The same method for every system, even if its order is lower or it is not symplectic.
    ///
    /// ```
    /// symplectic::tableau! { ForestRuth { base: forest-ruth-1990 } }
    /// use symplectic::nalgebra::Vector1;
    /// use symplectic::{Error, Integrator, Method, State, hamiltonian};
    ///
    /// # fn main() -> Result<(), Error> {
    /// let system = hamiltonian::<Vector1<f64>, _, _>(
    ///     |_, q, p, velocity| velocity[0] = p[0] * (q[0] * q[0] + 1.0),
    ///     |_, q, p, force| force[0] = -q[0] * (p[0] * p[0] + 1.0),
    /// );
    /// let start = State::from_arrays(0.0, [0.0], [1.0]);
    /// assert_eq!((ForestRuth::ORDERS.separable, ForestRuth::ORDERS.general), (4, 1));
    /// let mut integrator = Integrator::new(ForestRuth.accept_lower_order(), system, start, 0.1)?;
    /// integrator.step()?;
    /// # Ok(())
    /// # }
    /// ```
    fn accept_lower_order(self) -> LowerOrder<Self> {
        LowerOrder(self)
    }

    /// Its plan for systems with a general Hamiltonian.
    type General: Plan<Class = General>;
    /// Its plan for systems with a separable Hamiltonian.
    type Separable: Plan<Class = Separable>;
}

/// How a [`Method`] takes one step of a system of one [`Class`]:
///
/// * by drifts and kicks ([`Splitting`]),
/// * by other explicit stages ([`Explicit`]),
/// * by coupled stages, which a [`Solver`] computes ([`Coupled`]),
/// * by steps of other methods ([`Composition`]).
///
/// [`Splitting`]: crate::emitted::Splitting
/// [`Explicit`]: crate::emitted::Explicit
/// [`Coupled`]: crate::emitted::Coupled
/// [`Composition`]: crate::emitted::Composition
pub trait Plan {
    /// The class of systems that it steps.
    type Class: Class;
    /// Its memory besides the state, allocated once and used for every step.
    type Memory<V: Vector, S: System<V>, N: Solver<V, S>>: StageStorage<V>;

    /// Number of evaluations in a step [in place](Self::take_in_place); `None` if the plan takes no steps in place.
    const EVALUATIONS_IN_PLACE: Option<u32> = None;

    /// Whether a step has no branch on a value. Then a step of a vector of lanes has in every lane the bits of a step of doubles.
    const LANEWISE: bool = false;

    /// Allocates in `memory` what depends on the system.
    #[cfg_attr(not(debug_assertions), inline(always))]
    fn prepare<V, S, N>(
        _memory: &mut Self::Memory<V, S, N>,
        _system: &S,
        _time: f64,
        _q: &V,
        _p: &V,
    ) where
        V: Vector,
        S: System<V, Class = Self::Class>,
        N: Solver<V, S>,
    {
    }

    /// Checks that steps can begin at a state.
    ///
    /// # Errors
    ///
    /// [`Error::OtherClass`] if the system has constraints or friction that steps of this class ignore; [`Error::InconsistentStart`] and
    /// others if there are constraints.
    #[cfg_attr(not(debug_assertions), inline(always))]
    fn check<V, S>(system: &S, _time: f64, q: &V, _p: &V) -> Result<(), Error>
    where
        V: Vector,
        S: System<V, Class = Self::Class>,
    {
        check_no_constraints(system)?;
        check_no_friction(system, q)
    }

    /// Takes `step` and writes its result into `outcome`; returns the statistics of the step.
    ///
    /// # Errors
    ///
    /// [`Failure`] if the stages cannot be found. The caller checks that the result is finite.
    fn take<R: Summation, V: Vector, S: System<V, Class = Self::Class>, N: Solver<V, S>>(
        step: &Step<'_, V>,
        system: &S,
        memory: &mut Self::Memory<V, S, N>,
        kept: WarmStart,
        stopping: Stopping,
        outcome: Outcome<'_, V>,
    ) -> Result<StepStatistics, Failure>;

    /// Whether a tableau at run time has steps for systems of this class.
    #[cfg(feature = "alloc")]
    #[doc(hidden)]
    fn steps_at_run_time(_tableau: &RunTimeTableau) -> bool {
        true
    }

    /// Whether steps are taken [in lanes](Self::lane_step).
    #[cfg(feature = "alloc")]
    #[doc(hidden)]
    #[inline]
    fn goes_in_lanes<V, S, N>() -> bool
    where
        V: Vector,
        S: System<V, Class = Self::Class>,
        N: Solver<V, S>,
    {
        false
    }

    /// How it takes a step in lanes; `None` if that is impossible.
    #[cfg(feature = "alloc")]
    #[doc(hidden)]
    #[inline]
    fn lane_step<R, V, S, N, W, J>() -> Option<LaneStep<W, J>>
    where
        R: Summation,
        V: Vector,
        S: System<V, Class = Self::Class>,
        N: Solver<V, S>,
        W: Vector<Scalar: Lanes>,
        J: System<W, Class = Self::Class>,
    {
        None
    }

    /// Takes a step from `state`, in place, with the evaluations [kept](WarmStart::evaluation) by the previous step. Does nothing if
    /// [`EVALUATIONS_IN_PLACE`](Self::EVALUATIONS_IN_PLACE) is `None`.
    #[cfg_attr(not(debug_assertions), inline(always))]
    fn take_in_place<R, V, S, N, K>(
        _span: Span,
        _system: &S,
        _memory: &mut Self::Memory<V, S, N>,
        _state: Outcome<'_, V>,
        _kick_drift: &mut K,
    ) where
        R: Summation,
        V: Vector,
        S: System<V, Class = Self::Class>,
        N: Solver<V, S>,
        K: KickDrift,
    {
    }

    /// Takes `step` of a splitting with the kicks and drifts of `kick_drift`, and shows its evaluations to `observer`. Only for a plan that
    /// [splits](Splits).
    #[cfg_attr(not(debug_assertions), inline(always))]
    fn take_by<R, V, S, K, W>(
        _step: &Step<'_, V>,
        _system: &S,
        _evaluations: &mut Evaluations<V>,
        _kept: WarmStart,
        _outcome: Outcome<'_, V>,
        _kick_drift: &mut K,
        _witness: &mut W,
    ) -> StepStatistics
    where
        R: Summation,
        V: Vector,
        S: System<V, Class = Self::Class>,
        K: KickDrift,
        W: EvaluationObserver,
    {
        unreachable!("a plan that splits has this function, and no other is asked")
    }

    /// Repeats a step that failed, and shows its evaluations to `observer`; does nothing if they are in `memory` or have been shown.
    fn observe<R, V, S, N, W>(
        _step: &Step<'_, V>,
        _system: &S,
        _memory: &mut Self::Memory<V, S, N>,
        _outcome: Outcome<'_, V>,
        _witness: &mut W,
    ) where
        R: Summation,
        V: Vector,
        S: System<V, Class = Self::Class>,
        N: Solver<V, S>,
        W: EvaluationObserver,
    {
    }

    /// Repeats a step with new memory, and shows its stages. `None` if the stages follow from the position at its start and the momentum at
    /// its end.
    #[inline]
    fn show_stages<R, V, S>(
        _step: &Step<'_, V>,
        _system: &S,
        _stopping: Stopping,
        _show: &mut dyn FnMut(StageView<'_, V>),
    ) -> Option<Result<(), Failure>>
    where
        R: Summation,
        V: Vector,
        S: System<V, Class = Self::Class>,
    {
        None
    }

    /// Writes p' at a state into `rate`: the force, including that of constraints.
    #[cfg_attr(not(debug_assertions), inline(always))]
    fn momentum_rate<V, S>(system: &S, time: f64, q: &V, p: &V, rate: &mut V)
    where
        V: Vector,
        S: System<V, Class = Self::Class>,
    {
        system.force(V::Scalar::from_f64(time), q, p, rate);
    }

    /// How values inside a step are computed.
    const INTERPOLATION: Interpolation = Interpolation::Hermite;

    /// Adds to `q` and `p` their deviations from the straight line between the ends of the last step, if the
    /// [stages](Interpolation::Stages) in `memory` determine them.
    fn extend<V, S, N>(_memory: &Self::Memory<V, S, N>, _at: Inside<'_, V>, _q: &mut V, _p: &mut V)
    where
        V: Vector,
        S: System<V, Class = Self::Class>,
        N: Solver<V, S>,
    {
    }
}

/// Checks that a system whose class has no constraints has none.
#[cfg_attr(not(debug_assertions), inline(always))]
pub(crate) fn check_no_constraints<V: Vector, S: System<V>>(system: &S) -> Result<(), Error> {
    check_no_holonomic_constraints(system)?;
    check_no_rows(system)
}

/// Checks that a system whose class has no holonomic constraints has none.
#[cfg_attr(not(debug_assertions), inline(always))]
pub(crate) fn check_no_holonomic_constraints<V: Vector, S: System<V>>(
    system: &S,
) -> Result<(), Error> {
    if system.constraints() == 0 {
        return Ok(());
    }
    Err(Error::OtherClass {
        what: "constraints",
        class: "Constrained<Separable>` or `Constrained<General>",
    })
}

/// Checks that a system whose class has no non-holonomic constraints has none.
#[cfg_attr(not(debug_assertions), inline(always))]
pub(crate) fn check_no_rows<V: Vector, S: System<V>>(system: &S) -> Result<(), Error> {
    if system.nonholonomic_constraints() == 0 {
        return Ok(());
    }
    Err(Error::OtherClass {
        what: "non-holonomic constraints",
        class: "Nonholonomic<Separable>` or `Nonholonomic<General>",
    })
}

/// Checks that a system whose class has no friction has none.
#[cfg_attr(not(debug_assertions), inline(always))]
pub(crate) fn check_no_friction<V: Vector, S: System<V>>(system: &S, q: &V) -> Result<(), Error> {
    if (0..q.dimension()).all(|component| system.friction(component) == 0.0) {
        return Ok(());
    }
    Err(Error::OtherClass {
        what: "friction",
        class: "Damped",
    })
}

/// How the stages of a [`Method`] are computed for systems of one [`Class`].
///
/// A step is `begin`, then `sweep` until the stages have converged (never in an [`Explicit`](crate::emitted::Explicit) plan), then
/// `increments` with plain sums, then `finish`.
///
/// Stage `i` evaluates the force at `t0 + c_i h` and the velocity at `t0 + c̃_i h`: see [`Hamiltonian`](crate::Hamiltonian#time). Plans of
/// the class [`Separable`] pass an arbitrary vector for the argument that the system does not read.
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
