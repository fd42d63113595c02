//! The parts of a TOML file with their places.

use std::collections::BTreeMap;
use std::fmt;
use std::ops::Range;

use serde::de::{Error as _, MapAccess, Visitor};
use serde::{Deserialize, Deserializer};
use toml::Spanned;

use crate::coefficients::subscript;
use crate::definition::Key;
use crate::error::{Error, ErrorKind};
use crate::export::Format;
use crate::export::MAX_DIGITS;
use crate::export::entries::{Entries, Entry, first_line, of_toml};
use crate::export::provenance::{Origin, Part};
use crate::expression::Input;
use crate::limits::Limits;
use crate::properties::Properties;
use crate::suggestion::with_suggestion;
use crate::tableau::Tableau;

pub(super) type List = Spanned<Vec<Spanned<String>>>;
pub(super) type Matrix = Spanned<Vec<List>>;

/// The number of the format, whatever else a file has.
#[derive(Deserialize)]
struct FormatKey {
    format: Option<Spanned<toml::Value>>,
}

/// A file with the keys and shapes of a tableau; the entries are not checked yet.
pub(crate) struct Document {
    pub(crate) format: Format,
    name: Option<String>,
    provenance: Spanned<ProvenanceTable>,
    /// The data derived from the definition; a file written by hand has none.
    pub(super) derived: Option<Derived>,
}

/// The keys of a file.
#[derive(Deserialize)]
#[serde(deny_unknown_fields)]
struct Keys {
    // Read before the others.
    #[serde(rename = "format")]
    _format: Option<toml::Value>,
    name: Option<String>,
    stages: Option<Spanned<usize>>,
    provenance: Spanned<ProvenanceTable>,
    exact: Option<Exact>,
    decimals: Option<Decimals>,
    properties: Option<Spanned<BTreeMap<Spanned<String>, PropertyEntry>>>,
    order: Option<toml::Table>,
    stability: Option<toml::Table>,
}

/// The part of a file that can be derived again.
pub(super) struct Derived {
    stages: Spanned<usize>,
    pub(super) exact: Option<Exact>,
    decimals: Decimals,
    properties: Spanned<BTreeMap<Spanned<String>, PropertyEntry>>,
    /// Order and stability.
    facts: Vec<Entry>,
}

/// The parts of a definition, an entry for each [`Key`], with tier and source.
#[derive(Default)]
struct ProvenanceTable {
    parts: Vec<Part>,
    tier: Option<Spanned<String>>,
    source: Option<String>,
}

impl ProvenanceTable {
    const NAMES: [&str; Key::ALL.len() + 2] = {
        let mut names = ["tier"; Key::ALL.len() + 2];
        let mut k = 0;
        while k < Key::ALL.len() {
            names[k] = Key::ALL[k].name();
            k += 1;
        }
        names[k + 1] = "source";
        names
    };
}

/// A key of [`ProvenanceTable`].
enum ProvenanceKey {
    Part(Key),
    Tier,
    Source,
}

impl<'de> Deserialize<'de> for ProvenanceKey {
    fn deserialize<D: Deserializer<'de>>(deserializer: D) -> Result<Self, D::Error> {
        let name = String::deserialize(deserializer)?;
        match name.as_str() {
            "tier" => Ok(ProvenanceKey::Tier),
            "source" => Ok(ProvenanceKey::Source),
            _ => match Key::find(&name) {
                Some(key) => Ok(ProvenanceKey::Part(key)),
                None => Err(D::Error::unknown_field(&name, &ProvenanceTable::NAMES)),
            },
        }
    }
}

impl<'de> Deserialize<'de> for ProvenanceTable {
    fn deserialize<D: Deserializer<'de>>(deserializer: D) -> Result<Self, D::Error> {
        deserializer.deserialize_map(ProvenanceVisitor)
    }
}

struct ProvenanceVisitor;

