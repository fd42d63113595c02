//! Expressions in a run file, with the names of the formula.

use std::ops::Range;

use symplectic_compiler::Error;
use symplectic_compiler::expression::Input;
use symplectic_formula::{Form, System};
use symplectic_tape::{Entry, MAX_OPERATIONS, Refusal, Tape, Values};

use crate::setup::{File, Setup};

/// What expressions refer to.
pub(super) struct Names<'a> {
    pub(super) file: &'a File<'a>,
    pub(super) setup: &'a Setup,
    pub(super) values: &'a Values,
    /// Numbers that the formula does not have.
    pub(super) further: &'a [(String, Entry)],
}

impl Names<'_> {
    /// The tape of an expression, which is the value of `key` at `span`.
    pub(super) fn tape(&self, key: &str, text: &str, span: Range<usize>) -> Result<Tape, Error> {
        let file = self.file;
        let formula = self.setup.system.get_ref();
        let expression = Input {
            name: &format!("`{key}` in {}", file.path.display()),
            text,
        };
        let (numbers, entries): (Vec<String>, Vec<Entry>) = self.further.iter().cloned().unzip();
        let read = System::read_with(Form::of(formula), formula, &numbers, expression);
        let (system, parts) = read.map_err(|error| file.inside(span.clone(), text, error))?;
        let &[part] = &parts[..] else {
            let message = match parts.len() {
                0 => format!("`{key}` has no components: give an expression with a value"),
                count => {
                    format!("`{key}` has {count} components: give one of them, or a run for each")
                }
            };
            return Err(file.error(span, message));
        };
        let mut values = self.values.clone();
        let rows = entries.into_iter().map(|entry| vec![vec![entry]]);
        values.parameters.extend(rows);
        values.pairs.resize(values.parameters.len(), Vec::new());
        let tape = Tape::of_value(&system, &values, part, Some(self.setup.start()));
        tape.map_err(|refusal| {
            let message = match refusal {
                Refusal::TooLong => format!(
                    "with its sums written out, `{key}` has more than {MAX_OPERATIONS} operations: give a shorter expression, or take fewer bodies"
                ),
                Refusal::Outside => format!(
                    "an index in `{key}` is out of range: that coordinate or entry of a parameter does not exist; positions are from 0 to {}",
                    values.bodies.saturating_sub(1)
                ),
            };
            file.error(span, message)
        })
    }
}
