//! `symplectic list`

use std::process::ExitCode;

use clap::Args;
use symplectic_compiler::{Error, FAMILIES, catalogue};

use crate::output;

/// List the methods of the catalogue and the quadrature rules.
#[derive(Args)]
pub(crate) struct Arguments {}

pub(crate) fn run(_: &Arguments) -> Result<ExitCode, Error> {
    let mut methods = vec![["name", "stages", "definition", "title"].map(str::to_owned)];
    methods.extend(catalogue::entries().map(|entry| {
        let others = entry.same_as();
        let title = if others.is_empty() {
            entry.title
        } else {
            format!("{} (also {})", entry.title, others.join(", "))
        };
        [
            entry.name,
            entry.stages.to_string(),
            entry.definition,
            title,
        ]
    }));
    let mut rules = vec![["nodes", "s from", "what they are"].map(str::to_owned)];
    rules.extend(FAMILIES.map(|family| {
        [
            format!("{}(s)", family.name),
            family.minimum.to_string(),
            family.description.to_owned(),
        ]
    }));
    let mut text = String::from("Methods, for `symplectic show NAME`\n\n");
    text.push_str(&aligned(&methods));
    text.push_str(
        "\nNodes, for `symplectic derive --nodes`; also any list of distinct numbers in [0, 1]\n\n",
    );
    text.push_str(&aligned(&rules));
    output::print(&text)
}

/// A table with its columns aligned.
fn aligned<const N: usize>(rows: &[[String; N]]) -> String {
    let length = |cell: &String| cell.chars().count();
    let mut widths = [0; N];
    for row in rows {
        for (width, cell) in widths.iter_mut().zip(row) {
            *width = length(cell).max(*width);
        }
    }
    let mut text = String::new();
    for row in rows {
        let cells = row.iter().zip(widths);
        let cells: Vec<String> = cells
            .map(|(cell, width)| format!("{cell:width$}"))
            .collect();
        text.push_str("  ");
        text.push_str(cells.join("  ").trim_end());
        text.push('\n');
    }
    text
}
