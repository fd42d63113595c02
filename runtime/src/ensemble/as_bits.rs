//! Doubles in files, as their bits: formats of text may round.

use alloc::vec::Vec;

use serde::{Deserialize, Deserializer, Serializer};

pub(super) fn serialize<S: Serializer>(numbers: &[f64], serializer: S) -> Result<S::Ok, S::Error> {
    serializer.collect_seq(numbers.iter().map(|x| x.to_bits()))
}

pub(super) fn deserialize<'de, D: Deserializer<'de>>(source: D) -> Result<Vec<f64>, D::Error> {
    let bits = Vec::<u64>::deserialize(source)?;
    Ok(bits.into_iter().map(f64::from_bits).collect())
}
