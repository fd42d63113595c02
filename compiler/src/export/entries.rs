//! The entries of a file in their order, each with its name and its place.

use std::collections::BTreeSet;
use std::fmt;
use std::ops::Range;

use serde::de::{Deserialize, Deserializer, MapAccess, Visitor};
use serde_json::value::RawValue;
use toml::Spanned;
use toml::de::DeValue;

use crate::error::{Error, ErrorKind};
use crate::export::format::Format;
use crate::expression::Input;
use crate::tableau::Tableau;

/// One entry of a file.
#[derive(Debug, Clone, PartialEq, Eq)]
pub(crate) struct Entry {
    /// Its name in messages: `ã_21 (decimal)`.
    pub name: String,
    /// Its value in the file.
    pub value: String,
    /// Its bytes in the file.
    pub span: Range<usize>,
}

impl Entry {
    pub(super) fn new(name: impl Into<String>, value: impl ToString, span: Range<usize>) -> Self {
        Entry {
            name: name.into(),
            value: value.to_string(),
            span,
        }
    }
}

/// The entries of a file.
pub(crate) struct Entries {
    /// The definition and the coefficients.
    pub table: Vec<Entry>,
    /// The tier of a TOML file, properties, orders and stability.
    pub facts: Vec<Entry>,
}

/// Compares every entry of a file with the derived entry.
///
/// A file of an older format may lack facts that were not written then; those that it has are compared. Their evidence may
/// have become stronger since, and what is not so may be explained by another example.
///
/// # Errors
/// [`ErrorKind::Mismatch`] for the first entry that differs.
pub(crate) fn compare(
    file: Input<'_>,
    format: Format,
    tableau: &Tableau,
    mut found: Entries,
    mut derived: Entries,
) -> Result<(), Error> {
    let is_certified = derived.facts.iter().any(|entry| entry.value == "certified");
    let advice = match (format.is_older(), is_certified) {
        (false, _) => "",
        (true, false) => EARLIER,
        (true, true) => EARLIER_CERTIFIED,
    };
    if format.is_older() {
        let explains = |entry: &Entry| EXPLAINS.iter().any(|end| entry.name.ends_with(end));
        // In format 1 a method qualified only by its own coefficients, with the start of the step as the first stage and the end as the last.
        let (own, properties) = (tableau.own_properties(), tableau.properties());
        let in_order = own.first_same_as_last.holds || tableau.stages() == 1;
        let widened = [
            ("constrained", own.constrained.holds && in_order),
            ("nonholonomic", own.nonholonomic.holds),
        ];
        let widened = widened.into_iter().filter(|(name, qualified)| {
            let holds = properties.get(name).is_some_and(|property| property.holds);
            let name = format!("{name} (holds)");
            let mut facts = found.facts.iter();
            holds && !qualified && facts.any(|entry| entry.name == name && entry.value == "false")
        });
        let widened: Vec<&str> = widened.map(|(name, _)| name).collect();
        let is_widened = |entry: &Entry| widened.iter().any(|name| entry.name.starts_with(name));
        for facts in [&mut found.facts, &mut derived.facts] {
            facts.retain(|entry| !explains(entry) && !is_widened(entry));
        }
        for entry in &mut found.facts {
            let known = derived.facts.iter().find(|known| known.name == entry.name);
            if let Some(known) = known.filter(|known| is_stronger(&known.value, &entry.value)) {
                entry.value.clone_from(&known.value);
            }
        }
        // A list is stated as a whole.
        let key = |entry: &Entry| entry.name.split('[').next().map(str::to_owned);
        let stated: BTreeSet<_> = found.facts.iter().map(key).collect();
        derived.facts.retain(|entry| stated.contains(&key(entry)));
    }
    let all = |entries: Entries| [entries.table, entries.facts].concat();
    compare_each(file, &all(found), &all(derived), advice)
}

/// What to do with a file of an older format that does not fit.
const EARLIER: &str = "; an earlier version of `symplectic` wrote this file: export the method again, with `symplectic derive` or \
     `symplectic show`";

/// The same, if several exact methods have the printed digits of the definition.
const EARLIER_CERTIFIED: &str = "; an earlier version of `symplectic` wrote this file, and may have taken another exact method with the \
     same printed digits: export the method again, with `symplectic derive` or `symplectic show`";

