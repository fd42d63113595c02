//! The file of tab-separated doubles of RungeKutta.jl.

use super::not_expressible;
use super::table::{Entry, Table, comments};
use symplectic_compiler::Error;

/// What `to_file` writes and `from_file` reads: order, stages and type in the first line, then the rows `c_i a_i1 … a_is` and the
/// row `0 b_1 … b_s`.
pub(super) fn write(table: &Table<'_>) -> Result<String, Error> {
    const FILE: &str = "a TSV of RungeKutta.jl";
    if !table.is_runge_kutta() {
        let reason = "it holds one tableau, not a `PartitionedTableau`; `--format julia` writes both tableaux";
        return Err(not_expressible(FILE, reason));
    }
    if table.entries.a.is_empty() {
        return Err(not_expressible(
            FILE,
            "its matrices are too large to be written",
        ));
    }
    let line = |first: f64, entries: &[Entry]| {
        let doubles = entries.iter().map(|entry| entry.double);
        let numbers: Vec<String> = [first]
            .into_iter()
            .chain(doubles)
            .map(|x| format!("{x:?}"))
            .collect();
        format!("{}\n", numbers.join("\t"))
    };
    let rows = table.entries.c.iter().zip(&table.entries.a);
    let rows: String = rows.map(|(c, row)| line(c.double, row)).collect();
    Ok(format!(
        "# {} {} Float64\n{}{rows}{}",
        table.main_order(),
        table.tableau.stages(),
        comments("#", &table.description()),
        line(0.0, &table.entries.b),
    ))
}
