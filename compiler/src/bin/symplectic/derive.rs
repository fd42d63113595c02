//! `symplectic derive`

use std::process::ExitCode;

use clap::Args;
use symplectic_compiler::{Error, derive_within};

use crate::output::{self, OutputOptions};

/// Derive the tableau of a basis at nodes, with proofs.
#[derive(Args)]
pub(crate) struct Arguments {
    /// `polynomial(s)`, or a list of polynomials in t: "1, t, t^2 - 1/3".
    #[arg(long, allow_hyphen_values = true)]
    basis: String,
    /// A rule such as `gauss(3)` (`symplectic list` shows all), or a list of rationals: "0, 1/3, 1".
    #[arg(long, allow_hyphen_values = true)]
    nodes: String,
    /// A name to put into the output.
    #[arg(long)]
    name: Option<String>,
    #[command(flatten)]
    output: OutputOptions,
}

pub(crate) fn run(arguments: &Arguments) -> Result<ExitCode, Error> {
    let limits = arguments.output.limits();
    let mut tableau = derive_within(&arguments.basis, &arguments.nodes, &limits)?;
    if let Some(name) = &arguments.name {
        tableau = tableau.named(name);
    }
    output::print(&arguments.output.write(&tableau))
}
