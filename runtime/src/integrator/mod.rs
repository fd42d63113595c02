//! Integrators and their steps.

pub(crate) mod clock;
pub(crate) mod first_step;
pub(crate) mod last_step;
pub(crate) mod partial_step;
pub(crate) mod retry;
pub(crate) mod sight;
pub(crate) mod statistics;
pub(crate) mod step_clock;

#[cfg(feature = "alloc")]
pub use checkpoint::{Checkpoint, CheckpointError};
#[cfg(feature = "alloc")]
pub(crate) use coupled_in_lanes::CoupledLanes;
pub use retry::Retry;
pub use statistics::Statistics;
pub use step_map::{PhasePoint, StepMap};

use core::convert::Infallible;
use core::fmt;
use core::marker::PhantomData;
use core::ops::ControlFlow;

use crate::error::Error;
use crate::integrator::clock::{Clock, check_count};
use crate::integrator::last_step::{LastEvent, LastStep};
use crate::method::interpolation::Line;
use crate::method::{Inside, Interpolation, Method, Plan, ProvedFor, Solver, Stopping};
#[cfg(feature = "alloc")]
use crate::method::{Step, WarmStart};
use crate::number::{Compensated, Plain, Scalar, Summation, Vector};
use crate::state::State;
use crate::system::{Class, System};

#[cfg(feature = "alloc")]
pub(crate) mod checkpoint;
#[cfg(feature = "serde")]
mod checkpoint_format;
#[cfg(feature = "alloc")]
mod coupled_in_lanes;
#[cfg(feature = "alloc")]
pub(crate) mod explicit_in_lanes;
#[cfg(feature = "alloc")]
pub(crate) mod fingerprint;
mod many_steps;
mod memory;
mod one_step;
#[cfg(feature = "alloc")]
mod run_time;
mod solvers;
mod step_map;
pub(crate) mod validation;

use memory::StepMemory;
use validation::{
    check_masses, check_quadratic_kinetic, check_start, check_state, check_step_size,
    has_linear_velocity,
};

/// The plan of the method `M` for the class of the system `S`.
pub(crate) type PlanOf<M, S, V> = <<S as System<V>>::Class as Class>::Plan<M>;

/// The memory of the plan of `M` with the solver `N`.
type MemoryOf<M, S, V, N> = <PlanOf<M, S, V> as Plan>::Memory<V, S, N>;

/// An integrator: a method that steps a system from a state.
///
/// [`new`](Self::new) allocates all memory; a step allocates nothing. A step that fails leaves the state and the
/// counts unchanged.
///
/// The time after `k` steps is computed as `start + k h`, not as a sum. The count starts again when the step size or
/// the state is set and when [`integrate_to`](Self::integrate_to) ends.
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
pub struct Integrator<
    M: Method,
    S: System<V>,
    V: Vector,
    R: Summation = Compensated,
    N: Solver<V, S> = <S as System<V>>::Solver,
> {
    system: S,
    step_memory: StepMemory<V, MemoryOf<M, S, V, N>>,
    clock: Clock,
    step_size: f64,
    pub(crate) stopping: Stopping,
    pub(crate) retry: Retry,
    pub(crate) last_event: Option<LastEvent>,
    method: PhantomData<(M, R, N)>,
}

impl<M: Method, S: System<V>, V: Vector> Integrator<M, S, V> {
    /// Creates an integrator at `state` with [`Compensated`] sums. A negative `step_size` steps backward.
    ///
    /// # Errors
    ///
    /// [`Error::StepSize`], [`Error::Dimension`] if the dimensions of `q` and `p` differ, [`Error::NonFiniteState`],
    /// [`Error::NotQuadraticKinetic`], [`Error::NotUnitMasses`], [`Error::NotSeparable`], [`Error::NotForced`]. With constraints also
    /// [`Error::InconsistentStart`], [`Error::DependentConstraints`] and [`Error::ResizedEvaluation`]. If parameters of a formula do not
    /// fit the state, [`Error::ParameterLength`], [`Error::PairOutOfRange`], [`Error::DimensionFactor`] or [`Error::TooFewBodies`].
    pub fn new(method: M, system: S, state: State<V>, step_size: f64) -> Result<Self, Error>
    where
        M: ProvedFor<S::Class>,
    {
        Self::with_summation(method, system, state, step_size)
    }
}

