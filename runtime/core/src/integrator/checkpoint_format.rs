//! Checkpoints in files: text formats contain the words as digits, binary formats as bytes.

use alloc::borrow::Cow;
use alloc::format;
use alloc::string::String;
use alloc::vec::Vec;
use core::fmt;

use serde::de::{self, Visitor};
use serde::{Deserialize, Deserializer, Serialize, Serializer};

use super::Checkpoint;

/// A checkpoint as a file contains it.
#[derive(Serialize, Deserialize)]
#[serde(deny_unknown_fields, rename = "Checkpoint")]
struct Record<'a> {
    /// The first files did not have it.
    #[serde(default = "first")]
    format: u32,
    version: String,
    method: String,
    definition: String,
    scalar: String,
    sums: String,
    solver: String,
    dimension: usize,
    words: Stored<'a>,
    /// Checksum of all fields before it.
    checksum: String,
}

/// The format of files without a number.
fn first() -> u32 {
    1
}

/// The words in a file.
enum Stored<'a> {
    /// Sixteen hexadecimal digits for each word.
    Digits(String),
    /// Eight bytes for each word, the lowest first.
    Bytes(Cow<'a, [u8]>),
}

impl Serialize for Checkpoint {
    fn serialize<S: Serializer>(&self, serializer: S) -> Result<S::Ok, S::Error> {
        let words = match serializer.is_human_readable() {
            true => Stored::Digits(digits(&self.words)),
            false => Stored::Bytes(Cow::Borrowed(&self.words)),
        };
        let record = Record {
            format: self.format,
            version: self.version.clone(),
            method: self.method.clone(),
            definition: self.definition.clone(),
            scalar: self.scalar.clone(),
            sums: self.sums.clone(),
            solver: self.solver.clone(),
            dimension: self.dimension,
            checksum: self.sum(&words),
            words,
        };
        record.serialize(serializer)
    }
}

impl<'de> Deserialize<'de> for Checkpoint {
    fn deserialize<D: Deserializer<'de>>(deserializer: D) -> Result<Self, D::Error> {
        let record = Record::deserialize(deserializer)?;
        let mut checkpoint = Self {
            format: record.format,
            version: record.version,
            method: record.method,
            definition: record.definition,
            scalar: record.scalar,
            sums: record.sums,
            solver: record.solver,
            dimension: record.dimension,
            words: Vec::new(),
            damage: None,
        };
        if record.checksum != checkpoint.sum(&record.words) {
            checkpoint.damage = Some("its checksum does not match its contents");
            return Ok(checkpoint);
        }
        let words = match record.words {
            Stored::Digits(text) => bytes(&text),
            Stored::Bytes(bytes) => Some(bytes.into_owned()),
        };
        match words {
            Some(words) => checkpoint.words = words,
            None => checkpoint.damage = Some("a word is not sixteen hexadecimal digits"),
        }
        Ok(checkpoint)
    }
}

impl Checkpoint {
    /// FNV-1a hash of all fields and the words: of the bytes of a text, of the words of bytes.
    fn sum(&self, words: &Stored<'_>) -> String {
        let mut hash = 0xcbf2_9ce4_8422_2325;
        let mut add = |text: &str| {
            // A byte that does not occur in text terminates each text.
            hash = text.bytes().chain([0xff]).fold(hash, |hash, byte| {
                (hash ^ u64::from(byte)).wrapping_mul(FACTOR)
            });
        };
        // The first files had no format.
        if self.format > 1 {
            add(&format!("{}", self.format));
        }
        add(&self.version);
        for (_, text) in self.header() {
            add(&text);
        }
        match words {
            Stored::Digits(text) => add(text),
            Stored::Bytes(bytes) => {
                let (words, rest) = bytes.as_chunks();
                let words = words.iter().map(|word| u64::from_le_bytes(*word));
                let rest = rest.iter().map(|&byte| u64::from(byte));
                // The upper half of each product is folded onto the lower one, or changes of two signs could cancel.
                hash = words.chain(rest).fold(hash, |hash, word| {
                    let product = (hash ^ word).wrapping_mul(FACTOR);
                    product ^ (product >> 32)
                });
            }
        }
        format!("{hash:016x}")
    }
}

/// The prime of FNV-1a.
const FACTOR: u64 = 0x0100_0000_01b3;

/// Words as text.
fn digits(words: &[u8]) -> String {
    let mut text = String::with_capacity(2 * words.len());
    for word in words.as_chunks::<8>().0 {
        for byte in word.iter().rev() {
            for digit in [byte >> 4, byte & 15] {
                text.push(char::from(b"0123456789abcdef"[usize::from(digit)]));
            }
        }
    }
    text
}

/// The words of a text, as bytes.
fn bytes(text: &str) -> Option<Vec<u8>> {
    let mut bytes = Vec::with_capacity(text.len() / 2);
    let (words, rest) = text.as_bytes().as_chunks::<16>();
    for word in words {
        let word = core::str::from_utf8(word).ok()?;
        bytes.extend_from_slice(&u64::from_str_radix(word, 16).ok()?.to_le_bytes());
    }
    rest.is_empty().then_some(bytes)
}

impl Serialize for Stored<'_> {
    fn serialize<S: Serializer>(&self, serializer: S) -> Result<S::Ok, S::Error> {
        match self {
            Self::Digits(text) => serializer.serialize_str(text),
            Self::Bytes(bytes) => serializer.serialize_bytes(bytes),
        }
    }
}

impl<'de> Deserialize<'de> for Stored<'_> {
    fn deserialize<D: Deserializer<'de>>(deserializer: D) -> Result<Self, D::Error> {
        match deserializer.is_human_readable() {
            true => String::deserialize(deserializer).map(Self::Digits),
            false => {
                let bytes = deserializer.deserialize_byte_buf(Bytes)?;
                Ok(Self::Bytes(Cow::Owned(bytes)))
            }
        }
    }
}

/// Receives bytes.
struct Bytes;

impl<'de> Visitor<'de> for Bytes {
    type Value = Vec<u8>;

    fn expecting(&self, formatter: &mut fmt::Formatter<'_>) -> fmt::Result {
        formatter.write_str("bytes")
    }

    fn visit_bytes<E: de::Error>(self, bytes: &[u8]) -> Result<Vec<u8>, E> {
        Ok(bytes.to_vec())
    }

    fn visit_byte_buf<E: de::Error>(self, bytes: Vec<u8>) -> Result<Vec<u8>, E> {
        Ok(bytes)
    }

    fn visit_seq<A: de::SeqAccess<'de>>(self, mut bytes: A) -> Result<Vec<u8>, A::Error> {
        let mut all = Vec::new();
        while let Some(byte) = bytes.next_element()? {
            all.push(byte);
        }
        Ok(all)
    }
}
