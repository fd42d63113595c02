//! `symplectic search`

use std::ffi::OsString;
use std::process::ExitCode;

use clap::Args;
use symplectic_compiler::Error;

use crate::program::Program;

/// Find splittings and compositions of a class and an order, and prove them.
///
/// This starts the program `symplectic-search`; `symplectic search --help` prints its options.
#[derive(Args)]
#[command(disable_help_flag = true)]
pub(crate) struct Arguments {
    /// Options.
    #[arg(
        value_name = "OPTIONS",
        trailing_var_arg = true,
        allow_hyphen_values = true
    )]
    arguments: Vec<OsString>,
}

pub(crate) fn run(arguments: &Arguments) -> Result<ExitCode, Error> {
    let program = Program {
        name: "symplectic-search",
        folder: "../search",
    };
    program.run(&arguments.arguments)
}
