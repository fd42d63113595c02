//! Files of a single run: a table of its states, and checkpoints at intervals.
//!
//! Files are replaced as a whole: a run that is killed while it writes leaves the previous file.

mod recording;
mod replace;
mod run;

pub use crate::integrator::NamedSteps;
pub use recording::Recording;
pub use replace::{PeriodicFile, replace_file};
pub use run::{record_at, record_to};
