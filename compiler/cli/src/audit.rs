//! `symplectic audit`

use std::path::{Path, PathBuf};
use std::process::ExitCode;

use clap::Args;
use symplectic_compiler::{Error, ErrorKind, export};
use symplectic_terminal::{aligned, print};
use symplectic_tools::audit::{Audit, Row, Verdict};

use crate::output;

/// Compare the claims of libraries about their tables with proofs.
///
/// A file contains the library, its version and source, the `convention` by which it uses the numbers of its tables, or
/// `[steps]`, which names their lists, and these tables with their claims; `tableaux/libraries/` contains such files. Next to each
/// proved order the output shows the order observed in steps of a pendulum of its class. The exit status is 1 if a proved order
/// differs from the observed order.
#[derive(Args)]
pub(crate) struct Arguments {
    /// Files, or folders with files named .toml.
    #[arg(required = true, value_name = "FILE")]
    paths: Vec<PathBuf>,
    /// Write the results as JSON.
    #[arg(long, value_name = "FILE")]
    json: Option<PathBuf>,
    /// Write the results as an HTML page.
    #[arg(long, value_name = "FILE")]
    html: Option<PathBuf>,
    /// Largest number of stages of a table [default: 36].
    #[arg(long, value_name = "S", value_parser = clap::value_parser!(u16).range(1..=1000))]
    max_stages: Option<u16>,
}

pub(crate) fn run(arguments: &Arguments) -> Result<ExitCode, Error> {
    let limits = output::limits(arguments.max_stages);
    let mut audit = Audit::default();
    let inputs = files(&arguments.paths)?;
    let results: Vec<&Path> = [&arguments.json, &arguments.html]
        .into_iter()
        .filter_map(Option::as_deref)
        .collect();
    output::refuse_overwriting(inputs.iter().map(PathBuf::as_path), &results)?;
    for path in inputs {
        let text = export::read_text(&path)?;
        audit.add(&path.display().to_string(), &text, &limits)?;
    }
    for (path, text) in [
        (&arguments.json, Audit::json as fn(&Audit) -> String),
        (&arguments.html, Audit::html),
    ] {
        if let Some(path) = path {
            output::write_file(path, &text(&audit))?;
        }
    }
    let header = [
        "library",
        "table",
        "claim",
        "every H",
        "T(p) + U(q)",
        "T quadratic",
        "observed for each",
        "",
    ]
    .map(str::to_owned);
    let rows: Vec<_> = std::iter::once(header)
        .chain(audit.rows.iter().map(line))
        .collect();
    let unexplained = audit.unexplained().count();
    print(&format!(
        "{}\n{} tables; for {} the proved order is not the claimed order, {unexplained} unexplained\n",
        aligned(&rows),
        audit.rows.len(),
        audit.differences().count(),
    ))?;
    Ok(ExitCode::from(u8::from(unexplained > 0)))
}

/// All files in a list of files and folders.
fn files(paths: &[PathBuf]) -> Result<Vec<PathBuf>, Error> {
    let mut files = Vec::new();
    for path in paths {
        if !path.is_dir() {
            files.push(path.clone());
            continue;
        }
        let unreadable =
            |error: std::io::Error| document(format!("cannot read `{}`: {error}", path.display()));
        let mut found = Vec::new();
        for entry in std::fs::read_dir(path).map_err(unreadable)? {
            let file = entry.map_err(unreadable)?.path();
            if file
                .extension()
                .is_some_and(|extension| extension == "toml")
            {
                found.push(file);
            }
        }
        if found.is_empty() {
            return Err(document(format!(
                "`{}` has no files named .toml",
                path.display()
            )));
        }
        found.sort();
        files.extend(found);
    }
    Ok(files)
}

fn document(message: String) -> Error {
    ErrorKind::Document { message }.into()
}

/// A name without control characters, which could move the cursor or change colours.
fn shown(name: &str) -> String {
    name.replace(|c: char| c.is_control(), "\u{fffd}")
}

fn line(row: &Row) -> [String; 8] {
    let seen = |seen: Option<f64>| seen.map_or("–".to_owned(), |seen| format!("{seen:.2}"));
    let verdict = match row.verdict {
        Verdict::AsClaimed => "",
        Verdict::LessThanClaimed => "less than claimed",
        Verdict::MoreThanClaimed => "more than claimed",
    };
    let unexplained = if row.explained { "" } else { " UNEXPLAINED" };
    [
        shown(&row.library),
        shown(&row.name),
        format!("{} {}", row.claim.order, row.claim.class),
        row.general.order.to_string(),
        row.separable.order.to_string(),
        row.nystrom.order.to_string(),
        [row.seen_coupled, row.seen_relativistic, row.seen_quadratic]
            .map(seen)
            .join(", "),
        format!("{verdict}{unexplained}"),
    ]
}
