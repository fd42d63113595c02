//! `symplectic derive-system`

use std::path::PathBuf;
use std::process::ExitCode;

use clap::{Args, ValueEnum};
use symplectic_compiler::Error;
use symplectic_compiler::formula::description;

use crate::{formula, output};

/// Derive the equations of motion from the formula of a Hamiltonian or a Lagrangian.
///
/// The formula is written as in `hamiltonian!` or `lagrangian!`. Shown are the equations of motion, the second derivatives, and what was found:
/// whether H is separable, how the kinetic energy depends on the momenta, what is conserved.
#[derive(Args)]
pub(crate) struct Arguments {
    /// A file with the formula, or a TOML file with the key `hamiltonian` or `lagrangian`.
    #[arg(value_name = "FILE")]
    file: PathBuf,
    /// The form of the output.
    #[arg(long, value_enum, default_value_t = Format::Text)]
    format: Format,
}

/// The formats of a system.
#[derive(Clone, Copy, PartialEq, ValueEnum)]
enum Format {
    /// For people.
    Text,
    /// An `aligned` environment with the equations.
    Latex,
    /// For other programs.
    Json,
}

/// Derives the system of a file.
pub(crate) fn run(arguments: &Arguments) -> Result<ExitCode, Error> {
    let (system, structure) = formula::read(&arguments.file)?;
    output::print(&match arguments.format {
        Format::Text => description::text(&system, &structure),
        Format::Latex => description::latex(&system),
        Format::Json => format!("{:#}\n", description::json(&system, &structure)),
    })
}
