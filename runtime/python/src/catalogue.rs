//! The known methods, and the keys of definitions.

use pyo3::prelude::*;
use symplectic_compiler::{Key, catalogue as known};

/// Name, title, definition, number of stages and source of each method.
#[pyfunction]
pub(crate) fn catalogue() -> Vec<(String, String, String, usize, String)> {
    known::entries()
        .map(|entry| {
            (
                entry.name,
                entry.title,
                entry.definition,
                entry.stages,
                entry.source,
            )
        })
        .collect()
}

/// The keys of a definition: name, what the value is called (nothing for a switch), and what it is.
#[pyfunction]
pub(crate) fn keys() -> Vec<(&'static str, Option<&'static str>, &'static str)> {
    Key::ALL
        .map(|key| (key.name(), key.value_name(), key.help()))
        .into()
}
