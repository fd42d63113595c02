//! The stepper of a partitioned Runge–Kutta method.

use core::fmt;
use core::marker::PhantomData;

use super::clock::{Clock, RemainingSteps};
use super::last_step::LastStep;
use super::memory::StepMemory;
use super::validation::{
    check_masses, check_quadratic_kinetic, check_start, check_state, check_step_size,
    has_linear_velocity,
};
use super::{Equal, Retry, Run, Statistics, Stepper};
use crate::error::Error;
use crate::method::interpolation::Line;
use crate::method::{
    Inside, Interpolation, Method, Plan, ProvedFor, Solver, Step, Stopping, WarmStart,
};
use crate::number::{Compensated, Plain, Scalar, Summation, Vector};
use crate::state::State;
use crate::system::{Class, System};

/// The plan of the method `M` for the class of the system `S`.
pub type PlanOf<M, S, V> = <<S as System<V>>::Class as Class>::Plan<M>;

/// The memory of the plan of `M` with the solver `N`.
pub type MemoryOf<M, S, V, N> = <PlanOf<M, S, V> as Plan>::Memory<V, S, N>;

/// The memory of the plan of a method.
#[cfg_attr(not(debug_assertions), inline(always))]
pub(super) fn memory_of<M: Method, S: System<V>, V: Vector, N: Solver<V, S>>(
    method: &M,
    prototype: &V,
) -> MemoryOf<M, S, V, N> {
    <S::Class as Class>::memory::<M, V, S, N>(method, prototype)
}

/// The memory of the steps of a method from a state.
pub(super) fn step_memory_of<M: Method, S: System<V>, V: Vector, N: Solver<V, S>>(
    method: &M,
    system: &S,
    state: State<V>,
) -> StepMemory<V, MemoryOf<M, S, V, N>> {
    let linear_velocity = has_linear_velocity::<V, S, N>(system, &state);
    let memory = memory_of::<M, S, V, N>(method, &state.q);
    let mut step_memory = StepMemory::new(memory, linear_velocity, state);
    let State { time, q, p } = &step_memory.state;
    <PlanOf<M, S, V> as Plan>::prepare::<V, S, N>(&mut step_memory.memory, system, *time, q, p);
    step_memory
}

/// An integrator: a method that steps a system from a state.
///
/// [`new`](crate::Integrator#method.new) allocates all memory. A step that fails from what earlier steps left, such as extrapolated stages,
/// is taken once more as the first step of a new integrator: see [`Statistics::rejected`]. The errors of a step are
/// [`Error::NoConvergence`], [`Error::NonFinite`], [`Error::EvaluationDimension`] and [`Error::TimeResolution`]; with a Newton iteration
/// also [`Error::SingularMatrix`]. All other methods: [`Run`].
///
/// ```
/// symplectic::tableau! { StoermerVerlet { basis: polynomial(2), nodes: lobatto(2) } }
/// use symplectic::nalgebra::Vector2;
/// use symplectic::{Error, Integrator, State, separable};
///
/// # fn main() -> Result<(), Error> {
/// let kepler = separable(
///     |_time, p: &Vector2<f64>, velocity| *velocity = *p,
///     |_time, q, force| *force = -q / q.norm().powi(3),
/// );
/// let start = State::new(0.0, Vector2::new(1.0, 0.0), Vector2::new(0.0, 1.0));
/// let mut integrator = Integrator::new(StoermerVerlet, kepler, start, 0.01)?;
///
/// let first = integrator.step()?;
/// assert_eq!(first.time, 0.01);
/// for state in integrator.states().take(2) {
///     let state = state?;
///     assert!((state.q.norm() - 1.0).abs() < 1e-4);
/// }
/// let end = integrator.integrate_to(core::f64::consts::TAU)?;
/// assert_eq!(end.time, core::f64::consts::TAU);
/// assert_eq!(integrator.steps(), 3 + 626);
/// # Ok(())
/// # }
/// ```
pub type Integrator<M, S, V, R = Compensated, N = <S as System<V>>::Solver> =
    Run<Partitioned<M, S, V, R, N>>;

