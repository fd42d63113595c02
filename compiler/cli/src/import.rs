//! `symplectic import`

use std::path::PathBuf;
use std::process::ExitCode;

use clap::{Args, ValueEnum};
use symplectic_compiler::{Error, ErrorKind, Library, export};
use symplectic_terminal::{errors, print};
use symplectic_tools::{OwnNames, import_own, import_with_origin};

use crate::output::{self, OutputOptions};

/// Import a table of another library, by that library's convention for the numbers of its tables.
///
/// The file contains one table, in the language of the library: Julia's `1//2` and `big"0.5"`, C's `0x1.8p-1`,
/// Fortran's `1.0d0` and `0.5_real64`, Mathematica's "1.5`20", Python's `Fraction(1, 2)`, Matlab's `[1 2; 3 4]`.
/// Splittings use the library's letters for drifts and kicks; Runge–Kutta methods use `A` or `a`, `b`, and optionally
/// `c`, `a_tilde`, `b_tilde`. Tables with other names are read with `--drift`, `--kick` and `--first`, or with `--weights` and
/// `--base`, in the language of `--from` or of the file's extension. For rounded decimals the result is an exact method proved to be near them; standard error
/// shows the distance.
#[derive(Args)]
pub(crate) struct Arguments {
    /// Library: sciml, sundials, petsc, petsc-kick-first, rungekutta.jl, odeint, nodepy, mathematica, principia,
    /// rebound, pyhamsys or pyhamsys-drift-first.
    #[arg(long, value_name = "LIBRARY", required_unless_present_any = ["drift", "weights"])]
    from: Option<String>,
    /// The list of the drifts, q += drift_i h dT/dp.
    #[arg(long, value_name = "NAME", requires = "kick")]
    drift: Option<String>,
    /// The list of the kicks, p -= kick_i h dU/dq.
    #[arg(long, value_name = "NAME", requires = "drift")]
    kick: Option<String>,
    /// What comes first; where one list is longer, it is that one.
    #[arg(long, value_enum, requires = "drift")]
    first: Option<Flow>,
    /// The list of the weights of a composition of `--base`.
    #[arg(long, value_name = "NAME", conflicts_with = "drift")]
    weights: Option<String>,
    /// The method that the weights compose: a name of `symplectic list`, or a definition in brackets.
    #[arg(
        long,
        value_name = "METHOD",
        requires = "weights",
        default_value = "velocity-verlet"
    )]
    base: String,
    /// The lists are the first half of a step that is the same from both ends; what is in the middle is written once. The weight in
    /// the middle of a composition may be the first or missing, too.
    #[arg(long)]
    symmetric: bool,
    /// The file.
    #[arg(value_name = "FILE")]
    file: PathBuf,
    /// Name for the output.
    #[arg(long)]
    name: Option<String>,
    #[command(flatten)]
    output: OutputOptions,
}

/// What a step begins with.
#[derive(Clone, Copy, PartialEq, Eq, ValueEnum)]
enum Flow {
    /// A drift.
    Drift,
    /// A kick.
    Kick,
}

impl Arguments {
    /// The names of the table's own lists.
    fn own_names(&self) -> Option<OwnNames> {
        let symmetric = self.symmetric;
        if let Some(weights) = &self.weights {
            return Some(OwnNames::Composition {
                base: self.base.clone(),
                weights: weights.clone(),
                symmetric,
            });
        }
        Some(OwnNames::Splitting {
            drift: self.drift.clone()?,
            kick: self.kick.clone()?,
            drifts_first: self.first.map(|first| first == Flow::Drift),
            symmetric,
        })
    }
}

pub(crate) fn run(arguments: &Arguments) -> Result<ExitCode, Error> {
    let library = arguments.from.as_deref().map(Library::find).transpose()?;
    let text = export::read_text(&arguments.file)?;
    let file = arguments.file.display().to_string();
    let limits = arguments.output.limits();
    let (mut tableau, origin) = match (arguments.own_names(), library) {
        (Some(names), _) => import_own(&names, library, &file, &text, &limits)?,
        (None, Some(library)) if !arguments.symmetric => {
            import_with_origin(library, &file, &text, &limits)?
        }
        (None, _) => {
            let message = "`--symmetric` is for tables that are read with `--drift` and `--kick` or with `--weights`";
            let message = message.to_owned();
            return Err(ErrorKind::Document { message }.into());
        }
    };
    if let Some(note) = origin.note() {
        errors::warning(&note);
    }
    if let Some(name) = &arguments.name {
        tableau = tableau.named(name);
    }
    output::warn_if_inconsistent(&tableau);
    print(&arguments.output.write(&tableau)?)
}
