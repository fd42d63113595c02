//! Tables of other libraries and printed digits.

use std::sync::Arc;

use pyo3::prelude::*;
use symplectic_compiler::{Library, Limits};
use symplectic_tools::audit::Audit;
use symplectic_tools::{
    import_with_origin, refine as refined, refine_table, refine_table_to_nearest, refine_to_nearest,
};

use crate::errors;
use crate::tableau::Tableau;

/// Compares the claims of a text in TOML with proofs; the result is JSON.
#[pyfunction]
pub(crate) fn audit(py: Python<'_>, name: &str, text: &str) -> PyResult<String> {
    py.detach(|| {
        let mut audit = Audit::default();
        audit.add(name, text, &Limits::default())?;
        Ok(audit.json())
    })
    .map_err(|error| errors::definition(&error))
}

/// Proves that an exact method is near printed digits; the result is text or JSON.
#[pyfunction]
#[pyo3(signature = (name, text, digits, json, nearest))]
pub(crate) fn refine(
    py: Python<'_>,
    name: &str,
    text: &str,
    digits: usize,
    json: bool,
    nearest: bool,
) -> PyResult<String> {
    let work = || {
        let table = match nearest {
            true => refine_table_to_nearest(name, text)?,
            false => refine_table(name, text)?,
        };
        if let Some(table) = table {
            return match json {
                true => table.json(digits),
                false => table.text(digits),
            };
        }
        let refinement = match nearest {
            true => refine_to_nearest(name, text)?,
            false => refined(name, text)?,
        };
        match json {
            true => refinement.json(digits),
            false => refinement.text(digits),
        }
    };
    py.detach(work).map_err(|error| errors::definition(&error))
}

/// Reads a table in the language of another library; returns the tableau, and how its coefficients follow from the numbers if these are
/// not exact.
#[pyfunction]
pub(crate) fn import_table(
    py: Python<'_>,
    library: &str,
    name: &str,
    text: &str,
) -> PyResult<(Tableau, Option<String>)> {
    let work = || {
        let library = Library::find(library)?;
        import_with_origin(library, name, text, &Limits::default())
    };
    let (tableau, origin) = py
        .detach(work)
        .map_err(|error| errors::definition(&error))?;
    Ok((Tableau(Arc::new(tableau)), origin.note()))
}
