//! The lists of numbers of a table in a file.

use std::collections::BTreeMap;

use toml::Spanned;

use symplectic_compiler::expression::Input;
use symplectic_compiler::inside::{Notation, Value, first_line, value_of};
use symplectic_compiler::{Error, ErrorKind};

/// The texts of the lists by their names.
pub(super) type Table = BTreeMap<String, Spanned<Vec<Spanned<String>>>>;

/// The lists of numbers of a table.
pub(super) struct Lists<'a> {
    file: Input<'a>,
    title: &'a Spanned<String>,
    table: &'a Table,
}

impl<'a> Lists<'a> {
    /// Those of a table of a file.
    pub fn new(file: Input<'a>, title: &'a Spanned<String>, table: &'a Table) -> Self {
        Lists { file, title, table }
    }

    /// An error at the title of the table.
    pub fn at_title(&self, kind: ErrorKind) -> Error {
        let place = first_line(self.file.text, self.title.span());
        self.file.error(&place, kind)
    }

    /// The names.
    pub fn names(&self) -> impl Iterator<Item = &str> {
        self.table.keys().map(String::as_str)
    }

    /// The list of this name, if the table has it.
    pub fn list(&self, name: &str) -> Result<Option<Vec<Value>>, Error> {
        let Some(list) = self.table.get(name) else {
            return Ok(None);
        };
        let values = list.get_ref().iter().map(|text| {
            // Without the quotes.
            let span = text.span();
            let inner = span.start + 1..span.end.saturating_sub(1);
            value_of(self.file, inner, Notation::Julia)
        });
        values.collect::<Result<_, _>>().map(Some)
    }
}
