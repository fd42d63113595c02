//! `symplectic derive-system`

use std::path::PathBuf;
use std::process::ExitCode;

use clap::{Args, ValueEnum};
use symplectic_compiler::export::read_text;
use symplectic_compiler::formula::{Structure, System, description};
use symplectic_compiler::{Error, ErrorKind};

use crate::output;

/// Derive the equations of motion of a Hamiltonian from its formula.
///
/// The formula is written as in `hamiltonian!`. Shown are the equations of motion, the second derivatives, and what was found:
/// whether H is separable, how the kinetic energy depends on the momenta, what is conserved.
#[derive(Args)]
pub(crate) struct Arguments {
    /// A file with the formula, or a TOML file with the key `hamiltonian`.
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
    let name = arguments.file.display().to_string();
    let mut text = read_text(&arguments.file)?;
    if arguments
        .file
        .extension()
        .is_some_and(|extension| extension == "toml")
    {
        text = hamiltonian(&name, &text)?;
    }
    let mut system = System::read(&name, &text)?;
    let structure = Structure::of(&mut system);
    system.check(&structure, &text)?;
    output::print(&match arguments.format {
        Format::Text => description::text(&system, &structure),
        Format::Latex => description::latex(&system),
        Format::Json => format!("{:#}\n", description::json(&system, &structure)),
    })
}

/// The formula in a TOML file.
fn hamiltonian(name: &str, text: &str) -> Result<String, Error> {
    let refused = |message: String| Error::from(ErrorKind::Document { message });
    let table: toml::Table = text
        .parse()
        .map_err(|error| refused(format!("{name}: {error}")))?;
    match table.get("hamiltonian").and_then(toml::Value::as_str) {
        Some(formula) => Ok(formula.to_owned()),
        None => Err(refused(format!(
            "{name} has no key `hamiltonian` with a formula in quotes"
        ))),
    }
}
