//! Output of a run: states, dense output, events, invariants, progress.

mod assert_conserved;
pub(crate) mod at_times;
pub(crate) mod brent;
pub(crate) mod dense;
pub(crate) mod event;
pub(crate) mod invariant;
pub(crate) mod progress;
pub(crate) mod states;

pub use crate::method::{Inside, Interpolation};
pub use dense::DenseOutput;
pub use event::{Event, Events, Moment};
pub use invariant::{Invariant, invariants, unit_of};
pub use progress::Progress;
pub use states::States;
