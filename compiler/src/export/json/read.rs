//! Reading JSON: a tableau is derived again from basis and nodes, and everything else is checked.

use std::collections::BTreeMap;
use std::fmt;
use std::marker::PhantomData;
use std::ops::Range;

use serde::Deserialize;
use serde::de::{Deserializer, MapAccess, Visitor};
use serde_json::Value;
use serde_json::value::RawValue;

use crate::coefficients::subscript;
use crate::definition::{Definition, Key};
use crate::error::{Error, ErrorKind};
use crate::export::entries::{Entries, Entry, compare, of_json, offset};
use crate::export::provenance::{Origin, Part};
use crate::export::{Format, MAX_DIGITS};
use crate::expression::Input;
use crate::limits::Limits;
use crate::properties::Properties;
use crate::suggestion::with_suggestion;
use crate::tableau::Tableau;

/// Reads a tableau from JSON.
///
/// JSON exports hold no lossless data. So the tableau is derived from basis and nodes, its properties
/// are decided, and every entry of the file is compared with the export of the result. The name
/// and the source are taken from the file. The number of digits is that of most decimals in the file.
///
/// # Errors
/// [`ErrorKind::Document`] if the text is not JSON or its keys or shapes are not those of a tableau;
/// [`ErrorKind::Mismatch`] for the first entry that differs; every error of
/// [`derive`](crate::derive()). Each with its place in the file.
///
/// ```
/// use symplectic_compiler::{Limits, derive, export::json};
///
/// let tableau = derive("polynomial(2)", "gauss(2)")?;
/// let text = json::write(&tableau, 20);
/// assert_eq!(json::read("gauss.json", &text, &Limits::default())?, tableau);
///
/// let edited = text.replacen("0.25000000000000000000", "0.25000000000000000001", 1);
/// let error = json::read("gauss.json", &edited, &Limits::default()).unwrap_err();
/// assert!(error.to_string().contains("`a_11 (decimal)` does not fit"));
/// # Ok::<(), symplectic_compiler::Error>(())
/// ```
pub fn read(file_name: &str, text: &str, limits: &Limits) -> Result<Tableau, Error> {
    read_and_compare(file_name, text, limits).map(|(tableau, _)| tableau)
}

/// [Reads](read()) a tableau; also the properties that the file does not state.
pub(crate) fn read_and_compare(
    file_name: &str,
    text: &str,
    limits: &Limits,
) -> Result<(Tableau, Vec<&'static str>), Error> {
    let file = Input::of_file(file_name, text);
    let (format, document) = Document::parse(file)?;
    let found = document.entries(file, limits)?;
    let tableau = document.origin(file)?.derive(file, limits)?;
    let fresh = super::write(&tableau, document.digits());
    let expected = Input {
        name: "the derivation",
        text: &fresh,
    };
    let (_, derived) = Document::parse(expected)?;
    let derived = derived.entries(expected, limits)?;
    compare(file, format, &tableau, found, derived)?;
    Ok((tableau, document.properties.missing()))
}

/// A value as written in the text.
#[derive(Deserialize)]
#[serde(transparent)]
struct Leaf<'a>(#[serde(borrow)] &'a RawValue);

/// The number of the format, whatever else a file has.
#[derive(Deserialize)]
struct FormatKey<'a> {
    #[serde(borrow, default)]
    format: Option<Leaf<'a>>,
}

#[derive(Deserialize)]
#[serde(deny_unknown_fields)]
struct Document<'a> {
    // Read before the others.
    #[serde(borrow, default, rename = "format")]
    _format: Option<Leaf<'a>>,
    name: Leaf<'a>,
    stages: Leaf<'a>,
    basis: Leaf<'a>,
    nodes: Leaf<'a>,
    #[serde(default)]
    definition: Option<Leaf<'a>>,
    tier: Leaf<'a>,
    #[serde(default)]
    source: Option<Leaf<'a>>,
    c: Vec<Number<'a>>,
    c_tilde: Vec<Number<'a>>,
    b: Vec<Number<'a>>,
    b_tilde: Vec<Number<'a>>,
    /// Null for a long splitting.
    a: Option<Vec<Vec<Number<'a>>>>,
    a_tilde: Option<Vec<Vec<Number<'a>>>>,
    /// For gradient kicks only.
    #[serde(borrow, default)]
    gradient: Option<Vec<Number<'a>>>,
    properties: PropertyList<'a>,
    /// These may be absent in an older format.
    #[serde(borrow, default, deserialize_with = "stated")]
    order: Option<Leaf<'a>>,
    #[serde(borrow, default, deserialize_with = "stated")]
    stability: Option<Leaf<'a>>,
    #[serde(borrow, default, deserialize_with = "stated")]
    symplecticity_order: Option<Leaf<'a>>,
}

