//! What a tableau is derived from: the texts that a person writes.

use std::collections::BTreeMap;
use std::fmt;

/// The parts of a definition.
#[derive(Debug, Clone, Copy, PartialEq, Eq, PartialOrd, Ord, Hash)]
pub enum Key {
    /// The functions in which velocities are approximated: `polynomial(3)`, `1, cos(pi*t), sin(pi*t)`.
    Basis,
    /// The nodes of the square construction: `lobatto(3)`, `0, 1/2, 1`.
    Nodes,
}

impl Key {
    /// All keys, in the order in which they are written.
    pub const ALL: [Key; 2] = [Key::Basis, Key::Nodes];

    /// The key as it is written in the macro and in files.
    pub fn name(self) -> &'static str {
        match self {
            Key::Basis => "basis",
            Key::Nodes => "nodes",
        }
    }

    /// The key of this name.
    pub fn find(name: &str) -> Option<Key> {
        Key::ALL.into_iter().find(|key| key.name() == name)
    }
}

/// What a tableau is derived from: `basis: polynomial(3), nodes: lobatto(3)`.
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
            write!(f, "{comma}{}: ", key.name())?;
            // A list has brackets, so that its commas are not those between the parts.
            if text.contains(',') && !text.starts_with('[') {
                write!(f, "[{text}]")?;
            } else {
                f.write_str(text)?;
            }
        }
        Ok(())
    }
}
