//! Ensembles: many trajectories at once, in SIMD lanes and on all cores.
//!
//! An [`Ensemble`] consists of a method, a system and many starts. Every trajectory has the same bits as if run alone in an
//! [`Integrator`](symplectic_core::Integrator). They do not depend on the number of lanes and threads, or on how the ensemble is split or resumed.
//!
//! | What | Where |
//! |---|---|
//! | Final states, states at given times | [`Ensemble::integrate_to`], [`Ensemble::take_steps`], [`Ensemble::integrate_at`] |
//! | Events, and everything else that an integrator offers | [`Ensemble::each`] |
//! | Steps of variable size, and runs other than integrators | [`Ensemble::each_as`] |
//! | Result of a trajectory, or its error | [`Row`] |
//! | Mean, variance, histogram over the trajectories | [`Moments`], [`Histogram`] |
//! | Several machines, and interrupted runs | [`Ensemble::shard`], [`Ensemble::checkpoint`]; with MPI the package `symplectic-mpi` |
//!
//! # Lanes
//!
//! A method advances one trajectory per [lane](Ensemble::in_lanes) at once, if the system is written for every
//! [`Scalar`](symplectic_core::Scalar). The trajectories in the lanes have the same start time, consecutive numbers, and the same system. Systems
//! of a formula without friction and applied forces may have different parameters in each lane. Their arrays must have the same lengths,
//! and their lists of pairs the same pairs.
//!
//! With coupled stages, every sweep of the default solver computes the stages of all trajectories; converged trajectories wait for the
//! others. A trajectory takes a step alone if its stages do not converge as usual after a warm start, and then returns to its lane. This
//! happens in its first step, and in slow or failing iterations. A compiled method runs in lanes with AVX-512, or if you
//! [choose lanes](Ensemble::in_lanes). With narrower registers a single run, with the stages of one trajectory in lanes, is at least as
//! fast.
//!
//! For [inlined](symplectic_core::Hamiltonian::INLINED) systems a new ensemble detects the registers of the processor: sixteen lanes with AVX-512,
//! eight with AVX2. Other systems use the lanes of the build.
//!
//! All other trajectories run one at a time: with another solver, with constraints or with a composition of implicit methods; of
//! closures and chains; of tangent systems with coupled stages; in fewer than four steps with coupled stages; of
//! [`each`](Ensemble::each) and [`each_as`](Ensemble::each_as). So do trajectories with
//! [different systems](Ensemble::of_families), if these are written by hand, or are formulas with friction or applied forces.
//!
//! A system rounds differently in lanes if it depends on the number type, such as products of large matrices in nalgebra. So velocity
//! and force are compared with those of doubles, at the first starts of a run and at one start in each set of lanes. Trajectories run one
//! at a time if they differ. A system for every scalar must not [branch on a value](symplectic_core::Scalar), such as a magnitude: in lanes the
//! branch would apply to all trajectories, and few states are compared.
//!
//! # Threads
//!
//! With the feature `parallel` the threads of `rayon` share the trajectories. Without it there is one thread; the bits
//! are the same. A thread runs many short trajectories before their rows are shown, and the next ones run meanwhile.
//!
//! Each thread has its own copy of the system, so a system need not be `Sync`. `Newmark`,
//! `Poincare` and `Logarithmic`, for example, are not. Their ensembles can be moved to another thread, but not shared: for a thread pool of
//! your own write `pool.install(move || ensemble.take_steps(..))`.

#![no_std]

extern crate alloc;

#[cfg(feature = "std")]
extern crate std;

#[cfg(feature = "serde")]
mod as_bits;
mod checkpoint;
mod coupled;
mod error;
mod explicit;
#[cfg(any(feature = "npz", feature = "parquet"))]
mod facts;
mod group;
mod histogram;
mod in_lanes;
mod make;
mod moments;
#[cfg(feature = "npz")]
mod npz;
#[cfg(feature = "parquet")]
mod parquet;
mod pool;
#[cfg(test)]
mod registers;
mod row;
mod run;
mod shards;

pub use checkpoint::EnsembleCheckpoint;
pub use error::EnsembleError;
pub use histogram::Histogram;
pub use moments::Moments;
#[cfg(feature = "npz")]
pub use npz::WriteEnsemble;
#[cfg(feature = "parquet")]
pub use parquet::{Parquet, ParquetColumn};
pub use row::Row;
#[cfg(feature = "npz")]
pub use symplectic_files::{Npz, NpzArray, NpzValues};

