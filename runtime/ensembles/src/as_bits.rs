//! Serializes `f64` as its bits in sixteen hexadecimal digits: text formats may round decimals, and some have no 64-bit
//! integers.

use alloc::format;
use alloc::string::String;
use alloc::vec::Vec;

use serde::de::Error;
use serde::{Deserialize, Deserializer, Serializer};

pub(super) fn serialize<S: Serializer>(numbers: &[f64], serializer: S) -> Result<S::Ok, S::Error> {
    serializer.collect_seq(numbers.iter().map(|x| format!("{:016x}", x.to_bits())))
}

pub(super) fn deserialize<'de, D: Deserializer<'de>>(source: D) -> Result<Vec<f64>, D::Error> {
    let texts = Vec::<String>::deserialize(source)?;
    let double = |text: String| {
        let bits = u64::from_str_radix(&text, 16).map_err(D::Error::custom)?;
        Ok(f64::from_bits(bits))
    };
    texts.into_iter().map(double).collect()
}
