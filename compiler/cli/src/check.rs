//! `symplectic check`

use std::path::{Path, PathBuf};
use std::process::ExitCode;

use clap::{Args, ValueEnum};
use serde_json::{Value, json};
use symplectic_compiler::order::HamiltonianClass;
use symplectic_compiler::stability::StableSteps;
use symplectic_compiler::{Error, Limits, Tableau, check_and_list, export};
use symplectic_terminal::{errors, print};

use crate::output;

/// Derive the tableaux of files again, prove their properties and compare every entry.
///
/// The printed numbers of a `claim` are compared with the exact method. A warning shows each number that is not the
/// correctly rounded exact coefficient, and the verdict counts them.
#[derive(Args)]
pub(crate) struct Arguments {
    /// Files written by `derive` or `show` with `--format toml` or `--format json`.
    #[arg(required = true, value_name = "FILE")]
    files: Vec<PathBuf>,
    /// Format of the report: a line per file, or JSON with the tableau of each file.
    #[arg(long, value_enum, default_value = "text")]
    format: Format,
    /// Largest number of stages of a file [default: 36].
    #[arg(long, value_name = "S", value_parser = clap::value_parser!(u16).range(1..=1000))]
    max_stages: Option<u16>,
}

/// The formats of a report.
#[derive(Clone, Copy, PartialEq, ValueEnum)]
enum Format {
    Text,
    Json,
}

/// Checks every file; the exit status is the largest of all files.
pub(crate) fn run(arguments: &Arguments) -> Result<ExitCode, Error> {
    let limits = output::limits(arguments.max_stages);
    let mut status = 0;
    let mut results = Vec::new();
    for path in &arguments.files {
        let name = path.display().to_string();
        let outcome = check_file(path, &limits);
        match &outcome {
            Ok((tableau, _)) => output::warn_of_wrong_digits(tableau),
            Err(error) => {
                errors::to_stderr(error);
                status = errors::status(error).max(status);
            }
        }
        if arguments.format == Format::Json {
            results.push(entry(&name, &outcome));
            continue;
        }
        let verdict = match &outcome {
            Ok((tableau, not_stated)) => format!(
                "{}, {}{}",
                verdict(tableau),
                facts(tableau),
                added(tableau, not_stated)
            ),
            Err(error) => format!("FAILED, {}", error.kind),
        };
        // File names may contain control characters, such as line breaks.
        let line: String = format!("{name}: {verdict}")
            .chars()
            .map(|c| {
                if c.is_control() || is_direction(c) {
                    '\u{fffd}'
                } else {
                    c
                }
            })
            .collect();
        print(&format!("{line}\n"))?;
    }
    if arguments.format == Format::Json {
        let text = Value::Array(results);
        print(&format!("{text:#}\n"))?;
    }
    Ok(ExitCode::from(status))
}

/// Whether a character changes the text direction.
fn is_direction(c: char) -> bool {
    matches!(c, '\u{200e}' | '\u{200f}' | '\u{202a}'..='\u{202e}' | '\u{2066}'..='\u{2069}')
}

/// The JSON entry of a file: its tableau as written by `derive`, or the error.
fn entry(name: &str, outcome: &Result<Checked, Error>) -> Value {
    match outcome {
        Ok((tableau, not_stated)) => {
            let wrong = tableau.wrong_digits().iter();
            let wrong: Vec<String> = wrong.map(ToString::to_string).collect();
            let text = export::json::write(tableau, export::DEFAULT_DIGITS);
            let tableau: Value = serde_json::from_str(&text).unwrap_or_default();
            json!({ "file": name, "ok": true, "wrong_digits": wrong, "not_stated": not_stated, "tableau": tableau })
        }
        Err(error) => json!({ "file": name, "ok": false, "error": error.to_string() }),
    }
}

/// A tableau, and the properties that its file does not state.
type Checked = (Tableau, Vec<&'static str>);

fn check_file(path: &Path, limits: &Limits) -> Result<Checked, Error> {
    let name = path.display().to_string();
    let text = export::read_text(path)?;
    check_and_list(&name, &text, limits)
}

/// The verdict on a file: the number of wrong digits in its claim, and whether the method is consistent.
fn verdict(tableau: &Tableau) -> String {
    let verdict = match tableau.wrong_digits().len() {
        0 => "ok".to_owned(),
        1 => "ok apart from the digits of 1 printed number".to_owned(),
        count => format!("ok apart from the digits of {count} printed numbers"),
    };
    let consistent = tableau.properties().consistent;
    match consistent.witness.filter(|_| !consistent.holds) {
        Some(witness) => format!("{verdict} but not consistent: {witness}"),
        None => verdict,
    }
}

/// The properties that a file of an older format does not state.
fn added(tableau: &Tableau, not_stated: &[&str]) -> String {
    let properties = tableau.properties();
    let missing = properties.all().into_iter();
    let missing = missing.filter(|(name, _)| not_stated.contains(name));
    let missing: Vec<String> = missing
        .map(|(name, property)| {
            let holds = if property.holds { "yes" } else { "no" };
            format!("{name} {holds}")
        })
        .collect();
    match missing.is_empty() {
        true => String::new(),
        false => format!("; not in the file: {}", missing.join(", ")),
    }
}

/// The name, the orders and the stability of a tableau, in one line.
fn facts(tableau: &Tableau) -> String {
    let called = tableau.name().unwrap_or("a tableau without a name");
    let stages = match tableau.stages() {
        1 => "1 stage".to_owned(),
        stages => format!("{stages} stages"),
    };
    let report = tableau.orders();
    let orders = HamiltonianClass::ALL.map(|class| {
        let order = output::order(report.class(class));
        format!("{class} {order}")
    });
    let perturbed = match tableau.perturbed_order() {
        Some(found) => format!(", perturbed {}", found.numbers()),
        None => String::new(),
    };
    let stable = match tableau.stable_steps() {
        StableSteps::NotComputed | StableSteps::NotDecided { .. } => String::new(),
        steps => format!(", stable for hω in {steps}"),
    };
    format!(
        "{called} with {stages}, order {}{perturbed}{stable}",
        orders.join(", ")
    )
}