/// The ends of the names of entries that explain a fact: another version may explain it by another example.
const EXPLAINS: [&str; 7] = [
    "(witness)",
    "(bits)",
    ".bits",
    ".refuted_by",
    ".value",
    ".wanted",
    ".residual",
];

/// Whether a kind of evidence is stronger than another one.
fn is_stronger(evidence: &str, than: &str) -> bool {
    let kinds = ["undecided", "verified", "certified", "proved"];
    let place = |text: &str| kinds.iter().position(|kind| *kind == text);
    let (evidence, than) = (place(evidence), place(than));
    evidence.is_some() && than.is_some() && evidence > than
}

/// Compares two lists of entries. If their lengths differ, an entry before the end differs.
fn compare_each(
    file: Input<'_>,
    found: &[Entry],
    expected: &[Entry],
    advice: &'static str,
) -> Result<(), Error> {
    let all = found;
    let Some((found, expected)) = all
        .iter()
        .zip(expected)
        .find(|(f, e)| f.name != e.name || f.value != e.value)
    else {
        // Entries missing at the end.
        let Some(missing) = expected.get(all.len()) else {
            return Ok(());
        };
        let end = file.text.trim_end().len();
        let kind = ErrorKind::Mismatch {
            entry: missing.name.clone(),
            found: "nothing".to_owned(),
            expected: difference(&missing.value, "").0,
            advice,
        };
        return Err(file.error(&(end..end), kind));
    };
    if found.name != expected.name {
        // One of the two has an entry that the other does not have.
        let kind = if all.iter().any(|entry| entry.name == expected.name) {
            ErrorKind::Mismatch {
                entry: found.name.clone(),
                found: difference(&found.value, "").0,
                expected: "no such entry".to_owned(),
                advice,
            }
        } else {
            ErrorKind::Mismatch {
                entry: expected.name.clone(),
                found: format!("no such entry before `{}`", found.name),
                expected: difference(&expected.value, "").0,
                advice,
            }
        };
        return Err(file.error(&found.span, kind));
    }
    let (shown_found, shown_expected) = difference(&found.value, &expected.value);
    let kind = ErrorKind::Mismatch {
        entry: found.name.clone(),
        found: shown_found,
        expected: shown_expected,
        advice,
    };
    Err(file.error(&found.span, kind))
}

/// Longer values are shown around the place where they begin to differ.
const LONG: usize = 120;

/// Two different values in the form for a message.
fn difference(found: &str, expected: &str) -> (String, String) {
    let (found, expected): (Vec<char>, Vec<char>) =
        (found.chars().collect(), expected.chars().collect());
    let common = found
        .iter()
        .zip(&expected)
        .take_while(|(a, b)| a == b)
        .count();
    let shown = |value: &[char]| {
        if value.len() <= LONG {
            return value.iter().collect();
        }
        let start = common.saturating_sub(LONG / 2).min(value.len());
        let end = (start + LONG).min(value.len());
        let before = if start > 0 { "…" } else { "" };
        let after = if end < value.len() { "…" } else { "" };
        let middle: String = value[start..end].iter().collect();
        format!("{before}{middle}{after}")
    };
    (shown(&found), shown(&expected))
}

/// The entries of a JSON value, prefixed with its name.
pub(super) fn of_json(file: Input<'_>, name: &str, value: &RawValue, entries: &mut Vec<Entry>) {
    let text = value.get();
    // The value is borrowed from the text.
    let start = (text.as_ptr() as usize).saturating_sub(file.text.as_ptr() as usize);
    if let Ok(Pairs(mut table)) = serde_json::from_str(text) {
        if table.is_empty() {
            entries.push(Entry::new(name, "{}", start..start + text.len()));
        }
        table.sort_by(|(a, _), (b, _)| a.cmp(b));
        for (key, value) in table {
            of_json(file, &format!("{name}.{key}"), value, entries);
        }
    } else if let Ok(list) = serde_json::from_str::<Vec<&RawValue>>(text) {
        if list.is_empty() {
            entries.push(Entry::new(name, "[]", start..start + text.len()));
        }
        for (index, value) in list.into_iter().enumerate() {
            of_json(file, &format!("{name}[{index}]"), value, entries);
        }
    } else {
        // Another program may have written the same text with other escapes.
        let value = serde_json::from_str::<String>(text);
        let value = value.map_or_else(
            |_| text.to_owned(),
            |text| serde_json::Value::from(text).to_string(),
        );
        entries.push(Entry::new(name, value, start..start + text.len()));
    }
}

