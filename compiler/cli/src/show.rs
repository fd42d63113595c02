//! `symplectic show`

use std::process::ExitCode;

use clap::Args;
use symplectic_compiler::{Error, catalogue};
use symplectic_terminal::print;

use crate::output::OutputOptions;

/// Show a method of the catalogue.
#[derive(Args)]
pub(crate) struct Arguments {
    /// Name from `symplectic list`.
    name: String,
    #[command(flatten)]
    output: OutputOptions,
}

pub(crate) fn run(arguments: &Arguments) -> Result<ExitCode, Error> {
    let name = &arguments.name;
    let entry = catalogue::find(name).ok_or_else(|| catalogue::unknown(name))?;
    let tableau = entry.derive_within(&arguments.output.limits_of(&entry))?;
    print(&arguments.output.write(&tableau)?)
}
