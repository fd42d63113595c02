//! Python.

use super::table::{Entry, Table, comments};

pub(super) fn write(table: &Table<'_>) -> String {
    let mut text = comments("#", &table.description());
    text.push_str(
        "#\n# Entries are texts: exact fractions, or decimals of as many digits as they have.\n",
    );
    text.push_str(&format!(
        "name = \"{}\"\norder = {}\n",
        table.name,
        table.main_order()
    ));
    for (vector, entries) in table.vectors() {
        text.push_str(&format!("{vector} = {}\n", list(entries)));
    }
    for (matrix, rows) in table.matrices() {
        let rows: Vec<String> = rows.iter().map(|row| list(row)).collect();
        text.push_str(&format!("{matrix} = [\n    {},\n]\n", rows.join(",\n    ")));
    }
    text.push_str(READERS);
    text
}

/// A list of texts.
fn list(entries: &[Entry]) -> String {
    let text = |entry: &Entry| match (&entry.exact, entry.rational()) {
        (Some(exact), Some(_)) => format!("\"{exact}\""),
        _ => format!("\"{}\"", entry.decimal),
    };
    let texts: Vec<String> = entries.iter().map(text).collect();
    format!("[{}]", texts.join(", "))
}

/// Functions for the kinds of numbers.
const READERS: &str = r#"

def numbers(entries, kind):
    """The same lists with numbers: `kind` makes one of a Fraction."""
    from fractions import Fraction

    if isinstance(entries, str):
        return kind(Fraction(entries))
    return [numbers(entry, kind) for entry in entries]


def fractions(entries):
    return numbers(entries, lambda fraction: fraction)


def doubles(entries):
    """Correctly rounded. For an array: numpy.array(doubles(a))."""
    return numbers(entries, float)


def mpmath_matrix(entries):
    """With the precision that mpmath has at that time."""
    import mpmath

    return mpmath.matrix(
        numbers(entries, lambda x: mpmath.mpf(x.numerator) / mpmath.mpf(x.denominator))
    )
"#;
