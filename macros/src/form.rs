//! The keys of the three macros of methods.

use symplectic_compiler::Key;

/// A macro, for any definition or for one kind of definition.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum Form {
    /// `tableau!`, which takes all keys.
    Tableau,
    /// `splitting!`
    Splitting,
    /// `composition!`
    Composition,
}

impl Form {
    /// The parts of a definition that the macro takes.
    pub fn keys(self) -> &'static [Key] {
        match self {
            Form::Tableau => &Key::ALL,
            Form::Splitting => &[
                Key::Kick,
                Key::Drift,
                Key::Gradient,
                Key::First,
                Key::Processor,
                Key::Claim,
                Key::Symmetric,
                Key::Exchange,
                Key::Adjoint,
            ],
            Form::Composition => &[
                Key::Base,
                Key::Weights,
                Key::Compose,
                Key::Processor,
                Key::Claim,
                Key::Symmetric,
                Key::Exchange,
                Key::Adjoint,
            ],
        }
    }

    /// The sets of keys, of which a definition needs one. Empty if the compiler reports missing keys.
    pub fn needed(self) -> &'static [&'static [Key]] {
        match self {
            Form::Tableau => &[],
            Form::Splitting => &[&[Key::Kick, Key::Drift]],
            Form::Composition => &[&[Key::Base], &[Key::Compose]],
        }
    }

    /// The keys that are not parts of a definition.
    pub fn others(self) -> &'static [&'static str] {
        match self {
            Form::Tableau => &["file", "require", "accept", "max_stages"],
            Form::Splitting | Form::Composition => &["require", "accept", "max_stages"],
        }
    }

    /// An example of a definition, for error messages.
    pub fn shape(self) -> &'static str {
        match self {
            Form::Tableau => "expected `pub Name { basis: polynomial(3), nodes: lobatto(3) }`",
            Form::Splitting => "expected `pub Name { kick: [1/2, 1/2], drift: [1, 0] }`",
            Form::Composition => {
                "expected `pub Name { base: StoermerVerlet, weights: triple_jump(4) }`"
            }
        }
    }
}