/// The steps of an [`Integrator`]: those of a partitioned Runge–Kutta method or a splitting.
pub struct Partitioned<M: Method, S: System<V>, V: Vector, R: Summation, N: Solver<V, S>> {
    pub(super) system: S,
    pub(super) step_memory: StepMemory<V, MemoryOf<M, S, V, N>>,
    pub(crate) stopping: Stopping,
    pub(super) method: M,
    pub(super) kind: PhantomData<(R, N)>,
}

impl<M: Method, S: System<V>, V: Vector> Integrator<M, S, V> {
    /// Creates an integrator at `state` with [`Compensated`] sums. A negative `step_size` steps backward.
    ///
    /// # Errors
    ///
    /// [`Error::StepSize`], [`Error::Dimension`] if the dimensions of `q` and `p` differ, [`Error::NonFiniteState`],
    /// [`Error::NotQuadraticKinetic`], [`Error::NotUnitMasses`], [`Error::NotSeparable`], [`Error::NotForced`]. With constraints also
    /// [`Error::NoExtra`], [`Error::InconsistentStart`], [`Error::DependentConstraints`] and [`Error::ResizedEvaluation`]. If parameters of a formula do not
    /// fit the state, [`Error::ParameterLength`], [`Error::PairOutOfRange`], [`Error::DimensionFactor`] or [`Error::TooFewBodies`]. For a
    /// tableau at run time also [`Error::SeparableTableau`] and [`Error::NoConstrainedSteps`].
    pub fn new(method: M, system: S, state: State<V>, step_size: f64) -> Result<Self, Error>
    where
        M: ProvedFor<S::Class>,
    {
        Self::with_summation(method, system, state, step_size)
    }
}

impl<M: Method, S: System<V>, V: Vector> Integrator<M, S, V, Plain> {
    /// [`new`](crate::Integrator#method.new) with [`Plain`] sums.
    ///
    /// # Errors
    ///
    /// As for [`new`](crate::Integrator#method.new).
    ///
    /// ```
    /// symplectic::tableau! { StoermerVerlet { basis: polynomial(2), nodes: lobatto(2) } }
    /// # use symplectic::nalgebra::Vector1;
    /// # use symplectic::{Error, Integrator, State, separable};
    /// # fn main() -> Result<(), Error> {
    /// let oscillator = || separable::<Vector1<f64>, _, _>(|_, p, velocity| *velocity = *p, |_, q, force| *force = -q);
    /// let start = State::new(0.0, Vector1::new(1.0), Vector1::new(0.0));
    /// let mut plain = Integrator::plain(StoermerVerlet, oscillator(), start.clone(), 0.1)?;
    /// let mut compensated = Integrator::new(StoermerVerlet, oscillator(), start, 0.1)?;
    /// let difference = plain.integrate_to(1e4)?.q - compensated.integrate_to(1e4)?.q;
    /// assert!(difference[0] != 0.0 && difference[0].abs() < 1e-9);
    /// # Ok(())
    /// # }
    /// ```
    pub fn plain(method: M, system: S, state: State<V>, step_size: f64) -> Result<Self, Error>
    where
        M: ProvedFor<S::Class>,
    {
        Self::with_summation(method, system, state, step_size)
    }
}

