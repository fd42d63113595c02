//! Commands that are programs of their own, so that the others are built without what these need.

use std::ffi::OsString;
use std::io;
use std::path::Path;
use std::process::{Command, ExitCode};

use symplectic_compiler::{Error, ErrorKind};

/// A program beside this one.
pub(crate) struct Program {
    /// Its name, and that of its package.
    pub(crate) name: &'static str,
    /// The folder of its package, from that of this one.
    pub(crate) folder: &'static str,
}

impl Program {
    /// Goes on as the program with these arguments.
    pub(crate) fn run(&self, arguments: &[OsString]) -> Result<ExitCode, Error> {
        become_program(self.command().args(arguments)).map_err(|error| {
            let name = self.name;
            let message = match error.kind() {
                io::ErrorKind::NotFound => format!(
                    "the program `{name}` is neither beside `symplectic` nor on the PATH: install it with `cargo install {name}`"
                ),
                _ => format!("cannot start `{name}`: {error}"),
            };
            ErrorKind::Document { message }.into()
        })
    }

    /// The program: built by cargo if cargo started this one in the repository, else beside this one, else on the PATH.
    fn command(&self) -> Command {
        let package = std::env::var_os("CARGO_MANIFEST_DIR")
            .map(|folder| Path::new(&folder).join(self.folder).join("Cargo.toml"));
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
            program.with_file_name(format!("{}{}", self.name, std::env::consts::EXE_SUFFIX))
        });
        match beside {
            Ok(program) if program.exists() => Command::new(program),
            _ => Command::new(self.name),
        }
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
