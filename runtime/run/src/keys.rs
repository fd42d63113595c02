//! The keys of a setup file: where they stand, and what is wrong with them and with the types of their values.

use std::ops::Range;

use symplectic_compiler::did_you_mean;
use toml::Spanned;
use toml::de::{DeTable, DeValue};

/// A key of a file, with its value.
struct Entry<'a> {
    /// The key, with those of the tables around it: `output.file`.
    name: String,
    key: Range<usize>,
    value: &'a Spanned<DeValue<'a>>,
}

/// The place of the key that has the value at `span`.
pub(super) fn key_of(text: &str, span: &Range<usize>) -> Option<Range<usize>> {
    let table = DeTable::parse(text).ok()?;
    let entries = entries(table.get_ref());
    let mut found = entries.iter().filter(|entry| entry.value.span() == *span);
    found.next().map(|entry| entry.key.clone())
}

/// The keys of a file that are not tables.
const OF_FILE: [&str; 15] = [
    "system",
    "method",
    "step_size",
    "start_time",
    "end",
    "times",
    "section",
    "sums",
    "megno",
    "solver",
    "accept_lower_order",
    "skip_impossible_starts",
    "project_starts",
    "warn_energy_error",
    "random",
];

/// What to do with an unknown key in a table if it is one of the file: in TOML every key below `[name]` is in that table.
fn misplaced(name: &str) -> &'static str {
    match OF_FILE.contains(&name) {
        true => "; this key is one of the file: write it above the first `[…]`",
        false => "",
    }
}

/// What was probably meant by an unknown key: one of the file, or the nearest of the known ones.
pub(super) fn advice<'a>(name: &str, known: impl IntoIterator<Item = &'a str>) -> String {
    match misplaced(name) {
        "" => did_you_mean(name, known),
        misplaced => misplaced.to_owned(),
    }
}

/// A message of the deserializer about the value, or the key, at `span` in plain words.
pub(super) fn explained(text: &str, span: &Range<usize>, message: &str) -> String {
    if let Some(name) = quoted(message, "unknown field `") {
        let known = message.split_once(", expected ").map(|(_, known)| known);
        let known = known.map(|known| known.trim_start_matches("one of "));
        return match known {
            Some(known) => {
                let known = known.replace("` or `", "`, `");
                let advice = advice(name, known.split('`').skip(1).step_by(2));
                format!("there is no key `{name}`; known here: {known}{advice}")
            }
            None => format!("there is no key `{name}`"),
        };
    }
    if message == "duplicate key" {
        let name = text.get(span.clone()).unwrap_or_default();
        return format!("the key `{name}` is given twice: leave out one of the two");
    }
    let Ok(table) = DeTable::parse(text) else {
        return message.to_owned();
    };
    let entries = entries(table.get_ref());
    if let Some(key) = quoted(message, "missing field `") {
        let table = entries.iter().find(|entry| entry.value.span() == *span);
        let table = table.map_or(String::new(), |table| format!("{}.", table.name));
        let in_a_table = |entry: &&Entry<'_>| entry.name.ends_with(&format!(".{key}"));
        let misplaced = match entries.iter().find(in_a_table) {
            Some(Entry { name, .. }) => {
                format!(" (here it is `{name}`){}", misplaced(key))
            }
            None => String::new(),
        };
        return format!("the key `{table}{key}` is missing{misplaced}");
    }
    let around = |value: Range<usize>| value.start <= span.start && span.end <= value.end;
    let entry = entries
        .iter()
        .filter(|entry| around(entry.value.span()))
        .min_by_key(|entry| entry.value.span().len());
    let Some(Entry { name, value, .. }) = entry else {
        return message.to_owned();
    };
    if message.starts_with("expected ") {
        return format!("`{name}`: {message}");
    }
    let is_type = ["invalid type: ", "invalid value: ", "invalid length "]
        .iter()
        .any(|start| message.starts_with(start));
    match message.rsplit_once(", expected ") {
        Some((_, expected)) if is_type => {
            let value = part(value, span).unwrap_or(value.get_ref());
            let found = found(value, &text[span.clone()]);
            format!("`{name}`: found {found}, expected {}", in_words(expected))
        }
        _ => message.to_owned(),
    }
}

/// The text between `start` and the next backquote.
fn quoted<'a>(message: &'a str, start: &str) -> Option<&'a str> {
    let (name, _) = message.strip_prefix(start)?.split_once('`')?;
    Some(name)
}

/// All keys of a table, and of those in it.
fn entries<'a>(table: &'a DeTable<'a>) -> Vec<Entry<'a>> {
    fn collect<'a>(around: &str, value: &'a DeValue<'a>, all: &mut Vec<Entry<'a>>) {
        match value {
            DeValue::Table(table) => of_table(&format!("{around}."), table, all),
            DeValue::Array(items) => {
                for item in items.iter() {
                    collect(around, item.get_ref(), all);
                }
            }
            _ => (),
        }
    }
    fn of_table<'a>(prefix: &str, table: &'a DeTable<'a>, all: &mut Vec<Entry<'a>>) {
        for (key, value) in table {
            let name = format!("{prefix}{}", key.get_ref());
            collect(&name, value.get_ref(), all);
            all.push(Entry {
                name,
                key: key.span(),
                value,
            });
        }
    }
    let mut all = Vec::new();
    of_table("", table, &mut all);
    all
}

/// The value at a place in a list, in lists in it, …
fn part<'a>(value: &'a Spanned<DeValue<'a>>, span: &Range<usize>) -> Option<&'a DeValue<'a>> {
    if value.span() == *span {
        return Some(value.get_ref());
    }
    match value.get_ref() {
        DeValue::Array(items) => items.iter().find_map(|item| part(item, span)),
        _ => None,
    }
}

fn found(value: &DeValue<'_>, written: &str) -> String {
    match value {
        DeValue::String(_) => "a string".to_owned(),
        DeValue::Integer(_) => format!("the integer `{written}`"),
        DeValue::Float(_) => format!("the number `{written}`"),
        DeValue::Boolean(_) => format!("the boolean `{written}`"),
        DeValue::Datetime(_) => "a date or time".to_owned(),
        DeValue::Array(_) => "a list".to_owned(),
        DeValue::Table(_) => "a table".to_owned(),
    }
}

/// The names of the types of values; other phrases are words of this program.
fn in_words(expected: &str) -> &str {
    match expected {
        "f64" => "a number",
        "u64" | "usize" => "a whole number, 0 or larger",
        "i64" => "a whole number",
        "path string" => "a string with the name of a file",
        "a boolean" => "`true` or `false`",
        "a sequence" => "a list",
        "a map" => "a table",
        other => other,
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::setup::Setup;

    #[test]
    fn the_keys_of_a_file_are_those_of_the_setup() {
        let error = toml::from_str::<Setup>("nothing = 1").expect_err("an unknown key");
        let message = error.message();
        let known = message
            .split_once("expected")
            .map_or("", |(_, known)| known);
        let mut known: Vec<&str> = known.split('`').skip(1).step_by(2).collect();
        let mut expected = OF_FILE.to_vec();
        expected.extend(["parameters", "starts", "output"]);
        known.sort_unstable();
        expected.sort_unstable();
        assert_eq!(known, expected, "{message}");
    }
}
