//! `symplectic check`

use std::path::{Path, PathBuf};
use std::process::ExitCode;

use clap::Args;
use symplectic_compiler::export::STABILITY_STAGES;
use symplectic_compiler::order::HamiltonianClass;
use symplectic_compiler::{Error, Limits, check, export};

use crate::output;
use crate::report;

/// Derive the tableaux of files anew, prove their properties and compare every entry.
#[derive(Args)]
pub(crate) struct Arguments {
    /// Files written by `derive` or `show` with `--format toml` or `--format json`.
    #[arg(required = true, value_name = "FILE")]
    files: Vec<PathBuf>,
    /// The most stages that a file may have.
    #[arg(long, value_name = "S", value_parser = clap::value_parser!(u16).range(1..=1000))]
    max_stages: Option<u16>,
}

/// Checks every file; the exit status is that of the worst.
pub(crate) fn run(arguments: &Arguments) -> Result<ExitCode, Error> {
    let limits = output::limits(arguments.max_stages);
    let mut status = 0;
    for path in &arguments.files {
        let name = path.display();
        let line = match check_file(path, &limits) {
            Ok(verdict) => format!("{name}: ok, {verdict}\n"),
            Err(error) => {
                report::to_stderr(&error);
                status = report::status(&error).max(status);
                format!("{name}: FAILED, {}\n", error.kind)
            }
        };
        output::print(&line)?;
    }
    Ok(ExitCode::from(status))
}

fn check_file(path: &Path, limits: &Limits) -> Result<String, Error> {
    let name = path.display().to_string();
    let text = export::read_text(path)?;
    let tableau = check(&name, &text, limits)?;
    let called = tableau.name().unwrap_or("a tableau without a name");
    let stages = match tableau.stages() {
        1 => "1 stage".to_owned(),
        stages => format!("{stages} stages"),
    };
    let report = tableau.orders();
    let orders = HamiltonianClass::ALL.map(|class| {
        let found = report.class(class);
        let at_least = if found.refuted_by.is_none() {
            "≥ "
        } else {
            ""
        };
        format!("{class} {at_least}{}", found.order)
    });
    let stable = if tableau.stages() > STABILITY_STAGES {
        String::new()
    } else {
        let intervals = tableau.stability().intervals_text();
        format!(", stable for hω in {intervals}")
    };
    Ok(format!(
        "{called} with {stages}, order {}{stable}",
        orders.join(", ")
    ))
}
