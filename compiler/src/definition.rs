//! What a tableau is derived from: the texts that a person writes.

use std::collections::BTreeMap;
use std::fmt;

use crate::error::{Error, ErrorKind};
use crate::expression::Input;

/// The parts of a definition.
#[derive(Debug, Clone, Copy, PartialEq, Eq, PartialOrd, Ord, Hash)]
pub enum Key {
    /// The functions in which velocities are approximated: `polynomial(3)`, `1, cos(pi*t), sin(pi*t)`.
    Basis,
    /// The nodes of the square construction: `lobatto(3)`, `0, 1/2, 1`.
    Nodes,
    /// The nodes of the quadrature formula of the rectangular construction, as many as there are
    /// functions or more.
    Quadrature,
    /// The weights of the quadrature formula, if they are not the interpolatory ones.
    Weights,
    /// Given coefficients `a_ij`: `[[0, 0], [1/2, 1/2]]`.
    A,
    /// Given weights `b_i`.
    B,
    /// Given coefficients `ã_ij`, or `symplectic_partner`; `a` where they are not given.
    ATilde,
    /// Given weights `b̃_i`; `b` where they are not given.
    BTilde,
    /// `true` where the coefficients for positions and momenta are exchanged in the end.
    Exchange,
}

impl Key {
    /// All keys, in the order in which they are written.
    pub const ALL: [Key; 9] = [
        Key::Basis,
        Key::Nodes,
        Key::Quadrature,
        Key::Weights,
        Key::A,
        Key::B,
        Key::ATilde,
        Key::BTilde,
        Key::Exchange,
    ];

    /// The key as it is written in the macro and in files.
    pub fn name(self) -> &'static str {
        match self {
            Key::Basis => "basis",
            Key::Nodes => "nodes",
            Key::Quadrature => "quadrature",
            Key::Weights => "weights",
            Key::A => "a",
            Key::B => "b",
            Key::ATilde => "a_tilde",
            Key::BTilde => "b_tilde",
            Key::Exchange => "exchange",
        }
    }

    /// The key of this name.
    pub fn find(name: &str) -> Option<Key> {
        Key::ALL.into_iter().find(|key| key.name() == name)
    }
}

/// What a tableau is derived from: `basis: polynomial(3), nodes: lobatto(3)`.
///
/// | parts | construction |
/// |---|---|
/// | `basis`, `nodes` | square: as many functions as nodes (LZ §4.4) |
/// | `basis`, `quadrature`, perhaps `weights` | rectangular Galerkin: at least as many nodes (T §2.2) |
/// | `a`, `b`, perhaps `a_tilde`, `b_tilde` | given coefficients |
///
/// Each may have `exchange: true`. Every value is text in the grammar of [`expression`](crate::expression).
#[derive(Debug, Clone, Default, PartialEq, Eq)]
pub struct Definition {
    parts: BTreeMap<Key, String>,
}

impl Definition {
    /// The definition with these parts.
    pub fn new<T: Into<String>>(parts: impl IntoIterator<Item = (Key, T)>) -> Self {
        Definition {
            parts: parts
                .into_iter()
                .map(|(key, text)| (key, text.into()))
                .collect(),
        }
    }

    /// Reads `basis: polynomial(3), nodes: [0, 1/2, 1]`, as it is printed.
    ///
    /// # Errors
    /// [`ErrorKind::Syntax`] where a key is unknown or given twice.
    ///
    /// ```
    /// use symplectic_compiler::{Definition, Key, Limits};
    ///
    /// let definition = Definition::parse("basis: polynomial(3), nodes: [0, 1/4, 1]")?;
    /// assert_eq!(definition.get(Key::Nodes), Some("[0, 1/4, 1]"));
    /// assert_eq!(definition.derive(&Limits::default())?.stages(), 3);
    /// # Ok::<(), symplectic_compiler::Error>(())
    /// ```
    pub fn parse(text: &str) -> Result<Self, Error> {
        let input = Input {
            name: "definition",
            text,
        };
        let error = |start: usize, end: usize, found: String| {
            let expected = Key::ALL.map(|key| format!("`{}:`", key.name())).join(", ");
            let kind = ErrorKind::Syntax {
                found,
                expected: format!("one of {expected}, each once"),
            };
            input.error(&(start..end), kind)
        };
        // Commas outside brackets end a part.
        let mut definition = Definition::default();
        let (mut depth, mut start) = (0_i32, 0);
        let bytes = text.as_bytes();
        for end in 0..=bytes.len() {
            match bytes.get(end) {
                Some(b'(' | b'[') => depth += 1,
                Some(b')' | b']') => depth -= 1,
                None | Some(b',') if depth <= 0 || end == bytes.len() => {
                    let part = &text[start..end];
                    let missing = || error(start, end, format!("`{}`", part.trim()));
                    let (name, value) = part.split_once(':').ok_or_else(missing)?;
                    let key = Key::find(name.trim()).ok_or_else(missing)?;
                    if definition.parts.contains_key(&key) {
                        return Err(error(start, end, format!("a second `{}`", key.name())));
                    }
                    definition.parts.insert(key, value.trim().to_owned());
                    start = end + 1;
                }
                _ => {}
            }
        }
        Ok(definition)
    }

    /// The text of a part.
    pub fn get(&self, key: Key) -> Option<&str> {
        self.parts.get(&key).map(String::as_str)
    }

    /// All parts that are there.
    pub fn parts(&self) -> impl Iterator<Item = (Key, &str)> {
        self.parts.iter().map(|(&key, text)| (key, text.as_str()))
    }
}

impl fmt::Display for Definition {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        for (index, (key, text)) in self.parts().enumerate() {
            let comma = if index > 0 { ", " } else { "" };
            write!(f, "{comma}{}: {}", key.name(), Bracketed(text))?;
        }
        Ok(())
    }
}

/// A text that has brackets where it is a list, so that its commas are not those between the parts.
struct Bracketed<'a>(&'a str);

impl fmt::Display for Bracketed<'_> {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        let mut depth = 0_i32;
        let lists = self.0.chars().any(|c| {
            depth += i32::from(matches!(c, '(' | '[')) - i32::from(matches!(c, ')' | ']'));
            c == ',' && depth == 0
        });
        if lists {
            write!(f, "[{}]", self.0)
        } else {
            f.write_str(self.0)
        }
    }
}
