//! `symplectic certify`

use std::path::{Path, PathBuf};
use std::process::ExitCode;

use clap::Args;
use symplectic_compiler::{Error, ErrorKind, Tableau, catalogue, check, export};
use symplectic_terminal::print;
use symplectic_tools::certificate;

use crate::output;

/// Write the certificate of a method: everything that is proved about it, for an independent checker.
///
/// `python3 tableaux/check_certificate.py FILE` checks a certificate using Python's standard library only.
#[derive(Args)]
pub(crate) struct Arguments {
    /// A name from `symplectic list`, or a .toml or .json file written by `symplectic derive`.
    #[arg(value_name = "NAME|FILE")]
    method: PathBuf,
    /// Output file [default: standard output].
    #[arg(long, value_name = "FILE")]
    out: Option<PathBuf>,
    /// Largest number of stages of a file [default: 36].
    #[arg(long, value_name = "S", value_parser = clap::value_parser!(u16).range(1..=1000))]
    max_stages: Option<u16>,
}

pub(crate) fn run(arguments: &Arguments) -> Result<ExitCode, Error> {
    let text = certificate::write(&tableau(&arguments.method, arguments.max_stages)?)?;
    match &arguments.out {
        None => print(&text),
        Some(path) => {
            output::refuse_overwriting([arguments.method.as_path()], &[path])?;
            output::write_file(path, &text)?;
            Ok(ExitCode::SUCCESS)
        }
    }
}

/// The method of the catalogue with this name, or the method of a file.
fn tableau(method: &Path, max_stages: Option<u16>) -> Result<Tableau, Error> {
    let name = method.display().to_string();
    let is_file = ["toml", "json"]
        .iter()
        .any(|known| method.extension().is_some_and(|e| e == *known));
    if !is_file {
        let unknown = || {
            let mut error = catalogue::unknown(&name);
            if let ErrorKind::Unknown { known, .. } = &mut *error.kind {
                known.push_str(", or a file named .toml or .json");
            }
            error
        };
        return catalogue::find(&name).ok_or_else(unknown)?.derive();
    }
    let tableau = check(
        &name,
        &export::read_text(method)?,
        &output::limits(max_stages),
    )?;
    output::warn_of_wrong_digits(&tableau);
    Ok(tableau)
}
