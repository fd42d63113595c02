//! Python for nodepy.

use super::not_expressible;
use super::table::{Entry, Table, comments};
use symplectic_compiler::Error;

pub(super) fn write(table: &Table<'_>) -> Result<String, Error> {
    if !table.is_runge_kutta() {
        let reason = "nodepy has Runge–Kutta methods with one tableau, not partitioned ones";
        return Err(not_expressible("nodepy", reason));
    }
    if table.entries.a.is_empty() {
        let reason = "its matrices are too large to be written";
        return Err(not_expressible("nodepy", reason));
    }
    let numbers = |entries: &[Entry]| {
        let numbers: Vec<String> = entries.iter().map(number).collect();
        format!("[{}]", numbers.join(", "))
    };
    let rows: Vec<String> = table.entries.a.iter().map(|row| numbers(row)).collect();
    let name = &table.name;
    Ok(format!(
        "{}import numpy\nimport sympy\nfrom nodepy.runge_kutta_method import RungeKuttaMethod\n\n\
         A = numpy.array([\n    {},\n], dtype=object)\nb = numpy.array({}, dtype=object)\n\
         {name} = RungeKuttaMethod(A, b, name=\"{name}\")\n",
        comments("#", &table.description()),
        rows.join(",\n    "),
        numbers(&table.entries.b),
    ))
}

/// Exact if SymPy can read the exact form.
fn number(entry: &Entry) -> String {
    let known = |exact: &&String| !exact.contains("root(");
    match entry.exact.as_ref().filter(known) {
        Some(exact) => format!("sympy.sympify(\"{}\")", exact.replace('^', "**")),
        None => {
            let digits = entry.decimal.bytes().filter(u8::is_ascii_digit).count();
            format!("sympy.Float(\"{}\", {digits})", entry.decimal)
        }
    }
}
