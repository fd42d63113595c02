//! Fortran 2008.

use super::table::{Entry, Table, comments};

/// A statement has 255 continuation lines at most.
const LONGEST_STATEMENT: usize = 250;

pub(super) fn write(table: &Table<'_>) -> String {
    let stages = table.tableau.stages();
    let module = format!("{}_tableau", table.name);
    let mut text = comments("!", &table.description());
    text.push_str(&format!(
        "module {module}\n  use, intrinsic :: iso_fortran_env, only: real64\n  implicit none\n"
    ));
    for (vector, entries) in table.vectors() {
        if entries.len() <= LONGEST_STATEMENT {
            text.push_str(&array("real(real64), parameter", vector, entries));
            continue;
        }
        let parts = entries.chunks(LONGEST_STATEMENT);
        let names = joined(&mut text, vector, parts);
        text.push_str(&format!(
            "\n  real(real64), parameter :: {vector}({}) = [ &\n    {names} &\n  ]\n",
            entries.len()
        ));
    }
    for (matrix, rows) in table.matrices() {
        let names = joined(&mut text, matrix, rows.iter().map(Vec::as_slice));
        text.push_str(&format!(
            "\n  real(real64), parameter :: {matrix}({stages}, {stages}) = reshape([ &\n    {names} &\n  ], [{stages}, {stages}], order=[2, 1])\n"
        ));
    }
    text.push_str(&format!("end module {module}\n"));
    text
}

/// Writes the parts of a vector or matrix as private arrays; returns their names as a list.
fn joined<'a>(text: &mut String, name: &str, parts: impl Iterator<Item = &'a [Entry]>) -> String {
    let mut names = Vec::new();
    for (i, part) in (1..).zip(parts) {
        let name = format!("{name}_{i}");
        text.push_str(&array("real(real64), parameter, private", &name, part));
        names.push(name);
    }
    names.join(", &\n    ")
}

fn array(attributes: &str, name: &str, entries: &[Entry]) -> String {
    let last = entries.len().saturating_sub(1);
    let lines = entries.iter().enumerate().map(|(i, entry)| {
        let comma = if i < last { "," } else { "" };
        // The bits of the double, because a decimal need not be rounded correctly.
        let number = format!("real(z'{:016X}', real64){comma} &", entry.double.to_bits());
        let line = format!("    {number} ! {}", entry.remark());
        // A line has at most 132 characters.
        line.chars().take(132).collect::<String>() + "\n"
    });
    let lines: String = lines.collect();
    format!(
        "\n  {attributes} :: {name}({}) = [ &\n{lines}  ]\n",
        entries.len()
    )
}