/// A value that is present, null included.
fn stated<'de: 'a, 'a, D: Deserializer<'de>>(from: D) -> Result<Option<Leaf<'a>>, D::Error> {
    Leaf::deserialize(from).map(Some)
}

#[derive(Deserialize)]
#[serde(deny_unknown_fields)]
struct Number<'a> {
    #[serde(borrow)]
    exact: Leaf<'a>,
    decimal: Leaf<'a>,
    f64: Leaf<'a>,
    f32: Leaf<'a>,
}

#[derive(Deserialize)]
#[serde(deny_unknown_fields)]
struct PropertyEntry<'a> {
    #[serde(borrow)]
    holds: Leaf<'a>,
    evidence: Leaf<'a>,
    bits: Leaf<'a>,
    witness: Leaf<'a>,
}

/// The properties, each of them at most once.
struct PropertyList<'a>(Vec<(&'static str, PropertyEntry<'a>)>);

impl PropertyList<'_> {
    /// The properties that are not stated.
    fn missing(&self) -> Vec<&'static str> {
        let stated = |name: &&&str| self.0.iter().any(|(known, _)| known == *name);
        let missing = Properties::NAMES.iter().filter(|name| !stated(name));
        missing.copied().collect()
    }
}

impl<'de: 'a, 'a> Deserialize<'de> for PropertyList<'a> {
    fn deserialize<D: Deserializer<'de>>(deserializer: D) -> Result<Self, D::Error> {
        struct All<'a>(PhantomData<&'a ()>);
        impl<'de: 'a, 'a> Visitor<'de> for All<'a> {
            type Value = PropertyList<'a>;

            fn expecting(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
                f.write_str("an object of properties")
            }

            fn visit_map<A: MapAccess<'de>>(self, mut map: A) -> Result<Self::Value, A::Error> {
                use serde::de::Error;
                let mut known = BTreeMap::new();
                while let Some(key) = map.next_key::<String>()? {
                    let Some(name) = Properties::NAMES.iter().find(|name| **name == key) else {
                        return Err(A::Error::unknown_field(&key, Properties::NAMES));
                    };
                    if known.insert(*name, map.next_value()?).is_some() {
                        return Err(A::Error::duplicate_field(name));
                    }
                }
                let each = Properties::NAMES.iter();
                let stated = each.filter_map(|name| Some((*name, known.remove(name)?)));
                Ok(PropertyList(stated.collect()))
            }
        }
        deserializer.deserialize_map(All(PhantomData))
    }
}

/// The allowed types of a value.
#[derive(Clone, Copy)]
enum Types {
    Bool,
    Number,
    NumberOrNull,
    String,
    StringOrNull,
}

impl Types {
    fn expected(self) -> &'static str {
        match self {
            Types::Bool => "expected true or false",
            Types::Number => "expected a number",
            Types::NumberOrNull => "expected a number or null",
            Types::String => "expected a string",
            Types::StringOrNull => "expected a string or null",
        }
    }
}

impl<'a> Leaf<'a> {
    /// The bytes of the value in the text.
    fn span(&self, text: &str) -> Range<usize> {
        // The value is borrowed from the text.
        let start = (self.0.get().as_ptr() as usize).saturating_sub(text.as_ptr() as usize);
        start..start + self.0.get().len()
    }

    fn value(&self) -> Value {
        // The value has been parsed as JSON before. Only an excessive depth can be rejected here, and
        // values that deep have no type that occurs in a tableau.
        serde_json::from_str(self.0.get()).unwrap_or(Value::Array(Vec::new()))
    }

    /// The value for comparison; it must have the type of its key.
    fn entry(
        &self,
        file: Input<'a>,
        name: impl Into<String>,
        types: Types,
    ) -> Result<Entry, Error> {
        let value = match (self.value(), types) {
            // The string "null" differs from a missing value.
            (Value::String(text), Types::StringOrNull) if text == "null" => format!("{text:?}"),
            (Value::String(text), Types::String | Types::StringOrNull) => text,
            (value @ Value::Bool(_), Types::Bool) => value.to_string(),
            (value @ Value::Number(_), Types::Number | Types::NumberOrNull) => value.to_string(),
            (value @ Value::Null, Types::StringOrNull | Types::NumberOrNull) => value.to_string(),
            _ => return Err(self.error(file, types.expected())),
        };
        Ok(Entry::new(name, value, self.span(file.text)))
    }

