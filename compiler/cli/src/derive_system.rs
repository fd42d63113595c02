//! `symplectic derive-system`

use std::path::PathBuf;
use std::process::ExitCode;

use clap::{Args, ValueEnum};
use symplectic_compiler::Error;
use symplectic_formula::description;
use symplectic_terminal::print;

use crate::formula;

/// Derive the equations of motion from the formula of a Hamiltonian or a Lagrangian.
///
/// The formula has the syntax of `hamiltonian!` or `lagrangian!`. The output contains the equations of motion, the
/// second derivatives, and the structure found: whether H is separable, how the kinetic energy depends on the momenta,
/// and the conserved quantities.
#[derive(Args)]
pub(crate) struct Arguments {
    /// File with the formula, or TOML file with the key `hamiltonian` or `lagrangian`.
    #[arg(value_name = "FILE")]
    file: PathBuf,
    /// Format of the output.
    #[arg(long, value_enum, default_value_t = Format::Text)]
    format: Format,
}

/// Formats of a system.
#[derive(Clone, Copy, PartialEq, ValueEnum)]
enum Format {
    /// Readable text.
    Text,
    /// The equations in an `aligned` environment.
    Latex,
    /// JSON for other programs.
    Json,
}

/// Derives the system of a file.
pub(crate) fn run(arguments: &Arguments) -> Result<ExitCode, Error> {
    let (system, structure) = formula::read(&arguments.file)?;
    print(&match arguments.format {
        Format::Text => description::text(&system, &structure),
        Format::Latex => description::latex(&system, &structure),
        Format::Json => format!("{:#}\n", description::json(&system, &structure)),
    })
}
