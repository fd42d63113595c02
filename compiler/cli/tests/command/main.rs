//! What the binary prints and refuses, one file for each command or format.
//!
//! `UPDATE_EXPECT=1 cargo test -p symplectic-cli -- --include-ignored` writes the forms and the catalogue of the book anew.

mod audit;
mod bad_input;
mod book;
mod certificates;
mod check;
mod coq;
mod emit;
mod emit_systems;
mod encodings;
mod equations;
mod fitted;
mod import;
mod languages;
mod list;
mod refine;
mod refine_tables;
mod run;
mod shown;
mod splittings;
mod systems;
