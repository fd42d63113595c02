//! Files of a single run: a table of its states, and checkpoints at intervals.
//!
//! Files are replaced as a whole: a run that is killed while it writes leaves the previous file.

#[cfg(feature = "npz")]
mod npz;
mod recording;
mod replace;
mod run;

#[cfg(feature = "npz")]
pub use npz::{Npz, NpzArray, NpzValues};
pub use recording::Recording;
pub use replace::{PeriodicFile, replace_file};
pub use run::{record_at, record_to};
pub use symplectic_core::stepper::NamedSteps;
