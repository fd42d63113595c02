//! The seeds of a test.

use std::ops::Range;

/// The usual ones, or those of `SYMPLECTIC_SEEDS=0..5000`, which widens the test by hand.
///
/// # Panics
/// Where that is not a range.
pub fn seeds(usual: Range<u64>) -> Range<u64> {
    let Ok(text) = std::env::var("SYMPLECTIC_SEEDS") else {
        return usual;
    };
    let ends = text.split_once("..");
    let (first, last) = ends.expect("SYMPLECTIC_SEEDS is a range like 0..5000");
    let seed = |text: &str| text.trim().parse().expect("a seed");
    seed(first)..seed(last)
}
