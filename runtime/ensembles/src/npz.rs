//! Ensembles in files for NumPy: `.npz`.

use alloc::format;
use alloc::string::String;
use alloc::vec::Vec;
use core::fmt::Display;
use std::io::{self, Error, ErrorKind, Write};

use symplectic_core::solver::Solver;
use symplectic_core::{Method, Summation, System, Vector};
use symplectic_files::Npz;

use crate::{Ensemble, Row};

/// What an [`Npz`] file contains of an ensemble.
///
/// ```
/// use core::ops::ControlFlow;
/// use symplectic::State;
/// use symplectic::ensemble::{Ensemble, Npz, WriteEnsemble};
///
/// symplectic::tableau! { VelocityVerlet { base: velocity-verlet } }
/// symplectic::hamiltonian! { Pendulum q: [a], p: [pa]; H = pa^2/2 - cos(a) }
///
/// # fn main() -> Result<(), Box<dyn std::error::Error>> {
/// let starts = (0..100).map(|k| State::from_arrays(0.0, [0.03 * f64::from(k)], [0.0])).collect();
/// let ensemble = Ensemble::new(VelocityVerlet, Pendulum, starts, 0.01)?;
/// let mut rows = Vec::new();
/// ensemble.integrate_to(10.0, |row| {
///     rows.push(row);
///     ControlFlow::Continue(())
/// });
/// let mut file = Npz::new(Vec::new()); // or `File::create("pendulums.npz")?`
/// file.facts(&ensemble)?;
/// file.rows(&rows)?;
/// let bytes = file.finish()?;
/// assert!(bytes.starts_with(b"PK"));
/// # Ok(())
/// # }
/// ```
pub trait WriteEnsemble {
    /// Writes the metadata of an ensemble: `method`, `definition`, `orders` (general, separable, with quadratic kinetic
    /// energy), `step_size`, `sums`, `solver`, `tolerance` and the `version` of this library. For a tableau at run time
    /// `definition` is `at run time`.
    ///
    /// # Errors
    ///
    /// As for [`Npz::doubles`].
    fn facts<M, S, V, R, N, L>(&mut self, ensemble: &Ensemble<M, S, V, R, N, L>) -> io::Result<()>
    where
        M: Method,
        S: System<V>,
        V: Vector,
        R: Summation,
        N: Solver<V, S>;

    /// Writes rows, once per file: `trajectory`, `time`, `q` and `p` (row, component), `steps`; and for failed
    /// trajectories their numbers, `failed`, and their errors, `error`.
    ///
    /// # Errors
    ///
    /// Those of [`Npz::doubles`]; [`ErrorKind::InvalidInput`] also for rows of different dimensions.
    fn rows<V: Vector<Scalar = f64>, A, E: Display>(
        &mut self,
        rows: &[Row<V, A, E>],
    ) -> io::Result<()>;
}

impl<W: Write> WriteEnsemble for Npz<W> {
    fn facts<M, S, V, R, N, L>(&mut self, ensemble: &Ensemble<M, S, V, R, N, L>) -> io::Result<()>
    where
        M: Method,
        S: System<V>,
        V: Vector,
        R: Summation,
        N: Solver<V, S>,
    {
        let facts = ensemble.method_facts();
        self.text("method", facts.method)?;
        self.text("definition", facts.definition)?;
        self.integers("orders", &[3], &facts.orders)?;
        self.doubles("step_size", &[], &[facts.step_size])?;
        self.text("sums", facts.sums)?;
        self.text("solver", &facts.solver)?;
        self.doubles("tolerance", &[], &[facts.tolerance])?;
        self.text("version", env!("CARGO_PKG_VERSION"))
    }

    fn rows<V: Vector<Scalar = f64>, A, E: Display>(
        &mut self,
        rows: &[Row<V, A, E>],
    ) -> io::Result<()> {
        let count = rows.len();
        let dimension = rows.first().map_or(0, |row| row.state.q.dimension());
        let other =
            |row: &&Row<V, A, E>| [&row.state.q, &row.state.p].map(V::dimension) != [dimension; 2];
        if let Some(row) = rows.iter().find(other) {
            return Err(invalid(format!(
                "trajectory {} has another dimension than the first row, {dimension}: write them to files of their own",
                row.trajectory
            )));
        }
        let list = |of: fn(&Row<V, A, E>) -> u64| rows.iter().map(of).collect::<Vec<u64>>();
        self.integers("trajectory", &[count], &list(|row| row.trajectory as u64))?;
        let times: Vec<f64> = rows.iter().map(|row| row.state.time).collect();
        self.doubles("time", &[count], &times)?;
        let vectors = |of: fn(&Row<V, A, E>) -> &V| {
            let components = rows.iter().flat_map(|row| of(row).as_slice());
            components.copied().collect::<Vec<f64>>()
        };
        self.doubles("q", &[count, dimension], &vectors(|row| &row.state.q))?;
        self.doubles("p", &[count, dimension], &vectors(|row| &row.state.p))?;
        self.integers("steps", &[count], &list(|row| row.statistics.steps))?;
        let of = |row: &Row<V, A, E>| {
            let error = row.outcome.as_ref().err()?;
            Some((row.trajectory as u64, format!("{error}")))
        };
        let (failed, errors): (Vec<u64>, Vec<String>) = rows.iter().filter_map(of).unzip();
        self.integers("failed", &[failed.len()], &failed)?;
        let errors: Vec<&str> = errors.iter().map(String::as_str).collect();
        self.texts("error", &errors)
    }
}

fn invalid(reason: String) -> Error {
    Error::new(ErrorKind::InvalidInput, reason)
}
