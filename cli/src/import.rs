//! `symplectic import`

use std::path::PathBuf;
use std::process::ExitCode;

use clap::Args;
use symplectic_compiler::{Error, ImportOrigin, Library, export, import_with_origin};

use crate::output::{self, OutputOptions};
use crate::report;

/// Import a table of another library, by that library's convention for the numbers of its tables.
///
/// The file contains one table, in the language of the library: Julia's `1//2` and `big"0.5"`, C's `0x1.8p-1`,
/// Fortran's `1.0d0` and `0.5_real64`, Mathematica's "1.5`20", Python's `Fraction(1, 2)`, Matlab's `[1 2; 3 4]`.
/// Splittings use the library's letters for drifts and kicks; Runge–Kutta methods use `A` or `a`, `b`, and optionally
/// `c`, `a_tilde`, `b_tilde`. For rounded decimals the result is an exact method proved to be near them; standard error
/// shows the distance.
#[derive(Args)]
pub(crate) struct Arguments {
    /// Library: sciml, sundials, petsc, petsc-kick-first, rungekutta.jl, odeint, nodepy, mathematica, principia,
    /// rebound, pyhamsys or pyhamsys-drift-first.
    #[arg(long, value_name = "LIBRARY")]
    from: String,
    /// The file.
    #[arg(value_name = "FILE")]
    file: PathBuf,
    /// Name for the output.
    #[arg(long)]
    name: Option<String>,
    #[command(flatten)]
    output: OutputOptions,
}

pub(crate) fn run(arguments: &Arguments) -> Result<ExitCode, Error> {
    let library = Library::find(&arguments.from)?;
    let text = export::read_text(&arguments.file)?;
    let file = arguments.file.display().to_string();
    let limits = arguments.output.limits();
    let (mut tableau, origin) = import_with_origin(library, &file, &text, &limits)?;
    match origin {
        ImportOrigin::Exact => {}
        ImportOrigin::NearDecimals {
            forced_by,
            distance,
        } => {
            let forced_by = forced_by.map(|condition| {
                format!("as they are written, the decimals do not have {condition}; ")
            });
            let distance = distance.map(|distance| {
                format!(", from which the decimals differ by at most {distance:.1e}")
            });
            let distance = distance.unwrap_or_default();
            report::warning(&format!(
                "{}the result is the exact method near the decimals{distance}",
                forced_by.unwrap_or_default()
            ));
        }
        ImportOrigin::Decimals { separable, nystrom } => {
            report::warning(&format!(
                "no exact method was found near the decimals; they are taken as exact numbers; up to their rounding they have order \
                 {separable} for T(p) + U(q), and {nystrom} for quadratic T"
            ));
        }
    }
    if let Some(name) = &arguments.name {
        tableau = tableau.named(name);
    }
    output::warn_if_inconsistent(&tableau);
    output::print(&arguments.output.write(&tableau)?)
}