impl<M: Method, S: System<V>, V: Vector> Integrator<M, S, V, Plain> {
    /// [`new`](Integrator::new) with [`Plain`] sums.
    ///
    /// # Errors
    ///
    /// As for [`new`](Integrator::new).
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
        self.stopping.tolerance = tolerance;
        Ok(())
    }
}

impl<M: Method, S: System<V>, V: Vector, R: Summation, N: Solver<V, S>> Integrator<M, S, V, R, N> {
    /// Default bound on the sweeps of one step, for [`set_max_iterations`](Self::set_max_iterations). An iteration that
    /// needs more sweeps gains less than a factor of 1.2 per sweep.
    pub const DEFAULT_MAX_ITERATIONS: u32 = Stopping::DEFAULT.max_iterations;

    /// The values from which states inside a step are interpolated, and the order of the interpolation: see [`dense`](Self::dense).
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

    /// [`new`](Integrator::new) with the sums given by the type.
    ///
    /// # Errors
    ///
    /// As for [`new`](Integrator::new).
    pub fn with_summation(
        _method: M,
        system: S,
        state: State<V>,
        step_size: f64,
    ) -> Result<Self, Error>
    where
        M: ProvedFor<S::Class>,
    {
        Self::made(system, state, step_size)
    }

    /// An integrator of the method given by the type.
    fn made(system: S, state: State<V>, step_size: f64) -> Result<Self, Error> {
        Self::check(&system, &state, step_size)?;
        Ok(Self::unchecked(system, state, step_size))
    }

    /// Checks the arguments of an integrator.
    pub(crate) fn check(system: &S, state: &State<V>, step_size: f64) -> Result<(), Error> {
        check_step_size(step_size)?;
        check_start(system, state)?;
        check_masses(system, state)?;
        let orders = M::NEEDS_QUADRATIC_KINETIC.then_some(M::ORDERS);
        check_quadratic_kinetic::<M, V, S>(orders, system, state)?;
        <PlanOf<M, S, V> as Plan>::check(system, state.time, &state.q, &state.p)
    }

    /// An integrator whose arguments have been [checked](Self::check).
    pub(crate) fn unchecked(system: S, state: State<V>, step_size: f64) -> Self {
        let clock = Clock::new(state.time, step_size);
        let linear_velocity = has_linear_velocity::<V, S, N>(&system, &state);
        let mut step_memory: StepMemory<V, MemoryOf<M, S, V, N>> =
            StepMemory::new(linear_velocity, state);
        let State { time, q, p } = &step_memory.state;
        <PlanOf<M, S, V> as Plan>::prepare::<V, S, N>(
            &mut step_memory.memory,
            &system,
            *time,
            q,
            p,
        );
        Self {
            step_memory,
            system,
            clock,
            step_size,
            stopping: Stopping::DEFAULT,
            retry: Retry::default(),
            last_event: None,
            method: PhantomData,
        }
    }

