//! Ensembles: many trajectories at once, in SIMD lanes and on all cores.
//!
//! An [`Ensemble`] consists of a method, a system and many starts. Every trajectory has the same bits as alone in an
//! [`Integrator`], whatever the number of lanes and threads, and however the ensemble is split or resumed.
//!
//! | What | Where |
//! |---|---|
//! | Final states, states at given times | [`Ensemble::integrate_to`], [`Ensemble::take_steps`], [`Ensemble::integrate_at`] |
//! | Events, and everything else that an integrator offers | [`Ensemble::each`] |
//! | Result of a trajectory, or its error | [`Row`] |
//! | Mean, variance, histogram over the trajectories | [`Moments`], [`Histogram`] |
//! | Several machines, and interrupted runs | [`Ensemble::shard`], [`Ensemble::checkpoint`]; with MPI the package `symplectic-mpi` |
//!
//! # Lanes
//!
//! A method advances as many trajectories at once as there are [lanes](Ensemble::in_lanes), if the system is written for
//! every [`Scalar`](crate::Scalar). The trajectories in the lanes have the same system, the same start time and
//! consecutive numbers.
//!
//! With coupled stages every sweep of the default solver computes the stages of all trajectories, and a trajectory whose
//! stages have settled waits for the others. A trajectory takes a step alone, and returns to its lane, where its stages
//! do not settle as after a usual warm start: in its first step, in slow and in failing iterations. A compiled method
//! does so in builds for AVX-512, or if lanes [are chosen](Ensemble::in_lanes): in narrower registers a single run, with
//! the stages of one trajectory in lanes, is as fast.
//!
//! All other trajectories run one by one: those with another solver, with constraints or with a composition of implicit
//! methods; those of closures and chains; and those with a [system](Ensemble::of_families) of their own.
//!
//! A system rounds differently in lanes if it depends on the number type, as products of large matrices in nalgebra do.
//! So velocity and force are compared at every start, and trajectories run one by one where they differ. A system for
//! every scalar must not [branch on a value](crate::Scalar), such as a magnitude: in lanes the branch would apply to
//! all trajectories, and only the starts are compared.
//!
//! # Threads
//!
//! With the feature `parallel` the threads of `rayon` share the trajectories. Without it there is one thread; the bits
//! are the same.

#[cfg(feature = "serde")]
mod as_bits;
mod checkpoint;
mod coupled;
mod error;
#[cfg(any(feature = "npz", feature = "parquet"))]
mod facts;
mod group;
mod histogram;
mod moments;
#[cfg(feature = "npz")]
mod npz;
#[cfg(feature = "parquet")]
mod parquet;
mod pool;
mod row;
mod run;
mod run_time;

pub use checkpoint::EnsembleCheckpoint;
pub use error::EnsembleError;
pub use histogram::Histogram;
pub use moments::Moments;
#[cfg(feature = "npz")]
pub use npz::{Npz, NpzArray, NpzValues};
#[cfg(feature = "parquet")]
pub use parquet::{Parquet, ParquetColumn};
pub use row::Row;

use alloc::sync::Arc;
use alloc::vec::Vec;
use core::fmt;
use core::marker::PhantomData;
use core::ops::Range;

use crate::error::Error;
use crate::integrator::validation::{check_kinetic, check_step_size};
use crate::integrator::{Integrator, Retry};
use crate::method::{Method, ProvedFor, RunTimeTableau, Solver, Stopping};
use crate::number::{Compensated, DefaultLanes, Lanes, Plain, Summation, Vector};
use crate::state::State;
use crate::system::System;

/// Type parameters without stored values; `fn()` keeps the ensemble `Send` and `Sync`.
type Kind<M, R, N, L> = fn() -> (M, R, N, L);