impl<M: Method, S: System<V>, V: Vector, N: Solver<V, S>> Integrator<M, S, V, Plain, N> {
    /// Sets the tolerance of the iteration of coupled stages. A sweep is the last one if it moves no position by more than `tolerance`, in
    /// its unit. If the Hamiltonian is not separable, or the iteration is Newton's, this also holds for momenta. With a contraction rate
    /// `κ` per sweep, the remaining error is `κ/(1 − κ)` of the last change. Zero (the default) means: down to rounding. An iteration whose
    /// next change would be one rounding error ends in any case.
    ///
    /// A tolerance saves sweeps. It is for plain sums only: compensated sums are for runs without drift, and iterations that end above
    /// rounding make the energy drift.
    ///
    /// # Errors
    ///
    /// [`Error::Tolerance`] if it is negative, NaN or infinite; the previous tolerance then remains.
    ///
    /// ```
    /// symplectic::tableau! { Gauss4 { basis: polynomial(4), nodes: gauss(4) } }
    /// # use symplectic::nalgebra::Vector1;
    /// # use symplectic::{Error, Integrator, State, acceleration};
    /// # fn main() -> Result<(), Error> {
    /// let pendulum = acceleration(|_time, q: &Vector1<f64>, acceleration| acceleration[0] = -q[0].sin());
    /// let start = State::new(0.0, Vector1::new(1.0), Vector1::new(0.0));
    /// let mut integrator = Integrator::plain(Gauss4, pendulum, start, 0.1)?;
    /// integrator.take_steps(100)?;
    /// let to_rounding = integrator.iterations();
    /// integrator.set_tolerance(1e-10)?;
    /// integrator.take_steps(100)?;
    /// assert!(integrator.iterations() - to_rounding < to_rounding);
    /// # Ok(())
    /// # }
    /// ```
    pub const fn set_tolerance(&mut self, tolerance: f64) -> Result<(), Error> {
        if !(tolerance >= 0.0 && tolerance.is_finite()) {
            return Err(Error::Tolerance { value: tolerance });
        }
        self.stepper.stopping.tolerance = tolerance;
        Ok(())
    }
}

impl<M: Method, S: System<V>, V: Vector, R: Summation, N: Solver<V, S>> Integrator<M, S, V, R, N> {
    /// Default bound on the sweeps of one step, for [`set_max_iterations`](Self::set_max_iterations). An iteration that
    /// needs more sweeps gains less than a factor of 1.2 per sweep.
    pub const DEFAULT_MAX_ITERATIONS: u32 = Stopping::DEFAULT.max_iterations;

    /// The values from which states inside a step are interpolated, and the order of the interpolation: see
    /// [`dense`](crate::Integrator#method.dense).
    ///
    /// ```
    /// symplectic::tableau! { Gauss4 { basis: polynomial(4), nodes: gauss(4) } }
    /// # use symplectic::nalgebra::Vector1;
    /// # use symplectic::{Error, Integrator, Method, System, acceleration};
    /// # use symplectic::output::Interpolation;
    /// fn order<M: Method, S: System<Vector1<f64>>>(_method: M, _system: S) -> u32 {
    ///     Integrator::<M, S, Vector1<f64>>::INTERPOLATION.order()
    /// }
    /// assert_eq!(order(Gauss4, acceleration(|_, q: &Vector1<f64>, acceleration| *acceleration = -q)), 5);
    /// ```
    pub const INTERPOLATION: Interpolation = <PlanOf<M, S, V> as Plan>::INTERPOLATION;

    /// [`new`](crate::Integrator#method.new) with the sums given by the type.
    ///
    /// # Errors
    ///
    /// As for [`new`](crate::Integrator#method.new).
    pub fn with_summation(
        method: M,
        system: S,
        state: State<V>,
        step_size: f64,
    ) -> Result<Self, Error>
    where
        M: ProvedFor<S::Class>,
    {
        Self::check(&method, &system, &state, step_size)?;
        Ok(Self::unchecked(method, system, state, step_size))
    }

    /// Checks the arguments of an integrator.
    #[doc(hidden)]
    pub fn check(method: &M, system: &S, state: &State<V>, step_size: f64) -> Result<(), Error> {
        S::Class::check_steps(method)?;
        method.check_order::<S::Class>()?;
        check_step_size(step_size)?;
        check_start(system, state)?;
        check_masses(system, state)?;
        check_quadratic_kinetic(method, system, state)?;
        <PlanOf<M, S, V> as Plan>::check(system, state.time, &state.q, &state.p)
    }

