//! Hashes that identify a system in a checkpoint.

use alloc::vec::Vec;

use crate::number::vector::beside;
use crate::number::words::vector_words;
use crate::number::{Scalar, Vector};
use crate::system::{Class, System};

/// A hash of vectors. The upper half of each product is folded onto the lower half; otherwise it could miss changed signs of two
/// components.
pub fn hash<V: Vector>(vectors: &mut [V]) -> u64 {
    let mut found = 0_u64;
    vector_words(vectors, &mut |word| found = joined(found, *word));
    found
}

/// A hash of numbers. Those that are not finite count as zero, because the bits of NaN differ between machines.
pub(super) fn hash_of(numbers: Vec<f64>) -> u64 {
    let finite = |number: f64| if number.is_finite() { number } else { 0.0 };
    let words = numbers.into_iter().map(|number| finite(number).to_bits());
    words.fold(0, joined)
}

/// The hash of a hash and a word.
const fn joined(hash: u64, word: u64) -> u64 {
    let product = (hash ^ word).wrapping_mul(0x9e37_79b9_7f4a_7c15);
    product ^ (product >> 32)
}

/// Two hashes that identify a system. The first is of velocity and force at a state and at a second point, because symmetry may hide a
/// parameter at the first. The other is of friction or constraints at the second point.
pub fn system_fingerprint<V: Vector, S: System<V>>(
    system: &S,
    time: f64,
    q: &V,
    p: &V,
) -> [u64; 2] {
    let at = V::Scalar::from_f64(time);
    let mut found = [q, q, q, q].map(V::zeros_like);
    system.velocity(at, q, p, &mut found[0]);
    system.force(at, q, p, &mut found[1]);
    let (q, p) = (&beside(q), &beside(p));
    system.velocity(at, q, p, &mut found[2]);
    system.force(at, q, p, &mut found[3]);
    let mut numbers = Vec::new();
    S::Class::numbers(system, q, &mut |number| numbers.push(number));
    // The bits of NaN differ between machines.
    let known = |number: &mut V::Scalar| {
        if !number.is_finite() {
            *number = V::Scalar::from_f64(0.0);
        }
    };
    let vectors = found.iter_mut().flat_map(V::as_mut_slice);
    vectors.chain(&mut numbers).for_each(known);
    let mut others = 0;
    for number in &mut numbers {
        number.as_words(&mut |word| others = joined(others, *word));
    }
    [hash(&mut found), others]
}