/// Many trajectories with the same method and the same step size.
///
/// Trajectories are created from the stored starts a few at a time: an ensemble needs the memory of its starts,
/// whatever the number of steps.
///
/// ```
/// use core::ops::ControlFlow;
/// use symplectic::State;
/// use symplectic::ensemble::{Ensemble, EnsembleError};
///
/// symplectic::tableau! { VelocityVerlet { base: velocity-verlet } }
/// symplectic::hamiltonian! { Pendulum q: [a], p: [pa]; H = pa^2/2 - cos(a) }
///
/// # fn main() -> Result<(), EnsembleError> {
/// let starts = (0..100).map(|k| State::from_arrays(0.0, [0.03 * f64::from(k)], [0.0])).collect();
/// let ensemble = Ensemble::new(VelocityVerlet, Pendulum, starts, 0.01)?;
/// let mut largest: f64 = 0.0;
/// ensemble.integrate_to(10.0, |row| {
///     assert_eq!((row.outcome, row.state.time), (Ok(()), 10.0));
///     largest = largest.max(row.state.q[0].abs());
///     ControlFlow::Continue(())
/// });
/// // None of them goes over the top.
/// assert!(largest < 3.0);
/// # Ok(())
/// # }
/// ```
pub struct Ensemble<M, S, V, R = Compensated, N = <S as System<V>>::Solver, L = DefaultLanes>
where
    V: Vector,
    S: System<V>,
{
    /// Each system with the end of its range of starts.
    systems: Vec<(S, usize)>,
    starts: Vec<State<V>>,
    step_size: f64,
    /// Trajectory number of the first start.
    offset: usize,
    /// Index of the first start to run.
    first: usize,
    stopping: Stopping,
    retry: Retry,
    lanes: Wanted,
    stop: Option<Arc<dyn Fn() -> bool + Send + Sync>>,
    /// The method, if its tableau is given at run time.
    tableau: Option<RunTimeTableau>,
    kind: PhantomData<Kind<M, R, N, L>>,
}

/// Whether trajectories run in lanes if they can.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
enum Wanted {
    No,
    IfFaster,
    Yes,
}

impl<M: Method, S: System<V>, V: Vector> Ensemble<M, S, V> {
    /// The trajectories of a system from `starts`, with [`Compensated`] sums; a negative `step_size` goes backward.
    /// Trajectories have the numbers of their starts, from 0.
    ///
    /// # Errors
    ///
    /// [`EnsembleError::Empty`] without starts, [`EnsembleError::All`] for a step size that is zero or not finite,
    /// [`EnsembleError::Dimension`] for a start with another dimension than the first, [`EnsembleError::Start`] for a
    /// start that [`Integrator::new`] rejects.
    ///
    /// ```
    /// use symplectic::ensemble::{Ensemble, EnsembleError};
    /// use symplectic::{Error, State};
    ///
    /// symplectic::tableau! { VelocityVerlet { base: velocity-verlet } }
    /// symplectic::hamiltonian! { Pendulum q: [a], p: [pa]; H = pa^2/2 - cos(a) }
    ///
    /// let starts = [0.1, f64::NAN].map(|a| State::from_arrays(0.0, [a], [0.0]));
    /// let error = Ensemble::new(VelocityVerlet, Pendulum, starts.to_vec(), 0.01).unwrap_err();
    /// assert!(matches!(error, EnsembleError::Start { trajectory: 1, error: Error::NonFiniteState { .. } }));
    /// ```
    pub fn new(
        method: M,
        system: S,
        starts: Vec<State<V>>,
        step_size: f64,
    ) -> Result<Self, EnsembleError>
    where
        M: ProvedFor<S::Class>,
    {
        Self::of_families(method, [(system, starts)], step_size)
    }

    /// [`new`](Self::new) for several systems, for example with different parameters, each with its starts. The
    /// trajectories are numbered consecutively.
    ///
    /// # Errors
    ///
    /// Those of [`new`](Self::new).
    ///
    /// ```
    /// use core::ops::ControlFlow;
    /// use symplectic::State;
    /// use symplectic::ensemble::{Ensemble, EnsembleError};
    ///
    /// symplectic::tableau! { VelocityVerlet { base: velocity-verlet } }
    /// symplectic::hamiltonian! { Oscillator { omega } q: [x], p: [px]; H = px^2/2 + (omega x)^2/2 }
    ///
    /// # fn main() -> Result<(), EnsembleError> {
    /// let family = |omega: f64| (Oscillator { omega }, vec![State::from_arrays(0.0, [1.0], [0.0])]);
    /// let ensemble = Ensemble::of_families(VelocityVerlet, [1.0, 2.0, 3.0].map(family), 1e-3)?;
    /// ensemble.integrate_to(1.0, |row| {
    ///     assert!((row.state.q[0] - f64::cos(row.trajectory as f64 + 1.0)).abs() < 1e-5);
    ///     ControlFlow::Continue(())
    /// });
    /// # Ok(())
    /// # }
    /// ```
    pub fn of_families(
        method: M,
        families: impl IntoIterator<Item = (S, Vec<State<V>>)>,
        step_size: f64,
    ) -> Result<Self, EnsembleError>
    where
        M: ProvedFor<S::Class>,
    {
        Self::with_summation(method, families, step_size)
    }
}

