//! The notation of each language.

mod c;
pub(super) mod formulas;
mod julia;
mod python;
mod rust;

use super::Stepper;

/// The templates of a language for a stepper, and of its parts. Names in `@` mark values.
pub(super) struct Notation {
    /// A file with drifts and kicks.
    pub splitting: &'static str,
    /// A file with coupled stages.
    pub coupled: &'static str,
    /// The compensated sum.
    pub add: &'static str,
    /// Whether the force at the end of a step is reused at the start of the next: no, yes.
    pub carries: [&'static str; 2],
    /// A force and its kick.
    pub kick: &'static str,
    /// A kick whose force may have been evaluated in the previous step.
    pub carried_kick: &'static str,
    /// A velocity and its drift.
    pub drift: &'static str,
    /// A table of numbers.
    pub vector: &'static str,
    /// A line of a table of numbers.
    pub entry: &'static str,
    /// A table of rows.
    pub matrix: &'static str,
    /// A line of a table of rows.
    pub row: &'static str,
    /// A double, exactly.
    pub number: fn(f64) -> String,
    /// Lines as comments.
    pub comment: fn(&[String]) -> String,
    /// One line as a comment.
    pub remark: fn(&str) -> String,
}

/// The notation of a language.
pub(super) fn notation(language: Stepper) -> &'static Notation {
    match language {
        Stepper::C => &c::NOTATION,
        Stepper::Rust => &rust::NOTATION,
        Stepper::Julia => &julia::NOTATION,
        Stepper::Python => &python::NOTATION,
    }
}

/// The shortest decimal that reads back to the double.
fn shortest(value: f64) -> String {
    format!("{value:?}")
}
