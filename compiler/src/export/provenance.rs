//! The provenance of a tableau in a file.

use std::ops::Range;

use crate::definition::{Definition, Key};
use crate::error::{Error, Place};
use crate::export::entries::first_line;
use crate::expression::Input;
use crate::limits::Limits;
use crate::tableau::Tableau;

/// A part of a definition in a file.
#[derive(Clone)]
pub(super) struct Part {
    pub key: Key,
    /// Its text.
    pub text: String,
    /// Its bytes in the file, including quotes.
    pub span: Range<usize>,
}

/// Name, definition and source in a file.
pub(super) struct Origin {
    pub name: Option<String>,
    pub parts: Vec<Part>,
    pub source: Option<String>,
    /// The bytes of the file that all parts span together.
    pub span: Range<usize>,
}

impl Origin {
    /// The definition of the tableau in the file.
    pub fn definition(&self) -> Definition {
        Definition::new(self.parts.iter().map(|part| (part.key, &*part.text)))
    }

    /// Derives the tableau again.
    ///
    /// # Errors
    /// The errors of [`Definition::derive`], with places in the file.
    pub fn derive(&self, file: Input<'_>, limits: &Limits) -> Result<Tableau, Error> {
        let derived = self.definition().derive(limits);
        let mut tableau = derived.map_err(|error| self.in_file(file, error))?;
        let wrong = std::mem::take(&mut tableau.wrong_digits).into_iter();
        tableau.wrong_digits = wrong.map(|error| self.in_file(file, error)).collect();
        tableau.name.clone_from(&self.name);
        tableau.provenance.source.clone_from(&self.source);
        Ok(tableau)
    }

    /// Moves the place of an error from an expression to the file that contains it. An error
    /// in the combination of the parts is placed at all of them.
    fn in_file(&self, file: Input<'_>, mut error: Error) -> Error {
        let found = error.place.as_ref().and_then(|place| {
            let part = self.parts.iter().find(|p| p.key.name() == place.input)?;
            Some(moved(file.text, part, &place.span))
        });
        let span = found.unwrap_or_else(|| first_line(file.text, self.span.clone()));
        error.place = Some(Place {
            input: file.name.to_owned(),
            text: file.text.to_owned(),
            span,
        });
        error
    }
}

/// The bytes of a file for a range of bytes of a part.
fn moved(file: &str, part: &Part, within: &Range<usize>) -> Range<usize> {
    let Part { text, span, .. } = part;
    // Without escapes, bytes between the quotes are the bytes of the expression.
    let quoted = file.get(span.start + 1..span.end.saturating_sub(1));
    if quoted != Some(text.as_str()) {
        return span.clone();
    }
    let offset = |offset: usize| span.start + 1 + offset.min(text.len());
    offset(within.start)..offset(within.end)
}
