//! Reading a file of tables.

use std::collections::BTreeMap;
use std::ops::Range;

use serde::Deserialize;
use toml::Spanned;

use super::row::{Claim, Row, Source};
use crate::import::{Flows, Numbers, half};
use symplectic_compiler::Library;
use symplectic_compiler::Limits;
use symplectic_compiler::expression::Input;
use symplectic_compiler::inside::Notation;
use symplectic_compiler::inside::first_line;
use symplectic_compiler::inside::shown;
use symplectic_compiler::inside::with_suggestion;
use symplectic_compiler::inside::{Value, value_of};
use symplectic_compiler::order::HamiltonianClass;
use symplectic_compiler::{Error, ErrorKind};

type List = Spanned<Vec<Spanned<String>>>;

#[derive(Deserialize)]
#[serde(deny_unknown_fields)]
struct Keys {
    library: String,
    version: String,
    source: String,
    convention: Option<Spanned<String>>,
    table: Vec<TableKeys>,
}

#[derive(Deserialize)]
#[serde(deny_unknown_fields)]
struct TableKeys {
    name: Spanned<String>,
    order: usize,
    class: Spanned<String>,
    note: Option<String>,
    numbers: BTreeMap<String, List>,
}

/// The rows of a file.
pub(super) fn rows(file: Input<'_>, limits: &Limits) -> Result<Vec<Row>, Error> {
    let keys: Keys = toml::from_str(file.text).map_err(|error| {
        let message = format!("not a file of tables: {}", with_suggestion(error.message()));
        wrong(file, error.span().unwrap_or(0..0), message)
    })?;
    let Some(convention) = &keys.convention else {
        let known = Library::ALL.map(Library::name).join(", ");
        let message = format!(
            "`convention` is missing: whether kicks or drifts come first, and which numbers they are, must be stated; one of {known}"
        );
        return Err(wrong(file, 0..0, message));
    };
    let library = Library::find(convention.get_ref())
        .map_err(|error| file.error(&first_line(file.text, convention.span()), *error.kind))?;
    let source = Source {
        library: keys.library,
        version: keys.version,
        source: keys.source,
        convention: library,
    };
    let row = |table: &TableKeys| {
        let class = class(file, &table.class)?;
        let numbers = numbers(file, library, table, limits)?;
        let claim = Claim {
            order: table.order,
            class,
        };
        Row::new(
            &source,
            table.name.get_ref(),
            claim,
            table.note.clone(),
            &numbers,
            limits,
        )
    };
    keys.table.iter().map(row).collect()
}

fn wrong(file: Input<'_>, span: Range<usize>, message: String) -> Error {
    file.error(
        &first_line(file.text, span),
        ErrorKind::Document { message },
    )
}

fn class(file: Input<'_>, name: &Spanned<String>) -> Result<HamiltonianClass, Error> {
    let known = HamiltonianClass::ALL.into_iter();
    let found = known
        .into_iter()
        .find(|class| class.name() == name.get_ref());
    found.ok_or_else(|| {
        let kind = ErrorKind::Unknown {
            what: "class",
            name: shown(name.get_ref()),
            known: HamiltonianClass::ALL.map(HamiltonianClass::name).join(", "),
        };
        file.error(&first_line(file.text, name.span()), kind)
    })
}

/// The numbers of a table, with the library's letters.
fn numbers(
    file: Input<'_>,
    library: Library,
    table: &TableKeys,
    limits: &Limits,
) -> Result<Numbers, Error> {
    let at_name = |kind: ErrorKind| file.error(&first_line(file.text, table.name.span()), kind);
    let list = |name: &str| -> Result<Vec<Value>, Error> {
        let missing = || ErrorKind::Document {
            message: format!(
                "the numbers `{name}` are missing, which `{}` has",
                library.name()
            ),
        };
        let list = table.numbers.get(name).ok_or_else(|| at_name(missing()))?;
        let values = list.get_ref().iter().map(|text| {
            // Without the quotes.
            let span = text.span();
            value_of(
                file,
                span.start + 1..span.end.saturating_sub(1),
                Notation::Julia,
            )
        });
        values.collect()
    };
    let allowed: Vec<&str> = match library.stepping() {
        Some(stepping) => vec![stepping.drift, stepping.kick],
        None => vec!["a", "b", "a_tilde", "b_tilde"],
    };
    if let Some(name) = table
        .numbers
        .keys()
        .find(|name| !allowed.contains(&name.as_str()))
    {
        let message = format!(
            "`{}` has no numbers `{}`; it has {}",
            library.name(),
            shown(name),
            allowed.join(", ")
        );
        return Err(at_name(ErrorKind::Document { message }));
    }
    if let Some(stepping) = library.stepping() {
        let (drifts, kicks) = (list(stepping.drift)?, list(stepping.kick)?);
        return Numbers::splitting(&Flows::from(&stepping), drifts, kicks, limits).map_err(at_name);
    }
    let halves = |a: &str, b: &str| -> Result<_, Error> {
        let matrix = list(a)?;
        half(matrix, list(b)?, None, limits).map_err(at_name)
    };
    let momenta = match table.numbers.contains_key("a_tilde") {
        true => Some(halves(
            "a_tilde",
            if table.numbers.contains_key("b_tilde") {
                "b_tilde"
            } else {
                "b"
            },
        )?),
        false => None,
    };
    let positions = halves("a", "b")?;
    Ok(Numbers::RungeKutta { positions, momenta })
}