impl<M: Method, S: System<V>, V: Vector> Ensemble<M, S, V, Plain> {
    /// [`new`](Ensemble::new) with [`Plain`] sums.
    ///
    /// # Errors
    ///
    /// As for [`new`](Ensemble::new).
    pub fn plain(
        method: M,
        system: S,
        starts: Vec<State<V>>,
        step_size: f64,
    ) -> Result<Self, EnsembleError>
    where
        M: ProvedFor<S::Class>,
    {
        Self::with_summation(method, [(system, starts)], step_size)
    }
}

impl<M: Method, S: System<V>, V: Vector, R: Summation> Ensemble<M, S, V, R> {
    /// [`of_families`](Ensemble::of_families) with the [`Summation`] of the type.
    ///
    /// # Errors
    ///
    /// As for [`new`](Ensemble::new).
    pub fn with_summation(
        _method: M,
        families: impl IntoIterator<Item = (S, Vec<State<V>>)>,
        step_size: f64,
    ) -> Result<Self, EnsembleError>
    where
        M: ProvedFor<S::Class>,
    {
        Self::of(families, step_size, None)
    }

    /// An ensemble with the method `M`, or with a tableau at run time.
    fn of(
        families: impl IntoIterator<Item = (S, Vec<State<V>>)>,
        step_size: f64,
        tableau: Option<&RunTimeTableau>,
    ) -> Result<Self, EnsembleError> {
        check_step_size(step_size).map_err(EnsembleError::All)?;
        let mut systems: Vec<(S, usize)> = Vec::new();
        let mut starts: Vec<State<V>> = Vec::new();
        for (system, mut own) in families {
            let before = starts.len();
            starts.append(&mut own);
            check_starts::<M, S, V, R>(&system, &starts, before, step_size, tableau)?;
            systems.push((system, starts.len()));
        }
        if starts.is_empty() {
            return Err(EnsembleError::Empty);
        }
        Ok(Self {
            systems,
            starts,
            step_size,
            offset: 0,
            first: 0,
            stopping: Stopping::DEFAULT,
            retry: Retry::Never,
            lanes: Wanted::IfFaster,
            stop: None,
            tableau: tableau.cloned(),
            kind: PhantomData,
        })
    }
}

/// Checks the starts from index `first`, which all belong to `system`.
fn check_starts<M: Method, S: System<V>, V: Vector, R: Summation>(
    system: &S,
    starts: &[State<V>],
    first: usize,
    step_size: f64,
    tableau: Option<&RunTimeTableau>,
) -> Result<(), EnsembleError> {
    for (trajectory, start) in starts.iter().enumerate().skip(first) {
        let (found, expected) = (start.q.dimension(), starts[0].q.dimension());
        if found != expected {
            return Err(EnsembleError::Dimension {
                trajectory,
                found,
                expected,
            });
        }
        let kinetic = || match tableau {
            Some(tableau) => check_kinetic::<V, S>(tableau, system, start),
            None => Ok(()),
        };
        Integrator::<M, S, V, R>::check(system, start, step_size)
            .and_then(|()| kinetic())
            .map_err(|error| EnsembleError::Start { trajectory, error })?;
    }
    Ok(())
}

impl<M: Method, S: System<V>, V: Vector, N: Solver<V, S>, L: Lanes> Ensemble<M, S, V, Plain, N, L> {
    /// Sets the tolerance of every trajectory: see [`Integrator::set_tolerance`].
    ///
    /// # Errors
    ///
    /// [`Error::Tolerance`] for a tolerance that is negative or not finite.
    pub const fn set_tolerance(&mut self, tolerance: f64) -> Result<(), Error> {
        if !(tolerance >= 0.0 && tolerance.is_finite()) {
            return Err(Error::Tolerance { value: tolerance });
        }
        self.stopping.tolerance = tolerance;
        Ok(())
    }
}

