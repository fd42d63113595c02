//! A run and its table in one line.

use std::io;
use std::path::Path;

use super::Recording;
use crate::adaptive::{Adaptive, Monitor};
use crate::error::Error;
use crate::integrator::Integrator;
use crate::method::{Method, Solver};
use crate::number::{Summation, Vector};
use crate::state::State;
use crate::system::{Named, System};

/// Integrates to `end` and writes the start and the state after every step, with the [names](Named) of the system, as `.csv` or, with the
/// feature `npz`, as `.npz`.
///
/// The file is first written before the run, with the start alone. If a step fails, it contains the states before that step.
///
/// # Errors
///
/// Those of [`Recording::of`] and [`Recording::save`]. If a step fails, its [`Error`] is the inner error.
///
/// ```
/// symplectic::tableau! { Gauss2 { basis: polynomial(2), nodes: gauss(2) } }
/// symplectic::hamiltonian! { Pendulum q: [a], p: [pa]; H = pa^2/2 - cos(a) }
/// use symplectic::{Integrator, State, files};
///
/// # fn main() -> Result<(), Box<dyn std::error::Error>> {
/// # let path = std::env::temp_dir().join("symplectic-record-to.csv");
/// let mut run = Integrator::new(Gauss2, Pendulum, State::from_arrays(0.0, [1.0], [0.0]), 0.1)?;
/// files::record_to(&mut run, 10.0, &path)?;
/// assert!(std::fs::read_to_string(&path)?.starts_with("time,a,pa\n0.0,1.0,0.0\n0.1,"));
/// # std::fs::remove_file(path)?;
/// # Ok(())
/// # }
/// ```
pub fn record_to<R: NamedRun>(run: &mut R, end: f64, path: impl AsRef<Path>) -> io::Result<()> {
    let mut table = Recording::of(run.system(), run.state())?;
    table.save(&path)?;
    let outcome = run.integrate_with(end, |state| table.record(state));
    table.save(&path)?;
    outcome.map_err(io::Error::other)
}

/// [`record_to`] with the states at `times` only, as from [`Integrator::integrate_at`].
///
/// # Errors
///
/// As for [`record_to`].
pub fn record_at<R: NamedRun>(
    run: &mut R,
    times: &[f64],
    path: impl AsRef<Path>,
) -> io::Result<()> {
    let mut table = Recording::empty(run.system(), run.state())?;
    table.save(&path)?;
    let outcome = run.integrate_at(times, |state| table.record(state));
    table.save(&path)?;
    outcome.map_err(io::Error::other)
}

/// A run of a system with [names](Named): an [`Integrator`], or an [`Adaptive`] with steps of variable size.
pub trait NamedRun {
    /// The system.
    type System: Named;
    /// The vector of positions.
    type Vector: Vector<Scalar = f64>;

    /// The system.
    fn system(&self) -> &Self::System;

    /// The present state.
    fn state(&self) -> &State<Self::Vector>;

    /// See [`Integrator::integrate_with`].
    ///
    /// # Errors
    ///
    /// Those of a step.
    fn integrate_with(
        &mut self,
        end: f64,
        observe: impl FnMut(&State<Self::Vector>),
    ) -> Result<(), Error>;

    /// See [`Integrator::integrate_at`].
    ///
    /// # Errors
    ///
    /// Those of a step.
    fn integrate_at(
        &mut self,
        times: &[f64],
        observe: impl FnMut(&State<Self::Vector>),
    ) -> Result<(), Error>;
}

impl<M, S, V, R, N> NamedRun for Integrator<M, S, V, R, N>
where
    M: Method,
    S: System<V> + Named,
    V: Vector<Scalar = f64>,
    R: Summation,
    N: Solver<V, S>,
{
    type System = S;
    type Vector = V;

    fn system(&self) -> &S {
        self.system()
    }

    fn state(&self) -> &State<V> {
        self.state()
    }

    fn integrate_with(&mut self, end: f64, observe: impl FnMut(&State<V>)) -> Result<(), Error> {
        self.integrate_with(end, observe).map(|_| ())
    }

    fn integrate_at(&mut self, times: &[f64], observe: impl FnMut(&State<V>)) -> Result<(), Error> {
        self.integrate_at(times, observe).map(|_| ())
    }
}

impl<M, S, W, V, R, N> NamedRun for Adaptive<M, S, W, V, R, N>
where
    M: Method,
    S: System<V> + Named,
    W: Monitor,
    V: Vector<Scalar = f64>,
    R: Summation,
    N: Solver<V, S>,
{
    type System = S;
    type Vector = V;

    fn system(&self) -> &S {
        self.integrator().system()
    }

    fn state(&self) -> &State<V> {
        self.state()
    }

    fn integrate_with(&mut self, end: f64, observe: impl FnMut(&State<V>)) -> Result<(), Error> {
        self.integrate_with(end, observe).map(|_| ())
    }

    fn integrate_at(&mut self, times: &[f64], observe: impl FnMut(&State<V>)) -> Result<(), Error> {
        self.integrate_at(times, observe).map(|_| ())
    }
}
