//! Numbers as words of 64 bits, for checkpoints.

use crate::number::{Scalar, Vector};

/// A visitor of words: it saves each word, or replaces it by a saved one.
pub type Visit<'a> = dyn FnMut(&mut u64) + 'a;

/// A value that consists of words of 64 bits: numbers, flags, and lists of them.
pub trait Words {
    /// Shows `visit` every word, in an order that depends only on the type and the lengths of lists.
    fn words(&mut self, visit: &mut Visit<'_>);
}

/// Visits the words of several values, one after another.
#[doc(hidden)]
#[macro_export]
macro_rules! words {
    ($visit:ident: $($value:expr),+ $(,)?) => {
        $( $crate::solver::Words::words(&mut $value, $visit); )+
    };
}
pub use words;

macro_rules! as_words {
    ($($type:ty: $to:expr, $from:expr;)+) => {
        $(
            impl Words for $type {
                fn words(&mut self, visit: &mut Visit<'_>) {
                    let (to, from): (fn($type) -> u64, fn(u64) -> $type) = ($to, $from);
                    let mut word = to(*self);
                    visit(&mut word);
                    *self = from(word);
                }
            }
        )+
    };
}

as_words! {
    u64: |x| x, |x| x;
    u32: u64::from, |x| x as u32;
    usize: |x| x as u64, |x| x as usize;
    bool: u64::from, |x| x != 0;
    f64: f64::to_bits, f64::from_bits;
}

impl Words for () {
    fn words(&mut self, _visit: &mut Visit<'_>) {}
}

impl<A: Words, B: Words> Words for (A, B) {
    fn words(&mut self, visit: &mut Visit<'_>) {
        words!(visit: self.0, self.1);
    }
}

impl<T: Words> Words for [T] {
    fn words(&mut self, visit: &mut Visit<'_>) {
        for value in self {
            value.words(visit);
        }
    }
}

impl<T: Words, const N: usize> Words for [T; N] {
    fn words(&mut self, visit: &mut Visit<'_>) {
        self.as_mut_slice().words(visit);
    }
}

impl<T: Words + Default> Words for Option<T> {
    fn words(&mut self, visit: &mut Visit<'_>) {
        let mut is_some = self.is_some();
        let mut value = self.take().unwrap_or_default();
        words!(visit: is_some, value);
        *self = is_some.then_some(value);
    }
}

/// Shows copies of the words of vectors.
pub fn show_vectors<V: Vector>(vectors: &[V], show: &mut Visit<'_>) {
    for &(mut copy) in vectors.iter().flat_map(V::as_slice) {
        copy.as_words(show);
    }
}

/// Visits the words of scalars.
pub fn scalar_words<T: Scalar>(scalars: &mut [T], visit: &mut Visit<'_>) {
    for scalar in scalars {
        scalar.as_words(visit);
    }
}

/// Visits the words of vectors.
pub fn vector_words<V: Vector>(vectors: &mut [V], visit: &mut Visit<'_>) {
    for vector in vectors {
        scalar_words(vector.as_mut_slice(), visit);
    }
}
