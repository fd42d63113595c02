//! Searches for methods.

use std::ops::ControlFlow;
use std::sync::Arc;

use pyo3::prelude::*;
use symplectic_search::Options;

use crate::errors;
use crate::tableau::Tableau;

/// What is found: the counts of starts, solutions, conditions and unknowns, the free parameters, and the methods.
type Found = (u64, u64, usize, usize, Option<usize>, Vec<Method>);

/// A method: its tableau, its error constant and efficiency, its largest coefficient, the stable hω a kick, and how often it was found.
type Method = (Tableau, f64, f64, f64, f64, usize);

/// Searches with the options of the command line.
#[pyfunction]
pub(crate) fn search(py: Python<'_>, options: Vec<String>) -> PyResult<Found> {
    let options = Options::parse(options).map_err(|message| errors::argument(message.trim()))?;
    let mut signal = None;
    let found = py.detach(|| {
        options.search(|_| match Python::attach(|py| py.check_signals()) {
            Ok(()) => ControlFlow::Continue(()),
            Err(error) => {
                signal = Some(error);
                ControlFlow::Break(())
            }
        })
    });
    if let Some(signal) = signal {
        return Err(signal);
    }
    let found = found.map_err(|error| errors::argument(error.to_string()))?;
    let method = |(solution, method): (symplectic_search::Solution, symplectic_search::Method)| {
        (
            Tableau(Arc::new(method.tableau)),
            method.error,
            found.problem.efficiency(method.error),
            solution.largest(),
            solution.stable,
            solution.found,
        )
    };
    let progress = &found.progress;
    Ok((
        progress.starts,
        progress.solved,
        progress.conditions,
        progress.unknowns,
        progress.free,
        found.methods.into_iter().map(method).collect(),
    ))
}
