//! The command `symplectic run`.

use std::process::ExitCode;

fn main() -> ExitCode {
    symplectic_run::command(std::env::args_os())
}
