//! Construction of an ensemble, and the checks of its starts.

use alloc::sync::Arc;
use alloc::vec::Vec;
use core::marker::PhantomData;

use crate::{Ensemble, EnsembleError, Wanted};
use symplectic_core::inside::{check_step_size, widest};
use symplectic_core::solver::Stopping;
use symplectic_core::system::Class;
use symplectic_core::{
    Integrator, Method, Plain, ProvedFor, Retry, State, Summation, System, Vector,
};

impl<M: Method, S: System<V>, V: Vector> Ensemble<M, S, V> {
    /// The trajectories of a system from `starts`, with [`Compensated`](symplectic_core::Compensated) sums; a negative
    /// `step_size` goes backward. Trajectories are numbered like their starts, from 0.
    ///
    /// # Errors
    ///
    /// [`EnsembleError::Empty`] without starts, [`EnsembleError::All`] for a step size that is zero or not finite,
    /// [`EnsembleError::Dimension`] for starts of different dimensions, [`EnsembleError::Start`] for a start that
    /// [`Integrator::new`] rejects. [`EnsembleError::All`] also for a tableau at run time that is refused for the class of the
    /// system.
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
        method: M,
        families: impl IntoIterator<Item = (S, Vec<State<V>>)>,
        step_size: f64,
    ) -> Result<Self, EnsembleError>
    where
        M: ProvedFor<S::Class>,
    {
        S::Class::check_steps(&method).map_err(EnsembleError::All)?;
        method
            .check_order::<S::Class>()
            .map_err(EnsembleError::All)?;
        check_step_size(step_size).map_err(EnsembleError::All)?;
        let mut systems: Vec<(S, usize)> = Vec::new();
        let mut starts: Vec<State<V>> = Vec::new();
        for (system, mut own) in families {
            let before = starts.len();
            starts.append(&mut own);
            check_starts::<M, S, V, R>(&method, &system, &starts, before, step_size)?;
            systems.push((system, starts.len()));
        }
        if starts.is_empty() {
            return Err(EnsembleError::Empty);
        }
        Ok(Self {
            systems,
            starts: Arc::new(starts),
            step_size,
            offset: 0,
            first: 0,
            stopping: Stopping::DEFAULT,
            retry: Retry::Never,
            lanes: Wanted::IfFaster,
            registers: widest::<V, S>(),
            stop: None,
            method,
            kind: PhantomData,
        })
    }
}

/// Checks the starts from index `first`, which all belong to `system`.
fn check_starts<M: Method, S: System<V>, V: Vector, R: Summation>(
    method: &M,
    system: &S,
    starts: &[State<V>],
    first: usize,
    step_size: f64,
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
        Integrator::<M, S, V, R>::check(method, system, start, step_size)
            .map_err(|error| EnsembleError::Start { trajectory, error })?;
    }
    Ok(())
}