impl<'de> Visitor<'de> for ProvenanceVisitor {
    type Value = ProvenanceTable;

    fn expecting(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        f.write_str("a table with the parts of a definition")
    }

    fn visit_map<M: MapAccess<'de>>(self, mut map: M) -> Result<ProvenanceTable, M::Error> {
        let mut table = ProvenanceTable::default();
        while let Some(key) = map.next_key()? {
            match key {
                ProvenanceKey::Tier => table.tier = Some(map.next_value()?),
                ProvenanceKey::Source => table.source = Some(map.next_value()?),
                ProvenanceKey::Part(key) => {
                    let (span, text) = if key.is_switch() {
                        let switch: Spanned<bool> = map.next_value()?;
                        (switch.span(), switch.get_ref().to_string())
                    } else {
                        let text: Spanned<String> = map.next_value()?;
                        (text.span(), text.into_inner())
                    };
                    table.parts.push(Part { key, text, span });
                }
            }
        }
        table.parts.sort_by_key(|part| part.key);
        Ok(table)
    }
}

#[derive(Deserialize)]
#[serde(deny_unknown_fields)]
pub(super) struct Exact {
    pub(super) node_polynomial: Option<List>,
    pub(super) b: List,
    pub(super) b_tilde: List,
    /// For gradient kicks only.
    gradient: Option<List>,
    pub(super) a: Option<Matrix>,
    pub(super) a_tilde: Option<Matrix>,
}

#[derive(Deserialize)]
#[serde(deny_unknown_fields)]
struct Decimals {
    digits: Spanned<usize>,
    c: List,
    c_tilde: List,
    b: List,
    b_tilde: List,
    gradient: Option<List>,
    a: Option<Matrix>,
    a_tilde: Option<Matrix>,
}

#[derive(Deserialize)]
#[serde(deny_unknown_fields)]
struct PropertyEntry {
    holds: Spanned<bool>,
    evidence: Spanned<String>,
    bits: Option<Spanned<u32>>,
    witness: Option<Spanned<String>>,
}

/// The text for an absent key.
const ABSENT: &str = "nothing";

impl Document {
    /// Reads the keys and shapes of a file.
    ///
    /// # Errors
    /// [`ErrorKind::Document`] if the text is not TOML, if keys are missing or unknown, or if
    /// lists have a wrong length; [`ErrorKind::TooManyStages`].
    pub fn parse(file: Input<'_>, limits: &Limits) -> Result<Self, Error> {
        let refused = |error: toml::de::Error| {
            let span = error.span().unwrap_or(0..0);
            let message = format!(
                "not a TOML file of a tableau: {}",
                with_suggestion(error.message())
            );
            document_error(file, span, message)
        };
        // A later format may have other keys.
        let FormatKey { format } = toml::from_str(file.text).map_err(refused)?;
        let stated = format.map(|number| {
            let value = number.get_ref().as_integer();
            (
                number.span(),
                value.and_then(|value| u64::try_from(value).ok()),
            )
        });
        let format = Format::read(file, stated)?;
        let keys: Keys = toml::from_str(file.text).map_err(refused)?;
        let sections = (
            format.is_older() || keys.order.is_some(),
            format.is_older() || keys.stability.is_some(),
        );
        let any = keys.order.is_some() || keys.stability.is_some();
        let derived = match (
            keys.stages,
            keys.exact,
            keys.decimals,
            keys.properties,
            sections,
        ) {
            (None, None, None, None, _) if !any => None,
            (Some(stages), exact, Some(decimals), Some(properties), (true, true)) => {
                Some(Derived {
                    stages,
                    exact,
                    decimals,
                    properties,
                    facts: facts(file.text),
                })
            }
            (stages, _, decimals, properties, (order, _)) => {
                let missing = match (stages, decimals, properties, order) {
                    (None, ..) => "stages",
                    (_, None, ..) => "decimals",
                    (_, _, None, _) => "properties",
                    (.., false) => "order",
                    _ => "stability",
                };
                let message = format!(
                    "not a TOML file of a tableau: missing field `{missing}`; a file that only defines a tableau has `[provenance]` alone"
                );
                return Err(document_error(file, 0..0, message));
            }
        };
        if let Some(derived) = &derived {
            derived.check_shapes(file, format, limits)?;
        }
        Ok(Document {
            format,
            name: keys.name,
            provenance: keys.provenance,
            derived,
        })
    }

