//! `symplectic derive`

use std::path::PathBuf;
use std::process::ExitCode;

use clap::{Arg, ArgAction, ArgMatches, Args, Command, FromArgMatches};
use symplectic_compiler::{Definition, Error, ErrorKind, Fitted, Key, check, export};
use symplectic_terminal::print;

use crate::output::{self, OutputOptions};

/// Derive a tableau with proofs: from a basis and nodes, a basis and a quadrature formula, coefficients, kicks and
/// drifts, or as a composition of methods.
///
/// Expressions contain numbers, t, pi, e, + - * / ^, sqrt, cbrt, sin, cos, tan, exp, cosh, sinh and root(p, k), the
/// k-th real root of a polynomial p in t.
#[derive(Args)]
pub(crate) struct Arguments {
    /// A TOML file with the definition instead of the options below.
    #[arg(value_name = "FILE")]
    file: Option<PathBuf>,
    #[command(flatten)]
    definition: Parts,
    /// A number for a parameter: `--at w=3`. Without it, the coefficients are functions of the parameter.
    #[arg(
        long,
        value_name = "NAME=NUMBER",
        conflicts_with = "file",
        allow_hyphen_values = true
    )]
    at: Vec<String>,
    /// Name for the output.
    #[arg(long)]
    name: Option<String>,
    #[command(flatten)]
    output: OutputOptions,
}

pub(crate) fn run(arguments: &Arguments) -> Result<ExitCode, Error> {
    let limits = arguments.output.limits();
    let mut tableau = match &arguments.file {
        Some(path) => check(
            &path.display().to_string(),
            &export::read_text(path)?,
            &limits,
        )?,
        None => match arguments.at.as_slice() {
            [] if arguments.definition.0.get(Key::Parameters).is_some() => {
                return fitted(arguments);
            }
            [] => arguments.definition.0.derive(&limits)?,
            at => at_numbers(&arguments.definition.0, at)?.derive(&limits)?,
        },
    };
    if let Some(name) = &arguments.name {
        tableau = tableau.named(name);
    }
    output::warn_if_inconsistent(&tableau);
    output::warn_of_wrong_digits(&tableau);
    print(&arguments.output.write(&tableau)?)
}

/// Derives and prints a method whose coefficients are functions of its parameter.
fn fitted(arguments: &Arguments) -> Result<ExitCode, Error> {
    let mut fitted = Fitted::derive(&arguments.definition.0, &arguments.output.limits())?;
    if let Some(name) = &arguments.name {
        fitted = fitted.named(name);
    }
    print(&arguments.output.write_fitted(&fitted)?)
}

/// The definition with the numbers of `--at w=3`.
fn at_numbers(definition: &Definition, at: &[String]) -> Result<Definition, Error> {
    let pairs = at.iter().map(|text| {
        text.split_once('=').ok_or_else(|| {
            let message =
                format!("`--at {text}`: expected a name and a number, such as `--at w=3`");
            Error::from(ErrorKind::Definition { message })
        })
    });
    definition.at(&pairs.collect::<Result<Vec<_>, _>>()?)
}

/// The parts of a definition, one option per [`Key`].
struct Parts(Definition);

impl Args for Parts {
    fn augment_args(command: Command) -> Command {
        command.args(Key::ALL.map(|key| {
            let option = Arg::new(key.name())
                .long(key.name().replace('_', "-"))
                .help(key.help())
                .conflicts_with("file");
            match key.value_name() {
                None => option.action(ArgAction::SetTrue),
                Some(value) => option.value_name(value).allow_hyphen_values(true),
            }
        }))
    }

    fn augment_args_for_update(command: Command) -> Command {
        Parts::augment_args(command)
    }
}

impl FromArgMatches for Parts {
    fn from_arg_matches(matches: &ArgMatches) -> Result<Self, clap::Error> {
        let text = |key: Key| match key.is_switch() {
            true => matches.get_flag(key.name()).then_some("true"),
            // The text may come from a file with a byte-order mark: `--weights "$(cat weights.txt)"`.
            false => matches
                .get_one::<String>(key.name())
                .map(|text| export::without_mark(text)),
        };
        let given = Key::ALL.into_iter();
        let given = given.filter_map(|key| Some((key, text(key)?)));
        Ok(Parts(Definition::new(given)))
    }

    fn update_from_arg_matches(&mut self, matches: &ArgMatches) -> Result<(), clap::Error> {
        *self = Parts::from_arg_matches(matches)?;
        Ok(())
    }
}
