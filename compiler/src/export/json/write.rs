//! Writing JSON.

use crate::arithmetic::rounding::{shortest, shortest_single};
use crate::definition::Key;
use crate::evidence::Evidence;
use crate::export::{Format, facts, written};
use crate::properties::Property;
use crate::tableau::Tableau;

/// The forms of a coefficient.
type Forms = (Option<String>, (String, f64, f32));

/// Writes a tableau as JSON with decimals of `digits ≥ 1` significant digits.
///
/// The text is the same for the same tableau, with one coefficient or property per line.
///
/// ```
/// use symplectic_compiler::{derive, export::json};
///
/// let text = json::write(&derive("1", "1/2")?, 5);
/// assert!(text.contains(r#""b": [{"exact": "1", "decimal": "1.0000", "f64": "1", "f32": "1"}]"#));
/// # Ok::<(), symplectic_compiler::Error>(())
/// ```
pub fn write(tableau: &Tableau, digits: usize) -> String {
    let rounded = written(tableau, tableau.numbers()).map(|number| {
        let decimal = number.decimal(digits).to_string();
        (decimal, number.to_f64(), number.to_f32())
    });
    let forms = written(tableau, tableau.exact_forms()).zip(rounded);
    let provenance = tableau.provenance();
    let properties = tableau.properties();
    let properties: Vec<String> = properties
        .all()
        .into_iter()
        .map(|(name, property)| format!("    {}: {}", string(name), property_text(property)))
        .collect();
    let definition = &provenance.definition;
    let mut members = vec![
        ("format", Format::CURRENT.to_string()),
        ("name", optional(tableau.name())),
        ("stages", tableau.stages().to_string()),
        ("basis", optional(definition.get(Key::Basis))),
        ("nodes", optional(definition.get(Key::Nodes))),
    ];
    // Basis and nodes determine the tableau; otherwise one text does.
    let simple = |key| matches!(key, Key::Basis | Key::Nodes);
    if !definition.parts().all(|(key, _)| simple(key)) {
        members.push(("definition", string(&definition.to_string())));
    }
    members.extend([
        ("tier", string(tableau.tier().name())),
        ("source", optional(provenance.source.as_deref())),
        ("c", vector(&forms.c, "  ")),
        ("c_tilde", vector(&forms.c_tilde, "  ")),
        ("b", vector(&forms.b, "  ")),
        ("b_tilde", vector(&forms.b_tilde, "  ")),
        ("a", matrix(&forms.a)),
        ("a_tilde", matrix(&forms.a_tilde)),
    ]);
    if !forms.gradient.is_empty() {
        members.push(("gradient", vector(&forms.gradient, "  ")));
    }
    members.extend([(
        "properties",
        format!("{{\n{}\n  }}", properties.join(",\n")),
    )]);
    for (section, facts) in facts::sections(tableau, digits) {
        let facts: Vec<String> = facts
            .iter()
            .map(|(key, fact)| format!("    {}: {}", string(key), fact.json()))
            .collect();
        members.push((section, format!("{{\n{}\n  }}", facts.join(",\n"))));
    }
    let symplecticity = tableau.symplecticity_order(facts::SYMPLECTICITY_LIMIT);
    let order = symplecticity.map_or("null".to_owned(), |found| found.order.to_string());
    members.push(("symplecticity_order", order));
    let members: Vec<String> = members
        .iter()
        .map(|(key, value)| format!("  {}: {value}", string(key)))
        .collect();
    format!("{{\n{}\n}}\n", members.join(",\n"))
}

fn string(text: &str) -> String {
    serde_json::Value::from(text).to_string()
}

fn optional(text: Option<&str>) -> String {
    text.map_or_else(|| "null".to_owned(), string)
}

fn number((exact, (decimal, double, single)): &Forms) -> String {
    format!(
        "{{\"exact\": {}, \"decimal\": {}, \"f64\": {}, \"f32\": {}}}",
        optional(exact.as_deref()),
        string(decimal),
        string(&shortest(*double)),
        string(&shortest_single(*single))
    )
}

fn vector(numbers: &[Forms], indent: &str) -> String {
    match numbers {
        [single] => format!("[{}]", number(single)),
        _ => list(numbers.iter().map(number), indent),
    }
}

/// A matrix; null if it is left out because the weights determine it.
fn matrix(rows: &[Vec<Forms>]) -> String {
    if rows.is_empty() {
        return "null".to_owned();
    }
    list(rows.iter().map(|row| vector(row, "    ")), "  ")
}

/// An array with one item per line.
fn list(items: impl Iterator<Item = String>, indent: &str) -> String {
    let items: Vec<String> = items.map(|item| format!("{indent}  {item}")).collect();
    format!("[\n{}\n{indent}]", items.join(",\n"))
}

fn property_text(property: &Property) -> String {
    let (evidence, bits) = evidence(property.evidence);
    let bits = bits.map_or_else(|| "null".to_owned(), |bits| bits.to_string());
    format!(
        "{{\"holds\": {}, \"evidence\": {}, \"bits\": {bits}, \"witness\": {}}}",
        property.holds,
        string(evidence),
        optional(property.witness.as_deref())
    )
}

/// The name of a kind of evidence in files, and the precision of its enclosures.
pub(in crate::export) fn evidence(evidence: Evidence) -> (&'static str, Option<u32>) {
    match evidence {
        Evidence::Proved => ("proved", None),
        Evidence::Certified => ("certified", None),
        Evidence::Refuted => ("refuted", None),
        Evidence::Verified { bits } => ("verified", Some(bits)),
        Evidence::Undecided { bits } => ("undecided", Some(bits)),
    }
}
