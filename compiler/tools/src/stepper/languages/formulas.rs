//! The notation of formulas in each language.

use super::super::Stepper;
use super::{c, julia, python, rust};

/// The templates of a language for the functions of a system, and for statements and expressions. Names in `@` mark values.
pub(in super::super) struct Formulas {
    /// Parameters, velocity, force and energy.
    pub template: &'static str,
    /// The spaces before a line of a function.
    pub indent: usize,
    /// Lines as comments.
    pub comment: fn(&[String]) -> String,
    /// The declaration of the type with its parameters; the last argument is the least number of coordinates.
    pub declare: fn(&[Field], usize) -> String,
    /// How the stepper takes the system.
    pub usage: fn(&[Field]) -> Vec<String>,
    /// An argument that is a vector.
    pub argument: &'static str,
    /// What a function with this body begins with; the last arguments are the prefix and the vectors that it has.
    pub start: fn(&str, &str, &[&str]) -> String,
    /// The check of the number of coordinates, before all functions.
    pub enough: &'static str,
    /// The same, where a derivative is written.
    pub too_few: &'static str,
    /// The same, where the energy is returned.
    pub too_few_for_energy: &'static str,
    /// A vector is set to zero.
    pub clear: &'static str,
    /// A value gets a name.
    pub name: &'static str,
    /// A sum begins with zero.
    pub zero: &'static str,
    /// A value is added.
    pub increase: &'static str,
    /// A value is set.
    pub set: &'static str,
    /// A value is returned.
    pub result: &'static str,
    /// A loop begins: from `start` up to but excluding `end`, which is `last + 1`; or while `before < limit`.
    pub range: &'static str,
    /// The start of a loop over a list of pairs: the line of the loop, and lines in it that name both indices. They leave the function
    /// if one index is not less than the number of `bodies`.
    pub pairs: &'static [&'static str],
    /// Leaves a function that writes a derivative, without a result.
    pub outside: &'static str,
    /// The same, where the energy is returned.
    pub outside_energy: &'static str,
    /// A loop ends.
    pub end: &'static str,
    /// A parameter.
    pub member: &'static str,
    /// An entry of a parameter with two indices, of lengths that are open and fixed.
    pub matrix: [&'static str; 2],
    /// A length.
    pub length_member: &'static str,
    /// The name of a length without a name.
    pub length: &'static str,
    /// The name of a length with a name.
    pub named_length: &'static str,
    /// The number of pairs in a list.
    pub count: Count,
    /// A multiple of a length.
    pub multiple: &'static str,
    /// The first index.
    pub first: i64,
    /// Infinity.
    pub infinity: &'static str,
    /// The functions of the library.
    pub functions: Functions,
    /// Words that parameters cannot have as names.
    pub words: &'static [&'static str],
    /// More words that the type cannot have as its name.
    pub types: &'static [&'static str],
}

/// The functions of a library.
pub(in super::super) struct Functions {
    /// The square root.
    pub root: &'static str,
    /// The absolute value.
    pub absolute: &'static str,
    /// The number `a`, or 0 if `b` is 0.
    pub or_zero: &'static str,
    /// The natural logarithm.
    pub logarithm: &'static str,
    /// The angle of a point.
    pub angle: &'static str,
    /// Before the names of the others, which all languages share.
    pub prefix: &'static str,
}

/// The number of pairs in a list.
pub(in super::super) enum Count {
    /// A length with this name.
    Length(&'static str),
    /// An expression of the list.
    Expression(&'static str),
}

/// A length that the formula leaves open, or a parameter.
pub(in super::super) struct Field {
    /// Its name in the language.
    pub name: String,
    /// Its shape.
    pub shape: FieldShape,
}

/// The shape of a [`Field`].
pub(in super::super) enum FieldShape {
    /// A length.
    Length,
    /// A number, with its value unless it is set.
    Number(Option<f64>),
    /// An array with one or two lengths; whether both are numbers.
    Array {
        lengths: Vec<String>,
        is_fixed: bool,
    },
    /// A list of pairs of indices, with the number of pairs.
    Pairs { count: String },
}

impl Field {
    /// The value of the definition, unless it is too large for a double.
    pub fn default(&self) -> Option<String> {
        match self.shape {
            FieldShape::Number(Some(value)) if value.is_finite() => Some(format!("{value:?}")),
            _ => None,
        }
    }

    /// Each field by `pattern`, with its value or `...`, separated by commas.
    pub fn values(fields: &[Self], pattern: fn(&str, &str) -> String) -> String {
        let value = |field: &Field| {
            let value = field.default().unwrap_or_else(|| "...".to_owned());
            pattern(&field.name, &value)
        };
        fields.iter().map(value).collect::<Vec<_>>().join(", ")
    }
}

/// The notation of a language.
pub(in super::super) fn formulas(language: Stepper) -> &'static Formulas {
    match language {
        Stepper::C => &c::FORMULAS,
        Stepper::Rust => &rust::FORMULAS,
        Stepper::Julia => &julia::FORMULAS,
        Stepper::Python => &python::FORMULAS,
    }
}
