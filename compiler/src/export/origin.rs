//! What a file says about where its tableau comes from.

use std::ops::Range;

use crate::definition::{Definition, Key};
use crate::derive::derive_within;
use crate::error::{Error, Place};
use crate::expression::Input;
use crate::limits::Limits;
use crate::tableau::Tableau;

/// Name and provenance as a file gives them, with the place of the two expressions.
pub(super) struct Origin {
    pub name: Option<String>,
    pub basis: (String, Range<usize>),
    pub nodes: (String, Range<usize>),
    pub source: Option<String>,
}

impl Origin {
    /// What the file says that its tableau is derived from.
    pub fn definition(&self) -> Definition {
        Definition::new([(Key::Basis, &*self.basis.0), (Key::Nodes, &*self.nodes.0)])
    }

    /// Derives the tableau anew.
    ///
    /// # Errors
    /// As [`derive_within`], with places in the file.
    pub fn derive(&self, file: Input<'_>, limits: &Limits) -> Result<Tableau, Error> {
        let mut tableau = derive_within(&self.basis.0, &self.nodes.0, limits)
            .map_err(|error| self.in_file(file, error))?;
        tableau.name.clone_from(&self.name);
        tableau.provenance.source.clone_from(&self.source);
        Ok(tableau)
    }

    /// Moves the place of an error from an expression to the file that the expression stands in.
    fn in_file(&self, file: Input<'_>, mut error: Error) -> Error {
        if let Some(place) = error.place.take() {
            let (expression, whole) = if place.input == "basis" {
                &self.basis
            } else {
                &self.nodes
            };
            // Between two quotes and without escapes, bytes of the expression are bytes of the file.
            let quoted = file.text.get(whole.start + 1..whole.end.saturating_sub(1));
            let span = if quoted == Some(expression.as_str()) {
                let moved = |offset: usize| whole.start + 1 + offset.min(expression.len());
                moved(place.span.start)..moved(place.span.end)
            } else {
                whole.clone()
            };
            error.place = Some(Place {
                input: file.name.to_owned(),
                text: file.text.to_owned(),
                span,
            });
        }
        error
    }
}
