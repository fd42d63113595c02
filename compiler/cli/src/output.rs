//! Formats and output.

use std::path::{Path, PathBuf};

use clap::{Args, ValueEnum};
use symplectic_compiler::catalogue::Entry;
use symplectic_compiler::export::{self, DEFAULT_DIGITS, MAX_DIGITS, TEXT_DIGITS};
use symplectic_compiler::order::ClassOrder;
use symplectic_compiler::{Error, ErrorKind, Fitted, Limits, Tableau};

use symplectic_terminal::errors;
use symplectic_tools::Language;

/// An order, with "≥" if only a lower bound is known, and a dash for a class that the method does not step.
pub(crate) fn order(found: &ClassOrder) -> String {
    if !found.exists() {
        return "–".to_owned();
    }
    let at_least = if found.refuted_by.is_none() {
        "≥ "
    } else {
        ""
    };
    format!("{at_least}{}", found.order)
}

/// Formats of a tableau.
#[derive(Debug, Clone, Copy, PartialEq, Eq, ValueEnum)]
pub enum Format {
    /// A readable table.
    Text,
    /// The lossless exchange format.
    Toml,
    /// JSON for other programs.
    Json,
    /// A LaTeX table with booktabs.
    Latex,
    /// C99: static constants.
    C,
    /// Fortran 2008: a module of parameters.
    Fortran,
    /// Julia: a named tuple, for RungeKutta.jl, DiffEqBase.jl and RootedTrees.jl.
    Julia,
    /// Python: exact or long numbers, for fractions, mpmath and numpy.
    Python,
    /// C: a table for ARKODE.
    Sundials,
    /// C: a method for TS.
    Petsc,
    /// Python: a RungeKuttaMethod with SymPy entries.
    Nodepy,
    /// Tab-separated doubles for `from_file` of RungeKutta.jl.
    Tsv,
    /// A theorem for the proof assistant Coq.
    Coq,
}

/// Significant digits that identify a double.
const DOUBLE_DIGITS: usize = 17;

/// The options of `derive` and `show`.
#[derive(Args)]
pub(crate) struct OutputOptions {
    /// Format of the output.
    #[arg(long, value_enum, default_value_t = Format::Text)]
    format: Format,
    /// Significant digits of decimals [default: 40, in text and LaTeX 16, in C and Fortran 17].
    #[arg(long, value_name = "D", value_parser = digits)]
    digits: Option<usize>,
    /// Largest number of stages to derive [default: 36].
    #[arg(long, value_name = "S", value_parser = clap::value_parser!(u16).range(1..=1000))]
    max_stages: Option<u16>,
}

impl OutputOptions {
    pub(crate) fn limits(&self) -> Limits {
        limits(self.max_stages)
    }

    /// The limits for a method of the catalogue: its own, unless the user sets a limit.
    pub(crate) fn limits_of(&self, entry: &Entry) -> Limits {
        match self.max_stages {
            None => entry.limits(),
            given => limits(given),
        }
    }

    /// Writes a method whose coefficients are functions of a frequency.
    ///
    /// # Errors
    /// Formats other than text and JSON; `--digits`; coefficients without a limit.
    pub(crate) fn write_fitted(&self, fitted: &Fitted) -> Result<String, Error> {
        let w = fitted.parameter();
        let refused = |what: &str| -> Error {
            let message = format!(
                "{what} needs numbers, and with `parameters` the coefficients are functions of `{w}`: give it a number by \
                 `--at {w}=3`, or take `--format text` or `json`"
            );
            ErrorKind::Definition { message }.into()
        };
        if self.digits.is_some() {
            return Err(refused("`--digits`"));
        }
        match self.format {
            Format::Text => Ok(export::fitted::text(fitted)?),
            Format::Json => Ok(export::fitted::json(fitted)?),
            _ => Err(refused("this format")),
        }
    }

    /// Writes a tableau.
    ///
    /// # Errors
    /// Those of [`write`].
    pub(crate) fn write(&self, tableau: &Tableau) -> Result<String, Error> {
        write(tableau, self.format, self.digits)
    }
}

