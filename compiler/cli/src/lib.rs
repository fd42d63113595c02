//! The command line: derive a tableau or the equations of a Hamiltonian, show and list known methods, emit integrators
//! as source code, check files, write certificates, refine printed coefficients, import tables of other libraries and
//! audit their claims, search for methods, run ensembles of a formula.
//!
//! Exit status: 0 for success; 1 if the entries of a file do not match, its digits are not certified, an audit finds an
//! unexplained difference or all trajectories of a run fail; 2 for invalid input.

mod audit;
mod certify;
mod check;
mod choice;
mod derive;
mod derive_system;
mod emit;
mod formula;
mod import;
mod list;
pub mod output;
mod program;
mod refine;
mod run;
mod search;
mod show;

use std::ffi::OsString;
use std::process::ExitCode;

use clap::{Parser, Subcommand};
use symplectic_terminal::errors;

/// Derives symplectic partitioned Runge–Kutta methods exactly and proves their properties.
#[derive(Parser)]
#[command(name = "symplectic", version, about, long_about = None)]
struct Cli {
    #[command(subcommand)]
    command: Command,
}

#[derive(Subcommand)]
enum Command {
    Derive(Box<derive::Arguments>),
    DeriveSystem(derive_system::Arguments),
    Emit(emit::Arguments),
    List(list::Arguments),
    Show(show::Arguments),
    Check(check::Arguments),
    Certify(certify::Arguments),
    Refine(refine::Arguments),
    Import(import::Arguments),
    Audit(audit::Arguments),
    Search(search::Arguments),
    Run(run::Arguments),
}

/// Runs the command with the arguments of a command line, whose first one is the name of the program. Wrong arguments end the
/// process.
pub fn command(arguments: impl IntoIterator<Item = OsString>) -> ExitCode {
    let outcome = match Cli::parse_from(arguments).command {
        Command::Derive(arguments) => derive::run(&arguments),
        Command::DeriveSystem(arguments) => derive_system::run(&arguments),
        Command::Emit(arguments) => emit::run(&arguments),
        Command::List(arguments) => list::run(&arguments),
        Command::Show(arguments) => show::run(&arguments),
        Command::Check(arguments) => check::run(&arguments),
        Command::Certify(arguments) => certify::run(&arguments),
        Command::Refine(arguments) => refine::run(&arguments),
        Command::Import(arguments) => import::run(&arguments),
        Command::Audit(arguments) => audit::run(&arguments),
        Command::Search(arguments) => search::run(&arguments),
        Command::Run(arguments) => run::run(&arguments),
    };
    errors::exit_code(outcome)
}