    /// An integrator whose arguments have been [checked](Self::check).
    #[doc(hidden)]
    pub fn unchecked(method: M, system: S, state: State<V>, step_size: f64) -> Self {
        let clock = Clock::new(state.time, step_size);
        Self {
            stepper: Partitioned::unchecked(method, system, state),
            clock,
            step_size,
            retry: Retry::default(),
            last_event: None,
            output_by_steps: false,
        }
    }

    /// Takes a step whose stages `solve` computes from the step, the momentum after it, and its number.
    #[doc(hidden)]
    pub fn step_solved_by<T, E: From<Error>>(
        &mut self,
        solve: impl FnOnce(&S, &Step<'_, V>, &V, u64, Stopping) -> Result<T, E>,
    ) -> Result<T, E> {
        let (size, time) = (self.step_size, self.clock.next());
        let work = self.stepper.prepare(size, time)?;
        let number = self.stepper.step_memory.statistics.steps + 1;
        let (step, next, _) = self.stepper.step_memory.lend(size);
        let outcome = solve(
            &self.stepper.system,
            &step,
            next.p,
            number,
            self.stepper.stopping,
        );
        if outcome.is_ok() {
            self.stepper.step_memory.accept::<R>(size, time, work);
            self.clock.tick();
        } else {
            // The stages belong to a step that was not taken.
            self.stepper.step_memory.kept = WarmStart::default();
        }
        outcome
    }

    /// The round-off of position and momentum in [`state`](Self::state): less than half a unit in their last
    /// places, and zero with [`Plain`] sums.
    pub const fn remainder(&self) -> (&V, &V) {
        (
            &self.stepper.step_memory.low.0,
            &self.stepper.step_memory.low.1,
        )
    }

    /// Sets the bound on the sweeps of one step, beyond which it fails with [`Error::NoConvergence`]; 0 counts as 1.
    pub const fn set_max_iterations(&mut self, max_iterations: u32) {
        self.stepper.stopping.max_iterations = if max_iterations == 0 {
            1
        } else {
            max_iterations
        };
    }

    /// The system.
    pub const fn system(&self) -> &S {
        &self.stepper.system
    }

    /// Number of fixed-point sweeps in all steps taken; 0 for an explicit method.
    pub const fn iterations(&self) -> u64 {
        self.stepper.step_memory.statistics.iterations
    }

    /// The energy of the present state, if the system provides it.
    pub fn energy(&self) -> Option<V::Scalar> {
        let State { time, q, p } = &self.stepper.step_memory.state;
        self.stepper.system.energy(V::Scalar::from_f64(*time), q, p)
    }
}

impl<M: Method, S: System<V>, V: Vector, R: Summation, N: Solver<V, S>> Partitioned<M, S, V, R, N> {
    pub(super) fn unchecked(method: M, system: S, state: State<V>) -> Self {
        Self {
            step_memory: step_memory_of::<M, S, V, N>(&method, &system, state),
            system,
            stopping: Stopping::DEFAULT,
            method,
            kind: PhantomData,
        }
    }

    /// The system.
    pub const fn system(&self) -> &S {
        &self.system
    }

    /// Writes p' at a state: see [`Plan::momentum_rate`].
    #[cfg_attr(not(debug_assertions), inline(always))]
    pub(crate) fn momentum_rate(&self, time: f64, q: &V, p: &V, rate: &mut V) {
        <PlanOf<M, S, V> as Plan>::momentum_rate(&self.system, time, q, p, rate);
    }

    /// The last step, if its stages are still stored.
    pub(crate) fn last_step(&self) -> Option<LastStep<'_, V>> {
        self.step_memory.kept.stages.then_some(LastStep {
            start: self.step_memory.last_time,
            end: self.step_memory.state.time,
            size: self.step_memory.last_size,
            positions: Line {
                start: (&self.step_memory.next.0, &self.step_memory.next_low.0),
                end: (&self.step_memory.state.q, &self.step_memory.low.0),
            },
            momenta: Line {
                start: (&self.step_memory.next.1, &self.step_memory.next_low.1),
                end: (&self.step_memory.state.p, &self.step_memory.low.1),
            },
        })
    }

