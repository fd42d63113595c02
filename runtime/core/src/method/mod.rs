//! Methods as the macros emit them, and their plans for one step.

pub(crate) mod composition;
pub(crate) mod coupled;
pub(crate) mod diagnosis;
pub(crate) mod explicit;
pub(crate) mod separable_only;
pub(crate) mod splitting;
pub(crate) mod splitting_macros;
pub(crate) mod symmetric_steps;
pub(crate) mod tableau_macro;

pub use composition::{Composition, CompositionMemory, Substep, Substeps};
pub use coupled::Coupled;
pub use explicit::Explicit;
pub use separable_only::{SeparableOnly, lower_triangular, rows};
pub use splitting::{Splitting, SplittingPlan, SplittingStep};
pub use splitting_macros::{composition, splitting};
pub use tableau_macro::tableau;

// The rooms above find a step and its plan here, too.
pub use crate::contract::*;
