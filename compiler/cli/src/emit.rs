//! `symplectic emit`

use std::path::{Path, PathBuf};
use std::process::ExitCode;

use clap::{Args, ValueEnum};
use symplectic_compiler::{Error, Tableau, catalogue, check, export};
use symplectic_terminal::print;
use symplectic_tools::{SteppedClass, Stepper};

use crate::{formula, output};

/// Write a program that takes steps with a method: one file without dependencies.
///
/// A splitting becomes a sequence of drifts and kicks; other methods solve for their stages by fixed-point iteration. The programs in C,
/// Rust and Python give the same results to the last bit. With `--system` the program contains the velocity and the force of a formula;
/// otherwise you write these two functions.
#[derive(Args)]
pub(crate) struct Arguments {
    /// A method of the catalogue, or a TOML file with a definition as `derive` reads it.
    #[arg(value_name = "METHOD")]
    method: String,
    /// Programming language.
    #[arg(long, value_enum)]
    language: Language,
    /// Class of Hamiltonians [default: separable for splittings, general for other methods].
    #[arg(long, value_enum)]
    class: Option<Class>,
    /// A file with the formula of a system, as for `derive-system`: the program also contains its velocity, force and energy.
    #[arg(long, value_name = "FILE")]
    system: Option<PathBuf>,
    /// Largest number of stages to derive [default: 36].
    #[arg(long, value_name = "S", value_parser = clap::value_parser!(u16).range(1..=1000))]
    max_stages: Option<u16>,
}

#[derive(Debug, Clone, Copy, PartialEq, Eq, ValueEnum)]
enum Language {
    /// C99.
    C,
    /// Rust, without the standard library.
    Rust,
    /// Julia.
    Julia,
    /// Python.
    Python,
}

#[derive(Debug, Clone, Copy, PartialEq, Eq, ValueEnum)]
enum Class {
    /// Every H(t, q, p).
    General,
    /// H = T(t, p) + U(t, q).
    Separable,
}

pub(crate) fn run(arguments: &Arguments) -> Result<ExitCode, Error> {
    let tableau = method(arguments)?;
    let language = match arguments.language {
        Language::C => Stepper::C,
        Language::Rust => Stepper::Rust,
        Language::Julia => Stepper::Julia,
        Language::Python => Stepper::Python,
    };
    let class = arguments.class.map(|class| match class {
        Class::General => SteppedClass::General,
        Class::Separable => SteppedClass::Separable,
    });
    output::warn_if_inconsistent(&tableau);
    print(&match &arguments.system {
        None => language.write(&tableau, class)?,
        Some(file) => {
            let (system, structure) = formula::read(file)?;
            language.write_with_system(&tableau, class, &system, &structure)?
        }
    })
}

/// The method of the catalogue, or of a file.
fn method(arguments: &Arguments) -> Result<Tableau, Error> {
    let name = &arguments.method;
    if let Some(entry) = catalogue::find(name) {
        return entry.derive_within(&match arguments.max_stages {
            None => entry.limits(),
            given => output::limits(given),
        });
    }
    let path = Path::new(name);
    if path.extension().is_none() && !path.exists() {
        return Err(catalogue::unknown(name));
    }
    let limits = output::limits(arguments.max_stages);
    check(name, &export::read_text(path)?, &limits)
}
