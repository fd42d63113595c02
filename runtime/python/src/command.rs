//! The command line of `symplectic`, in this process.

use std::ffi::OsString;
use std::process::ExitCode;

use pyo3::prelude::*;

/// Runs a command with its arguments and returns its exit status. Wrong arguments end the process.
#[pyfunction]
pub(crate) fn command(py: Python<'_>, arguments: Vec<OsString>) -> u8 {
    py.detach(|| {
        let name = OsString::from("symplectica");
        let status = match arguments.split_first() {
            Some((first, others)) if first == "run" => {
                symplectic_run::command([&name].into_iter().chain(others).cloned())
            }
            _ => symplectic_cli::command([&name].into_iter().chain(&arguments).cloned()),
        };
        // The status itself cannot be read.
        (0..=u8::MAX)
            .find(|&number| ExitCode::from(number) == status)
            .unwrap_or(1)
    })
}