    /// The significant digits of the decimals, if there are any.
    pub fn digits(&self) -> Option<usize> {
        self.derived
            .as_ref()
            .map(|derived| *derived.decimals.digits.get_ref())
    }

    /// Name and provenance.
    pub(super) fn origin(&self) -> Origin {
        let provenance = self.provenance.get_ref();
        Origin {
            name: self.name.clone(),
            parts: provenance.parts.clone(),
            source: provenance.source.clone(),
            span: self.provenance.span(),
        }
    }

    /// Derives the tableau again, with the name and the source of the file.
    ///
    /// # Errors
    /// The errors of [`Definition::derive`](crate::Definition::derive), with places in the file.
    pub fn derive(&self, file: Input<'_>, limits: &Limits) -> Result<Tableau, Error> {
        self.origin().derive(file, limits)
    }

    /// All entries except the name and the source, which cannot be derived.
    pub fn entries(&self) -> Entries {
        let Some(derived) = &self.derived else {
            return Entries {
                table: Vec::new(),
                facts: Vec::new(),
            };
        };
        let mut entries = vec![one("stages".to_owned(), &derived.stages)];
        for Part { key, text, span } in &self.provenance.get_ref().parts {
            entries.push(Entry::new(key.name(), text, span.clone()));
        }
        entries.extend(derived.coefficients());
        let tier = self.provenance.get_ref().tier.iter();
        let tier = tier.map(|tier| one("tier".to_owned(), tier));
        let mut facts: Vec<Entry> = tier.chain(derived.property_entries()).collect();
        facts.extend(derived.facts.iter().cloned());
        Entries {
            table: entries,
            facts,
        }
    }

    /// The properties that the file does not state.
    pub fn not_stated(&self) -> Vec<&'static str> {
        let Some(derived) = &self.derived else {
            return Vec::new();
        };
        let missing = Properties::NAMES
            .iter()
            .filter(|name| !derived.states(name));
        missing.copied().collect()
    }
}

/// The entries of the sections that are kept as they are.
fn facts(text: &str) -> Vec<Entry> {
    let mut entries = Vec::new();
    // The text has been parsed before.
    if let Ok(table) = toml::de::DeTable::parse(text) {
        for section in ["order", "stability"] {
            if let Some(value) = table.get_ref().get(section) {
                of_toml(section, value, &mut entries);
            }
        }
    }
    entries
}

fn one<T: ToString>(name: String, value: &Spanned<T>) -> Entry {
    Entry::new(name, value.get_ref().to_string(), value.span())
}

