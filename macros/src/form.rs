//! What the three macros expect.

use symplectic_compiler::Key;

/// A macro: any definition, or those of one kind.
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
                Key::First,
                Key::Claim,
                Key::Symmetric,
                Key::Exchange,
                Key::Adjoint,
            ],
            Form::Composition => &[
                Key::Base,
                Key::Weights,
                Key::Compose,
                Key::Claim,
                Key::Symmetric,
                Key::Exchange,
                Key::Adjoint,
            ],
        }
    }

    /// Sets of keys one of which a definition needs; none where the compiler says what is missing.
    pub fn needed(self) -> &'static [&'static [Key]] {
        match self {
            Form::Tableau => &[],
            Form::Splitting => &[&[Key::Kick, Key::Drift]],
            Form::Composition => &[&[Key::Base], &[Key::Compose]],
        }
    }

    /// The keys beside the parts of a definition.
    pub fn others(self) -> &'static [&'static str] {
        match self {
            Form::Tableau => &["file", "require", "accept", "max_stages"],
            Form::Splitting | Form::Composition => &["require", "accept", "max_stages"],
        }
    }

    /// A definition as it looks.
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
