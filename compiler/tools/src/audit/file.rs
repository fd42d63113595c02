//! Reading a file of tables.

use std::ops::Range;

use serde::Deserialize;
use toml::Spanned;

use super::convention::{Convention, Steps};
use super::lists::{Lists, Table};
use super::row::{Claim, Row, Source};
use symplectic_compiler::Library;
use symplectic_compiler::Limits;
use symplectic_compiler::expression::Input;
use symplectic_compiler::inside::first_line;
use symplectic_compiler::inside::shown;
use symplectic_compiler::inside::with_suggestion;
use symplectic_compiler::order::HamiltonianClass;
use symplectic_compiler::{Error, ErrorKind};

#[derive(Deserialize)]
#[serde(deny_unknown_fields)]
struct Keys {
    library: String,
    version: String,
    source: String,
    convention: Option<Spanned<String>>,
    steps: Option<Spanned<Steps>>,
    table: Vec<TableKeys>,
}

#[derive(Deserialize)]
#[serde(deny_unknown_fields)]
struct TableKeys {
    name: Spanned<String>,
    order: usize,
    class: Spanned<String>,
    note: Option<String>,
    numbers: Table,
}

/// The rows of a file.
pub(super) fn rows(file: Input<'_>, limits: &Limits) -> Result<Vec<Row>, Error> {
    let keys: Keys = toml::from_str(file.text).map_err(|error| {
        let message = format!("not a file of tables: {}", with_suggestion(error.message()));
        wrong(file, error.span().unwrap_or(0..0), message)
    })?;
    let convention = convention(file, keys.convention, keys.steps)?;
    let source = Source {
        library: keys.library,
        version: keys.version,
        source: keys.source,
        convention: convention.text(),
    };
    let row = |table: &TableKeys| {
        let class = class(file, &table.class)?;
        let numbers = convention.numbers(&Lists::new(file, &table.name, &table.numbers), limits)?;
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

/// How the numbers of a file are stepped.
fn convention(
    file: Input<'_>,
    library: Option<Spanned<String>>,
    steps: Option<Spanned<Steps>>,
) -> Result<Convention, Error> {
    match (library, steps) {
        (Some(name), None) => {
            let library = Library::find(name.get_ref())
                .map_err(|error| file.error(&first_line(file.text, name.span()), *error.kind))?;
            Ok(Convention::Library(library))
        }
        (None, Some(steps)) => {
            let span = steps.span();
            let convention = steps.into_inner().convention();
            convention.map_err(|message| wrong(file, span, message))
        }
        (None, None) => {
            let known = Library::ALL.map(Library::name).join(", ");
            let message = format!(
                "`convention` is missing: whether kicks or drifts come first, and which numbers they are, must be stated; one of {known}, \
                 or `[steps]` with the names of the lists"
            );
            Err(wrong(file, 0..0, message))
        }
        (Some(name), Some(_)) => {
            let message = "`convention` and `[steps]` both state how numbers are stepped: keep one"
                .to_owned();
            Err(wrong(file, name.span(), message))
        }
    }
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