use alloc::sync::Arc;
use alloc::vec::Vec;
use core::fmt;
use core::marker::PhantomData;
use core::ops::Range;

use symplectic_core::inside::Widest;
use symplectic_core::simd::{DefaultLanes, Lanes};
use symplectic_core::solver::{Solver, Stopping};
use symplectic_core::{Compensated, Error, Method, Plain, Retry, State, Summation, System, Vector};

/// Type parameters without stored values; `fn()` keeps the ensemble `Send` and `Sync`.
type Kind<M, R, N, L> = fn() -> (M, R, N, L);

/// Many trajectories with the same method and the same step size.
///
/// Trajectories are created from the stored starts a few at a time: the memory is that of the starts, whatever the number of steps.
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
    /// Shared by all threads.
    starts: Arc<Vec<State<V>>>,
    step_size: f64,
    /// Trajectory number of the first start.
    offset: usize,
    /// Index of the first start to run.
    first: usize,
    stopping: Stopping,
    retry: Retry,
    lanes: Wanted,
    registers: Widest,
    stop: Option<Arc<dyn Fn() -> bool + Send + Sync>>,
    method: M,
    kind: PhantomData<Kind<M, R, N, L>>,
}

/// Whether trajectories use lanes if possible.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
enum Wanted {
    No,
    IfFaster,
    Yes,
}

impl<M: Method, S: System<V>, V: Vector, N: Solver<V, S>, L: Lanes> Ensemble<M, S, V, Plain, N, L> {
    /// Sets the tolerance of every trajectory: see [`Integrator::set_tolerance`](symplectic_core::Integrator::set_tolerance).
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
    /// The same ensemble with another [`Solver`] for coupled stages, for example `<Newton>::new()` of the feature `newton`.
    pub fn with_solver<O: Solver<V, S>>(self, _solver: O) -> Ensemble<M, S, V, R, O, L> {
        self.of_kind()
    }

    /// The same ensemble with lanes of your choice, for example [`F64x4`](symplectic_core::simd::F64x4), in the registers of the build. Implicit
    /// methods then use lanes even where these are not faster: in registers of fewer than eight doubles. The results are the same.
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
            registers: Widest::Build,
            ..self.of_kind()
        }
    }

    /// The same ensemble without lanes, one trajectory after another. The results are the same.
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
            registers: self.registers,
            stop: self.stop,
            method: self.method,
            kind: PhantomData,
        }
    }

    /// Sets the retry policy for failed steps: see [`Integrator::set_retry`](symplectic_core::Integrator::set_retry). It is that of the integrators,
    /// not of other runs made from them by [`each_as`](Self::each_as).
    pub const fn set_retry(&mut self, retry: Retry) {
        self.retry = retry;
    }

    /// Sets the maximum number of sweeps per step: see [`Integrator::set_max_iterations`](symplectic_core::Integrator::set_max_iterations).
    pub const fn set_max_iterations(&mut self, max_iterations: u32) {
        self.stopping.max_iterations = if max_iterations == 0 {
            1
        } else {
            max_iterations
        };
    }

    /// Stops a run as soon as `stop` returns true; typically it reads a flag. Every thread calls it before each trajectory. In lanes it
    /// is called before each block of at most 65 536 steps, or 1024 with coupled stages.
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

    /// The starts; for a [shard](Self::shard), those of its part.
    pub fn starts(&self) -> &[State<V>] {
        &self.starts
    }

    /// The numbers of the trajectories that a run computes: only those of a [shard](Self::shard), and after [`restore`](Self::restore)
    /// only those without a row.
    pub fn trajectories(&self) -> Range<usize> {
        self.offset + self.first..self.offset + self.starts.len()
    }
}

impl<M: Method, S: System<V>, V: Vector, R, N, L> fmt::Debug for Ensemble<M, S, V, R, N, L> {
    fn fmt(&self, formatter: &mut fmt::Formatter<'_>) -> fmt::Result {
        formatter
            .debug_struct("Ensemble")
            .field("method", &self.method.name())
            .field("trajectories", &self.starts.len())
            .field("step_size", &self.step_size)
            .finish_non_exhaustive()
    }
}