/// Writes a tableau in a format, with a number of significant digits or the default number of the format.
///
/// # Errors
/// If the digits cannot be computed in bounded time, or the language cannot express the method.
pub fn write(tableau: &Tableau, format: Format, wanted: Option<usize>) -> Result<String, Error> {
    let digits = |default| wanted.unwrap_or(default);
    let most = export::most_digits(tableau);
    if let Some(wanted) = wanted.filter(|&wanted| wanted > most) {
        let stages = tableau.stages();
        let message = format!(
            "{wanted} digits take too long for a method with {stages} stages: for this method `--digits` may be up to {most}"
        );
        return Err(ErrorKind::Definition { message }.into());
    }
    let in_language = |language: Language, default| language.write(tableau, digits(default));
    Ok(match format {
        Format::Text => {
            let table = export::text::write(tableau, digits(TEXT_DIGITS));
            format!("{table}\n{}", export::text::write_facts(tableau))
        }
        Format::Toml => export::toml::write(tableau, digits(DEFAULT_DIGITS)),
        Format::Json => export::json::write(tableau, digits(DEFAULT_DIGITS)),
        Format::Latex => in_language(Language::Latex, TEXT_DIGITS)?,
        Format::C => in_language(Language::C, DOUBLE_DIGITS)?,
        Format::Fortran => in_language(Language::Fortran, DOUBLE_DIGITS)?,
        Format::Julia => in_language(Language::Julia, DEFAULT_DIGITS)?,
        Format::Python => in_language(Language::Python, DEFAULT_DIGITS)?,
        Format::Sundials => in_language(Language::Sundials, DOUBLE_DIGITS)?,
        Format::Petsc => in_language(Language::Petsc, DOUBLE_DIGITS)?,
        Format::Tsv => in_language(Language::Tsv, DOUBLE_DIGITS)?,
        Format::Coq => in_language(Language::Coq, DEFAULT_DIGITS)?,
        Format::Nodepy => in_language(Language::Nodepy, DEFAULT_DIGITS)?,
    })
}

pub(crate) fn limits(max_stages: Option<u16>) -> Limits {
    max_stages.map_or_else(Limits::default, Limits::at_most)
}

/// Reads a number of digits.
pub(crate) fn digits(text: &str) -> Result<usize, String> {
    text.parse()
        .ok()
        .filter(|digits| (1..=MAX_DIGITS).contains(digits))
        .ok_or_else(|| format!("expected a whole number from 1 to {MAX_DIGITS}"))
}

/// Warns on standard error if a method is not consistent, which is hardly intended.
pub(crate) fn warn_if_inconsistent(tableau: &Tableau) {
    let consistent = tableau.properties().consistent;
    if !consistent.holds {
        let witness = consistent.witness.as_deref().unwrap_or_default();
        errors::warning(&format!(
            "the method is not consistent, of order 0: {witness}"
        ));
    }
}

/// Warns on standard error about each printed number of a claim that the exact coefficient does not round to.
pub(crate) fn warn_of_wrong_digits(tableau: &Tableau) {
    tableau.wrong_digits().iter().for_each(errors::warning_at);
}

/// Writes a file.
pub(crate) fn write_file(path: &Path, text: &str) -> Result<(), Error> {
    std::fs::write(path, text)
        .map_err(|error| document(format!("cannot write `{}`: {error}", path.display())))
}

/// Refuses results that would overwrite an input or another result.
pub(crate) fn refuse_overwriting<'a>(
    inputs: impl IntoIterator<Item = &'a Path>,
    results: &[&Path],
) -> Result<(), Error> {
    // A file that does not exist yet is identified by its folder and name.
    let known = |path: &Path| -> Option<PathBuf> {
        path.canonicalize().ok().or_else(|| {
            let folder = path
                .parent()
                .filter(|folder| !folder.as_os_str().is_empty());
            let folder = folder.unwrap_or(Path::new(".")).canonicalize().ok()?;
            Some(folder.join(path.file_name()?))
        })
    };
    let mut taken: Vec<Option<PathBuf>> = inputs.into_iter().map(known).collect();
    for path in results {
        let place = known(path);
        if place.is_some() && taken.contains(&place) {
            return Err(document(format!(
                "the output `{}` would overwrite an input or the other output: give another name",
                path.display()
            )));
        }
        taken.push(place);
    }
    Ok(())
}

fn document(message: String) -> Error {
    ErrorKind::Document { message }.into()
}
