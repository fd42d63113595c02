//! `symplectic run`

use std::ffi::OsString;
use std::process::ExitCode;

use clap::Args;
use symplectic_compiler::Error;

use crate::program::Program;

/// Integrate an ensemble of trajectories of a system given by its formula.
///
/// This starts the program `symplectic-run`; `symplectic run --help` prints its options.
#[derive(Args)]
#[command(disable_help_flag = true)]
pub(crate) struct Arguments {
    /// A TOML file and options.
    #[arg(
        value_name = "FILE",
        trailing_var_arg = true,
        allow_hyphen_values = true
    )]
    arguments: Vec<OsString>,
}

pub(crate) fn run(arguments: &Arguments) -> Result<ExitCode, Error> {
    let program = Program {
        name: "symplectic-run",
        folder: "../../runtime/run",
    };
    program.run(&arguments.arguments)
}