    fn error(&self, file: Input<'_>, message: &str) -> Error {
        let message = message.to_owned();
        file.error(&self.span(file.text), ErrorKind::Document { message })
    }

    fn optional_string(&self, file: Input<'_>) -> Result<Option<String>, Error> {
        match self.value() {
            Value::String(text) => Ok(Some(text)),
            Value::Null => Ok(None),
            _ => Err(self.error(file, "expected a string or null")),
        }
    }

    fn string(&self, file: Input<'_>) -> Result<String, Error> {
        self.optional_string(file)?
            .ok_or_else(|| self.error(file, "expected a string"))
    }
}

impl<'a> Document<'a> {
    fn parse(file: Input<'a>) -> Result<(Format, Self), Error> {
        let refused = |error: serde_json::Error| {
            let start = offset(file.text, error.line(), error.column());
            let length = file.text[start..].chars().next();
            let end = start + length.filter(|c| *c != '\n').map_or(0, char::len_utf8);
            // The place is separated from the message.
            let message = error.to_string();
            let message = message
                .rsplit_once(" at line ")
                .map_or(message.as_str(), |(message, _)| message);
            let message = with_suggestion(message);
            let message = format!("not a JSON export of a tableau: {message}");
            file.error(&(start..end), ErrorKind::Document { message })
        };
        // A later format may have other keys.
        let FormatKey { format } = serde_json::from_str(file.text).map_err(refused)?;
        let stated = format.map(|leaf| (leaf.span(file.text), leaf.value().as_u64()));
        let format = Format::read(file, stated)?;
        let document: Self = serde_json::from_str(file.text).map_err(refused)?;
        if !format.is_older()
            && let Some(missing) = document.missing()
        {
            return Err(refused(serde::de::Error::missing_field(missing)));
        }
        Ok((format, document))
    }