    /// Adds the contribution of the stages to a state inside the last step: see [`Plan::extend`].
    pub(crate) fn extend(&self, at: Inside<'_, V>, q: &mut V, p: &mut V) {
        <PlanOf<M, S, V> as Plan>::extend::<V, S, N>(&self.step_memory.memory, at, q, p);
    }
}

impl<M: Method, S: System<V>, V: Vector, R: Summation, N: Solver<V, S>> Stepper
    for Partitioned<M, S, V, R, N>
{
    type State = State<V>;
    type Error = Error;
    type Pace = Equal;
    /// With the round-off of the state.
    type Saved = (State<V>, (V, V), Statistics);

    fn state(&self) -> &State<V> {
        &self.step_memory.state
    }

    fn into_state(self) -> State<V> {
        self.step_memory.state
    }

    fn statistics(&self) -> &Statistics {
        &self.step_memory.statistics
    }

    fn statistics_mut(&mut self) -> &mut Statistics {
        &mut self.step_memory.statistics
    }

    fn set_state(&mut self, state: &State<V>) -> Result<(), Error> {
        let State { time, q, p } = state;
        check_state(*time, q, p, self.step_memory.state.q.dimension())?;
        <PlanOf<M, S, V> as Plan>::check(&self.system, *time, q, p)?;
        self.step_memory.copy_state(state);
        Ok(())
    }

    #[inline]
    fn advance(&mut self, size: f64, end: f64) -> Result<(), Error> {
        self.check_progress(size, end)?;
        self.advance_after(None, size, end)
    }

    /// A splitting takes the steps in place, in blocks of 128 to 65 536 steps, and checks after each block whether the state is finite. If
    /// it is not, the block is repeated step by step. Coupled stages of short vectors stay in registers from step to step.
    #[inline]
    fn take(&mut self, steps: &mut RemainingSteps) -> Result<(), Error> {
        self.take_all(steps)
    }

    #[inline]
    fn take_while(
        &mut self,
        steps: &mut RemainingSteps,
        goes_on: impl FnMut(&State<V>, &Statistics) -> bool,
    ) -> Result<bool, Error> {
        self.take_some(steps, goes_on)
    }

    fn save(&self) -> Self::Saved {
        let StepMemory {
            state,
            low,
            statistics,
            ..
        } = &self.step_memory;
        (state.clone(), low.clone(), *statistics)
    }

    fn go_back(&mut self, (state, low, statistics): &Self::Saved) {
        self.step_memory.copy_state(state);
        self.step_memory.low = low.clone();
        self.step_memory.statistics = *statistics;
    }

    fn may_split(&self, error: &Error) -> bool {
        error.depends_on_the_size()
    }
}

impl<M: Method, S: System<V> + Clone, V: Vector, R: Summation, N: Solver<V, S>> Clone
    for Partitioned<M, S, V, R, N>
{
    /// Both continue with the same bits.
    fn clone(&self) -> Self {
        Self {
            system: self.system.clone(),
            step_memory: self.step_memory.clone(),
            stopping: self.stopping,
            method: self.method.clone(),
            kind: PhantomData,
        }
    }
}

impl<M: Method, S: System<V>, V: Vector, R: Summation, N: Solver<V, S>> fmt::Debug
    for Partitioned<M, S, V, R, N>
{
    fn fmt(&self, formatter: &mut fmt::Formatter<'_>) -> fmt::Result {
        formatter
            .debug_struct("Partitioned")
            .field("method", &self.method.name())
            .field("state", &self.step_memory.state)
            .field("statistics", &self.step_memory.statistics)
            .finish_non_exhaustive()
    }
}