impl Derived {
    fn check_shapes(&self, file: Input<'_>, format: Format, limits: &Limits) -> Result<(), Error> {
        let stages = *self.stages.get_ref();
        if stages == 0 {
            let message = "a tableau has at least one stage".to_owned();
            return Err(document_error(file, self.stages.span(), message));
        }
        if stages > limits.stages {
            let kind = ErrorKind::TooManyStages {
                stages: stages.to_string(),
                limit: limits.stages,
            };
            return Err(file.error(&self.stages.span(), kind));
        }
        let digits = *self.decimals.digits.get_ref();
        if !(1..=MAX_DIGITS).contains(&digits) {
            let message = format!("the number of digits must be from 1 to {MAX_DIGITS}");
            return Err(document_error(file, self.decimals.digits.span(), message));
        }
        let length = |key: &str, found: usize, expected: usize, span: Range<usize>| {
            if found == expected {
                return Ok(());
            }
            let message = format!(
                "`{key}` has {found} entries where {expected} are needed for {stages} stages"
            );
            Err(document_error(file, span, message))
        };
        let decimals = &self.decimals;
        let mut vectors = vec![
            ("c", &decimals.c, stages),
            ("c_tilde", &decimals.c_tilde, stages),
            ("b", &decimals.b, stages),
            ("b_tilde", &decimals.b_tilde, stages),
        ];
        let gradient = |list| ("gradient", list, stages);
        vectors.extend(decimals.gradient.as_ref().map(gradient));
        let mut matrices = vec![("a", &decimals.a), ("a_tilde", &decimals.a_tilde)];
        if let Some(exact) = &self.exact {
            vectors.extend(exact.gradient.as_ref().map(gradient));
            vectors.extend([("b", &exact.b, stages), ("b_tilde", &exact.b_tilde, stages)]);
            let modulus = exact.node_polynomial.as_ref();
            vectors.extend(modulus.map(|list| ("node_polynomial", list, stages + 1)));
            matrices.extend([("a", &exact.a), ("a_tilde", &exact.a_tilde)]);
            let functions = exact.node_polynomial.as_ref();
            if let Some(list) = functions.filter(|_| exact.a.is_none() || exact.a_tilde.is_none()) {
                let message = "functions of the nodes have both `a` and `a_tilde`".to_owned();
                return Err(document_error(file, list.span(), message));
            }
        }
        vectors.sort_by_key(|(_, list, _)| list.span().start);
        // The matrices of a long splitting are left out.
        let written = matrices.into_iter();
        let written = written.filter_map(|(key, matrix)| Some((key, matrix.as_ref()?)));
        let mut matrices: Vec<(&str, &Matrix)> = written.collect();
        matrices.sort_by_key(|(_, matrix)| matrix.span().start);
        for (key, list, expected) in vectors {
            length(key, list.get_ref().len(), expected, list.span())?;
        }
        for (key, matrix) in matrices {
            length(key, matrix.get_ref().len(), stages, matrix.span())?;
            for (index, row) in matrix.get_ref().iter().enumerate() {
                let key = format!("{key}[{index}]");
                length(&key, row.get_ref().len(), stages, row.span())?;
            }
        }
        let properties = self.properties.get_ref();
        if let Some(unknown) = properties
            .keys()
            .find(|key| !Properties::NAMES.contains(&key.get_ref().as_str()))
        {
            let kind = ErrorKind::Unknown {
                what: "property",
                name: unknown.get_ref().clone(),
                known: Properties::NAMES.join(", "),
            };
            return Err(file.error(&unknown.span(), kind));
        }
        let mut missing = Properties::NAMES.iter().filter(|name| !self.states(name));
        if let Some(missing) = missing.next().filter(|_| !format.is_older()) {
            let message = format!("the property `{missing}` is missing");
            return Err(document_error(file, self.properties.span(), message));
        }
        Ok(())
    }

    /// Whether the file states a property.
    fn states(&self, name: &str) -> bool {
        let stated = self.properties.get_ref().keys();
        stated.into_iter().any(|key| key.get_ref() == name)
    }

    /// The number of stages.
    pub fn stages(&self) -> usize {
        *self.stages.get_ref()
    }

