//! The command `symplectic search`.

use std::process::ExitCode;

fn main() -> ExitCode {
    symplectic_search::command(std::env::args_os())
}