    /// The first section or property that is not stated.
    fn missing(&self) -> Option<&'static str> {
        let sections = [
            ("order", self.order.is_some()),
            ("stability", self.stability.is_some()),
            ("symplecticity_order", self.symplecticity_order.is_some()),
        ];
        let mut sections = sections.into_iter().filter(|(_, stated)| !stated);
        let section = sections.next().map(|(name, _)| name);
        section.or_else(|| self.properties.missing().first().copied())
    }

    fn origin(&self, file: Input<'_>) -> Result<Origin, Error> {
        let whole = self.definition.as_ref().unwrap_or(&self.basis);
        Ok(Origin {
            name: self.name.optional_string(file)?,
            parts: self.parts(file)?,
            source: self
                .source
                .as_ref()
                .map_or(Ok(None), |source| source.optional_string(file))?,
            span: whole.span(file.text),
        })
    }

    /// The parts of the definition, each with its place.
    fn parts(&self, file: Input<'_>) -> Result<Vec<Part>, Error> {
        if let Some(leaf) = &self.definition {
            // One text contains all of them.
            let definition = Definition::parse(&leaf.string(file)?)
                .map_err(|error| leaf.error(file, &error.kind.to_string()))?;
            let part = |(key, text): (Key, &str)| Part {
                key,
                text: text.to_owned(),
                span: leaf.span(file.text),
            };
            return Ok(definition.parts().map(part).collect());
        }
        let part = |(key, leaf): (Key, &Leaf<'_>)| {
            Ok(Part {
                key,
                text: leaf.string(file)?,
                span: leaf.span(file.text),
            })
        };
        let leaves = [(Key::Basis, &self.basis), (Key::Nodes, &self.nodes)];
        leaves.into_iter().map(part).collect()
    }

    /// The named vectors and matrices.
    fn tables(&self) -> Vec<(&'static str, Table<'_, 'a>)> {
        let mut tables = vec![
            ("c", Table::Vector(&self.c)),
            ("c̃", Table::Vector(&self.c_tilde)),
            ("b", Table::Vector(&self.b)),
            ("b̃", Table::Vector(&self.b_tilde)),
        ];
        let matrices = [("a", &self.a), ("ã", &self.a_tilde)].into_iter();
        tables.extend(
            matrices.filter_map(|(name, rows)| Some((name, Table::Matrix(rows.as_ref()?)))),
        );
        tables.extend(self.gradient.iter().map(|list| ("g", Table::Vector(list))));
        tables
    }

    /// All entries except the name and the source, which cannot be derived.
    fn entries(&self, file: Input<'a>, limits: &Limits) -> Result<Entries, Error> {
        let stages = self.stages.value().as_u64().map(|s| s as usize);
        let Some(stages) = stages.filter(|&s| s > 0) else {
            return Err(self.stages.error(file, "expected a number of stages"));
        };
        if stages > limits.stages {
            let kind = ErrorKind::TooManyStages {
                stages: stages.to_string(),
                limit: limits.stages,
            };
            return Err(file.error(&self.stages.span(file.text), kind));
        }
        let mut entries = vec![
            self.stages.entry(file, "stages", Types::Number)?,
            self.basis.entry(file, "basis", Types::StringOrNull)?,
            self.nodes.entry(file, "nodes", Types::StringOrNull)?,
        ];
        if let Some(definition) = &self.definition {
            entries.push(definition.entry(file, "definition", Types::String)?);
        }
        entries.push(self.tier.entry(file, "tier", Types::String)?);
        let shape = |name: &str, found: usize| {
            let message = format!("`{name}` has {found} entries, but there are {stages} stages");
            if found == stages {
                Ok(())
            } else {
                Err(self.stages.error(file, &message))
            }
        };
        let mut number = |name: String, number: &Number<'a>| {
            entries.push(number.exact.entry(
                file,
                format!("{name} (exact)"),
                Types::StringOrNull,
            )?);
            entries.push(
                number
                    .decimal
                    .entry(file, format!("{name} (decimal)"), Types::String)?,
            );
            entries.push(
                number
                    .f64
                    .entry(file, format!("{name} (f64)"), Types::String)?,
            );
            entries.push(
                number
                    .f32
                    .entry(file, format!("{name} (f32)"), Types::String)?,
            );
            Ok::<_, Error>(())
        };
        for (name, table) in self.tables() {
            match table {
                Table::Vector(vector) => {
                    shape(name, vector.len())?;
                    for (i, entry) in vector.iter().enumerate() {
                        number(format!("{name}_{}", i + 1), entry)?;
                    }
                }
                Table::Matrix(rows) => {
                    shape(name, rows.len())?;
                    for (i, row) in rows.iter().enumerate() {
                        shape(&format!("row {} of {name}", i + 1), row.len())?;
                        for (j, entry) in row.iter().enumerate() {
                            number(format!("{name}_{}", subscript(i + 1, j + 1)), entry)?;
                        }
                    }
                }
            }
        }
        let table = entries;
        let mut entries = Vec::new();
        for (name, property) in &self.properties.0 {
            let fields = [
                ("holds", &property.holds, Types::Bool),
                ("evidence", &property.evidence, Types::String),
                ("bits", &property.bits, Types::NumberOrNull),
                ("witness", &property.witness, Types::StringOrNull),
            ];
            for (field, leaf, types) in fields {
                entries.push(leaf.entry(file, format!("{name} ({field})"), types)?);
            }
        }
        for (name, section) in [("order", &self.order), ("stability", &self.stability)] {
            if let Some(section) = section {
                of_json(file, name, section.0, &mut entries);
            }
        }
        if let Some(order) = &self.symplecticity_order {
            let types = Types::NumberOrNull;
            entries.push(order.entry(file, "symplecticity_order", types)?);
        }
        Ok(Entries {
            table,
            facts: entries,
        })
    }

    /// The number of significant digits that most decimals have.
    fn digits(&self) -> usize {
        let mut counts: BTreeMap<usize, usize> = BTreeMap::new();
        let numbers = self
            .tables()
            .into_iter()
            .flat_map(|(_, table)| match table {
                Table::Vector(vector) => vector.iter().collect::<Vec<_>>(),
                Table::Matrix(rows) => rows.iter().flatten().collect(),
            });
        for number in numbers {
            if let Value::String(decimal) = number.decimal.value() {
                *counts.entry(significant_digits(&decimal)).or_default() += 1;
            }
        }
        // Zeros have no digits.
        counts.remove(&0);
        let most = counts.into_iter().max_by_key(|(_, count)| *count);
        most.map_or(1, |(digits, _)| digits.clamp(1, MAX_DIGITS))
    }
}

enum Table<'d, 'a> {
    Vector(&'d [Number<'a>]),
    Matrix(&'d [Vec<Number<'a>>]),
}

/// The number of digits of a decimal, starting with the first nonzero digit.
fn significant_digits(decimal: &str) -> usize {
    let mantissa = decimal.split('e').next().unwrap_or_default();
    mantissa
        .bytes()
        .filter(u8::is_ascii_digit)
        .skip_while(|digit| *digit == b'0')
        .count()
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn digits_are_counted_from_the_first_that_is_not_zero() {
        let cases = [
            ("0", 0),
            ("0.00120", 3),
            ("-1.20e-7", 3),
            ("120", 3),
            ("1.2e5", 2),
        ];
        for (decimal, digits) in cases {
            assert_eq!(significant_digits(decimal), digits, "{decimal}");
        }
    }
}
