//! `symplectic derive-system`

use std::path::PathBuf;
use std::process::ExitCode;

use clap::{Args, ValueEnum};
use symplectic_compiler::export::read_text;
use symplectic_compiler::formula::{Form, Structure, System, description};
use symplectic_compiler::{Error, ErrorKind};

use crate::output;

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
    let name = arguments.file.display().to_string();
    let mut text = read_text(&arguments.file)?;
    let mut form = Form::of(&text);
    if arguments
        .file
        .extension()
        .is_some_and(|extension| extension == "toml")
    {
        (form, text) = formula(&name, &text)?;
    }
    let mut system = System::read_as(form, &name, &text)?;
    let structure = Structure::of(&mut system);
    system.check(&structure, &text)?;
    output::print(&match arguments.format {
        Format::Text => description::text(&system, &structure),
        Format::Latex => description::latex(&system),
        Format::Json => format!("{:#}\n", description::json(&system, &structure)),
    })
}

/// The formula in a TOML file.
fn formula(name: &str, text: &str) -> Result<(Form, String), Error> {
    let refused = |message: String| Error::from(ErrorKind::Document { message });
    let table: toml::Table = text
        .parse()
        .map_err(|error| refused(format!("{name}: {error}")))?;
    let value = |key: &str| table.get(key).and_then(toml::Value::as_str);
    match (value("hamiltonian"), value("lagrangian")) {
        (Some(formula), None) => Ok((Form::Hamiltonian, formula.to_owned())),
        (None, Some(formula)) => Ok((Form::Lagrangian, formula.to_owned())),
        (None, None) => Err(refused(format!(
            "{name} has no key `hamiltonian` or `lagrangian` with a formula in quotes"
        ))),
        (Some(_), Some(_)) => Err(refused(format!(
            "{name} has both keys `hamiltonian` and `lagrangian`: a system has one of them"
        ))),
    }
}
