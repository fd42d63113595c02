//! Tableaux as text: a table for people, JSON for programs, TOML for lossless exchange.
//!
//! | format | written by | read by | holds |
//! |---|---|---|---|
//! | text | [`text::write`] | | exact entries where short, decimals otherwise, the properties |
//! | JSON | [`json::write`] | [`json::read`] | short exact forms, decimals, doubles, the properties |
//! | TOML | [`toml::write`] | [`toml::read`] | all exact data, decimals, the properties |

mod entries;
pub mod json;
mod layout;
mod origin;
pub mod text;
pub mod toml;

pub(crate) use entries::compare;

/// The significant digits of decimals in JSON and TOML, unless another number is asked for.
pub const DEFAULT_DIGITS: usize = 40;
/// The significant digits of decimals in a text table, unless another number is asked for.
pub const TEXT_DIGITS: usize = 16;
/// The most significant digits of a decimal that can be asked for.
pub const MAX_DIGITS: usize = 10_000;
