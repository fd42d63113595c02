//! C99.

use super::table::{Entry, Table};

pub(super) fn write(table: &Table<'_>) -> String {
    let stages = table.tableau.stages();
    let name = &table.name;
    let mut text = comment(&table.description());
    for (vector, entries) in table.vectors() {
        text.push_str(&array(&format!("{name}_{vector}"), entries));
    }
    for (matrix, rows) in table.matrices() {
        text.push_str(&format!(
            "\nstatic const double {name}_{matrix}[{stages}][{stages}] = {{\n"
        ));
        for row in rows {
            text.push_str(&format!("    {{\n{}    }},\n", numbers("        ", row)));
        }
        text.push_str("};\n");
    }
    text
}

/// Lines as one comment.
pub(crate) fn comment(lines: &[String]) -> String {
    let lines: Vec<String> = lines.iter().map(|line| line.replace("*/", "* /")).collect();
    let text = lines.join("\n   ").replace("\n   \n", "\n\n");
    format!("/* {text} */\n")
}

/// A constant array.
fn array(name: &str, entries: &[Entry]) -> String {
    let (length, numbers) = (entries.len(), numbers("    ", entries));
    format!("\nstatic const double {name}[{length}] = {{\n{numbers}}};\n")
}

/// Numbers, one per line, each with a comment: its exact form or decimal.
pub(super) fn numbers(indent: &str, entries: &[Entry]) -> String {
    let line = |entry: &Entry| {
        format!(
            "{indent}{}, /* {} */\n",
            hexadecimal(entry.double),
            entry.remark()
        )
    };
    entries.iter().map(line).collect()
}

/// A double as a hexadecimal floating constant, exactly: `0x1.8p-1`.
pub(crate) fn hexadecimal(value: f64) -> String {
    let bits = value.to_bits();
    let sign = if value.is_sign_negative() { "-" } else { "" };
    let (exponent, fraction) = ((bits >> 52) & 0x7ff, bits & ((1 << 52) - 1));
    let digits = format!("{fraction:013x}");
    let digits = digits.trim_end_matches('0');
    let point = if digits.is_empty() { "" } else { "." };
    match exponent {
        0 if fraction == 0 => format!("{sign}0x0p+0"),
        0 => format!("{sign}0x0{point}{digits}p-1022"),
        _ => format!("{sign}0x1{point}{digits}p{:+}", exponent as i64 - 1023),
    }
}

#[cfg(test)]
mod tests {
    use super::hexadecimal;

    #[test]
    fn c_constants_are_written_in_exact_hexadecimal() {
        for (value, expected) in [
            (0.0, "0x0p+0"),
            (1.0, "0x1p+0"),
            (-0.75, "-0x1.8p-1"),
            (0.1, "0x1.999999999999ap-4"),
            (5e-324, "0x0.0000000000001p-1022"),
            (1e300, "0x1.7e43c8800759cp+996"),
        ] {
            assert_eq!(hexadecimal(value), expected);
        }
    }
}
