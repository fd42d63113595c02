//! The command `symplectic`.

use std::process::ExitCode;

fn main() -> ExitCode {
    symplectic_cli::command(std::env::args_os())
}