    /// Takes `count` steps and returns the state after them. The result equals that of `count` calls of [`step`](Self::step) to the last
    /// bit, but it is faster for splittings and for short vectors.
    ///
    /// A splitting takes the steps in place, in blocks of 128 to 65 536 steps, and checks after each block whether the state is finite. If
    /// it is not, the block is repeated step by step. Coupled stages of short vectors stay in registers from step to step.
    ///
    /// # Errors
    ///
    /// Those of [`step`](Self::step); the state is then that after the last successful step. [`Error::StepCount`] for 2⁵³ steps or more.
    ///
    /// ```
    /// symplectic::tableau! { StoermerVerlet { basis: polynomial(2), nodes: lobatto(2) } }
    /// # use symplectic::nalgebra::Vector1;
    /// # use symplectic::{Error, Integrator, State, acceleration};
    /// # fn main() -> Result<(), Error> {
    /// let oscillator = || acceleration::<Vector1<f64>, _>(|_, q, acceleration| *acceleration = -q);
    /// let start = State::new(0.0, Vector1::new(1.0), Vector1::new(0.0));
    /// let mut at_once = Integrator::new(StoermerVerlet, oscillator(), start.clone(), 0.125)?;
    /// let mut one_by_one = Integrator::new(StoermerVerlet, oscillator(), start, 0.125)?;
    /// for _ in 0..1000 {
    ///     one_by_one.step()?;
    /// }
    /// assert_eq!(at_once.take_steps(1000)?, one_by_one.state());
    /// # Ok(())
    /// # }
    /// ```
    pub fn take_steps(&mut self, count: u64) -> Result<&State<V>, Error> {
        let (time, size) = (self.step_memory.state.time, self.step_size);
        check_count(time, time + size * count as f64, size)?;
        let mut remaining = self.steps_left(count);
        let outcome = self.take_remaining(&mut remaining);
        self.clock = remaining.clock;
        outcome.map(|()| &self.step_memory.state)
    }