/// The entries of an object, including duplicate keys.
struct Pairs<'a>(Vec<(String, &'a RawValue)>);

impl<'de: 'a, 'a> Deserialize<'de> for Pairs<'a> {
    fn deserialize<D: Deserializer<'de>>(deserializer: D) -> Result<Self, D::Error> {
        struct Visit;

        impl<'de> Visitor<'de> for Visit {
            type Value = Pairs<'de>;

            fn expecting(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
                f.write_str("an object")
            }

            fn visit_map<A: MapAccess<'de>>(self, mut map: A) -> Result<Self::Value, A::Error> {
                let mut pairs = Vec::new();
                while let Some(pair) = map.next_entry()? {
                    pairs.push(pair);
                }
                Ok(Pairs(pairs))
            }
        }

        deserializer.deserialize_map(Visit)
    }
}

/// The entries of a TOML value, prefixed with its name.
pub(super) fn of_toml(name: &str, value: &Spanned<DeValue<'_>>, entries: &mut Vec<Entry>) {
    match value.get_ref() {
        DeValue::Table(table) => {
            if table.is_empty() {
                entries.push(Entry::new(name, "{}", value.span()));
            }
            for (key, value) in table {
                of_toml(&format!("{name}.{}", key.get_ref()), value, entries);
            }
        }
        DeValue::Array(list) => {
            if list.is_empty() {
                entries.push(Entry::new(name, "[]", value.span()));
            }
            for (index, value) in list.iter().enumerate() {
                of_toml(&format!("{name}[{index}]"), value, entries);
            }
        }
        // Quotes distinguish a string from the number, truth value or empty list that it looks like.
        DeValue::String(text)
            if text.parse::<i64>().is_ok() || ["true", "false", "[]", "{}"].contains(&&**text) =>
        {
            entries.push(Entry::new(name, format!("{text:?}"), value.span()));
        }
        DeValue::String(text) => entries.push(Entry::new(name, text, value.span())),
        DeValue::Integer(number) => entries.push(Entry::new(name, number, value.span())),
        DeValue::Boolean(holds) => entries.push(Entry::new(name, holds, value.span())),
        DeValue::Float(number) => entries.push(Entry::new(name, number, value.span())),
        // No tableau has dates.
        other => entries.push(Entry::new(name, format!("{other:?}"), value.span())),
    }
}

/// The offset of a line and a column in a text, both counted from 1, the column in bytes.
pub(super) fn offset(text: &str, line: usize, column: usize) -> usize {
    let start: usize = text
        .split_inclusive('\n')
        .take(line.saturating_sub(1))
        .map(str::len)
        .sum();
    let mut offset = (start + column.saturating_sub(1)).min(text.len());
    while !text.is_char_boundary(offset) {
        offset -= 1;
    }
    offset
}

/// A span cut at the end of its first line, so that a caret can be placed under it.
pub fn first_line(text: &str, span: Range<usize>) -> Range<usize> {
    let end = text
        .get(span.clone())
        .and_then(|part| part.find(['\n', '\r']))
        .map_or(span.end, |length| span.start + length);
    span.start..end
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn long_values_are_shortened_around_their_difference() {
        let (one, other) = (
            format!("{}7{}", "3".repeat(500), "3".repeat(500)),
            "3".repeat(1001),
        );
        let (found, expected) = difference(&one, &other);
        assert!(found.starts_with('…') && found.ends_with('…') && found.contains('7'));
        assert_eq!(expected.chars().count(), LONG + 2);
        assert_eq!(difference("1", "2"), ("1".into(), "2".into()));
    }

    #[test]
    fn places_stay_inside_the_text() {
        assert_eq!(offset("a\nbã\n", 2, 3), 3);
        assert_eq!(offset("a\nb", 9, 9), 3);
        assert_eq!(first_line("ab\ncd", 1..5), 1..2);
    }
}
