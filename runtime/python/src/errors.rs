//! Errors as exceptions: the texts of the library, with their fields.

use pyo3::exceptions::PyRuntimeError;
use pyo3::prelude::*;
use pyo3::types::PyDict;
use symplectic_compiler::{Error, ErrorKind};
use symplectic_terminal::errors;

/// Loads an exception class of the package.
fn class<'py>(py: Python<'py>, name: &str) -> PyResult<Bound<'py, PyAny>> {
    py.import("symplectica._errors")?.getattr(name)
}

/// An instance of a class of the package, with fields.
fn instance(
    py: Python<'_>,
    name: &str,
    message: &str,
    fields: impl FnOnce(&Bound<'_, PyDict>) -> PyResult<()>,
) -> PyErr {
    let made = || {
        let dict = PyDict::new(py);
        fields(&dict)?;
        class(py, name)?.call((message,), Some(&dict))
    };
    match made() {
        Ok(value) => PyErr::from_value(value),
        Err(error) => error,
    }
}

/// A wrong definition of a method or a system, at its place.
pub(crate) fn definition(error: &Error) -> PyErr {
    let text = errors::plain(error);
    let message = text.strip_prefix("error: ").unwrap_or(&text).to_owned();
    Python::attach(|py| {
        let name = match *error.kind {
            ErrorKind::Mismatch { .. } | ErrorKind::NotCertified { .. } => "ProofError",
            _ => "DefinitionError",
        };
        instance(py, name, &message, |fields| {
            fields.set_item("reason", error.kind.to_string())?;
            if let Some(place) = &error.place {
                fields.set_item("input", &place.input)?;
                fields.set_item("text", &place.text)?;
                let chars = |at: usize| place.text.get(..at).map_or(at, |s| s.chars().count());
                fields.set_item("span", (chars(place.span.start), chars(place.span.end)))?;
            }
            Ok(())
        })
    })
}

/// A wrong argument.
pub(crate) fn argument(message: impl Into<String>) -> PyErr {
    let message = message.into();
    Python::attach(|py| instance(py, "ArgumentError", &message, |_| Ok(())))
}

/// A step that failed.
pub(crate) fn step(error: &symplectic::Error) -> PyErr {
    let message = in_python(error);
    Python::attach(|py| {
        instance(py, "StepError", &message, |fields| {
            fields.set_item("kind", kind(error))?;
            if let Some((time, step, size)) = place(error) {
                fields.set_item("time", time)?;
                fields.set_item("step", step)?;
                fields.set_item("step_size", size)?;
            }
            Ok(())
        })
    })
}

/// The message of an error, with arguments of Python in place of calls in Rust.
pub(crate) fn in_python(error: &symplectic::Error) -> String {
    let mut error = error.clone();
    let mut newton = false;
    match &mut error {
        symplectic::Error::NoConvergence {
            newton_may_help, ..
        } => newton = std::mem::take(newton_may_help),
        symplectic::Error::Stagnation { .. } => return stagnation(&error),
        _ => {}
    }
    match newton {
        true => format!("{error}, or `solver=\"newton\"` for a stiff system"),
        false => error.to_string(),
    }
}

/// Python has no sums but compensated ones, and no tolerance.
fn stagnation(error: &symplectic::Error) -> String {
    let text = error.to_string();
    let text = text.split(", or take `Plain` sums").next();
    text.unwrap_or_default().to_owned()
}

/// The kind of an error of a step, in a few words.
pub(crate) fn kind(error: &symplectic::Error) -> &'static str {
    use symplectic::Error as E;
    match error {
        E::NonFinite { .. } | E::NonFiniteState { .. } => "not finite",
        E::NoConvergence { .. } => "no convergence",
        E::Stagnation { .. } => "stagnation",
        E::SingularMatrix { .. } => "singular matrix",
        E::EventValue { .. } => "event is NaN",
        _ => "other",
    }
}

/// Time, number and size of the step that failed.
fn place(error: &symplectic::Error) -> Option<(f64, u64, f64)> {
    use symplectic::Error as E;
    match *error {
        E::NoConvergence {
            time,
            step_size,
            step,
            ..
        }
        | E::Stagnation {
            time,
            step_size,
            step,
            ..
        }
        | E::NonFinite {
            time,
            step_size,
            step,
            ..
        }
        | E::SingularMatrix {
            time,
            step_size,
            step,
        } => Some((time, step, step_size)),
        _ => None,
    }
}

/// What the library itself should never do.
pub(crate) fn internal(message: &str) -> PyErr {
    PyRuntimeError::new_err(message.to_owned())
}

/// A requirement that is refuted or not proved.
pub(crate) fn proof(message: &str, requirement: &str) -> PyErr {
    let text = format!("`{requirement}`: {message}");
    Python::attach(|py| {
        instance(py, "ProofError", &text, |fields| {
            fields.set_item("reason", message)?;
            fields.set_item("requirement", requirement)
        })
    })
}
