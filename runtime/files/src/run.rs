//! A run and its table in one line.

use std::io;
use std::path::Path;

use super::Recording;
#[cfg(doc)]
use symplectic_core::Error;
use symplectic_core::Run;
use symplectic_core::stepper::NamedSteps;
#[cfg(doc)]
use symplectic_core::system::Named;

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
pub fn record_to<S: NamedSteps>(
    run: &mut Run<S>,
    end: f64,
    path: impl AsRef<Path>,
) -> io::Result<()> {
    let mut table = Recording::of(run.stepper().system(), run.state())?;
    table.save(&path)?;
    let outcome = run.watch_to(end, |state| table.record(state));
    table.save(&path)?;
    outcome.map_err(io::Error::other)
}

/// [`record_to`] with the states at `times` only, as from [`Run::integrate_at`].
///
/// # Errors
///
/// As for [`record_to`].
pub fn record_at<S: NamedSteps>(
    run: &mut Run<S>,
    times: &[f64],
    path: impl AsRef<Path>,
) -> io::Result<()> {
    let mut table = Recording::empty(run.stepper().system(), run.state())?;
    table.save(&path)?;
    let outcome = run.integrate_at(times, |state| table.record(state));
    table.save(&path)?;
    outcome.map(|_| ()).map_err(io::Error::other)
}