impl<M: Method, S: System<V>, V: Vector, R: Summation, N: Solver<V, S>, L: Lanes>
    Ensemble<M, S, V, R, N, L>
{
    /// The same ensemble with another [`Solver`] for coupled stages.
    pub fn with_solver<O: Solver<V, S>>(self, _solver: O) -> Ensemble<M, S, V, R, O, L> {
        self.of_kind()
    }

    /// The same ensemble with Newton's iteration: see [`Integrator::by_newton`].
    pub fn by_newton(self) -> Ensemble<M, S, V, R, crate::solver::Newton, L> {
        self.of_kind()
    }

    /// The same ensemble with another lane width than [`DefaultLanes`], for example [`F64x4`](crate::simd::F64x4). Implicit methods then run
    /// in lanes too where this is no faster: in builds with registers of less than eight doubles. The results do not depend on it.
    ///
    /// ```
    /// # use symplectic::State;
    /// # use symplectic::ensemble::{Ensemble, EnsembleError};
    /// use symplectic::simd::F64x4;
    ///
    /// # symplectic::tableau! { VelocityVerlet { base: velocity-verlet } }
    /// # symplectic::hamiltonian! { Pendulum q: [a], p: [pa]; H = pa^2/2 - cos(a) }
    /// # let starts = vec![State::from_arrays(0.0, [0.5], [0.0])];
    /// let ensemble = Ensemble::new(VelocityVerlet, Pendulum, starts, 0.01)?.in_lanes::<F64x4>();
    /// # Ok::<(), EnsembleError>(())
    /// ```
    pub fn in_lanes<K: Lanes>(self) -> Ensemble<M, S, V, R, N, K> {
        Ensemble {
            lanes: Wanted::Yes,
            ..self.of_kind()
        }
    }

    /// The same ensemble without lanes, one trajectory after another. The results do not depend on it.
    #[must_use]
    pub fn one_by_one(self) -> Self {
        Self {
            lanes: Wanted::No,
            ..self
        }
    }

    fn of_kind<O, K>(self) -> Ensemble<M, S, V, R, O, K> {
        Ensemble {
            systems: self.systems,
            starts: self.starts,
            step_size: self.step_size,
            offset: self.offset,
            first: self.first,
            stopping: self.stopping,
            retry: self.retry,
            lanes: self.lanes,
            stop: self.stop,
            tableau: self.tableau,
            kind: PhantomData,
        }
    }

    /// Part `part`, from 0, of `count` parts of almost equal size. The trajectories keep their numbers.
    ///
    /// The parts are consecutive. On several machines, for example with `--array` of Slurm, each machine runs one part;
    /// the rows of all parts in order are those of the whole ensemble.
    ///
    /// # Errors
    ///
    /// [`EnsembleError::Shard`] unless `part < count`.
    ///
    /// ```
    /// use core::ops::ControlFlow;
    /// # use symplectic::State;
    /// # use symplectic::ensemble::{Ensemble, EnsembleError};
    /// # symplectic::tableau! { VelocityVerlet { base: velocity-verlet } }
    /// # symplectic::hamiltonian! { Pendulum q: [a], p: [pa]; H = pa^2/2 - cos(a) }
    /// # fn main() -> Result<(), EnsembleError> {
    /// let whole = || {
    ///     let starts = (0..10).map(|k| State::from_arrays(0.0, [0.1 * f64::from(k)], [0.0])).collect();
    ///     Ensemble::new(VelocityVerlet, Pendulum, starts, 0.01)
    /// };
    /// let mut seen = Vec::new();
    /// for part in 0..3 {
    ///     whole()?.shard(part, 3)?.integrate_to(1.0, |row| {
    ///         seen.push(row.trajectory);
    ///         ControlFlow::Continue(())
    ///     });
    /// }
    /// assert_eq!(seen, Vec::from_iter(0..10));
    /// assert!(whole()?.shard(3, 3).is_err());
    /// # Ok(())
    /// # }
    /// ```
    pub fn shard(mut self, part: usize, count: usize) -> Result<Self, EnsembleError> {
        let Range { start, end } = self.places_of(part, count)?;
        self.starts.truncate(end);
        self.starts.drain(..start);
        for (_, last) in &mut self.systems {
            *last = (*last).min(end).saturating_sub(start);
        }
        self.offset += start;
        self.first = self.first.clamp(start, end) - start;
        Ok(self)
    }

    /// A copy of the part that [`shard`](Self::shard) returns; only the starts of the part are copied.
    ///
    /// # Errors
    ///
    /// Those of [`shard`](Self::shard).
    ///
    /// ```
    /// # use symplectic::State;
    /// # use symplectic::ensemble::{Ensemble, EnsembleError};
    /// # symplectic::tableau! { VelocityVerlet { base: velocity-verlet } }
    /// # symplectic::hamiltonian! { Pendulum q: [a], p: [pa]; H = pa^2/2 - cos(a) }
    /// # let starts = (0..10).map(|k| State::from_arrays(0.0, [0.1 * f64::from(k)], [0.0])).collect();
    /// let ensemble = Ensemble::new(VelocityVerlet, Pendulum, starts, 0.01)?;
    /// let second = ensemble.to_shard(1, 2)?;
    /// assert_eq!((second.trajectories(), ensemble.trajectories()), (5..10, 0..10));
    /// # Ok::<(), EnsembleError>(())
    /// ```
    pub fn to_shard(&self, part: usize, count: usize) -> Result<Self, EnsembleError>
    where
        S: Clone,
    {
        let Range { start, end } = self.places_of(part, count)?;
        // Copy only the systems of these starts; every start may have its own system.
        let first = self.systems.partition_point(|(_, last)| *last <= start);
        let after = &self.systems[first..];
        let count = after.partition_point(|(_, last)| *last < end) + 1;
        let mut systems: Vec<_> = after.iter().take(count).cloned().collect();
        for (_, last) in &mut systems {
            *last = (*last).min(end) - start;
        }
        Ok(Self {
            systems,
            starts: self.starts[start..end].to_vec(),
            step_size: self.step_size,
            offset: self.offset + start,
            first: self.first.clamp(start, end) - start,
            stopping: self.stopping,
            retry: self.retry,
            lanes: self.lanes,
            stop: self.stop.clone(),
            tableau: self.tableau.clone(),
            kind: PhantomData,
        })
    }

    /// The range of starts of a part.
    fn places_of(&self, part: usize, count: usize) -> Result<Range<usize>, EnsembleError> {
        if part >= count {
            return Err(EnsembleError::Shard { part, count });
        }
        let total = self.starts.len();
        // The product may overflow `usize`.
        let bound = |part: usize| (part as u128 * total as u128 / count as u128) as usize;
        Ok(bound(part)..bound(part + 1))
    }

    /// Sets the retry policy for failed steps: see [`Integrator::set_retry`].
    pub const fn set_retry(&mut self, retry: Retry) {
        self.retry = retry;
    }

    /// Sets the maximum number of sweeps per step: see [`Integrator::set_max_iterations`].
    pub const fn set_max_iterations(&mut self, max_iterations: u32) {
        self.stopping.max_iterations = if max_iterations == 0 {
            1
        } else {
            max_iterations
        };
    }

    /// Stops a run as soon as `stop` returns true; typically it reads a flag. Every thread calls it before each
    /// trajectory, and for trajectories in lanes before each block of at most 65 536 steps; with coupled stages, of 1024.
    ///
    /// Unfinished trajectories have no row.
    ///
    /// ```
    /// use std::sync::Arc;
    /// use std::sync::atomic::{AtomicBool, Ordering};
    /// # use core::ops::ControlFlow;
    /// # use symplectic::State;
    /// # use symplectic::ensemble::{Ensemble, EnsembleError};
    /// # symplectic::tableau! { VelocityVerlet { base: velocity-verlet } }
    /// # symplectic::hamiltonian! { Pendulum q: [a], p: [pa]; H = pa^2/2 - cos(a) }
    /// # fn main() -> Result<(), EnsembleError> {
    /// # let starts = vec![State::from_arrays(0.0, [0.5], [0.0])];
    /// let mut ensemble = Ensemble::new(VelocityVerlet, Pendulum, starts, 0.01)?;
    /// let interrupted = Arc::new(AtomicBool::new(false));
    /// let flag = Arc::clone(&interrupted);
    /// ensemble.stop_if(move || flag.load(Ordering::Relaxed));
    /// // By a handler of signals, say.
    /// interrupted.store(true, Ordering::Relaxed);
    /// assert_eq!(ensemble.integrate_to(10.0, |_row| ControlFlow::Continue(())), 0);
    /// # Ok(())
    /// # }
    /// ```
    pub fn stop_if(&mut self, stop: impl Fn() -> bool + Send + Sync + 'static) {
        self.stop = Some(Arc::new(stop));
    }

    /// The starts; of a [shard](Self::shard), those of its part.
    pub fn starts(&self) -> &[State<V>] {
        &self.starts
    }

    /// The numbers of the trajectories that a run computes: those of a [shard](Self::shard) only, and after
    /// [`restore`](Self::restore) those without a row.
    pub const fn trajectories(&self) -> Range<usize> {
        self.offset + self.first..self.offset + self.starts.len()
    }
}

impl<M: Method, S: System<V>, V: Vector, R, N, L> fmt::Debug for Ensemble<M, S, V, R, N, L> {
    fn fmt(&self, formatter: &mut fmt::Formatter<'_>) -> fmt::Result {
        formatter
            .debug_struct("Ensemble")
            .field("method", &M::NAME)
            .field("trajectories", &self.starts.len())
            .field("step_size", &self.step_size)
            .finish_non_exhaustive()
    }
}