    /// The entries of exact coefficients: of polynomials in the nodes if there is a node polynomial,
    /// and of the tableau itself otherwise.
    fn exact_entries(&self) -> Vec<Entry> {
        let mut entries = Vec::new();
        let Some(exact) = &self.exact else {
            return entries;
        };
        let functions = exact.node_polynomial.is_some();
        let node_polynomial = exact.node_polynomial.iter();
        let lists = node_polynomial.map(|list| ("the node polynomial", list));
        let weights = [("b", &exact.b), ("b̃", &exact.b_tilde)];
        let gradient = exact.gradient.iter().map(|list| ("g", list));
        for (name, list) in lists.chain(weights).chain(gradient) {
            for (index, value) in list.get_ref().iter().enumerate() {
                let name = if functions {
                    format!("{name}, coefficient of {} (exact)", monomial(index, 0))
                } else {
                    format!("{name}_{} (exact)", index + 1)
                };
                entries.push(one(name, value));
            }
        }
        for (name, matrix) in [("a", &exact.a), ("ã", &exact.a_tilde)] {
            for (row, list) in matrix.iter().flat_map(Spanned::get_ref).enumerate() {
                for (column, value) in list.get_ref().iter().enumerate() {
                    let name = if functions {
                        format!("{name}, coefficient of {} (exact)", monomial(column, row))
                    } else {
                        format!("{name}_{} (exact)", subscript(row + 1, column + 1))
                    };
                    entries.push(one(name, value));
                }
            }
        }
        entries
    }

    fn coefficients(&self) -> Vec<Entry> {
        let mut entries = self.exact_entries();
        let decimals = &self.decimals;
        entries.push(one("digits".to_owned(), &decimals.digits));
        let lists = [
            ("c", &decimals.c),
            ("c̃", &decimals.c_tilde),
            ("b", &decimals.b),
            ("b̃", &decimals.b_tilde),
        ];
        let gradient = decimals.gradient.iter().map(|list| ("g", list));
        for (name, list) in lists.into_iter().chain(gradient) {
            for (index, value) in list.get_ref().iter().enumerate() {
                entries.push(one(format!("{name}_{} (decimal)", index + 1), value));
            }
        }
        for (name, matrix) in [("a", &decimals.a), ("ã", &decimals.a_tilde)] {
            for (row, list) in matrix.iter().flat_map(Spanned::get_ref).enumerate() {
                for (column, value) in list.get_ref().iter().enumerate() {
                    let index = subscript(row + 1, column + 1);
                    entries.push(one(format!("{name}_{index} (decimal)"), value));
                }
            }
        }
        entries
    }

    fn property_entries(&self) -> Vec<Entry> {
        let mut entries = Vec::new();
        for name in Properties::NAMES {
            let properties = self.properties.get_ref().iter();
            for (key, property) in properties.filter(|(key, _)| key.get_ref() == name) {
                // An absent key has the place of the property.
                let absent =
                    |field: &str| Entry::new(format!("{name} ({field})"), ABSENT, key.span());
                let optional =
                    |field: &str, entry: Option<Entry>| entry.unwrap_or_else(|| absent(field));
                let label = |field: &str| format!("{name} ({field})");
                // A witness with this text differs from an absent witness.
                let stated = |text: &Spanned<String>| match text.get_ref().as_str() {
                    ABSENT => Entry::new(label("witness"), format!("{ABSENT:?}"), text.span()),
                    _ => one(label("witness"), text),
                };
                let bits = property.bits.as_ref();
                let witness = property.witness.as_ref();
                entries.extend([
                    one(label("holds"), &property.holds),
                    one(label("evidence"), &property.evidence),
                    optional("bits", bits.map(|bits| one(label("bits"), bits))),
                    optional("witness", witness.map(stated)),
                ]);
            }
        }
        entries
    }
}

/// The product of powers `x^k y^l`.
fn monomial(x: usize, y: usize) -> String {
    let power = |name: &str, exponent: usize| match exponent {
        0 => None,
        1 => Some(name.to_owned()),
        _ => Some(format!("{name}^{exponent}")),
    };
    let factors: Vec<String> = [power("x", x), power("y", y)]
        .into_iter()
        .flatten()
        .collect();
    if factors.is_empty() {
        "1".to_owned()
    } else {
        factors.join(" ")
    }
}

/// An error in the form of a file.
pub(super) fn document_error(file: Input<'_>, span: Range<usize>, message: String) -> Error {
    let span = first_line(file.text, span);
    file.error(&span, ErrorKind::Document { message })
}
