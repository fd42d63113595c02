//! Tableaux as text: a table for people, JSON for programs, TOML for lossless exchange.
//!
//! | format | written by | read by | holds |
//! |---|---|---|---|
//! | text | [`text::write`] | | exact entries where short, decimals otherwise, the properties |
//! | JSON | [`json::write`] | [`json::read`] | short exact forms, decimals, doubles, the properties |
//! | text and JSON of functions of a frequency | [`fitted::text`], [`fitted::json`] | | methods with `parameters` |
//! | TOML | [`toml::write`] | [`toml::read`] | all exact data, decimals, the properties |

use crate::coefficients::Coefficients;
use crate::exact::Exact;
use crate::tableau::{Tableau, left_out};

pub mod columns;
mod encoding;
mod entries;
mod facts;
pub mod fitted;
mod format;
pub mod json;
mod provenance;
pub mod text;
pub mod toml;

pub use crate::expression::without_mark;
pub use encoding::read_text;
pub(crate) use entries::compare;
#[doc(hidden)]
pub use entries::first_line;
#[doc(hidden)]
pub use facts::{Fact, separable_only};
pub(crate) use format::Format;

/// The default number of significant digits of decimals in JSON and TOML.
pub const DEFAULT_DIGITS: usize = 40;
/// The default number of significant digits of decimals in a text table.
pub const TEXT_DIGITS: usize = 16;
/// The largest number of significant digits of a decimal.
pub const MAX_DIGITS: usize = 10_000;

/// The largest number of significant digits that can be computed for a tableau within about ten seconds, at most [`MAX_DIGITS`].
///
/// A matrix entry for `s` algebraic nodes is a sum of `s²` products of numbers with as many digits.
pub fn most_digits(tableau: &Tableau) -> usize {
    /// A bound on the square of the digits times the cube of the stages.
    const MAX_WORK: u64 = 2_000_000_000_000;
    match &*tableau.exact {
        Exact::Nodes(_) => {
            let stages = tableau.stages().max(1) as u64;
            let digits = (MAX_WORK / stages.saturating_pow(3)).isqrt();
            // Rounded down to hundreds, but at least the number that is always allowed.
            usize::try_from(digits / 100 * 100).map_or(MAX_DIGITS, |n| n.clamp(100, MAX_DIGITS))
        }
        _ => MAX_DIGITS,
    }
}

/// The coefficients without the matrices that are left out.
pub fn written<T>(tableau: &Tableau, mut coefficients: Coefficients<T>) -> Coefficients<T> {
    if left_out(tableau).is_some() {
        (coefficients.a, coefficients.a_tilde) = (Vec::new(), Vec::new());
    }
    coefficients
}
