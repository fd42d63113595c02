//! The command line: derive a tableau or the equations of a Hamiltonian, show and list known methods, write programs that take
//! their steps, check files, write certificates, refine printed coefficients, read tables of other libraries and hold their claims
//! against proofs, run ensembles of a formula.
//!
//! Exit status: 0; 1 where a file's entries do not fit, or its digits are not those of a method as claimed; 2 for bad input.

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
mod output;
mod refine;
mod report;
mod run;
mod show;

use std::process::ExitCode;

use clap::{Parser, Subcommand};

/// Derives symplectic partitioned Runge–Kutta methods exactly and proves what they are.
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
    Run(run::Arguments),
}

fn main() -> ExitCode {
    let outcome = match Cli::parse().command {
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
        Command::Run(arguments) => run::run(&arguments),
    };
    outcome.unwrap_or_else(|error| {
        report::to_stderr(&error);
        ExitCode::from(report::status(&error))
    })
}
