//! `symplectic run`, which is a program of its own: the other commands are built without the runtime library.

use std::ffi::OsString;
use std::io;
use std::path::Path;
use std::process::{Command, ExitCode};

use clap::Args;
use symplectic_compiler::{Error, ErrorKind};

const PROGRAM: &str = "symplectic-run";

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
    let mut command = program();
    become_program(command.args(&arguments.arguments)).map_err(|error| {
        let message = match error.kind() {
            io::ErrorKind::NotFound => format!(
                "the program `{PROGRAM}` is neither beside `symplectic` nor on the PATH: install it with `cargo install {PROGRAM}`"
            ),
            _ => format!("cannot start `{PROGRAM}`: {error}"),
        };
        ErrorKind::Document { message }.into()
    })
}

/// The program: built by cargo if cargo started this one in the repository, else beside this one, else on the PATH.
fn program() -> Command {
    let package = std::env::var_os("CARGO_MANIFEST_DIR")
        .map(|folder| Path::new(&folder).join("../../runtime/run/Cargo.toml"));
    if let (Some(cargo), Some(package)) = (
        std::env::var_os("CARGO"),
        package.filter(|file| file.exists()),
    ) {
        let mut command = Command::new(cargo);
        command
            .args(["run", "--quiet", "--manifest-path"])
            .arg(package);
        if !cfg!(debug_assertions) {
            command.arg("--release");
        }
        command.arg("--");
        return command;
    }
    let beside = std::env::current_exe().map(|program| {
        program.with_file_name(format!("{PROGRAM}{}", std::env::consts::EXE_SUFFIX))
    });
    match beside {
        Ok(program) if program.exists() => Command::new(program),
        _ => Command::new(PROGRAM),
    }
}

/// Goes on as another program, so that signals reach it.
#[cfg(unix)]
fn become_program(command: &mut Command) -> io::Result<ExitCode> {
    use std::os::unix::process::CommandExt;
    Err(command.exec())
}

#[cfg(not(unix))]
fn become_program(command: &mut Command) -> io::Result<ExitCode> {
    let code = command.status()?.code();
    Ok(ExitCode::from(
        code.and_then(|code| u8::try_from(code).ok()).unwrap_or(1),
    ))
}