    /// Takes a step whose stages `solve` computes from the step, the momentum after it, and its number.
    #[cfg(feature = "alloc")]
    pub(crate) fn step_solved_by<T>(
        &mut self,
        solve: impl FnOnce(&S, &Step<'_, V>, &V, u64, Stopping) -> Result<T, Error>,
    ) -> Result<T, Error> {
        let (size, time) = (self.step_size, self.clock.next());
        let work = self.prepare(size, time)?;
        let number = self.step_memory.statistics.steps + 1;
        let (step, next, _) = self.step_memory.lend(size);
        let outcome = solve(&self.system, &step, next.p, number, self.stopping);
        if outcome.is_ok() {
            self.step_memory.accept::<R>(size, time, work);
            self.clock.tick();
        } else {
            // The stages belong to a step that was not taken.
            self.step_memory.kept = WarmStart::default();
        }
        outcome
    }

    /// Integrates to the time `end`, exactly, in the smallest number of equal steps that are no longer than the step size, up
    /// to rounding. The sign of the step size does not matter. At the time `end` it takes no step.
    ///
    /// # Errors
    ///
    /// [`Error::EndTime`], [`Error::StepCount`], and those of [`step`](Self::step); the state is then that after the
    /// last successful step.
    pub fn integrate_to(&mut self, end: f64) -> Result<&State<V>, Error> {
        let mut remaining = self.steps_to_time(end)?;
        let outcome = self.take_remaining(&mut remaining);
        self.restart_clock();
        outcome.map(|()| &self.step_memory.state)
    }

    /// [`integrate_to`](Self::integrate_to) that calls `observe` with the state after every step.
    ///
    /// # Errors
    ///
    /// As for [`integrate_to`](Self::integrate_to).
    ///
    /// ```
    /// symplectic::tableau! { StoermerVerlet { basis: polynomial(2), nodes: lobatto(2) } }
    /// # use symplectic::nalgebra::Vector1;
    /// # use symplectic::{Error, Integrator, State, separable};
    /// # fn main() -> Result<(), Error> {
    /// let oscillator = separable::<Vector1<f64>, _, _>(|_, p, velocity| *velocity = *p, |_, q, force| *force = -q);
    /// let start = State::new(0.0, Vector1::new(1.0), Vector1::new(0.0));
    /// let mut integrator = Integrator::new(StoermerVerlet, oscillator, start, 0.1)?;
    /// let mut times = Vec::new();
    /// integrator.integrate_with(0.5, |state| times.push(state.time))?;
    /// assert_eq!(times, [0.1, 0.2, 0.1 * 3.0, 0.4, 0.5]);
    /// # Ok(())
    /// # }
    /// ```
    pub fn integrate_with<F: FnMut(&State<V>)>(
        &mut self,
        end: f64,
        mut observe: F,
    ) -> Result<&State<V>, Error> {
        let ControlFlow::Continue(()) = self.steps_to(end, |integrator, size, time| {
            integrator.advance(size, time)?;
            observe(integrator.state());
            Ok(ControlFlow::<Infallible>::Continue(()))
        })?;
        Ok(&self.step_memory.state)
    }

    /// Calls `take` with the size and the end of each step of [`integrate_to`](Self::integrate_to), until it breaks.
    #[inline]
    pub(crate) fn steps_to<B>(
        &mut self,
        end: f64,
        mut take: impl FnMut(&mut Self, f64, f64) -> Result<ControlFlow<B>, Error>,
    ) -> Result<ControlFlow<B>, Error> {
        let mut remaining = self.steps_to_time(end)?;
        let mut outcome = Ok(ControlFlow::Continue(()));
        while let Some((size, time)) = remaining.next_step() {
            outcome = take(self, size, time);
            if !matches!(outcome, Ok(ControlFlow::Continue(()))) {
                break;
            }
        }
        self.restart_clock();
        outcome
    }

    /// Takes one step as [`step`](Self::step) does, and calls `see` after each of its parts.
    pub(crate) fn step_shown_to(
        &mut self,
        mut see: impl FnMut(&Self) -> Result<(), Error>,
    ) -> Result<(), Error> {
        let (size, time) = (self.step_size, self.clock.next());
        let outcome = self.advance_in_sight(size, time, &mut |integrator| {
            see(integrator)?;
            Ok(ControlFlow::<Infallible>::Continue(()))
        });
        match outcome {
            Ok(_) => self.clock.tick(),
            Err(_) => self.restart_clock(),
        }
        outcome.map(|_| ())
    }

    /// Takes steps in blocks, all or all but a few of those that end before `time`.
    pub(crate) fn take_most_before(&mut self, time: f64) -> Result<(), Error> {
        // The quotient is wrong by rounding.
        let whole = (time - self.step_memory.state.time) / self.step_size - 2.0;
        if whole < 2.0 {
            return Ok(());
        }
        let outcome = self.take_steps(whole as u64).map(|_| ());
        if outcome.is_err() {
            self.restart_clock();
        }
        outcome
    }

    /// The present state, rounded.
    pub const fn state(&self) -> &State<V> {
        &self.step_memory.state
    }

    /// The round-off of position and momentum in [`state`](Self::state): less than half a unit in their last
    /// places, and zero with [`Plain`] sums.
    pub const fn remainder(&self) -> (&V, &V) {
        (&self.step_memory.low.0, &self.step_memory.low.1)
    }

    /// Replaces the present state by another one of the same dimension.
    ///
    /// # Errors
    ///
    /// [`Error::Dimension`], [`Error::NonFiniteState`]; the state is then unchanged.
    pub fn set_state(&mut self, state: State<V>) -> Result<(), Error> {
        self.copy_state(&state)
    }

    /// [`set_state`](Self::set_state) by a copy.
    pub(crate) fn copy_state(&mut self, state: &State<V>) -> Result<(), Error> {
        let State { time, q, p } = state;
        check_state(*time, q, p, self.step_memory.state.q.dimension())?;
        <PlanOf<M, S, V> as Plan>::check(&self.system, *time, q, p)?;
        self.step_memory.copy_state(state);
        self.restart_clock();
        Ok(())
    }

    /// Returns the present state and drops the integrator.
    pub fn into_state(self) -> State<V> {
        self.step_memory.state
    }

    /// The step size.
    pub const fn step_size(&self) -> f64 {
        self.step_size
    }

    /// Changes the step size; negative to go backward.
    ///
    /// # Errors
    ///
    /// [`Error::StepSize`]; the step size is then unchanged.
    pub fn set_step_size(&mut self, step_size: f64) -> Result<(), Error> {
        check_step_size(step_size)?;
        self.step_size = step_size;
        self.restart_clock();
        Ok(())
    }

    /// Sets the bound on the sweeps of one step, beyond which it fails with [`Error::NoConvergence`]; 0 counts as 1.
    pub const fn set_max_iterations(&mut self, max_iterations: u32) {
        self.stopping.max_iterations = if max_iterations == 0 {
            1
        } else {
            max_iterations
        };
    }

    /// Sets the reaction to a failed step; the default is [`Retry::Never`].
    ///
    /// ```
    /// symplectic::tableau! { Midpoint { basis: polynomial(1), nodes: gauss(1) } }
    /// # use symplectic::nalgebra::Vector2;
    /// # use symplectic::{Error, Integrator, Retry, State, separable};
    /// # fn main() -> Result<(), Error> {
    /// let kepler = separable(
    ///     |_time, p: &Vector2<f64>, velocity| *velocity = *p,
    ///     |_time, q, force| *force = -q / q.norm().powi(3),
    /// );
    /// // From the apocentre of an orbit with eccentricity 0.99; at the pericentre steps of 1/16 do not converge.
    /// let start = State::new(0.0, Vector2::new(1.99, 0.0), Vector2::new(0.0, (0.01_f64 / 1.99).sqrt()));
    /// let mut integrator = Integrator::new(Midpoint, kepler, start, 0.0625)?;
    /// integrator.set_retry(Retry::Split { halvings: 8 });
    /// integrator.integrate_to(6.0)?;
    /// assert!(integrator.statistics().rejected > 0);
    /// # Ok(())
    /// # }
    /// ```
    pub const fn set_retry(&mut self, retry: Retry) {
        self.retry = retry;
    }

    /// The system.
    pub const fn system(&self) -> &S {
        &self.system
    }

    /// The statistics of all steps so far.
    pub const fn statistics(&self) -> &Statistics {
        &self.step_memory.statistics
    }

    /// Number of steps taken.
    pub const fn steps(&self) -> u64 {
        self.step_memory.statistics.steps
    }

    /// Number of fixed-point sweeps in all steps taken; 0 for an explicit method.
    pub const fn iterations(&self) -> u64 {
        self.step_memory.statistics.iterations
    }

    /// The energy of the present state, if the system provides it.
    pub fn energy(&self) -> Option<V::Scalar> {
        let State { time, q, p } = &self.step_memory.state;
        self.system.energy(V::Scalar::from_f64(*time), q, p)
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

    const fn restart_clock(&mut self) {
        self.clock = Clock::new(self.step_memory.state.time, self.step_size);
    }
}

impl<M: Method, S: System<V> + Clone, V: Vector, R: Summation, N: Solver<V, S>> Clone
    for Integrator<M, S, V, R, N>
{
    /// The integrator and its clone continue with the same bits.
    fn clone(&self) -> Self {
        Self {
            system: self.system.clone(),
            step_memory: self.step_memory.clone(),
            ..*self
        }
    }
}

impl<M: Method, S: System<V>, V: Vector, R: Summation, N: Solver<V, S>> fmt::Debug
    for Integrator<M, S, V, R, N>
{
    fn fmt(&self, formatter: &mut fmt::Formatter<'_>) -> fmt::Result {
        formatter
            .debug_struct("Integrator")
            .field("method", &M::NAME)
            .field("state", &self.step_memory.state)
            .field("step_size", &self.step_size)
            .field("statistics", &self.step_memory.statistics)
            .finish_non_exhaustive()
    }
}
