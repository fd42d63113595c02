//! Methods: derived, proved, written and read.
//!
//! `UPDATE_EXPECT=1 cargo test -p symplectic-compiler -- --include-ignored` writes the emitted code anew.

mod catalogue;
mod certified;
mod emission;
mod exchange;
mod extreme;
mod extreme_definitions;
mod golden;
mod gradient_kicks;
mod observed_order;
mod older_files;
mod perturbed;
mod processed;
mod properties;
mod refused_files;
mod splittings;
mod tiers;
