//! `symplectic refine`

use std::path::PathBuf;
use std::process::ExitCode;

use clap::{Args, ValueEnum};
use symplectic_compiler::Error;
use symplectic_compiler::export::{self, DEFAULT_DIGITS};
use symplectic_terminal::print;
use symplectic_tools::{refine, refine_table, refine_table_to_nearest, refine_to_nearest};

use crate::output;

/// Prove that an exact method exists near the printed coefficients of a file, and print it to any number of digits.
///
/// The file is TOML: `name` and `source`; `[claim]` with `class = "separable"` or `"nystrom"` and `order = 6`, or with
/// `perturbed = [8, 4]`; `[printed]` with `kick` and `drift`, lists of decimals in quotes. Alternatively `[printed]`
/// contains the `weights` of a composition of any symmetric method of order 2; the claim is then an `order` without a
/// class.
///
/// Digits are wrong if no exact method rounds to all of them. Coefficients that the conditions leave free may vary
/// within their last place. Fractions and integers are exact; an expression such as `1 - 2*0.2345678` is exact given its numbers.
///
/// Butcher arrays: `[printed]` with `a` and `b`, optionally `c`, `a_tilde`, `b_tilde`, `c_tilde`; `[claim]` with
/// `class = "general"`, `"separable"` or `"nystrom"`, `order = 6`, and optionally
/// `properties = ["symplectic", "symmetric", "collocation"]`. These can be refined: polynomial collocation methods,
/// alone or with their symplectic partner, or the partner alone (Radau IA, Lobatto IIIB); compositions of implicit
/// midpoint steps; explicit symplectic pairs; all with at most 16 stages. Also tables of short fractions and surds
/// (Lobatto IIIC, Crouzeix's methods, RK4), and any other table of at most 6 stages and order 8 by its order
/// conditions. A `c` that is not the row sum is an error.
#[derive(Args)]
pub(crate) struct Arguments {
    /// Input file.
    #[arg(value_name = "FILE")]
    file: PathBuf,
    /// Significant digits of the coefficients [default: 40].
    #[arg(long, value_name = "D", value_parser = output::digits)]
    digits: Option<usize>,
    /// Format of the output.
    #[arg(long, value_enum, default_value = "text")]
    format: Format,
    /// Print the solution that was found, however far it is from the digits.
    #[arg(long)]
    nearest: bool,
}

/// Formats of a refined method.
#[derive(Clone, Copy, PartialEq, Eq, ValueEnum)]
enum Format {
    /// Readable text.
    Text,
    /// JSON for other programs.
    Json,
}

pub(crate) fn run(arguments: &Arguments) -> Result<ExitCode, Error> {
    let path = &arguments.file;
    let (name, text) = (path.display().to_string(), export::read_text(path)?);
    let digits = arguments.digits.unwrap_or(DEFAULT_DIGITS);
    let table = match arguments.nearest {
        true => refine_table_to_nearest(&name, &text)?,
        false => refine_table(&name, &text)?,
    };
    if let Some(table) = table {
        return print(&match arguments.format {
            Format::Text => table.text(digits)?,
            Format::Json => table.json(digits)?,
        });
    }
    let refinement = match arguments.nearest {
        true => refine_to_nearest(&name, &text)?,
        false => refine(&name, &text)?,
    };
    print(&match arguments.format {
        Format::Text => refinement.text(digits)?,
        Format::Json => refinement.json(digits)?,
    })
}
